"""The one error tree of the package.

::

    ViasplineError
    ├── MissionError        the mission is wrong: every fault at once          (exit code 2)
    ├── GeometryError       a curve, a world or an argument makes no sense     (exit code 2)
    ├── OutputError         a result can't be written                          (exit code 2)
    ├── SavedPlanError      a saved plan can't be read, or isn't what it says  (exit code 2)
    ├── StudioError         the studio can't be served                         (exit code 2)
    ├── WorkersError        those who were to do the work can't, or are gone   (exit code 2)
    ├── LinkError           a machine can't be reached, or doesn't do as told  (exit code 2)
    ├── MessageError        bytes or values make no such message of ROS        (exit code 2)
    ├── BagError            a log of a drive can't be read, or isn't one       (exit code 2)
    └── PlanningError       no path was laid: where, why, what would help
        ├── NoPathError     there is none: that is proven                      (exit code 3)
        └── GaveUpError     a budget ran out before it was known               (exit code 5)

Every error carries its data as attributes; its message names the thing and the remedy.

Tested through ``test_cli``.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any


def with_article(name: str) -> str:
    """A name with a or an before it, as it is spoken.

    >>> with_article("map"), with_article("OctoMap"), with_article("UInt8"), with_article("unseen")
    ('a map', 'an OctoMap', 'a UInt8', 'an unseen')
    """
    low = name.lower()
    spoken_as_you = low.startswith("u") and not (low.startswith("un") and low[2:3] != "i")
    return (
        f"an {name}" if low[:1] in ("a", "e", "i", "o", "u") and not spoken_as_you else f"a {name}"
    )


class ViasplineError(Exception):
    """Base of every error that viaspline raises on purpose.

    A copy, deep or pickled, says the same and carries the same data.
    """

    def __reduce__(self) -> tuple[Any, ...]:
        # An error is made of its data, not of the message that Python would hand to its class.
        return _as_it_was, (type(self), self.args, dict(self.__dict__))


def _as_it_was(
    kind: type[ViasplineError], args: tuple[Any, ...], data: dict[str, Any]
) -> ViasplineError:
    error = kind.__new__(kind)
    error.args = args
    error.__dict__.update(data)
    return error


class MissionWarning(UserWarning):
    """Something in a mission file is legal but can't be represented; it is named, not dropped."""


@dataclass(frozen=True)
class Change:
    """One change of a mission that would help, for programs that offer it.

    Attributes:
        key: Of what is to be changed, e.g. ``route.via[2].at``.
        value: What it is to be; None: it is to be left out.
    """

    key: str
    value: float | tuple[float, ...] | str | None


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong in a mission, and what would be right.

    Attributes:
        key: Where in the mission, e.g. ``route.via[2].at``.
        problem: What is wrong.
        remedy: What would be right.
        source: The file, or ``<mission>`` when it came from Python.
        line: Line in the file, from 1; ``None`` when there is no file.
        column: Column in the file, from 1.
        changes: What the remedy says, each by itself enough for this fault; it need not be all.
    """

    key: str
    problem: str
    remedy: str
    source: str = "<mission>"
    line: int | None = None
    column: int | None = None
    changes: tuple[Change, ...] = field(default=(), compare=False)

    def __str__(self) -> str:
        place = self.source if self.line is None else f"{self.source}:{self.line}:{self.column}"
        key = f" {self.key}:" if self.key else ""
        return f"{place}:{key} {self.problem}; {self.remedy}"


class MissionError(ViasplineError):
    """The mission is wrong.

    Attributes:
        faults: Every fault that was found, in the order of the file.
    """

    def __init__(self, faults: Sequence[Fault]) -> None:
        self.faults = tuple(faults)
        super().__init__("\n".join(str(fault) for fault in self.faults))


class GeometryError(ViasplineError, ValueError):
    """A curve, a world or an argument makes no geometric sense."""


class OutputError(ViasplineError):
    """A result can't be written.

    Attributes:
        path: The file or folder.
    """

    def __init__(self, path: object, problem: str) -> None:
        self.path = str(path)
        super().__init__(f"{self.path}: {problem}")


class SavedPlanError(ViasplineError):
    """A plan that was saved can't be read again, or doesn't prove what it says.

    Attributes:
        path: Its file.
    """

    def __init__(self, path: object, problem: str) -> None:
        self.path = str(path)
        super().__init__(f"{self.path}: {problem}")


class StudioError(ViasplineError):
    """The studio can't be served: something isn't installed, or its address can't be had."""


class WorkersError(ViasplineError):
    """Those who were to do pieces of the work can't be had, or died."""


class LinkError(ViasplineError):
    """A machine can't be reached, or doesn't do as it is told.

    Attributes:
        link: Its address, or its name.
        problem: What is wrong.
        remedy: What would help.
    """

    def __init__(self, link: object, problem: str, remedy: str) -> None:
        self.link, self.problem, self.remedy = str(link), problem, remedy
        super().__init__(f"{self.link}: {problem}; {remedy}")


class MessageError(ViasplineError):
    """Bytes or values make no such message of ROS, or its definition can't be read."""


class BagError(ViasplineError):
    """A log of a drive can't be read, is damaged, or holds nothing of what is asked.

    Attributes:
        path: The file or folder.
    """

    def __init__(self, path: object, problem: str) -> None:
        self.path = str(path)
        super().__init__(f"{self.path}: {problem}")


class PlanningError(ViasplineError):
    """No path was laid that serves every via point with the clearance that was asked for.

    Attributes:
        reason: What is in the way.
        where: The place [m], shape (d,).
        remedy: The least change that would serve, or would help.
        via: The via point that can't be served, if it is one.
        obstacles: The names of the obstacles in the way.
        changes: What the remedy says, each by itself; it need not be all. The route is the one
            that was planned, with its via points in the order in which they are served.
    """

    def __init__(
        self,
        reason: str,
        *,
        where: Iterable[float],
        remedy: str,
        via: str | None = None,
        obstacles: Sequence[str] = (),
        changes: Sequence[Change] = (),
    ) -> None:
        self.reason = reason
        self.where = tuple(float(x) for x in where)
        self.remedy = remedy
        self.via = via
        self.obstacles = tuple(obstacles)
        self.changes = tuple(changes)
        super().__init__(f"{reason}: {remedy}")


class NoPathError(PlanningError):
    """There is no path that serves every via point with the clearance that was asked for.

    It is proven that there is none, as closely as the search can see.
    """


class GaveUpError(PlanningError):
    """The search for a path ran out of a budget: there may be one.

    Attributes:
        tried: What was tried, each in words.
    """

    def __init__(
        self,
        reason: str,
        *,
        where: Iterable[float],
        remedy: str,
        tried: Sequence[str],
        via: str | None = None,
        obstacles: Sequence[str] = (),
        changes: Sequence[Change] = (),
    ) -> None:
        super().__init__(
            reason, where=where, remedy=remedy, via=via, obstacles=obstacles, changes=changes
        )
        self.tried = tuple(tried)
