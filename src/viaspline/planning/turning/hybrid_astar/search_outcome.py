"""What a search among poses is asked, and what it comes to.

Tested through ``planning/turning/hybrid_astar/test_pose_search``.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from viaspline.kernels.arrays import Floats


@dataclass(frozen=True)
class Pose:
    """A place [m] and the heading there [rad], which is driven through without curvature."""

    x: float
    y: float
    heading: float


@dataclass(frozen=True)
class Goal:
    """A place to get to.

    Attributes:
        x: [m].
        y: [m].
        headings: Those that it may be driven through with [rad]; if there are none, any.
    """

    x: float
    y: float
    headings: tuple[float, ...] = ()


class Reason(Enum):
    """Why no way was found."""

    START_TAKEN = "there is no room for the body at the start"
    GOAL_TAKEN = "there is no room for the body at the goal"
    START_SHUT_IN = "forwards, the robot can't get far from the start"
    GOAL_SHUT_IN = "forwards, the robot can't come to the goal from anywhere far"
    NO_WAY = "nothing that can be reached from the start leads to the goal"
    BUDGET = "the search was given up before it had seen everything"
    CLOSE = "a way was found only with turns that are a little sharper than they may be"

    @property
    def is_at_start(self) -> bool:
        """Whether it is about the place where the search began."""
        return self in (Reason.START_TAKEN, Reason.START_SHUT_IN)

    @property
    def is_proof(self) -> bool:
        """Whether all was seen, at the finest resolution."""
        return self not in (Reason.BUDGET, Reason.CLOSE)

    @property
    def is_of_goal(self) -> bool:
        """Whether it is about a place that isn't reached, wherever the search begins."""
        return self in (Reason.GOAL_TAKEN, Reason.GOAL_SHUT_IN)

    @property
    def is_of_turns(self) -> bool:
        """Whether sharper turns might change it."""
        return self not in (Reason.START_TAKEN, Reason.GOAL_TAKEN)


@dataclass(frozen=True)
class NotFound:
    """Nothing was found.

    Attributes:
        reason: Why. All but BUDGET and CLOSE mean that all was seen at the finest resolution: of
            the states in a cell of place, heading and curvature the search follows the first one,
            and the cells are small near the start and the goal and where it is tight. CLOSE is what
            that comes to where it may have overlooked a way.
        goal: Number of the goal that isn't reached from the one before.
        expanded: How many states were looked at.
        is_full: Whether there was no room for more states: with more of it another search may come
            to something else.
    """

    reason: Reason
    goal: int = 0
    expanded: int = 0
    is_full: bool = False


@dataclass(frozen=True)
class Chain:
    """A way.

    Attributes:
        segments: Curvature at the start and the end, and length, of its lines, arcs and ramps
            [1/m, 1/m, m], (n, 3).
        spans: The same as Bézier control polygons [m], (m, 4, 2): exactly through both ends, with
            continuous curvature, which is 0 at the ends.
        length: [m].
        start: Where it begins.
        end: Where it ends.
        expanded: How many states were looked at.
    """

    segments: Floats = field(repr=False)
    spans: Floats = field(repr=False)
    length: float
    start: Pose
    end: Pose
    expanded: int = 0
