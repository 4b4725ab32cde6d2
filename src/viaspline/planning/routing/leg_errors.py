"""Errors of legs whose reasons are found out when they are asked for.

Finding the least change that would serve takes many more searches than finding that there is no
way, and who has another way to try doesn't ask.

Tested through ``planning/methods/test_clear_spline``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from viaspline.errors import GaveUpError, NoPathError, PlanningError


class _ExplainedLaterError(PlanningError):
    """An error of a leg whose reason is found out when it is asked for."""

    def __init__(self, via: str, explain: Callable[[], PlanningError]) -> None:
        Exception.__init__(self)
        self.via = via
        self._explain = explain

    def __getattr__(self, name: str) -> Any:
        if name not in ("reason", "where", "remedy", "obstacles", "changes"):
            raise AttributeError(name)
        told = self._explain()
        self.reason, self.where, self.remedy = told.reason, told.where, told.remedy
        self.obstacles, self.changes = told.obstacles, told.changes
        return vars(self)[name]

    def __str__(self) -> str:
        return f"{self.reason}: {self.remedy}"


class BlockedLegError(_ExplainedLaterError, NoPathError):
    """No way leads from one via point to the next.

    Args:
        via: The via point that can't be reached.
        explain: Finds the reason.
    """


class UnfinishedLegError(_ExplainedLaterError, GaveUpError):
    """No way from one via point to the next was found before a budget ran out.

    Args:
        via: The via point that wasn't reached.
        explain: Finds out what would help.
        tried: What was tried, each in words.
    """

    def __init__(
        self, via: str, explain: Callable[[], PlanningError], tried: Sequence[str]
    ) -> None:
        super().__init__(via, explain)
        self.tried = tuple(tried)
