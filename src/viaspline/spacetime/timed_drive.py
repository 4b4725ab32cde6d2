"""A path with a time law on which the robot is clear of what moves, and how it was come by.

Tested through ``spacetime/test_plan_among``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.solution import Solution
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.waits import TrafficWait


@dataclass(frozen=True)
class Passing:
    """A moving obstacle that a path leads round, as if it stood where it is at a time.

    Attributes:
        obstacle: Its name.
        side: On which side of it the robot goes.
        from_time: From when it is taken to stand there [s],
        until: and until when [s].
    """

    obstacle: str
    side: Side
    from_time: float
    until: float


@dataclass(frozen=True)
class TimedCandidate:
    """A path that was tried.

    Attributes:
        passings: What it leads round; nothing: the path among what stands, or one that was
            searched.
        length: [m].
        free_arrival: When the robot would arrive if nothing moved [s].
        arrival: When it arrives [s]; None if no law was found on it.
        reason: Why there is none, or why it wasn't looked for; None if there is one.
        chosen: Whether the plan takes it.
        is_searched: Whether its places and times were searched at once.
    """

    passings: tuple[Passing, ...]
    length: float
    free_arrival: float
    arrival: float | None
    reason: str | None = None
    chosen: bool = False
    is_searched: bool = False


@told_in_lines
@dataclass(frozen=True)
class TimedDrive:
    """A path and a law that are proven clear of what stands and of what moves.

    Attributes:
        solution: The path.
        trajectory: The law along it.
        certificate: The proven clearance to what moves.
        free: The law that would be driven if nothing moved.
        candidates: Every path that was tried, in the order in which they were.
        waits: Where the robot loses time to what moves, and to what.
    """

    solution: Solution
    trajectory: Trajectory
    certificate: MovingCertificate
    free: Trajectory
    candidates: tuple[TimedCandidate, ...] = ()
    waits: tuple[TrafficWait, ...] = ()
