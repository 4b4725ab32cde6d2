"""Either side of every group in the way: all candidates, the shortest taken, the rest kept.

The paper's rule, made exact. Obstacles that stand together are one group; where it blocks a leg,
the shortest way is sought on its left and on its right, past everything else that those ways meet;
the spline is regenerated through each, proven and measured, and the shorter one is taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.comparison import Comparison, Met
from viaspline.planning.alternatives.fit import Fitted
from viaspline.planning.alternatives.leg_search import LegSearch, Spline, opposite
from viaspline.planning.routing.router import TautPath, on_the_line
from viaspline.planning.routing.side_barrier import barriers_of
from viaspline.world.world import World

FEW = 12  # groups on a leg up to which each other side is sought along the whole leg
NEAR = 4  # corners before and after a group between which it is sought otherwise


@dataclass(frozen=True)
class Group(Met):
    """A group whose obstacles are known one by one.

    Attributes:
        indices: Of its obstacles in the world.
    """

    indices: tuple[int, ...]


@dataclass(frozen=True)
class PassedGroups:
    """A leg that was led round the groups in its way.

    Attributes:
        comparison: The curves on either side of each.
        winner: The shortest of them.
        best: The one along the shortest way.
    """

    comparison: Comparison
    winner: Spline
    best: Spline

    @property
    def fitted(self) -> Fitted:
        """The leg's spline."""
        return self.winner.fitted


def groups_met(leg: LegSearch, labels: NDArray[np.int64], active: Flags) -> tuple[Group, ...]:
    """The groups in the way of a leg, in its order.

    A group is passed as one: members that ask for a side are marked in ``active`` as well.
    """
    start, goal = leg.ends
    along = goal[:2] - start[:2]
    indices = np.flatnonzero(active)
    order = np.argsort([_centre(leg.world, int(i)) @ along for i in indices], kind="stable")
    met: dict[int, Group] = {}
    for i in indices[order].tolist():
        label = int(labels[i])
        if label not in met:
            members = tuple(np.flatnonzero(labels == label).tolist())
            names = tuple(leg.world.name(k) for k in members)
            met[label] = Group(names, barriers_of(leg.world, i, start, goal), members)
    for group in met.values():
        forced = [i for i in group.indices if leg.world.obstacles[i].forced_side is not None]
        active[forced] = True
    return tuple(met.values())


@dataclass(frozen=True)
class DeferredComparison:
    """A leg past so many groups that their other sides are looked at when the ledger is read.

    The way that was taken is the shortest of all, whatever the other sides cost.

    Attributes:
        leg: What was led round.
        met: The groups in its way.
        best: The curve along the shortest way.
        active: (n,): the obstacles that way was found with.
    """

    leg: LegSearch
    met: tuple[Group, ...]
    best: Spline
    active: Flags

    @property
    def fitted(self) -> Fitted:
        """The leg's spline."""
        return self.best.fitted

    @cached_property
    def comparison(self) -> Comparison:
        """The curves on either side of every group."""
        curves, reasons = _curves(self.leg, self.met, self.best, self.active.copy())
        return Comparison(self.leg, self.met, tuple(curves), self.best, tuple(reasons))


def pass_groups(leg: LegSearch, met: Sequence[Group], best: Spline, active: Flags) -> PassedGroups:
    """Weigh the other side of every group as well.

    Args:
        leg: What is led round.
        met: The groups in its way.
        best: The curve along the shortest way.
        active: (n,): the obstacles that way was found with.
    """
    curves, reasons = _curves(leg, met, best, active)
    winner = min(curves, key=lambda curve: curve.measured.length)
    comparison = Comparison(leg, tuple(met), tuple(curves), winner, tuple(reasons))
    return PassedGroups(comparison, winner, best)


def _curves(
    leg: LegSearch, met: Sequence[Group], best: Spline, active: Flags
) -> tuple[list[Spline], list[str]]:
    """The best curve and those on the other side of each group; why there might be none."""
    curves = [best]
    reasons: list[str] = []
    for group in met:
        side = opposite(group.side_of(best.taut_path))
        other, reason = _other_side(leg, met, group, side, best.taut_path, active)
        curves += [other] if other else []
        reasons.append(reason)
    return curves, reasons


def _other_side(
    leg: LegSearch, met: Sequence[Group], group: Group, side: Side, best: TautPath, active: Flags
) -> tuple[Spline | None, str]:
    """The shortest curve on the given side of a group, or why there is none.

    On a leg with many groups the way changes only near the group: there are then as many other
    sides as groups, and each would be a search of the whole leg.
    """
    for i in group.indices:
        forced = leg.world.obstacles[i].forced_side
        if forced is not None and forced != side:
            return None, f"the mission has {leg.world.name(i)!r} passed on the {forced}"
    closed = group.barriers.closing(opposite(side))
    if len(met) <= FEW:
        taut_path, _ = leg.shortest_allowed(active, closed)
    else:
        taut_path = _nearby(leg, group, closed, best)
    return leg.curve(taut_path), f"no way is wide enough on the {side}"


def _nearby(leg: LegSearch, group: Group, closed: Floats, best: TautPath) -> TautPath | None:
    """The best way, led past the other side of one group between corners near to it."""
    first, last = best.window(closed, NEAR)
    start, goal = (best.corners[k, X : Y + 1] for k in (first, last))
    active = on_the_line(leg.world, start, goal, leg.requirements.required)
    active[list(group.indices)] = True  # a way can only turn at what is active
    barriers = np.vstack((closed, leg.forced_barriers(active)))
    part = leg.router.find(start, goal, barriers, active)
    return None if part is None else best.spliced(first, last, part)


def _centre(world: World, index: int) -> Floats:
    ring = world.obstacles[index].ring
    assert ring is not None  # grids are islands, not members of groups
    mean: Floats = ring.vertices.mean(axis=0)
    return mean
