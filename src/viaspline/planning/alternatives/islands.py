"""Clutter and maps: what stands together is an island of blocked cells, with two sides.

The taut path that was taken is the shortest of all, whatever stands around it. The other side of
an island is sought when the ledger is read, or where that path loses much to its bends.

Tested through ``test_map_promises``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.mission.shapes.obstacle import Side
from viaspline.planning.alternatives.comparison import Met
from viaspline.planning.alternatives.groups import asked_of
from viaspline.planning.alternatives.leg_search import LegSearch, opposite
from viaspline.planning.problem.method import Outcome
from viaspline.planning.routing.route_problem import on_the_line
from viaspline.planning.routing.side_barrier import barriers_at
from viaspline.planning.routing.taut_path import TautPath
from viaspline.world.world import World

MAX_ISLAND_NAMES = 12  # that an island is given


@dataclass(frozen=True)
class IslandsInTheWay:
    """The islands that a leg was led through; see ``InTheWay``.

    Attributes:
        leg: The leg.
    """

    leg: LegSearch

    @cached_property
    def met(self) -> tuple[Met, ...]:
        """The islands that its straight line goes through, in its order."""
        return tuple(islands_met(self.leg))

    @cached_property
    def active(self) -> Flags:
        """See ``InTheWay``."""
        return on_the_line(self.leg.world, *self.leg.ends, self.leg.requirements.required)

    @property
    def is_little(self) -> bool:
        """See ``InTheWay``."""
        return False

    @property
    def among_made(self) -> IslandsInTheWay:
        """See ``InTheWay``."""
        return replace(self, leg=replace(self.leg, router=self.leg.router.among_made))

    def other_way(self, met: Met, side: Side, best: TautPath) -> Outcome[TautPath]:
        """See ``InTheWay``."""
        closed = met.barriers.closing(opposite(side))
        return self.leg.shortest_allowed(self.active, closed)[0]


def islands_met(leg: LegSearch) -> Iterator[Met]:
    """The islands that the straight line of a leg goes through, in its order."""
    from scipy.ndimage import label

    lattice = leg.router.lattice
    labels: NDArray[Any] = label(lattice.cells, structure=np.ones((3, 3)))[0]
    start, goal = leg.ends
    size = float(np.hypot(*(goal - start)[:2]))
    share = np.linspace(0.0, 1.0, int(2 * size / lattice.side) + 2)
    places = start[None, :2] + share[:, None] * (goal - start)[None, :2]
    found = lattice.at(labels, places)
    seen: set[int] = set()
    for k in np.flatnonzero(found).tolist():
        island = int(found[k])
        if island in seen:
            continue
        seen.add(island)
        inside = places[k : k + np.argmax(np.append(found[k:] != island, True))]
        middle = inside[len(inside) // 2]
        barriers = barriers_at(leg.world, middle, start, goal)
        members = _members(leg, labels == island)
        asked = asked_of(leg.world, np.intersect1d(members, leg.sides.bound).tolist())
        yield Met(_names(leg, members, middle), barriers, asked)


def _members(leg: LegSearch, island: NDArray[np.bool_]) -> Ints:
    """The obstacles that an island may consist of, all maps among them, (k,)."""
    within = leg.router.lattice.at(island, _centres(leg.world))
    return np.flatnonzero(within | leg.world.are_maps)


def _names(leg: LegSearch, members: Ints, middle: Floats) -> tuple[str, ...]:
    """What an island consists of: its obstacles, and where on a map it is."""
    world, are_maps = leg.world, leg.world.are_maps
    named = [
        i
        for i in members.tolist()
        if not are_maps[i] or world.distances_to(i, middle[None, :])[0] < leg.requirements.required
    ]
    names = [
        f"{world.name(i)} at ({middle[0]:.2f}, {middle[1]:.2f})" if are_maps[i] else world.name(i)
        for i in named[:MAX_ISLAND_NAMES]
    ]
    more = len(named) - len(names)
    return (*names, f"{more} more") if more else tuple(names)


def _centres(world: World) -> Floats:
    """The middle of every obstacle's box [m], shape (n, 2)."""
    packed = world.packed
    leaves = packed.leaf >= 0
    centres = np.empty((len(world), 2))
    boxes = packed.boxes[leaves]
    centres[packed.leaf[leaves]] = 0.5 * (boxes[:, :2] + boxes[:, 2:])
    return centres
