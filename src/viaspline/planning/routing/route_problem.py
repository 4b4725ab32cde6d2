"""The problem of routing one leg: from place to place, in the free space of a robot.

Tested through ``planning/routing/test_router``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import count, pairwise

import numpy as np

from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.kernels.world.segment import mark_near_segment
from viaspline.planning.routing.lattice import Lattice
from viaspline.planning.routing.lattices import (
    CELLS_QUICK,
    fine_lattice,
    lattices,
    least_required,
)
from viaspline.planning.routing.pulled_guides import PulledGuides
from viaspline.planning.routing.taut_path import TautPath
from viaspline.world.world import World

# How far off an obstacle a route turns beyond what is required, for gaps that are ever less wider
# than the robot. Below nothing at last: a via point may stand at just what is required, and a route
# turns only round what it is outside of.
TURN_MARGINS_M = (1e-3, 1e-4, -0.25 * PROOF_SLACK_M)
# Where it is the length that counts: a millimetre at each of many turns would be a thousandth of
# it, and a fatter robot in a narrow gap has no room for it.
SHORTEST_MARGINS_M = (1e-5, *TURN_MARGINS_M)
TURN_STEPS_RAD = (np.pi / 6, np.pi / 32, np.pi / 200)  # largest turn at one corner
NO_BARRIERS = np.empty((0, 4))
MADE_AGAIN = (
    "_lattices",
    "fine_lattices",
    "pulled",
    "among_made",
    "of_fatter",
)  # of a search space, where that is needed
MAX_DISC_PAIRS = 200_000  # near enough to each other that their gaps are looked at all at once


def for_nothing(cost: float) -> None:
    """Work that nobody counts costs nothing."""


@dataclass(frozen=True)
class SearchSpace:
    """Where the middle of a robot may be.

    Attributes:
        world: What to keep clear of.
        required: Distance to keep [m].
        places: Where routes may begin and end [m], (n, 2).
        most_cells: Of the lattice that is tried first for a slim robot.
        margins: How far off an obstacle a route turns, the best first [m].
    """

    world: World
    required: float
    places: Floats
    most_cells: int = field(default=CELLS_QUICK, kw_only=True)
    margins: tuple[float, ...] = field(default=TURN_MARGINS_M, kw_only=True)

    @property
    def floor(self) -> float:
        """What a route keeps, a little less than what is asked for, as the certificate does [m]."""
        return self.required - 0.5 * PROOF_SLACK_M

    @cached_property
    def has_maps(self) -> bool:
        """Whether there are occupancy grids in the world."""
        return bool(self.world.are_maps.any())

    @property
    def lattice(self) -> Lattice:
        """The coarsest lattice."""
        return next(self.ever_finer())

    @property
    def has_lattice(self) -> bool:
        """Whether the coarsest lattice is made already."""
        return bool(self._lattices[0])

    @cached_property
    def narrow_disc_gaps(self) -> Floats:
        """Segments between discs with too little room between them, (n, 4) [m].

        What a lidar sees is hundreds of discs: closed one by one, their gaps take a search each.
        """
        from scipy.spatial import cKDTree

        table = self.world.discs
        if len(table) < 2:
            return NO_BARRIERS
        tree, reach = cKDTree(table[:, :2]), 2.0 * (self.floor + float(table[:, 2].max()))
        if tree.count_neighbors(tree, reach) > MAX_DISC_PAIRS:
            return NO_BARRIERS
        first, second = tree.query_pairs(reach, output_type="ndarray").T
        a, b = table[first], table[second]
        gaps = np.hypot(*(b - a)[:, :2].T) - a[:, 2] - b[:, 2]
        ends: Floats = np.hstack((a[:, :2], b[:, :2]))[gaps < 2.0 * self.floor]
        return ends

    def ever_finer(self) -> Iterator[Lattice]:
        """The lattices of this space, the coarsest first; each is made once, when it is needed."""
        made, to_make = self._lattices
        for k in count():
            if k == len(made):
                finer = next(to_make, None)
                if finer is None:
                    return
                made.append(finer)
            yield made[k]

    def made_lattices(self) -> Iterator[Lattice]:
        """Those that have been made by now, the coarsest first."""
        return iter(self._lattices[0])

    @cached_property
    def _lattices(self) -> tuple[list[Lattice], Iterator[Lattice]]:
        """Those that are made, and those that are not yet."""
        return [], lattices(self.world, self.required, self.floor, self.places, self.most_cells)

    @cached_property
    def fine_lattices(self) -> tuple[Lattice, ...]:
        """The finest one of use, where there is one."""
        made = fine_lattice(self.world, self.required, self.floor, self.places)
        return () if made is None else (made,)

    @cached_property
    def of_fatter(self) -> SearchSpace | None:
        """That of the slimmest robot that cells are small beside; None if this one is no slimmer.

        A way for a fat robot is one for a slim one.
        """
        required = least_required(self.world, self.required, self.places)
        if required <= self.required:
            return None
        return SearchSpace(self.world, required, self.places, margins=self.margins)

    @cached_property
    def pulled(self) -> PulledGuides:
        """What came of the guides that were followed in it."""
        return PulledGuides()

    def without_lattices(self) -> None:
        """Let go of the lattices, some ten megabytes: they are made again where they are needed."""
        for name in MADE_AGAIN:
            vars(self).pop(name, None)

    def __getstate__(self) -> dict[str, object]:
        """For another process: without the lattices, which are made there if they are needed."""
        return {name: part for name, part in vars(self).items() if name not in MADE_AGAIN}


@dataclass(frozen=True)
class RouteProblem:
    """A taut path that is asked for.

    Attributes:
        space: Where it may go.
        start: [m], at least (2,).
        goal: [m], at least (2,).
        barriers: Segments that it must not cross, (b, 4).
        active: (n,): obstacles that are known to be met; methods add those that they meet, in
            place.
        spend: Takes off what work costs; see ``Requirements``.
    """

    space: SearchSpace
    start: Floats
    goal: Floats
    barriers: Floats
    active: Flags
    spend: Callable[[float], None] = for_nothing

    @property
    def active_count(self) -> int:
        """How many obstacles are known to be met."""
        return int(np.count_nonzero(self.active))

    def mark(self, taut_path: TautPath) -> None:
        """Add what a taut path goes round to the active obstacles."""
        width = self.space.required + 2 * TURN_MARGINS_M[0]
        packed = self.space.world.packed
        for (ax, ay), (bx, by) in pairwise(taut_path.corners[:, X : Y + 1].tolist()):
            if self.active.all():
                return
            mark_near_segment(packed, ax, ay, bx, by, width, self.active)


def on_the_line(world: World, start: Floats, goal: Floats, width: float) -> Flags:
    """Which obstacles are nearer than ``width`` to the straight line, (n,)."""
    found = np.zeros(len(world), np.bool_)
    mark_near_segment(world.packed, start[0], start[1], goal[0], goal[1], width, found)
    return found
