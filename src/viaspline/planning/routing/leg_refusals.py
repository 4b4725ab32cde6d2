"""Why nothing leads from one via point to the next, and the least change that would allow it.

Tested through ``test_planner`` and ``planning/routing/test_lattice``.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.errors import Change, GaveUpError, NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.planning.problem.method import GaveUp
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import RouteVia, ViaSequence
from viaspline.planning.routing.asked_sides import AskedSides, sided
from viaspline.planning.routing.lattice_route import LatticeRoute
from viaspline.planning.routing.route_problem import NO_BARRIERS, on_the_line
from viaspline.planning.routing.router import Router
from viaspline.planning.routing.side_refusals import (
    changes_freeing,
    freeing_in_words,
    sides_in_words,
)
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.routing.via_refusals import change_moving
from viaspline.world.world import World

MAX_BISECTIONS = 30  # of the distance that a way can keep
WIDTH_RESOLUTION = 1e-4  # to which that is known, in required distances
MAX_GOALS_TRIED = 8  # places that are tried as a better goal
PLACES_ON_STRAIGHT = 201  # of each piece of a taut path, to find its tightest place


def explain_unfinished_leg(
    sequence: ViaSequence, leg: int, world: World, requirements: Requirements, barriers: Floats,
    gave_up: GaveUp,
) -> GaveUpError:  # fmt: skip
    """What would help where no way between two via points was found."""
    start, goal = sequence.ends(leg)
    told = explain_blocked_leg(sequence, leg, world, requirements, barriers)
    helps = [told.remedy, *([gave_up.would_help] if gave_up.would_help else [])]
    return GaveUpError(
        f"no way from {start.name!r} to {goal.name!r} was found, and none is ruled out",
        where=goal.at,
        remedy=" or ".join(helps),
        tried=gave_up.tried,
        via=goal.name,
        obstacles=told.obstacles,
        changes=told.changes,
    )


def explain_blocked_leg(
    sequence: ViaSequence, leg: int, world: World, requirements: Requirements, barriers: Floats
) -> NoPathError:
    """Why there is no way between two via points."""
    start, goal = sequence.ends(leg)
    if len(barriers):
        free = _way(start, goal, world, requirements.required, NO_BARRIERS)
        if free is not None:
            return _forced(sequence, leg, world, requirements.required, free)
    opened = _widest(start, goal, world, requirements.required)
    moved = reachable_near(start.at, goal.at, world, requirements.required)
    moves = [] if moved is None else [f"move {goal.name!r} to ({moved[0]:.3f}, {moved[1]:.3f})"]
    changes = change_moving(goal, moved)
    if opened is None:
        walls = _walls(start, goal, world)
        moves.append(f"open a gap of {2 * requirements.required:.3f} m")
        return NoPathError(
            f"nothing leads from {start.name!r} to {goal.name!r}: {_listed(walls)} shuts it off",
            where=goal.at,
            remedy=" or ".join(moves),
            via=goal.name,
            obstacles=walls,
            changes=changes,
        )
    required, taut_path = opened
    gap = _narrowest(taut_path, world)
    clearance = np.floor((required - requirements.radius) * 1000) / 1000
    if clearance >= 0:
        moves.insert(0, f"set robot.clearance_m to at most {clearance:.3f}")
        changes = (Change("robot.clearance_m", float(clearance)), *changes)
    else:
        most = np.floor(required * 1000) / 1000
        moves.insert(0, f"the body's radius may be at most {most:.3f} m there")
    room, needed = _told_apart(gap.width, 2 * requirements.required)
    return NoPathError(
        f"no way from {start.name!r} to {goal.name!r} is wide enough: the best one goes through "
        f"a gap {gap.between} at ({gap.at[0]:.2f}, {gap.at[1]:.2f}) with {room} m of "
        f"room, {needed} m are needed",
        where=gap.at,
        remedy=" or ".join(moves),
        via=goal.name,
        obstacles=gap.sides,
        changes=changes,
    )


def _told_apart(width: float, needed: float) -> tuple[str, str]:
    """Two widths with as many digits as it takes to tell them apart, of the millimetre at least."""
    for digits in range(3, 9):
        shown = f"{width:.{digits}f}", f"{needed:.{digits}f}"
        if shown[0] != shown[1]:
            return shown
    return f"just {width:.3f}", f"more than {needed:.3f}"


def reachable_near(start: Floats, goal: Floats, world: World, required: float) -> Floats | None:
    """A place near ``goal`` that ``start`` has a way to, to within a lattice's cell.

    Returns:
        Shape (2,) [m]; None where none was found.
    """
    router = Router(world, required, np.array([start[:2], goal[:2]]))
    closed, place = NO_BARRIERS, goal
    for _ in range(MAX_GOALS_TRIED):
        closed = LatticeRoute().followed(router, router.lattice, start, place, closed).closed
        candidate = _nearest_in_room(router, start, goal, closed)
        if candidate is None:
            return None
        nothing_met = np.zeros(len(world), np.bool_)
        if router.find(start, candidate, NO_BARRIERS, nothing_met).value is not None:
            return candidate
        place = candidate
    return None


def _nearest_in_room(router: Router, start: Floats, goal: Floats, closed: Floats) -> Floats | None:
    """The middle of a free cell that is connected to the start's, as near to the goal as can be."""
    from scipy.ndimage import label

    lattice = router.lattice.without(closed)
    rooms: NDArray[Any] = label(lattice.cells == 0)[0]
    here = lattice.at(rooms, start[None, :2])[0]
    if here == 0:
        return None
    rows, columns = np.nonzero(rooms == here)
    free = (np.column_stack((columns, rows)) + 0.5) * lattice.side + (lattice.x, lattice.y)
    free = free[np.argsort(np.hypot(*(free - goal[:2]).T), kind="stable")]
    for some in np.array_split(free, max(1, len(free) // 1000)):
        roomy = np.flatnonzero(router.world.distance(some) >= router.required + 1e-3)
        if roomy.size:
            nearest: Floats = some[roomy[0]]
            return nearest
    return None


def explain_tight_leg(
    sequence: ViaSequence,
    leg: int,
    world: World,
    requirements: Requirements,
    tried: tuple[str, ...],
) -> GaveUpError:
    """Where no spline along a leg was found that is clear: at a via point with just enough room."""
    start, goal = sequence.ends(leg)
    room, index = world.nearest(np.array([start.at[:2], goal.at[:2]]))
    worse = int(np.argmin(room))
    via = (start, goal)[worse]
    return GaveUpError(
        f"no curve was found that passes {via.name!r} with the clearance of "
        f"{world.name(int(index[worse]))!r}: it has {room[worse]:.4f} m, "
        f"{requirements.required:.4f} m are required",
        where=via.at,
        remedy=f"move {via.name!r} a little away, or lower robot.clearance_m",
        tried=tried,
        via=via.name,
        obstacles=(world.name(int(index[worse])),),
    )


def _forced(
    sequence: ViaSequence, leg: int, world: World, required: float, free: TautPath
) -> NoPathError:
    """Where there is a way, but not on the sides that are asked for."""
    start, goal = sequence.ends(leg)
    indices = sided(world)
    sides = AskedSides.of(
        sequence.whole_leg(leg), indices, world, required, lambda: np.arange(len(world))
    )
    wrong = sides.with_binding(indices.tolist()).gone_round(free.corners[:, X : Y + 1])
    forced = (wrong if wrong.size else indices).tolist()
    return NoPathError(
        f"from {start.name!r} to {goal.name!r} there is no way on the sides that are asked for: "
        f"none passes {sides_in_words(world, forced)}",
        where=goal.at,
        remedy=freeing_in_words(world, forced),
        via=goal.name,
        obstacles=tuple(world.name(i) for i in forced),
        changes=changes_freeing(world, forced),
    )


def _way(
    start: RouteVia, goal: RouteVia, world: World, required: float, barriers: Floats
) -> TautPath | None:
    router = Router(world, required, np.array([start.at[:2], goal.at[:2]]))
    active = on_the_line(world, start.at, goal.at, required)
    return router.find(start.at, goal.at, barriers, active).value


def _widest(
    start: RouteVia, goal: RouteVia, world: World, required: float
) -> tuple[float, TautPath] | None:
    """The largest distance that a way can keep, and that way; None if there is no way at all."""
    low, high = 1e-6, required
    best = _way(start, goal, world, low, NO_BARRIERS)
    if best is None:
        return None
    for _ in range(MAX_BISECTIONS):
        middle = 0.5 * (low + high)
        taut_path = _way(start, goal, world, middle, NO_BARRIERS)
        if taut_path is None:
            high = middle
        else:
            low, best = middle, taut_path
        if high - low < WIDTH_RESOLUTION * required:
            break
    return low, best


class _Gap(NamedTuple):
    """The narrowest place of a way: where [m], how wide [m], and what stands on either side."""

    at: tuple[float, float]
    width: float
    sides: tuple[str, ...]

    @property
    def between(self) -> str:
        """The sides in words."""
        return "beside " + repr(self.sides[0]) if len(self.sides) == 1 else _pair(self.sides)


def _pair(names: tuple[str, ...]) -> str:
    return f"between {names[0]!r} and {names[1]!r}"


def _narrowest(taut_path: TautPath, world: World) -> _Gap:
    """Where a way is tightest."""
    w = np.linspace(0.0, 1.0, PLACES_ON_STRAIGHT)[:, None]
    corners = taut_path.corners[:, X : Y + 1]
    places = np.vstack([a + w * (b - a) for a, b in pairwise(corners)])
    inner = places[2:-2] if len(places) > 4 else places
    distance, index = world.nearest(inner)
    k = int(np.argmin(distance))
    at, room = inner[k], float(distance[k])
    step = 1e-3 * max(room, 1e-6)
    away = world.distance(at + step * np.eye(2)) - room
    size = float(np.hypot(*away))
    sides = [world.name(int(index[k]))]
    if size > 0.0:
        opposite = int(world.nearest(at + 0.5 * room * away / size)[1])
        sides.append(world.name(opposite))
    return _Gap((float(at[0]), float(at[1])), 2.0 * room, tuple(dict.fromkeys(sides)))


def _walls(start: RouteVia, goal: RouteVia, world: World) -> tuple[str, ...]:
    """The obstacles that the straight line between two via points meets."""
    found = on_the_line(world, start.at, goal.at, PROOF_SLACK_M)
    return tuple(world.name(int(i)) for i in np.flatnonzero(found))


def _listed(names: tuple[str, ...]) -> str:
    """The first few names, and how many more there are."""
    if not names:
        return "what stands there"
    shown = " and ".join(map(repr, names[:2]))
    return shown if len(names) <= 2 else f"{shown} and {len(names) - 2} more"
