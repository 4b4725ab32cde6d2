"""The parts of a mission that are structurally sound, each with its path.

A sound mission is a draft in which nothing is missing. If something is, the semantic checks still
run on the rest, so that the user hears of every fault at once.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from pydantic import TypeAdapter, ValidationError

from viaspline.mission.flaws import Path, children, spell
from viaspline.mission.parts import (
    EndPoint,
    MissionParts,
    Obstacle,
    Ring,
    RobotSpec,
    SplineSpec,
    ViaPoint,
    WorldSpec,
)
from viaspline.mission.structure import parts

Corners: TypeAlias = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Draft:
    """What could be read of a mission.

    Attributes:
        bounds: ``x_min, y_min, x_max, y_max`` [m].
        fences: Inclusion polygons.
        known: Obstacles on the map.
        unseen: Obstacles that the sensor has to find.
        robot: None if it is faulty.
        points: Start, via points, goal in order; None where one is faulty.
        closed: Whether the route is closed; None if that can't be said.
        has_goal: Whether there is a goal, sound or not.
        has_route: Whether the number of points is known.
        spline: None if it is faulty.
    """

    bounds: tuple[float, float, float, float] | None = None
    fences: list[tuple[Path, Corners]] = field(default_factory=list)
    known: list[tuple[Path, Obstacle]] = field(default_factory=list)
    unseen: list[tuple[Path, Obstacle]] = field(default_factory=list)
    robot: RobotSpec | None = None
    points: list[tuple[Path, ViaPoint | None]] = field(default_factory=list)
    closed: bool | None = None
    has_goal: bool = False
    has_route: bool = True
    spline: SplineSpec | None = None

    @classmethod
    def of(cls, mission: MissionParts) -> Draft:
        """A whole mission as a draft."""
        world, route = mission.world, mission.route
        points: list[tuple[Path, ViaPoint | None]] = [(("route", "start"), route.start)]
        points += [(("route", "via", i), via) for i, via in enumerate(route.via)]
        if route.goal is not None:
            points.append((("route", "goal"), route.goal))
        return cls(
            bounds=world.bounds,
            fences=[(("world", "fences", i), ring) for i, ring in enumerate(world.fences)],
            known=[(("world", "known", i), obstacle) for i, obstacle in enumerate(world.known)],
            unseen=[(("world", "unseen", i), obstacle) for i, obstacle in enumerate(world.unseen)],
            robot=mission.robot,
            points=points,
            closed=route.closed,
            has_goal=route.goal is not None,
            spline=mission.spline,
        )

    @classmethod
    def salvage(cls, data: Any) -> Draft:
        """What is sound in data that is not."""
        top = children(data) or {}
        world = children(top.get("world")) or {}
        route = children(top.get("route")) or {}
        bounds = _attempt(WorldSpec, {"bounds": world.get("bounds")})
        via = route.get("via", ())
        points: list[tuple[Path, ViaPoint | None]] = [
            (("route", "start"), _point(_END, route.get("start")))
        ]
        points += [(("route", "via", i), _point(_VIA, item)) for i, item in parts(via)]
        if route.get("goal") is not None:
            points.append((("route", "goal"), _point(_END, route["goal"])))
        closed = route.get("closed", False)
        return cls(
            bounds=bounds.bounds if bounds is not None else None,
            fences=_all(TypeAdapter(Ring), world, "fences"),
            known=_all(TypeAdapter(Obstacle), world, "known"),
            unseen=_all(TypeAdapter(Obstacle), world, "unseen"),
            robot=_robot(top.get("robot", {})),
            points=points,
            closed=closed if isinstance(closed, bool) else None,
            has_goal=route.get("goal") is not None,
            has_route=bool(route) and (isinstance(via, list | tuple) or hasattr(via, "tolist")),
            spline=_attempt(SplineSpec, top.get("spline", {})),
        )


_VIA = TypeAdapter(ViaPoint)
_END = TypeAdapter(EndPoint)


def _point(adapter: TypeAdapter[Any], value: Any) -> ViaPoint | None:
    if hasattr(value, "tolist"):
        value = value.tolist()
    data = {"at": value} if isinstance(value, list | tuple) else value
    point: ViaPoint | None = _validated(adapter, data)
    return point


def _robot(data: Any) -> RobotSpec | None:
    """The robot without what is faulty about it, unless that is its size."""
    given = children(data)
    if given is None:
        return None
    sound = {}
    for key in RobotSpec.model_fields.keys() & given.keys():
        if _attempt(RobotSpec, {key: given[key]}) is not None:
            sound[key] = given[key]
        elif key in ("radius_m", "clearance_m", "sensor"):
            return None
    robot: RobotSpec | None = _attempt(RobotSpec, sound)
    return robot


def _attempt(kind: type[Any], value: Any) -> Any:
    return _validated(TypeAdapter(kind), value)


def _validated(adapter: TypeAdapter[Any], value: Any) -> Any:
    try:
        return adapter.validate_python(value)
    except ValidationError:
        return None


def _all(adapter: TypeAdapter[Any], world: Any, key: str) -> list[Any]:
    items: Iterable[tuple[int, Any]] = parts(world.get(key))
    tried = ((("world", key, i), _validated(adapter, item)) for i, item in items)
    return [(path, value) for path, value in tried if value is not None]


def obstacle_label(path: Path, obstacle: Obstacle) -> str:
    """What an obstacle is called in a message."""
    return f"obstacle '{obstacle.name}'" if obstacle.name else f"obstacle {spell(path)}"
