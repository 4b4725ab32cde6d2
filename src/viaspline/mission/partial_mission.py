"""The parts of a mission that are structurally sound, each with its path.

A sound mission is a partial one in which nothing is missing. If something is, the semantic checks
still run on the rest, so that the user hears of every fault at once.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import Any

from pydantic import TypeAdapter, ValidationError

from viaspline.mission.corridor_spec import Corridor
from viaspline.mission.fields import Corners, Ring
from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.resolve_files import ResolvedFiles
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.route_spec import EndPoint, ViaPoint, as_point
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.space.spatial_parts import SpatialParts
from viaspline.mission.spline_spec import SplineSpec
from viaspline.mission.unplaced_faults import Path, children, list_items, spell
from viaspline.mission.world_spec import SpeedZone, WorldSpec


@dataclass(frozen=True)
class PartialMission:
    """What could be read of a mission.

    Attributes:
        bounds: ``x_min, y_min, x_max, y_max`` [m].
        fences: Inclusion polygons.
        zones: Polygons in which the robot is to be slower.
        known: Obstacles on the map.
        unseen: Obstacles that the sensor has to find.
        robot: None if it is faulty.
        points: Start, via points, goal in order; None where one is faulty.
        closed: Whether the route is closed; None if that can't be said.
        has_goal: Whether there is a goal, sound or not.
        has_route: Whether the number of points is known.
        spline: None if it is faulty.
        edge: Paths of the bounds or the fence that maps brought.
        corridor: What the route is to stay inside of; None if there is none, or it is faulty.
        laps: How often a closed route is driven; 1 if that can't be said.
        in_given_order: Whether the via points are served in the order in which they are given.
        robot_path: Where the robot stands in what was given.
        space: What there is in space only; None for a planar mission.
    """

    bounds: tuple[float, float, float, float] | None = None
    fences: list[tuple[Path, Corners]] = field(default_factory=list)
    zones: list[tuple[Path, Corners]] = field(default_factory=list)
    known: list[tuple[Path, Obstacle]] = field(default_factory=list)
    unseen: list[tuple[Path, Obstacle]] = field(default_factory=list)
    robot: RobotSpec | None = None
    points: list[tuple[Path, ViaPoint | None]] = field(default_factory=list)
    closed: bool | None = None
    has_goal: bool = False
    has_route: bool = True
    spline: SplineSpec | None = None
    edge: frozenset[Path] = frozenset()
    corridor: Corridor | None = None
    laps: int = 1
    in_given_order: bool = True
    robot_path: Path = ("robot",)
    space: SpatialParts | None = None

    @property
    def is_line(self) -> bool:
        """Whether a closed corridor says alone where the route goes round."""
        return bool(self.closed and self.corridor is not None and self.corridor.line is not None)

    @property
    def robot_or_point(self) -> RobotSpec:
        """The robot; a point for one that makes no sense, which may be inside of something, too."""
        return self.robot or RobotSpec(radius_m=0, clearance_m=0)

    def standing(self, misshapen: Collection[Path]) -> PartialMission:
        """It with what places can be held against: what stands, and has a usable shape.

        Args:
            misshapen: Paths of obstacles and fences that have none.
        """
        known = [one for one in self.known if one[0] not in misshapen and one[1].motion is None]
        fences = [one for one in self.fences if one[0] not in misshapen]
        bounds = self.bounds
        if bounds is not None and (bounds[0] >= bounds[2] or bounds[1] >= bounds[3]):
            bounds = None
        return replace(self, known=known, fences=fences, bounds=bounds)

    @classmethod
    def of(cls, mission: MissionParts, resolved: ResolvedFiles) -> PartialMission:
        """A whole mission as a partial one; obstacles of maps have the path of their map."""
        world, route = mission.world, mission.route
        points: list[tuple[Path, ViaPoint | None]] = [(("route", "start"), route.start)]
        points += [(("route", "via", i), via) for i, via in enumerate(route.via)]
        if route.goal is not None:
            points.append((("route", "goal"), route.goal))
        return cls(
            bounds=world.bounds,
            fences=[(("world", "fences", i), ring) for i, ring in enumerate(world.fences)],
            zones=_of_zones(enumerate(world.speed_zones), resolved),
            known=_placed(enumerate(world.known), "known", resolved),
            unseen=_placed(enumerate(world.unseen), "unseen", resolved),
            robot=mission.robot,
            points=points,
            closed=route.closed,
            has_goal=route.goal is not None,
            spline=mission.spline,
            edge=resolved.edge,
            corridor=route.corridor,
            laps=route.laps,
            in_given_order=route.order == "given",
            space=SpatialParts.of(mission, resolved.unread),
        )

    @classmethod
    def salvage(cls, resolved: ResolvedFiles) -> PartialMission:
        """What is sound in data that is not."""
        top = children(resolved.data) or {}
        world = children(top.get("world")) or {}
        route = children(top.get("route")) or {}
        bounds = _attempt(WorldSpec, {"bounds": world.get("bounds")})
        via = route.get("via", ())
        points: list[tuple[Path, ViaPoint | None]] = [
            (("route", "start"), _point(_END, route.get("start")))
        ]
        points += [(("route", "via", i), _point(_VIA, item)) for i, item in list_items(via)]
        if route.get("goal") is not None:
            points.append((("route", "goal"), _point(_END, route["goal"])))
        closed = route.get("closed", False)
        laps = route.get("laps", 1)
        return cls(
            bounds=bounds.bounds if bounds is not None else None,
            fences=_placed(_sound(TypeAdapter(Ring), world, "fences"), "fences", resolved),
            zones=_of_zones(_sound(TypeAdapter(SpeedZone), world, "speed_zones"), resolved),
            known=_placed(_sound(TypeAdapter(Obstacle), world, "known"), "known", resolved),
            unseen=_placed(_sound(TypeAdapter(Obstacle), world, "unseen"), "unseen", resolved),
            robot=_robot(top.get("robot", {})),
            points=points,
            closed=closed if isinstance(closed, bool) else None,
            has_goal=route.get("goal") is not None,
            has_route=bool(route) and (isinstance(via, list | tuple) or hasattr(via, "tolist")),
            spline=_attempt(SplineSpec, top.get("spline", {})),
            edge=resolved.edge,
            corridor=_attempt(Corridor, route.get("corridor")),
            laps=laps if isinstance(laps, int) else 1,
            in_given_order=route.get("order", "given") == "given",
            space=SpatialParts.salvage(top, resolved.unread),
        )


_VIA = TypeAdapter(ViaPoint)
_END = TypeAdapter(EndPoint)


def _point(adapter: TypeAdapter[Any], value: Any) -> ViaPoint | None:
    point: ViaPoint | None = _validated(adapter, as_point(value))
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
        elif key in ("radius_m", "footprint", "clearance_m", "sensor"):
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


def _sound(adapter: TypeAdapter[Any], world: Any, key: str) -> Iterator[tuple[int, Any]]:
    tried = ((i, _validated(adapter, item)) for i, item in list_items(world.get(key)))
    return ((i, value) for i, value in tried if value is not None)


def _placed(items: Iterable[tuple[int, Any]], key: str, resolved: ResolvedFiles) -> list[Any]:
    """Items of a list under ``world``, each with its path in the mission as it was given."""
    return [(resolved.original(("world", key, i)), value) for i, value in items]


def _of_zones(
    zones: Iterable[tuple[int, SpeedZone]], resolved: ResolvedFiles
) -> list[tuple[Path, Corners]]:
    placed = _placed(zones, "speed_zones", resolved)
    return [((*path, "polygon"), zone.polygon) for path, zone in placed]


def obstacle_label(path: Path, obstacle: Obstacle) -> str:
    """What an obstacle is called in a message."""
    kind = "obstacle" if obstacle.grid is None else "map"
    if obstacle.name:
        return f"{kind} '{obstacle.name}'"
    if obstacle.grid is not None and obstacle.grid.source is not None:
        return f"map '{obstacle.grid.source}'"
    return f"{kind} {spell(path)}"
