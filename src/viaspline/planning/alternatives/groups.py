"""Either side of every group in the way: all candidates, the shortest taken, the rest kept.

The paper's rule, made exact. Obstacles that stand together are one group; where it blocks a leg,
the shortest taut path is sought on its left and on its right, past everything else that those
meet; the spline is regenerated through each, proven and measured, and the shorter one is taken.

Tested through ``planning/problem/test_ledger``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.comparison import Met
from viaspline.planning.alternatives.leg_search import LegSearch, opposite
from viaspline.planning.problem.method import Found, Outcome
from viaspline.planning.routing.route_problem import on_the_line
from viaspline.planning.routing.side_barrier import barriers_of
from viaspline.planning.routing.taut_path import TautPath
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.world.world import World

FEW_GROUPS = 4  # on a leg, up to which the ways on either side are always sought
MAX_GROUPS_SOUGHT_WHOLE = 12  # on a leg, up to which other sides are sought along all of it
CORNERS_AROUND_GROUP = 4  # before and after a group, between which its other side is sought else


@dataclass(frozen=True)
class Group(Met):
    """A group whose obstacles are known one by one.

    Attributes:
        indices: Of its obstacles in the world.
    """

    indices: tuple[int, ...]


@told_in_lines
@dataclass(frozen=True)
class GroupsInTheWay:
    """The groups that a leg was led round; see ``InTheWay``.

    Attributes:
        leg: The leg.
        met: The groups, in its order.
        active: (n,): the obstacles that its shortest taut path was found with.
    """

    leg: LegSearch
    met: tuple[Group, ...]
    active: Flags

    @property
    def is_little(self) -> bool:
        """See ``InTheWay``."""
        return len(self.met) <= FEW_GROUPS

    @property
    def among_made(self) -> GroupsInTheWay:
        """See ``InTheWay``: among few obstacles no lattice is needed."""
        return self

    def other_way(self, met: Met, side: Side, best: TautPath) -> Outcome[TautPath]:
        """See ``InTheWay``.

        On a leg with many groups the taut path changes only near the group: there are then as
        many other sides as groups, and each would be a search of the whole leg.
        """
        group = next(group for group in self.met if group is met)
        closed = group.barriers.closing(opposite(side))
        if len(self.met) <= MAX_GROUPS_SOUGHT_WHOLE:
            return self.leg.shortest_allowed(self.active, closed)[0]
        return _nearby(self.leg, group, closed, best)


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
            forced = sided_among(leg.world, members)
            active[forced] = True
            asked = asked_of(leg.world, forced)
            met[label] = Group(names, barriers_of(leg.world, i, start, goal), asked, members)
    return tuple(met.values())


def sided_among(world: World, indices: Sequence[int]) -> list[int]:
    """Those of some obstacles that ask for a side."""
    sided = set(world.sided.tolist())
    return [i for i in indices if i in sided] if sided else []


def asked_of(world: World, forced: Sequence[int]) -> tuple[Side, str] | None:
    """The side that the first of some obstacles asks for, and its name; None if there is none."""
    for i in forced:
        side = world.obstacles[i].forced_side
        if side is not None:
            return side, world.name(i)
    return None


def _nearby(leg: LegSearch, group: Group, closed: Floats, best: TautPath) -> Outcome[TautPath]:
    """The best taut path, led past the other side of one group between corners near to it."""
    first, last = best.window(closed, CORNERS_AROUND_GROUP)
    start, goal = (best.corners[k, X : Y + 1] for k in (first, last))
    active = on_the_line(leg.world, start, goal, leg.requirements.required)
    active[list(group.indices)] = True  # a route can only turn at what is active
    barriers = np.vstack((closed, leg.sides.closed_among(active)))
    part = leg.router.find(start, goal, barriers, active)
    if not isinstance(part, Found):
        return part
    spliced = best.spliced(first, last, part.value)
    return Found(spliced, spliced.length)


def _centre(world: World, index: int) -> Floats:
    ring = world.obstacles[index].ring
    assert ring is not None  # grids are islands, not members of groups
    mean: Floats = ring.vertices.mean(axis=0)
    return mean
