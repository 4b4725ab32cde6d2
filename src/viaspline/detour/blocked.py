"""Why there is no path, and the least change that would allow one."""

from __future__ import annotations

import numpy as np

from viaspline.curve.certificate import SPARE
from viaspline.detour.brief import Brief
from viaspline.detour.course import Course, RouteVia
from viaspline.detour.route import NO_BARRIERS, Floats, Router, Way, on_the_line
from viaspline.errors import NoPathError
from viaspline.kernels.corners import X, Y
from viaspline.kernels.segment import nearest_to_segment
from viaspline.world.world import World

BISECTIONS = 30


def refuse_blocked_vias(course: Course, world: World, brief: Brief) -> None:
    """Raise NoPathError for the first via point that has not the room that is required."""
    at = np.array([via.at[:2] for via in course.vias])
    distance, index = world.nearest(at)
    for via, room, nearest in zip(course.vias, distance, index, strict=True):
        if room < brief.required - SPARE:
            raise _no_room(via, float(room), int(nearest), world, brief)


def _no_room(via: RouteVia, room: float, index: int, world: World, brief: Brief) -> NoPathError:
    name = world.name(index)
    free = room - brief.radius
    place = _nearest_free(via.at, world, brief.required)
    moves = [] if place is None else [f"move it to ({place[0]:.3f}, {place[1]:.3f})"]
    if 0 <= free < brief.clearance:
        moves.append(f"set robot.clearance_m to at most {np.floor(free * 1000) / 1000:.3f}")
    missing = brief.required - room
    what = "outside" if index < -1 and room < 0 else f"{missing:.3f} m inside the clearance of"
    return NoPathError(
        f"via point {via.name!r} lies {what} {name!r}",
        where=via.at,
        remedy=" or ".join(moves) or "move it",
        via=via.name,
        obstacles=(name,),
    )


def _nearest_free(at: Floats, world: World, required: float) -> Floats | None:
    """A place near ``at`` with the room that is required: rings of growing radius, then closer."""
    angles = np.linspace(0, 2 * np.pi, 180, endpoint=False)
    ring = np.column_stack((np.cos(angles), np.sin(angles)))
    radius = max(required, 1e-3) * 0.05
    for _ in range(60):
        places = at[:2] + radius * ring
        free = np.flatnonzero(world.distance(places) >= required)
        if free.size:
            return _pulled_back(at[:2], places[free[0]], world, required)
        radius *= 1.25
    return None


def _pulled_back(at: Floats, place: Floats, world: World, required: float) -> Floats:
    low, high = 0.0, 1.0
    for _ in range(30):
        middle = 0.5 * (low + high)
        if world.distance(at + middle * (place - at)) >= required + 1e-3:
            high = middle
        else:
            low = middle
    found: Floats = at + high * (place - at)
    return found


def explain_blocked_leg(
    course: Course, leg: int, world: World, brief: Brief, barriers: Floats
) -> NoPathError:
    """Why there is no way between two via points."""
    start, goal = course.ends(leg)
    if len(barriers) and _way(start, goal, world, brief.required, NO_BARRIERS) is not None:
        return _forced(start, goal, world)
    opened = _widest(start, goal, world, brief.required)
    if opened is None:
        walls = _walls(start, goal, world)
        return NoPathError(
            f"nothing leads from {start.name!r} to {goal.name!r}: {_listed(walls)} shuts it off",
            where=goal.at,
            remedy=f"move {goal.name!r} to the side of {start.name!r}, or open a gap of "
            f"{2 * brief.required:.3f} m",
            via=goal.name,
            obstacles=walls,
        )
    required, way = opened
    place, index, width = _narrowest(way, world)
    name = world.name(index)
    clearance = np.floor((required - brief.radius) * 1000) / 1000
    if clearance >= 0:
        remedy = f"set robot.clearance_m to at most {clearance:.3f}"
    else:
        remedy = f"the body's radius may be at most {np.floor(required * 1000) / 1000:.3f} m there"
    return NoPathError(
        f"no way from {start.name!r} to {goal.name!r} is wide enough: the best one passes "
        f"{name!r} at ({place[0]:.2f}, {place[1]:.2f}) with {2 * width:.3f} m of room, "
        f"{2 * brief.required:.3f} m are needed",
        where=place,
        remedy=remedy,
        via=goal.name,
        obstacles=(name,),
    )


def explain_tight_leg(course: Course, leg: int, world: World, brief: Brief) -> NoPathError:
    """Why no spline along a leg is clear: one of its via points has no room for the curve."""
    start, goal = course.ends(leg)
    room, index = world.nearest(np.array([start.at[:2], goal.at[:2]]))
    worse = int(np.argmin(room))
    via = (start, goal)[worse]
    return NoPathError(
        f"the curve can't pass {via.name!r} with the clearance of "
        f"{world.name(int(index[worse]))!r}: it has {room[worse]:.4f} m, just what is required",
        where=via.at,
        remedy=f"move {via.name!r} a little away, or lower robot.clearance_m",
        via=via.name,
        obstacles=(world.name(int(index[worse])),),
    )


def _forced(start: RouteVia, goal: RouteVia, world: World) -> NoPathError:
    forced = tuple(
        world.name(i) for i, obstacle in enumerate(world.obstacles) if obstacle.forced_side
    )
    return NoPathError(
        f"from {start.name!r} to {goal.name!r} there is no way on the sides that are asked for",
        where=goal.at,
        remedy=f"drop pass_on or never_pass_on of {', '.join(map(repr, forced))}",
        via=goal.name,
        obstacles=forced,
    )


def _way(
    start: RouteVia, goal: RouteVia, world: World, required: float, barriers: Floats
) -> Way | None:
    router = Router(world, required, np.array([start.at[:2], goal.at[:2]]))
    active = on_the_line(world, start.at, goal.at, required)
    return router.find(start.at, goal.at, barriers, active)


def _widest(
    start: RouteVia, goal: RouteVia, world: World, required: float
) -> tuple[float, Way] | None:
    """The largest distance that a way can keep, and that way; None if there is no way at all."""
    low, high = 1e-6, required
    best = _way(start, goal, world, low, NO_BARRIERS)
    if best is None:
        return None
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        way = _way(start, goal, world, middle, NO_BARRIERS)
        if way is None:
            high = middle
        else:
            low, best = middle, way
        if high - low < 1e-4 * required:
            break
    return low, best


def _narrowest(way: Way, world: World) -> tuple[tuple[float, float], int, float]:
    """Where a way is tightest: place, what is nearest there, distance [m]."""
    tightest = (np.inf, -1, 0)
    for k in range(1, len(way.corners) - 1):
        a, b = way.corners[k, X : Y + 1], way.corners[k + 1, X : Y + 1]
        distance, index = nearest_to_segment(world.packed, a[0], a[1], b[0], b[1], np.inf)
        if distance < tightest[0]:
            tightest = (distance, index, k)
    distance, index, k = tightest
    corner = way.corners[k]
    return (float(corner[X]), float(corner[Y])), int(index), float(distance)


def _walls(start: RouteVia, goal: RouteVia, world: World) -> tuple[str, ...]:
    """The obstacles that the straight line between two via points meets."""
    found = on_the_line(world, start.at, goal.at, SPARE)
    return tuple(world.name(int(i)) for i in np.flatnonzero(found))


def _listed(names: tuple[str, ...]) -> str:
    """The first few names, and how many more there are."""
    if not names:
        return "what stands there"
    shown = " and ".join(map(repr, names[:2]))
    return shown if len(names) <= 2 else f"{shown} and {len(names) - 2} more"
