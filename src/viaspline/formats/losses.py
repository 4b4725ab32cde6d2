"""What of a mission files of way points and fences can't carry: named, not dropped.

Tested through ``formats/test_waypoint_format``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any, Final

from viaspline.formats.interpret import SAME_STOP_M
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import KINDS
from viaspline.mission.shapes.rounded_ring import RoundedRing

_MAX_SHOWN: Final = 8
_POINT: Final = frozenset({"at", "dwell_s", "agl_m", "look_at"})
_NUMBERED: Final = re.compile(r"exclusion \d+")
_SHAPES: Final = frozenset(KINDS)


def losses(mission: Mission) -> tuple[tuple[str, str], ...]:
    """What way points and fences can't say of a mission, by kind: where.

    Whatever hasn't its default value and isn't written is there, keys of later versions too.

    >>> route = {"start": [0, 0], "goal": {"at": [9, 0], "name": "quay"}}
    >>> losses(Mission.model_validate({"route": route, "robot": {"radius_m": 2}}))
    (('name', 'route.goal'), ('robot', 'radius_m'))
    """
    kinds: dict[str, list[str]] = {}
    for kind, where in _found(mission):
        kinds.setdefault(kind, []).append(where)
    return tuple((kind, _listed(where)) for kind, where in kinds.items())


def _listed(names: list[str]) -> str:
    """Some of the names, and how many more there are.

    >>> _listed(["a", "b"])
    'a, b'
    """
    shown = ", ".join(filter(None, names[:_MAX_SHOWN]))
    return f"{shown} and {len(names) - _MAX_SHOWN} more" if len(names) > _MAX_SHOWN else shown


def _found(mission: Mission) -> Iterator[tuple[str, str]]:
    data = mission.model_dump(
        exclude_defaults=True, exclude={"world": {"known": {"__all__": {"grid", "voxels"}}}}
    )
    yield from _of_route(mission)
    yield from _of_world(mission, data.get("world", {}))
    for part in data:
        if part not in ("route", "world"):
            kept = {"max_speed_mps"} if part == "robot" else set()
            yield from ((part, key) for key in data[part] if key not in kept)


def _of_route(mission: Mission) -> Iterator[tuple[str, str]]:
    route = mission.route
    for key, point in route.points():
        yield from ((name, key) for name in _unsaid(point.model_dump(), _POINT))
    for (_, before), (key, point) in pairwise(route.points()):
        if math.dist(before.at[:2], point.at[:2]) < 2 * SAME_STOP_M:
            yield "points so near to the one before that they may be read as one", key
    if route.closed:
        yield "closed route, written as a way that ends at its start", ""
    if route.order != "given":
        yield "route", "order"
    if route.laps != 1:
        yield "route", "laps"
    if route.yaw is not None:
        yield "route", "yaw"
    if route.corridor is not None:
        yield "route", "corridor"
    if route.depart_s or route.hold_s:
        yield "route", "depart_s" if route.depart_s else "hold_s"


def _of_world(mission: Mission, data: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    world = mission.world
    if world.bounds is not None:
        yield "bounds, written as a fence", "world.bounds"
    for i, item in enumerate(world.known):
        key = f"world.known[{i}]"
        if item.motion is not None:
            yield "moving obstacle", item.name or key
            continue
        if item.grid is not None:
            yield "map of squares", key
        if item.ring is not None:
            yield from _of_ring(item.ring, key)
        elif item.capsule is not None:
            yield "capsule in space", key
        unsaid = item.model_dump(exclude={"grid"})
        yield from (
            (name, key) for name in _unsaid(unsaid, _SHAPES) if not _is_numbered(item.name, name)
        )
    for i, item in enumerate(world.unseen):
        yield "unseen obstacle", item.name or f"world.unseen[{i}]"
    for i, zone in enumerate(world.speed_zones):
        yield "speed zone", zone.name or f"world.speed_zones[{i}]"
    told = {"bounds", "fences", "known", "unseen", "speed_zones", "ground"}
    yield from (("world", key) for key in data if key not in told)


def _of_ring(ring: RoundedRing, key: str) -> Iterator[tuple[str, str]]:
    """By how much the polygon is larger that stands for a ring, where it isn't the ring itself."""
    if ring.radius > 0.0 and not ring.is_disc:
        millimetres = math.ceil(1e3 * ring.polygon_around()[1])
        larger = f"{key} (by up to {millimetres / 1e3:g} m)"
        yield "rounded outline, written as a larger polygon around it", larger


def _unsaid(data: Mapping[str, Any], said: frozenset[str]) -> Iterator[str]:
    """The keys with a value that isn't said."""
    return (key for key, value in data.items() if key not in said and value not in (None, (), []))


def _is_numbered(name: str | None, key: str) -> bool:
    """Whether this is the name that every exclusion area is given when it is read."""
    return key == "name" and name is not None and _NUMBERED.fullmatch(name) is not None
