"""Either side of every group in the way: all candidates, the shortest taken, the rest kept.

The paper's rule, made exact. Obstacles that stand together are one group; where it blocks a leg,
the shortest way is sought on its left and on its right, past everything else that those ways meet;
the spline is regenerated through each, proven and measured, and the shorter one is taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viaspline.detour.blocked import explain_blocked_leg
from viaspline.detour.brief import Brief
from viaspline.detour.course import Course
from viaspline.detour.fit import Fitted, fit
from viaspline.detour.ledger import Candidate, LedgerEntry
from viaspline.detour.measure import measure
from viaspline.detour.route import NO_BARRIERS, Flags, Floats, Way, barrier, find_way
from viaspline.kernels.distance import mark_near_segment
from viaspline.mission.model import Side
from viaspline.world.world import World

SIDES: tuple[Side, Side] = ("left", "right")


@dataclass(frozen=True)
class Met:
    """A group that stands in the way of a leg: its members, and the one that is in the way."""

    members: tuple[int, ...]
    foremost: int


@dataclass(frozen=True)
class Passed:
    """A leg that was led round what stood in its way."""

    fitted: Fitted
    entries: tuple[LedgerEntry, ...]


def pass_groups(
    course: Course, leg: int, world: World, brief: Brief, hit: Sequence[int],
    groups: NDArray[np.int64],
) -> Passed:  # fmt: skip
    """Lead one leg round everything, by the shorter side of each group.

    Args:
        course: What there is so far.
        leg: The leg that comes too close to something.
        world: The known world.
        brief: What to keep.
        hit: Obstacles that the leg's curve comes too close to.
        groups: Label of every obstacle's group.

    Raises:
        NoPathError: When there is no way, with the least change that would serve.
    """
    start, goal = (via.at for via in course.ends(leg))
    active = np.zeros(len(world), np.bool_)
    active[list(hit)] = True
    barriers = _forced_barriers(world, np.flatnonzero(active), start, goal)
    best = find_way(world, start, goal, brief.required, barriers, active)
    mark_near_segment(world.packed, *start[:2], *goal[:2], brief.required, active)
    while (more := _forced_barriers(world, np.flatnonzero(active), start, goal)).size != barriers.size:
        barriers = more
        best = find_way(world, start, goal, brief.required, barriers, active)
    chosen = None if best is None else fit(course, leg, best, world, brief.required)
    if best is None or chosen is None:
        raise explain_blocked_leg(course, leg, world, brief, barriers)
    met = _groups_met(world, groups, hit, start, goal, brief.required)
    options = [
        _Option(side, *_other_side(course, leg, world, brief, group, side, barriers, active))
        for group in met
        for side in (_other(_side_of(best, world, group, start, goal)),)
    ]
    return _choose(course, leg, world, brief, chosen, met, options)


@dataclass(frozen=True)
class _Option:
    """The other side of a group: its fitted leg, or why there is none."""

    side: Side
    fitted: Fitted | None
    impossible: str | None


def _choose(
    course: Course, leg: int, world: World, brief: Brief, best: Fitted, met: Sequence[Met],
    options: Sequence[_Option],
) -> Passed:  # fmt: skip
    """Take the shortest of the measured curves, and write every candidate down."""
    measured = measure(best.spans, world, brief)
    names = course.ends(leg)[0].name, course.ends(leg)[1].name
    winner, shortest, swapped = best, measured.length, None
    rows: list[tuple[Candidate, Candidate]] = []
    for k, option in enumerate(options):
        here = _candidate(_other(option.side), best, leg, measured)
        if option.fitted is None:
            there = _impossible(option.side, option.impossible, len(best.spans[0, 0]))
        else:
            other = measure(option.fitted.spans, world, brief)
            there = _candidate(option.side, option.fitted, leg, other)
            if other.length < shortest - 1e-9:
                winner, shortest, swapped = option.fitted, other.length, k
        rows.append((here, there))
    entries = []
    for k, (group, (here, there)) in enumerate(zip(met, rows, strict=True)):
        pair = (here, replace(there, chosen=True)) if k == swapped else (
            replace(here, chosen=True), there)  # fmt: skip
        ordered = tuple(sorted(pair, key=lambda c: SIDES.index(c.side)))
        members = tuple(world.name(i) for i in group.members)
        entries.append(LedgerEntry(members, names, ordered))
    return Passed(winner, tuple(entries))


def _candidate(side: Side, fitted: Fitted, leg: int, measured: Candidate) -> Candidate:
    return replace(measured, side=side, vias=fitted.course.legs[leg].points, spans=fitted.spans)


def _impossible(side: Side, why: str | None, dimension: int) -> Candidate:
    return Candidate(
        side, np.empty((0, dimension)), np.empty((0, 4, dimension)), impossible=why
    )


def _other_side(
    course: Course, leg: int, world: World, brief: Brief, group: Met, side: Side,
    barriers: Floats, active: Flags,
) -> tuple[Fitted | None, str | None]:  # fmt: skip
    """The shortest way on the given side of a group, fitted."""
    for i in group.members:
        forced = world.obstacles[i].forced_side
        if forced is not None and forced != side:
            return None, f"the mission has {world.name(i)!r} passed on the {forced}"
    start, goal = (via.at for via in course.ends(leg))
    closed = barrier(world, group.foremost, _other(side), start, goal)
    way = find_way(
        world, start, goal, brief.required, np.vstack((barriers, closed)), active
    )
    if way is None:
        return None, f"no way is wide enough on the {side}"
    fitted = fit(course, leg, way, world, brief.required)
    return (fitted, None) if fitted else (None, "no spline along it is clear")


def _side_of(way: Way, world: World, group: Met, start: Floats, goal: Floats) -> Side:
    right = barrier(world, group.foremost, "right", start, goal)
    return "right" if way.crosses(right) else "left"


def _other(side: Side) -> Side:
    return "right" if side == "left" else "left"


def _forced_barriers(
    world: World, indices: NDArray[np.int64], start: Floats, goal: Floats
) -> Floats:
    """Barriers on the forbidden sides of those obstacles that may be passed on one side only."""
    rows = [
        barrier(world, int(i), _other(forced), start, goal)
        for i in indices
        if (forced := world.obstacles[i].forced_side) is not None
    ]
    return np.vstack(rows) if rows else NO_BARRIERS


def _groups_met(
    world: World, groups: NDArray[np.int64], hit: Sequence[int], start: Floats, goal: Floats,
    required: float,
) -> list[Met]:  # fmt: skip
    """The groups in the way of the straight line or of the curve, in the order of the leg."""
    found = np.zeros(len(world), np.bool_)
    mark_near_segment(world.packed, *start[:2], *goal[:2], required, found)
    found[list(hit)] = True
    indices = np.flatnonzero(found)
    along = goal[:2] - start[:2]
    indices = indices[np.argsort([_centre(world, i) @ along for i in indices], kind="stable")]
    met: dict[int, Met] = {}
    for i in indices.tolist():
        label = int(groups[i])
        if label not in met:
            met[label] = Met(tuple(np.flatnonzero(groups == label).tolist()), i)
    return list(met.values())


def _centre(world: World, index: int) -> Floats:
    obstacle = world.obstacles[index]
    if obstacle.circle is not None:
        return np.array(obstacle.circle.center)
    return np.mean(np.array(obstacle.polygon), axis=0)
