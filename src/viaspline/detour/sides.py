"""Either side of every group in the way: all candidates, the shortest taken, the rest kept.

The paper's rule, made exact. Obstacles that stand together are one group; where it blocks a leg,
the shortest way is sought on its left and on its right, past everything else that those ways meet;
the spline is regenerated through each, proven and measured, and the shorter one is taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viaspline.detour.barrier import Barriers, barriers_of
from viaspline.detour.blocked import explain_blocked_leg
from viaspline.detour.brief import Brief
from viaspline.detour.course import Course
from viaspline.detour.fit import Fitted, fit
from viaspline.detour.ledger import Candidate, LedgerEntry
from viaspline.detour.measure import Measured, measure
from viaspline.detour.route import NO_BARRIERS, Flags, Floats, Way, find_way, on_the_line
from viaspline.kernels.corners import X, Y
from viaspline.mission.parts import Side
from viaspline.world.world import World

SIDES: tuple[Side, Side] = ("left", "right")
FEW = 12  # groups on a leg up to which each other side is sought along the whole leg
NEAR = 4  # corners before and after a group between which it is sought otherwise


@dataclass(frozen=True)
class Met:
    """A group that stands in the way of a leg.

    Attributes:
        members: Its obstacles.
        barriers: Of the one that is in the way first.
    """

    members: tuple[int, ...]
    barriers: Barriers

    def side_of(self, way: Way) -> Side:
        """The side on which a way passes it."""
        return "right" if way.crosses(self.barriers.right) else "left"


@dataclass(frozen=True)
class Passed:
    """A leg that was led round what stood in its way."""

    fitted: Fitted
    entries: tuple[LedgerEntry, ...]


@dataclass(frozen=True)
class _Curve:
    """A spline that was fitted to a way, what it costs, and on which side it passes each group."""

    way: Way
    fitted: Fitted
    measured: Measured
    sides: tuple[Side, ...]


@dataclass(frozen=True)
class _Leg:
    """A leg in its course and world, and the groups in its way."""

    course: Course
    index: int
    world: World
    brief: Brief
    met: tuple[Met, ...]

    @property
    def ends(self) -> tuple[Floats, Floats]:
        start, goal = self.course.ends(self.index)
        return start.at, goal.at

    def way(self, barriers: Floats, active: Flags) -> Way | None:
        return find_way(self.world, *self.ends, self.brief.required, barriers, active)

    def curve(self, way: Way | None) -> _Curve | None:
        """The spline along a way, or None where no slack makes it clear."""
        if way is None:
            return None
        fitted = fit(self.course, self.index, way, self.world, self.brief.required)
        if fitted is None:
            return None
        measured = measure(fitted.spans, self.world, self.brief)
        return _Curve(way, fitted, measured, tuple(group.side_of(way) for group in self.met))


def pass_groups(
    course: Course,
    index: int,
    world: World,
    brief: Brief,
    hit: Sequence[int],
    groups: NDArray[np.int64],
) -> Passed:
    """Lead one leg round everything, by the shorter side of each group.

    Args:
        course: What there is so far.
        index: The leg that comes too close to something.
        world: The known world.
        brief: What to keep.
        hit: Obstacles that the leg's curve comes too close to.
        groups: Label of every obstacle's group.

    Raises:
        NoPathError: When there is no way, with the least change that would serve.
    """
    start, goal = (via.at for via in course.ends(index))
    active = on_the_line(world, start, goal, brief.required)
    active[list(hit)] = True
    met = _groups_met(world, groups, np.flatnonzero(active), start, goal)
    for group in met:  # a group is passed as one: a side that one of its members asks for counts
        active[[i for i in group.members if world.obstacles[i].forced_side is not None]] = True
    leg = _Leg(course, index, world, brief, met)
    way, barriers = _shortest_allowed(leg, active)
    best = leg.curve(way)
    if best is None:
        raise explain_blocked_leg(course, index, world, brief, barriers)
    curves = [best]
    reasons: list[str] = []
    for group, side in zip(met, best.sides, strict=True):
        other, reason = _other_side(leg, group, _opposite(side), best.way, active)
        curves += [other] if other else []
        reasons.append(reason)
    winner = min(curves, key=lambda curve: curve.measured.length)
    entries = tuple(
        _entry(leg, place, curves, winner, reason) for place, reason in enumerate(reasons)
    )
    return Passed(winner.fitted, entries)


def _shortest_allowed(
    leg: _Leg, active: Flags, closed: Floats = NO_BARRIERS
) -> tuple[Way | None, Floats]:
    """The shortest way that passes what it meets on the sides that the mission allows.

    A way can meet obstacles with a side of their own that were not met before; each such round
    adds at least one barrier, so there are no more rounds than obstacles.
    """
    barriers = _forced_barriers(leg, active)
    while True:
        way = leg.way(np.vstack((closed, barriers)), active)
        needed = _forced_barriers(leg, active)
        if len(needed) == len(barriers):
            return way, barriers
        barriers = needed


def _other_side(
    leg: _Leg, group: Met, side: Side, best: Way, active: Flags
) -> tuple[_Curve | None, str]:
    """The shortest curve on the given side of a group, or why there is none.

    On a leg with many groups the way changes only near the group: there are then as many other
    sides as groups, and each would be a search of the whole leg.
    """
    for i in group.members:
        forced = leg.world.obstacles[i].forced_side
        if forced is not None and forced != side:
            return None, f"the mission has {leg.world.name(i)!r} passed on the {forced}"
    closed = group.barriers.closing(_opposite(side))
    if len(leg.met) <= FEW:
        way, _ = _shortest_allowed(leg, active, closed)
    else:
        way = _nearby(leg, group, closed, best)
    return leg.curve(way), f"no way is wide enough on the {side}"


def _nearby(leg: _Leg, group: Met, closed: Floats, best: Way) -> Way | None:
    """The best way, led past the other side of one group between corners near to it."""
    first, last = best.window(closed, NEAR)
    start, goal = (best.corners[k, X : Y + 1] for k in (first, last))
    required = leg.brief.required
    active = on_the_line(leg.world, start, goal, required)
    active[list(group.members)] = True  # a way can only turn at what is active
    barriers = np.vstack((closed, _forced_barriers(leg, active)))
    part = find_way(leg.world, start, goal, required, barriers, active)
    return None if part is None else best.spliced(first, last, part)


def _entry(
    leg: _Leg, place: int, curves: Sequence[_Curve], winner: _Curve, reason: str
) -> LedgerEntry:
    """The shortest of all curves on either side of one of the groups that were met."""
    candidates = []
    for side in SIDES:
        passing = [curve for curve in curves if curve.sides[place] == side]
        best = min(passing, key=lambda curve: curve.measured.length, default=None)
        candidates.append(_candidate(leg, side, best, reason, chosen=best is winner))
    start, goal = leg.course.ends(leg.index)
    members = tuple(leg.world.name(i) for i in leg.met[place].members)
    return LedgerEntry(members, (start.name, goal.name), tuple(candidates))


def _candidate(
    leg: _Leg, side: Side, curve: _Curve | None, reason: str, *, chosen: bool
) -> Candidate:
    if curve is None:
        dimension = len(leg.ends[0])
        none = np.empty((0, dimension))
        return Candidate(side, none, none.reshape(0, 4, dimension), impossible=reason)
    return Candidate(
        side=side,
        vias=curve.fitted.course.legs[leg.index].points,
        spans=curve.fitted.spans,
        length=curve.measured.length,
        clearance=curve.measured.clearance,
        max_curvature=curve.measured.max_curvature,
        chosen=chosen,
    )


def _opposite(side: Side) -> Side:
    return "right" if side == "left" else "left"


def _forced_barriers(leg: _Leg, active: Flags) -> Floats:
    """Barriers on the forbidden sides of those obstacles that may be passed on one side only."""
    rows = [
        barriers_of(leg.world, int(i), *leg.ends).closing(_opposite(forced))
        for i in np.flatnonzero(active)
        if (forced := leg.world.obstacles[i].forced_side) is not None
    ]
    return np.vstack(rows) if rows else NO_BARRIERS


def _groups_met(
    world: World,
    groups: NDArray[np.int64],
    indices: NDArray[np.intp],
    start: Floats,
    goal: Floats,
) -> tuple[Met, ...]:
    """The groups in the way of the straight line or of the curve, in the order of the leg."""
    along = goal[:2] - start[:2]
    order = np.argsort([_centre(world, int(i)) @ along for i in indices], kind="stable")
    met: dict[int, Met] = {}
    for i in indices[order].tolist():
        label = int(groups[i])
        if label not in met:
            met[label] = Met(
                tuple(np.flatnonzero(groups == label).tolist()),
                barriers_of(world, i, start, goal),
            )
    return tuple(met.values())


def _centre(world: World, index: int) -> Floats:
    obstacle = world.obstacles[index]
    if obstacle.circle is not None:
        return np.array(obstacle.circle.center)
    mean: Floats = np.array(obstacle.polygon).mean(axis=0)
    return mean
