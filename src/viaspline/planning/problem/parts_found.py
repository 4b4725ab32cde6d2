"""What parts of a path come to while it is laid, so that none is sought twice.

Tested through ``planning/test_plan_path``.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field
from typing import Any, TypeVar

Value = TypeVar("Value")


@dataclass(eq=False)
class PartsFound:
    """What is found while one path is laid; once it is, nothing is kept any more.

    A plan goes on holding what it was laid with, and is read for long after: memory would grow.

    Attributes:
        found: What parts came to, by all that they depend on.
        is_laid: Whether the path is laid.

    Example:
        >>> parts = PartsFound()
        >>> parts.once("route", list) is parts.once("route", list)
        True
        >>> parts.forget()
        >>> parts.once("route", list) is parts.once("route", list)
        False
    """

    found: dict[Hashable, Any] = field(default_factory=dict)
    is_laid: bool = False

    def once(self, asked: Hashable, part: Callable[[], Value]) -> Value:
        """What a part comes to, or came to when it was asked before.

        Args:
            asked: All that the part depends on.
            part: Does it.
        """
        if self.is_laid:
            return part()
        if asked not in self.found:
            self.found[asked] = part()
        value: Value = self.found[asked]
        return value

    def forget(self) -> None:
        """The path is laid."""
        self.found.clear()
        self.is_laid = True

    def __reduce__(self) -> tuple[object, ...]:
        return PartsFound, ({}, True)  # a copy elsewhere is of a path that is laid
