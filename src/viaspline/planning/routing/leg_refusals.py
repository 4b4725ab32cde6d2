"""Why nothing leads from one via point to the next, and the least change that would allow it."""

from __future__ import annotations

import math

import numpy as np

from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.errors import Change, GaveUpError, NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.planning.problem.method import GaveUp
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import RouteVia, ViaSequence
from viaspline.planning.routing.asked_sides import AskedSides, sided
from viaspline.planning.routing.bottleneck import Bottleneck, bottleneck_between
from viaspline.planning.routing.free_rooms import places_reached
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

CURVE_SLACK_M = 2e-4  # beyond what is required, in which a curve may find no way through a gap
CURVE_ROOM_M = 1.1e-3  # in which it finds one: it turns a millimetre beyond what is required
CURVE_ROOM = 3e-4  # the same as a part of what is required, where that is more
NEAR_RADII = 2.0  # from a via point to the mouth of its pocket, in required distances


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


def is_blocked(sequence: ViaSequence, leg: int, world: World, requirements: Requirements) -> bool:
    """Whether it is proven that no way between two via points is wide enough."""
    start, goal = sequence.ends(leg)
    reach = 2.0 * (requirements.required - PROOF_SLACK_M)
    return bottleneck_between(world, start.at, goal.at, reach) is not None


def explain_blocked_leg(
    sequence: ViaSequence, leg: int, world: World, requirements: Requirements, barriers: Floats
) -> NoPathError:
    """Why there is no way between two via points."""
    start, goal = sequence.ends(leg)
    free = _way(start, goal, world, requirements.required) if len(barriers) else None
    if free is not None:
        return _forced(sequence, leg, world, requirements.required, free)
    moves, changes = _moves(sequence, leg, world, requirements.required)
    reach = 2.0 * (requirements.required + CURVE_SLACK_M)
    gap = bottleneck_between(world, start.at, goal.at, reach)
    if gap is None:
        return _just_enough(start, goal, world, requirements, moves, changes)
    if gap.is_shut:
        return _shut_off(start, goal, world, gap, requirements, moves, changes)
    remedy, change = _slimmer(0.5 * gap.width, requirements)
    remedies, changes = (*remedy, *moves), (*change, *changes)
    required = requirements.required
    return _too_narrow(start, goal, world, gap, required, 2.0 * required, remedies, changes)


def explain_narrow_leg(
    sequence: ViaSequence, leg: int, world: World, requirements: Requirements, gap: Bottleneck
) -> NoPathError:
    """Why a body gets from no via point to the next: all ways go through too narrow a gap."""
    start, goal = sequence.ends(leg)
    needed, kept = requirements.narrowest_gap, requirements.kept
    less = 0.5 * (needed - gap.width) + CURVE_ROOM_M
    clearance = _rounded_down(requirements.clearance - less)
    remedies: tuple[str, ...] = (f"widen it to more than {math.ceil(1e3 * needed) / 1e3:.3f} m",)
    changes: tuple[Change, ...] = ()
    if clearance >= 0.0:
        remedies = (f"set robot.clearance_m to at most {clearance:.3f}", *remedies)
        changes = (Change("robot.clearance_m", clearance),)
    elif gap.width > 2.0 * kept:
        width = _rounded_down(gap.width - 2.0 * kept)
        remedies = (f"the body may be at most {width:.3f} m wide there", *remedies)
    return _too_narrow(start, goal, world, gap, requirements.required, needed, remedies, changes)


def _shut_off(
    start: RouteVia, goal: RouteVia, world: World, gap: Bottleneck, requirements: Requirements,
    moves: tuple[str, ...], changes: tuple[Change, ...],
) -> NoPathError:  # fmt: skip
    """Where not even a point gets through."""
    obstacles = [owner for owner in gap.owners if owner >= 0] or gap.owners
    walls = tuple(world.name(owner) for owner in obstacles)
    needed = math.ceil(2e3 * (requirements.required + CURVE_ROOM_M)) / 1e3
    shut = "shuts" if len(walls) == 1 else "shut"
    return NoPathError(
        f"nothing leads from {start.name!r} to {goal.name!r}: {_listed(walls)} {shut} it off",
        where=goal.at,
        remedy=" or ".join((*moves, f"open a gap of {needed:.3f} m")),
        via=goal.name,
        obstacles=walls,
        changes=changes,
    )


def _too_narrow(
    start: RouteVia, goal: RouteVia, world: World, gap: Bottleneck, required: float,
    wide_enough: float, remedies: tuple[str, ...], changes: tuple[Change, ...],
) -> NoPathError:  # fmt: skip
    """Where the widest way is narrower than is wide enough [m]."""
    sides = tuple(dict.fromkeys(world.name(owner) for owner in gap.owners))
    between = f"in {sides[0]!r}" if len(sides) == 1 else f"between {sides[0]!r} and {sides[1]!r}"
    room, needed = _told_apart(gap.width, wide_enough)
    through = _towards(gap, start, goal, required)
    return NoPathError(
        f"no way from {start.name!r} to {goal.name!r} is wide enough: the best one {through} "
        f"a gap {between} at ({gap.at[0]:.2f}, {gap.at[1]:.2f}) with {room} m of "
        f"room, {needed} m are needed",
        where=gap.at,
        remedy=" or ".join(remedies) or f"widen it to more than {needed} m",
        via=goal.name,
        obstacles=sides,
        changes=changes,
    )


def _just_enough(
    start: RouteVia, goal: RouteVia, world: World, requirements: Requirements,
    moves: tuple[str, ...], changes: tuple[Change, ...],
) -> NoPathError:  # fmt: skip
    """Where no gap is too narrow: the via point that has less room stands where no curve fits."""
    room, index = world.nearest(np.array([start.at[:2], goal.at[:2]]))
    worse = int(np.argmin(room))
    via, nearest = (start, goal)[worse], world.name(int(index[worse]))
    remedy, change = _slimmer(float(room[worse]), requirements)
    has, needed = _told_apart(float(room[worse]), requirements.required)
    return NoPathError(
        f"no way from {start.name!r} to {goal.name!r} was found that leaves enough room for a "
        f"curve: {via.name!r} has {has} m to {nearest!r}, {needed} m are needed",
        where=via.at,
        remedy=" or ".join((*remedy, *moves)) or f"move {via.name!r} a little away",
        via=via.name,
        obstacles=(nearest,),
        changes=(*change, *changes),
    )


def _slimmer(room: float, requirements: Requirements) -> tuple[tuple[str, ...], tuple[Change, ...]]:
    """What would make a robot pass where there is so much room [m], in words and as changes."""
    most = min(room, requirements.required)
    most -= max(CURVE_ROOM_M, CURVE_ROOM * most)
    clearance = _rounded_down(most - requirements.radius - requirements.tracking_error)
    if clearance >= 0.0:
        words = f"set robot.clearance_m to at most {clearance:.3f}"
        return (words,), (Change("robot.clearance_m", clearance),)
    radius = _rounded_down(most - requirements.tracking_error)
    if radius <= 0.0:
        return (), ()
    instead = "" if requirements.clearance == 0.0 else "with robot.clearance_m 0 "
    return (f"{instead}the body's radius may be at most {radius:.3f} m there",), ()


def _rounded_down(length: float) -> float:
    """A length to the millimetre [m]."""
    return float(math.floor(length * 1e3) / 1e3)


def _moves(
    sequence: ViaSequence, leg: int, world: World, required: float
) -> tuple[tuple[str, ...], tuple[Change, ...]]:
    """The shorter of the moves of either via point that join the two, in words and as a change.

    A via point has to be reached from its other neighbour as well.
    """
    count = len(sequence.vias)
    movable: list[tuple[RouteVia, list[Floats]]] = []
    for index, step in (((leg + 1) % count, 1), (leg, -1)):
        via, beyond = sequence.vias[index], index + step
        others = [sequence.ends(leg)[0 if step == 1 else 1].at]
        if sequence.closed or 0 <= beyond < count:
            others.append(sequence.vias[beyond % count].at)
        if via.key:
            movable.append((via, others))
    if not movable:
        return (), ()
    wanted = [(via.at, others) for via, others in movable]
    found = [
        (float(np.hypot(*(place - via.at[:2]))), via, place)
        for (via, _), place in zip(movable, places_reached(wanted, world, required), strict=True)
        if place is not None
    ]
    if not found:
        return (), ()
    _, via, place = min(found, key=lambda move: move[0])
    words = f"move {via.name!r} to ({place[0]:.3f}, {place[1]:.3f})"
    return (words,), change_moving(via, place)


def _towards(gap: Bottleneck, start: RouteVia, goal: RouteVia, required: float) -> str:
    """How the best way goes to a gap: whether it is the mouth of a pocket."""
    away = [float(np.hypot(*(np.array(gap.at) - via.at[:2]))) for via in (start, goal)]
    if min(away) > NEAR_RADII * required:
        return "goes through"
    if away[0] <= away[1]:
        return f"leaves {start.name!r}, right behind it, through"
    return f"comes to {goal.name!r}, right behind it, through"


def _told_apart(width: float, needed: float) -> tuple[str, str]:
    """Two widths with as many digits as it takes to tell them apart, of the millimetre at least."""
    if width < needed:
        for digits in range(3, 9):
            shown = f"{width:.{digits}f}", f"{needed:.{digits}f}"
            if shown[0] != shown[1] and float(shown[0]) > 0.0:
                return shown
    return f"just {width:.3f}", f"more than {needed:.3f}"


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


def _way(start: RouteVia, goal: RouteVia, world: World, required: float) -> TautPath | None:
    """The shortest way on any side."""
    router = Router(world, required, np.array([start.at[:2], goal.at[:2]]))
    active = on_the_line(world, start.at, goal.at, required)
    return router.find(start.at, goal.at, NO_BARRIERS, active).value


def _listed(names: tuple[str, ...]) -> str:
    """The first few names, and how many more there are."""
    if not names:
        return "what stands there"
    shown = " and ".join(map(repr, names[:2]))
    return shown if len(names) <= 2 else f"{shown} and {len(names) - 2} more"
