"""The exact shortest route between two places, on a side of a group if that is asked for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, islice, pairwise

import numpy as np

from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.routing.narrow_gaps import narrow_places, narrowest
from viaspline.kernels.routing.string_pulling.pull import pulled_taut
from viaspline.kernels.routing.tangent_arcs import bends_of, detour_points, taut_length
from viaspline.kernels.routing.tangent_graph import (
    barrier_crossings,
    has_narrow_gap,
    shortest_route,
)
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.kernels.world.segment import mark_near_segment
from viaspline.planning.routing.lattice import Lattice, lattices
from viaspline.world.world import World

# How far off an obstacle a route turns beyond what is required, for gaps that are ever less wider
# than the robot. Below nothing at last: a via point may stand at just what is required, and a route
# turns only round what it is outside of.
MARGINS = (1e-3, 1e-4, -0.25 * PROOF_SLACK_M)
STEPS = (np.pi / 6, np.pi / 32, np.pi / 200)  # largest turn at one corner [rad]
MANY = 16  # obstacles in the way of a leg beyond which it is sought on a lattice
GAPS = 200  # gaps that may prove too narrow before a finer lattice is tried
NO_BARRIERS = np.empty((0, 4))


@dataclass(frozen=True)
class TautPath:
    """A route between two places.

    Attributes:
        corners: Corner rows, see ``kernels.world.corner_fans``, shape (k, 8), start and goal
            among them.
        bends: Pulled taut, see ``kernels.routing.tangent_arcs``, shape (m, 6); empty where the arcs
            have no common tangents.
        length: [m].
    """

    corners: Floats
    bends: Floats
    length: float

    @property
    def is_direct(self) -> bool:
        """Whether nothing stands between the two places."""
        return len(self.corners) == 2

    @property
    def turns(self) -> Floats:
        """The corners between start and goal [m], shape (n, 2): their polyline is clear."""
        return np.ascontiguousarray(self.corners[1:-1, X : Y + 1])

    def points(self, step: float, excess: float, stretch: float, ease: float) -> Floats:
        """Detour via points along it [m], shape (n, 2); see ``tangent_arcs.detour_points``."""
        if len(self.bends) == 0:
            return self.turns
        points: Floats = detour_points(self.bends, step, excess, stretch, ease)
        return points

    @classmethod
    def through(cls, corners: Floats) -> TautPath:
        """The way along given corners."""
        bends = bends_of(corners)
        return cls(corners, bends, float(taut_length(corners, bends)))

    def crosses(self, barrier: Floats) -> bool:
        """Whether it crosses a barrier, shape (1, 4), an odd number of times."""
        return barrier_crossings(self.corners, barrier)[0] % 2 == 1

    def window(self, barrier: Floats, reach: int) -> tuple[int, int]:
        """The corners ``reach`` before and after the place where it crosses a barrier first."""
        crossing = barrier_crossings(self.corners, barrier)[1]
        return max(0, crossing - reach), min(len(self.corners) - 1, crossing + 1 + reach)

    def spliced(self, first: int, last: int, part: TautPath) -> TautPath:
        """The same with ``part`` between two of its corners."""
        inner = part.corners[1:-1]
        rows = (self.corners[: first + 1], inner, self.corners[last:])
        return TautPath.through(np.concatenate(rows))


@dataclass(frozen=True)
class _Tried:
    """What came of one lattice.

    Attributes:
        taut_path: The way, if there is one.
        closed: Segments that no way crosses, (n, 4).
        is_proof: Whether nothing else was closed in the lattice. Closing a segment blocks whole
            cells, so a finer lattice may still show a way beside it.
    """

    taut_path: TautPath | None
    closed: Floats
    is_proof: bool


@dataclass(frozen=True)
class Router:
    """Finds the shortest ways in a world for a robot that needs a certain room.

    With few obstacles in the way the search is exact among them alone. Among many, and on maps,
    a guide through a lattice of free cells is pulled taut.

    Attributes:
        world: What to keep clear of.
        required: Distance to keep [m].
        places: Where ways may begin and end [m], (n, 2).
    """

    world: World
    required: float
    places: Floats

    @cached_property
    def has_maps(self) -> bool:
        """Whether there are occupancy grids in the world."""
        return bool(self.world.are_maps.any())

    @cached_property
    def lattice(self) -> Lattice:
        """The coarsest lattice."""
        return next(lattices(self.world, self.required, self.places))

    def find(self, start: Floats, goal: Floats, barriers: Floats, active: Flags) -> TautPath | None:
        """The shortest way that keeps the distance from everything and crosses no barrier.

        Args:
            start: [m], at least (2,).
            goal: [m], at least (2,).
            barriers: Segments not to cross, (b, 4).
            active: (n,): obstacles to begin with; those met are added in place.

        Returns:
            The way, or None where there is none.
        """
        taut_path = None
        if not self.is_dense(active):
            taut_path = self._exact(start, goal, barriers, active)
        if taut_path is not None and self._is_surely_shortest(active):
            return taut_path
        guided = self._guided(start, goal, barriers)
        if guided is None or (taut_path is not None and taut_path.length <= guided.length):
            return taut_path
        self._mark(guided, active)
        return guided

    def _is_surely_shortest(self, active: Flags) -> bool:
        """Whether circumscribed corners close no gap that the arcs themselves leave open."""
        if self.world.enclosures and active.any():
            return False
        met = (self.world.obstacles[i].ring for i in np.flatnonzero(active))
        radius = max((ring.radius for ring in met if ring is not None), default=0.0)
        excess = (radius + self.required) * (1.0 / np.cos(0.25 * STEPS[0]) - 1.0)
        low, high = 2.0 * self._floor, 2.0 * (self.required + MARGINS[0] + excess)
        return not has_narrow_gap(self.world.packed, active, low, high)

    def is_dense(self, active: Flags) -> bool:
        """Whether ways are sought on a lattice: on maps, and among many obstacles."""
        return self.has_maps or bool(np.count_nonzero(active) > MANY)

    def _mark(self, taut_path: TautPath, active: Flags) -> None:
        """Mark what a way goes round in ``active``."""
        width = self.required + 2 * MARGINS[0]
        for (ax, ay), (bx, by) in pairwise(taut_path.corners[:, X : Y + 1].tolist()):
            mark_near_segment(self.world.packed, ax, ay, bx, by, width, active)

    def _exact(
        self, start: Floats, goal: Floats, barriers: Floats, active: Flags
    ) -> TautPath | None:
        """The shortest among few obstacles; None too where they prove to be many."""
        a, b = np.ascontiguousarray(start[:2]), np.ascontiguousarray(goal[:2])
        corners = shortest_route(
            self.world.packed, a, b, self.required + MARGINS[0], self._floor, STEPS[0], barriers,
            active, MANY,
        )  # fmt: skip
        return TautPath.through(corners) if len(corners) else None

    def _guided(self, start: Floats, goal: Floats, barriers: Floats) -> TautPath | None:
        """The first of ever finer lattices that leads to a way."""
        closed = barriers
        for lattice in chain((self.lattice,), self._finer):
            tried = self._along(lattice, start, goal, closed)
            shut = lattice.is_open and len(tried.closed) == len(barriers) and tried.is_proof
            if tried.taut_path is not None or shut:
                return tried.taut_path
            closed = tried.closed
        return None

    def closed_between(self, start: Floats, goal: Floats, closed: Floats) -> Floats:
        """The gaps that proved too narrow on the way to a goal that can't be reached, (n, 4)."""
        return self._along(self.lattice, start, goal, closed).closed

    def _along(self, lattice: Lattice, start: Floats, goal: Floats, closed: Floats) -> _Tried:
        """Follow the guides of a lattice, each but the last through a gap that is closed then."""
        is_proof = True
        if len(closed):
            lattice = lattice.without(closed)
        for _ in range(GAPS):
            guide = lattice.guide(start, goal)
            if guide is None:
                return _Tried(None, closed, is_proof)
            bends, corners, stuck = pulled_taut(
                self.world.packed, guide, self.required + np.array(MARGINS), self._floor,
                lattice.side, np.array(STEPS),
            )  # fmt: skip
            if len(bends):
                taut_path = TautPath(corners, bends, float(taut_length(corners, bends)))
                return _Tried(taut_path, closed, is_proof)
            gap = self._gap(guide, stuck, lattice.side)
            lattice = lattice.without(gap)
            proven = narrow_places(self.world.packed, guide, self._floor)
            if self._is_too_narrow(gap):
                proven = np.vstack((proven, gap))
            else:
                is_proof = False
            if len(proven):
                closed = np.vstack((closed, proven))
                lattice = lattice.without(proven)
        return _Tried(None, closed, is_proof=False)

    def _is_too_narrow(self, gap: Floats) -> bool:
        """Whether nothing on a segment across a gap, shape (1, 4), has the room."""
        w = np.linspace(0.0, 1.0, 65)[:, None]
        return bool(
            self.world.distance(gap[:, :2] + w * (gap[:, 2:] - gap[:, :2])).max() < self._floor
        )

    def _gap(self, guide: Floats, stuck: Floats, side: float) -> Floats:
        """The segment across the gap at which a guide through cells got stuck, (1, 4)."""
        if stuck[0, 4] < 0.0:
            return np.ascontiguousarray(stuck[:, :4])
        near = max(self._floor, 0.5 * side)  # what is required may be nothing at all
        found: Floats = narrowest(self.world.packed, guide, stuck[0, 4], near)
        return found

    @property
    def _floor(self) -> float:
        """What a way keeps, a little less than what is asked for, as the certificate does."""
        return self.required - 0.5 * PROOF_SLACK_M

    @property
    def _finer(self) -> Iterator[Lattice]:
        return islice(lattices(self.world, self.required, self.places), 1, None)


def on_the_line(world: World, start: Floats, goal: Floats, width: float) -> Flags:
    """Which obstacles are nearer than ``width`` to the straight line, (n,)."""
    found = np.zeros(len(world), np.bool_)
    mark_near_segment(world.packed, start[0], start[1], goal[0], goal[1], width, found)
    return found
