"""What a search may spend, counted in work: the same search stops at the same place everywhere.

No clock is read. Work is counted in seconds of a reference machine: every step of a search that
takes its time says what it costs before it begins, by the sizes of what it is given. A step that
would cost more than is left isn't begun.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Protocol, Self, TypeVar

from viaspline.errors import GaveUpError
from viaspline.planning.problem.shared_searches import SharedSearches

LAY_S = 2e-3
"""What every path that is laid costs besides what it is made of [s]."""

ROUTE_S, LATTICE_S, GUIDE_S, GUIDE_OBSTACLE_S = 5e-4, 4e-3, 1e-3, 2e-6
"""Of a route between two places; of each lattice and each guide through one that it takes, and of
pulling that taut for each obstacle of the world [s]."""

FINE_ROUTE_OBSTACLES_S = 6e-5
"""Of a search of fine tangents, for each pair of obstacles that is met [s]."""

CONFLICTS_S, CONFLICTS_SPAN_S, CONFLICTS_BODY_SPAN_S = 1e-4, 1e-6, 4e-6
"""Of looking for conflicts: in all, for each span, and for each span if a polygon drives [s],"""

CONFLICTS_BODY_OBSTACLE_S, CONFLICTS_BODY_OBSTACLES = 2.5e-8, 1000
"""more for each obstacle, up to so many: of a larger world what is near is looked at [s]."""

PROOF_S, PROOF_SPAN_S, PROOF_BODY_S = 3e-4, 2e-6, 1.5e-3
"""Of a certificate: in all, for each span, and more if a polygon drives [s]."""

TURN_PATH_S, TURN_PATH_BEND_S = 5e-5, 2e-5
"""Of a turn path: in all, and for each bend [s]."""

TURN_WISHES_S, LOCAL_LEG_S = 2e-4, 5e-4
"""Of what its turns should be like, and of a leg that keeps to its line for as long as it may [s].
"""

PUSH_S = 3e-4
"""Of a run of spans that is pushed away from what it is too close to [s]."""

STRIP_S, STRIP_SPAN_S, STRIP_BODY_SPAN_S = 2e-3, 5e-5, 8e-5
"""To bend a run of a path less, as a strip under tension: in all, and for each of its spans, with a
disc and with a body on it [s]."""

HEADING_PAIR_BEND_S, HEADING_PAIR_BENDS_S = 1.2e-5, 1e-6
"""Of the length of a leg between two headings, for each bend, and for each pair of bends [s]."""

TREE_S, FIELD_CELL_S = 2e-3, 1e-7
"""Of a search among poses: to begin one, and for each cell of the lattice on which it is told how
far it is to its goal [s],"""

POSES_EFFORT_S = 2.5e-6
"""for each distance to the world that is reckoned in it, as much for some that are looked up, for
each connection that is tried and each move that is done [s]."""

GAPS_S, GAPS_OBSTACLE_S = 1e-3, 3e-5
"""Of the gaps that a body doesn't get through: in all, and for each obstacle [s]."""

PASSAGES_S = 2e-2
"""Of the narrow places of a leg that it is led by [s]."""

JERK_KNOT_S = 3e-5
"""Of a time law with a limit of the jerk, for each of its points [s]."""

TIME_LAW_S, JERK_LAW_S, LAW_AMONG_S = 1e-3, 1.5e-2, 8e-3
"""Of a time law, of one with a limit of the jerk, and of one past what moves [s]."""

STATE_S, STATE_MOVING_S = 5e-6, 8e-6
"""Of a state of a search over places and times: in all, and for each thing that moves [s]."""

DRIVE_AHEAD_S, DRIVE_AHEAD_SECOND_S = 5e-4, 7e-5
"""Of a drive ahead along a new path: to begin one, and for each second that it takes [s]."""


Value = TypeVar("Value")


class Part(Protocol):
    """A part of a search that is stopped and goes on, and changes as it does."""

    def copy(self) -> Self:
        """As far as it came."""
        ...


Progress = TypeVar("Progress", bound=Part)


class SpentBudgetError(GaveUpError):
    """A search was stopped because what it might spend was spent."""


def turn_path_s(bends: int) -> float:
    """What a turn path round a row of so many bends costs [s of the reference machine].

    >>> turn_path_s(3) == TURN_PATH_S + 3 * TURN_PATH_BEND_S
    True
    """
    return TURN_PATH_S + TURN_PATH_BEND_S * bends


@dataclass(eq=False)
class WorkBudget:
    """What a search may spend, and what it has spent so far.

    It is handed from method to method like a generator of random numbers, and like one it changes.

    Attributes:
        limit: [s of the reference machine].
        spent: [s of the reference machine].
        finished: What parts of the search came to that are over, by what they were asked: a robot
            that stands goes on with them in its next step.
        has_gained: Whether one of them is new.
        shared: Searches that the plans it is spent on have in common, if any.
        poses: What all searches among poses of the plans it is spent on may spend together; None:
            each as much as usual.

    Example:
        >>> budget = WorkBudget(0.01)
        >>> budget.spend(PROOF_S)
        >>> budget.spent
        0.0003
    """

    limit: float
    spent: float = 0.0
    finished: dict[Hashable, Any] = field(default_factory=dict, repr=False)
    has_gained: bool = False
    shared: SharedSearches | None = None
    poses: WorkBudget | None = field(default=None, repr=False)
    _under_way: list[Hashable] = field(default_factory=list, init=False, repr=False)
    """What was taken up for parts that aren't over yet, the first one first."""

    def once(self, asked: Hashable, part: Callable[[], Value]) -> Value:
        """What a part of the search comes to, or came to when it was asked before.

        What it took up is of no use once it is over, and is let go: a tree of poses has ten
        megabytes, and a search of a robot that stands may grow hundreds.

        Args:
            asked: All that the part depends on.
            part: Does it.
        """
        if asked not in self.finished:
            before = len(self._under_way)
            self.finished[asked] = part()
            for over in self._under_way[before:]:
                self.finished.pop(over, None)
            del self._under_way[before:]
            self.has_gained = True
        found: Value = self.finished[asked]
        return found

    def taken_up(self, asked: Hashable, begin: Callable[[], Progress]) -> Progress:
        """A part of the search that is stopped and goes on: as far as it came in the step before.

        It changes as it goes on, so that what the step before has of it is left as it was.

        Args:
            asked: All that the part depends on; the part it is taken up for is the only one to ask.
            begin: Begins it, if the step before has not.
        """
        part = self.finished[asked].copy() if asked in self.finished else begin()
        self.finished[asked] = part
        self._under_way.append(asked)
        taken: Progress = part
        return taken

    @property
    def left(self) -> float:
        """What may still be spent [s of the reference machine]."""
        return max(self.limit - self.spent, 0.0)

    @property
    def is_spent(self) -> bool:
        """Whether nothing is left."""
        return self.spent >= self.limit

    @contextmanager
    def share(self, most: float) -> Iterator[WorkBudget]:
        """A budget of its own for one of several tries, which all draw on this one.

        Args:
            most: It has no more than this, nor than what is left [s].

        Yields:
            What the try may spend. It is taken off this budget however the try ends; a try that is
            stopped because too little was left takes all of that.

        Example:
            >>> whole = WorkBudget(1.0)
            >>> with whole.share(0.2) as one:
            ...     one.spend(0.15)
            >>> whole.spent
            0.15
        """
        one = WorkBudget(min(most, self.left))
        try:
            yield one
        except SpentBudgetError:
            if one.limit < most:
                one.spent = one.limit
            raise
        finally:
            self.spent += one.spent

    @contextmanager
    def afterwards(self) -> Iterator[None]:
        """What is done once the search is over has no limit, and leaves the budget as it was.

        What a search found is told of when somebody asks for it, and takes some more work then.

        Example:
            >>> budget = WorkBudget(0.01, spent=0.01)
            >>> with budget.afterwards():
            ...     budget.spend(PROOF_S)
            >>> budget.is_spent
            True
        """
        before = vars(self).copy()
        self.limit, self.finished = math.inf, self.finished.copy()
        self._under_way = self._under_way.copy()
        try:
            yield
        finally:
            vars(self).update(before)

    def spend_on_part(self, cost: float) -> None:
        """Take off what a step costs of a part that the search takes up again [s].

        Raises:
            SpentBudgetError: When less is left.
        """
        self.spend(cost)
        self.has_gained = True

    def spend(self, cost: float) -> None:
        """Take off what the next step costs [s].

        Raises:
            SpentBudgetError: When less is left; then nothing is taken off.
        """
        if self.spent + cost > self.limit:
            raise SpentBudgetError(
                "the search was stopped: its time was up",
                where=(),
                remedy="let it go on in the steps to come, or plan anew: a plan has no such limit",
                tried=(f"what can be tried in {self.limit:.3g} s",),
            )
        self.spent += cost

    def affords(self, cost: float) -> bool:
        """Take off what the next step costs [s], if so much is left; whether it was.

        >>> budget = WorkBudget(0.01)
        >>> budget.affords(0.008), budget.affords(0.008), budget.spent
        (True, False, 0.008)
        """
        is_left = self.spent + cost <= self.limit
        if is_left:
            self.spent += cost
        return is_left
