"""What of a mission in space is structurally sound, beside what it shares with planar ones.

Tested through ``mission/space/test_spatial_checks``.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import TypeAdapter, ValidationError

from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.shapes.obstacle import HAVING_HEIGHTS
from viaspline.mission.space.altitude_spec import AltitudeSpec
from viaspline.mission.space.ground_spec import GroundSpec
from viaspline.mission.space.planar_keys import planar_keys_of
from viaspline.mission.space.takeoff_spec import AnyLanding, Landing, Takeoff
from viaspline.mission.unplaced_faults import Path, children, list_items

_GROUND: Path = ("world", "ground", "terrain")
_ROBOT_KEYS = ("half_height_m", "max_climb_mps", "max_descent_mps", "max_vertical_accel_mps2")
_ROUTE_KEYS = ("takeoff", "land", "yaw")
_POINT_KEYS = ("agl_m", "look_at", "gate")
_SHAPE_KEYS = ("height_m", *HAVING_HEIGHTS)


@dataclass(frozen=True)
class SpatialParts:
    """What could be read of it.

    Attributes:
        altitude: How low and how high it may be; None if nothing is said, or it is faulty.
        ground: The ground; None if there is none, or it is faulty.
        has_ground: Whether there is a ground, sound or not.
        takeoff: How it begins; None if it begins in the air, or that is faulty.
        has_takeoff: Whether it takes off, soundly or not.
        land: Where it lands; None if it doesn't, or that is faulty.
        has_land: Whether it lands, soundly or not.
        planar_keys: Keys that were given though they mean something in the plane only.
    """

    altitude: AltitudeSpec | None = None
    ground: GroundSpec | None = None
    has_ground: bool = False
    takeoff: Takeoff | None = None
    has_takeoff: bool = False
    land: Landing | None = None
    has_land: bool = False
    planar_keys: tuple[Path, ...] = ()

    @classmethod
    def of(cls, parts: MissionParts, unread: Collection[Path] = ()) -> SpatialParts | None:
        """Those of a whole mission; None if it is a planar one.

        Args:
            parts: The mission.
            unread: Paths of what asks for voxels or a terrain that couldn't be read.
        """
        if not parts.is_spatial and not unread:
            return None
        world, route = parts.world, parts.route
        return cls(
            altitude=world.altitude,
            ground=world.ground,
            has_ground=world.ground is not None or _GROUND in unread,
            takeoff=route.takeoff,
            has_takeoff=route.takeoff is not None,
            land=route.land,
            has_land=route.land is not None,
            planar_keys=tuple(planar_keys_of(parts)),
        )

    @classmethod
    def salvage(cls, top: Mapping[Any, Any], unread: Collection[Path] = ()) -> SpatialParts | None:
        """What is sound in data that is not; None if no key of it is one of space.

        Args:
            top: The data.
            unread: As in `of`.
        """
        if not has_spatial_keys(top) and not unread:
            return None
        world = children(top.get("world")) or {}
        route = children(top.get("route")) or {}
        return cls(
            altitude=_attempt(AltitudeSpec, world.get("altitude")),
            ground=_attempt(GroundSpec, world.get("ground")),
            has_ground=world.get("ground") is not None or _GROUND in unread,
            takeoff=_attempt(Takeoff, route.get("takeoff")),
            has_takeoff=route.get("takeoff") is not None,
            land=_attempt(AnyLanding, route.get("land")),
            has_land=route.get("land") is not None,
            planar_keys=tuple(planar_keys_of(top)),
        )


def has_spatial_keys(top: Mapping[Any, Any]) -> bool:
    """Whether any key of a mission's data, sound or not, is one of space.

    >>> has_spatial_keys({"world": {"known": [{"ball": {"radius": "wide"}}]}})
    True
    """
    world = children(top.get("world")) or {}
    robot = children(top.get("robot")) or {}
    route = children(top.get("route")) or {}
    points = [route.get("start"), route.get("goal")]
    points += (item for _, item in list_items(route.get("via")))
    return (
        _has(world, ("altitude", "ground"))
        or _has(robot, _ROBOT_KEYS)
        or _has(route, _ROUTE_KEYS)
        or any(_has(children(point) or {}, _POINT_KEYS) for point in points)
        or any(
            _is_solid(children(item) or {})
            for key in ("known", "unseen")
            for _, item in list_items(world.get(key))
        )
    )


def _has(data: Mapping[Any, Any], keys: tuple[str, ...]) -> bool:
    return any(data.get(key) is not None for key in keys)


def _is_solid(item: Mapping[Any, Any]) -> bool:
    capsule = children(item.get("capsule")) or {}
    ends = (capsule.get(key) for key in ("from", "from_", "to"))
    return (
        _has(item, _SHAPE_KEYS)
        or _moves_in_space(item.get("motion"))
        or any(isinstance(end, list | tuple) and len(end) == 3 for end in ends)
        or any(item.get(key) in ("over", "under") for key in ("pass_on", "never_pass_on"))
    )


def _moves_in_space(data: Any) -> bool:
    motion = children(data) or {}
    long = [(motion.get(key), 2) for key in ("from", "from_", "velocity_mps")]
    long += [(frame, 4) for _, frame in list_items(motion.get("keyframes"))]
    return any(isinstance(row, list | tuple) and len(row) > most for row, most in long)


def _attempt(kind: Any, value: Any) -> Any:
    try:
        return TypeAdapter(kind).validate_python(value)
    except ValidationError:
        return None
