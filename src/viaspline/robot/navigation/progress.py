"""How far a robot has come.

Tested through ``robot/navigation/test_track_path``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.robot.controller import Controller

SAME_PLACE_M = 1e-6
"""Distances nearer than this are the same place [m]."""

REST_MPS = 1e-9
"""A robot that is slower is at rest: what a law ends with may be off by rounding [m/s]."""


@dataclass(frozen=True)
class Dwell:
    """A stay at a station: its name, where it is [m], and until when [s]."""

    name: str
    at: tuple[float, ...]
    until: float


@dataclass(frozen=True)
class Progress:
    """How far along its path a robot is at one moment, and how near to where it should be.

    Attributes:
        time: Of the last step [s]; with a drive, when what is decided in it happens.
        distance: Along the path [m]; it never goes back.
        cross_track: How far beside the path the robot is [m].
        along_track: How far it is from where its trajectory has it, forward is positive [m]; 0
            where that is so little that the trajectory stays.
        last_via: Index in the route of the last via point that was passed; -1 before the start.
        dwell: The stay at a station that is under way.
        finished: Whether the drive is over, at the goal or not.
        controller: The controller of a robot with a drive; None if it follows exactly.
        set_off: Whether there has been a step.
        facing: Which way a robot without a drive looks [rad]; None where it turns in no time.
    """

    time: float
    distance: float = 0.0
    cross_track: float = 0.0
    along_track: float = 0.0
    last_via: int = -1
    dwell: Dwell | None = None
    finished: bool = False
    controller: Controller | None = None
    set_off: bool = False
    facing: float | None = None
