"""What of a mission decides which kernels it needs.

Numbers don't: a kernel is compiled for the types of its arguments. What counts is which parts a
mission has: a lidar or a sensor that tells of obstacles, a drive, a body, a turning circle.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.model import Mission

PARTS: Final = (
    "lidar",
    "differential",
    "ackermann",
    "skid_steer",
    "omnidirectional",
    "localization",
    "footprint",
    "turning",
    "jerk",
    "yaw",
    "map",
    "moving",
    "passive",
    "laps",
    "corridor",
    "zones",
    "space",
)
"""All that a mission can have that needs kernels of its own."""


@dataclass(frozen=True)
class MissionKind:
    """Which kernels a mission needs.

    Attributes:
        parts: What it has, of ``PARTS``, in that order.
        is_fleet: Whether it is one of a fleet's.

    >>> MissionKind(("lidar", "footprint")).name
    'lidar+footprint'
    """

    parts: tuple[str, ...] = ()
    is_fleet: bool = False

    @property
    def name(self) -> str:
        """What it has, in a word."""
        words = (*(("fleet",) if self.is_fleet else ()), *self.parts)
        return "+".join(words) or "plain"


def kind_of(mission: Mission, *, is_fleet: bool = False) -> MissionKind:
    """The kind of a mission.

    Args:
        mission: It.
        is_fleet: Whether it is driven in a fleet.

    Example:
        >>> from viaspline.mission.model import Mission
        >>> kind_of(Mission.model_validate({
        ...     "robot": {"sensor": {"lidar": {"range_m": 5}}, "min_turn_radius_m": 2},
        ...     "route": {"start": [0, 0], "goal": [9, 0]},
        ... })).name
        'lidar+turning'
    """
    robot, route, world = mission.robot, mission.route, mission.world
    if mission.is_spatial:
        return MissionKind(("space",), is_fleet)
    drive = robot.drive
    has = {
        "lidar": robot.sensor is not None and robot.sensor.lidar is not None,
        "localization": drive is None and robot.localization is not None,
        "footprint": robot.footprint is not None,
        "turning": robot.turn_radius is not None,
        "jerk": robot.max_jerk_mps3 is not None,
        "yaw": robot.max_yaw_rate_degps is not None or robot.max_yaw_accel_degps2 is not None,
        "map": any(one.grid is not None for one in (*world.known, *world.unseen)),
        "moving": any(one.motion is not None for one in world.known),
        "passive": robot.moving is not None,
        "laps": route.laps > 1,
        "corridor": route.corridor is not None,
        "zones": bool(world.speed_zones),
    }
    if drive is not None:
        has |= {name: getattr(drive, name) is not None for name in PARTS[1:5]}
    return MissionKind(tuple(part for part in PARTS if has.get(part)), is_fleet)


def kinds_of(asked: Mission | Fleet) -> tuple[MissionKind, ...]:
    """The kinds of a mission, or of all members of a fleet, each once."""
    from viaspline.mission.model import Mission

    if isinstance(asked, Mission):
        return (kind_of(asked),)
    found = (kind_of(one.mission, is_fleet=True) for one in asked.members)
    return tuple(dict.fromkeys(found))


def kind_named(name: str) -> MissionKind:
    """The kind that has a name.

    >>> kind_named("fleet+turning") == MissionKind(("turning",), is_fleet=True)
    True
    """
    words = name.split("+")
    return MissionKind(tuple(part for part in PARTS if part in words), "fleet" in words)
