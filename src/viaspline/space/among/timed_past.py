"""A path in space timed past all that moves in its mission, and proven.

Tested through ``space/among/test_plan_past_moving`` and ``space/online/test_fly_among``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.law_past_moving import law_past_moving, proven_past_moving
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.waits import TrafficWait

WATCHED_SHARE: Final = 4.0
WATCHED_S: Final = 300.0
"""What moves is looked at for so many times as long as the robot would fly, and for so long more
[s]; who hasn't arrived by then has no law."""


@dataclass(frozen=True, eq=False)
class TimedPast:
    """A law past what moves.

    Attributes:
        trajectory: It.
        proof: How far the robot stays from what moves.
        waits: Where it loses time, and for what.
    """

    trajectory: Trajectory
    proof: MovingCertificate
    waits: tuple[TrafficWait, ...]


def solids_beside(mission: Mission, law: Trajectory, hold: float) -> tuple[MovingSolid, ...]:
    """What moves in a mission, for as long as it is looked at beside a law.

    Args:
        mission: In space.
        law: The fastest one of a path; what moves begins when it does.
        hold: How long the robot stays at the end [s].
    """
    until = law.start_time + WATCHED_SHARE * law.duration + WATCHED_S + hold
    return MovingSolid.all_of(mission, law.start_time, until)


def timed_past(
    path: Path, static: Trajectory, limits: SpatialLimits, mission: Mission,
    moving: Sequence[MovingSolid],
) -> TimedPast | str:  # fmt: skip
    """The law of a path past what moves, proven; or the name of what it can't let pass.

    Args:
        path: In space.
        static: The fastest law along it if nothing moved.
        limits: Of the drive.
        mission: Whose robot it is, and how long its goal has to stay free.
        moving: What moves, from the law's beginning on.

    Raises:
        GaveUpError: The path and the ways of what moves come near each other in too many places.
    """
    hold = mission.route.hold_s
    past = law_past_moving(path, static, hold, limits, kept_about(mission), moving)
    if isinstance(past, str):
        return past
    proof = proven_beside(path, past.trajectory, hold, mission, moving)
    until = min(float(one.times[-1]) for one in moving)
    if past.trajectory.end_time + hold > until or not proof.holds:
        return proof.obstacle or moving[0].name
    return TimedPast(past.trajectory, proof, past.waits)


def proven_beside(
    path: Path, law: Trajectory, hold: float, mission: Mission, moving: Sequence[MovingSolid]
) -> MovingCertificate:
    """How far a mission's robot stays from what moves, proven over continuous time.

    Args:
        path: In space.
        law: The time law along it.
        hold: How long the robot stays at the end after that [s].
        mission: Whose robot it is.
        moving: What moves, from the law's beginning until then.
    """
    radius, half, margin = kept_about(mission)
    clearance = mission.robot.clearance_m
    bare = (radius, half, margin - clearance)
    return proven_past_moving(path, law, hold, bare, clearance, moving)


def kept_about(mission: Mission) -> tuple[float, float, float]:
    """Radius and half height of the robot's cylinder, and what is kept about it [m]."""
    body = FlyingBody.of(mission.robot)
    return body.radius, body.half_height, body.margin + mission.robot.clearance_m
