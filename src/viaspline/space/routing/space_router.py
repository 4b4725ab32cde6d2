"""The cheapest route between two places in space: searched in several ways, the best kept.

The sight line; else a way from contact to contact among the solids that stand in the way, and one
through a lattice, there and back. Each is pulled taut, and the cheapest is taken. Where none is
found, the lattice is halved, and cells of it that could be free are flooded: if they don't connect
the two places there is no route, and that is proven. Else the search gives up at its resolution.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from viaspline.errors import GeometryError
from viaspline.handed_in import numbers_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.routing.contact_graph import contact_way
from viaspline.kernels.space.routing.could_be_free import APART, are_apart
from viaspline.kernels.space.routing.lazy_theta import lattice_way
from viaspline.kernels.space.routing.pull_taut import taut_way
from viaspline.kernels.space.routing.route_protocol import PlaceLattice
from viaspline.kernels.space.routing.travel_past import least_travel
from viaspline.kernels.space.routing.voxel_block import VoxelBlock
from viaspline.kernels.space.routing.way_checks import way_cost, way_is_free
from viaspline.kernels.space.space_distance import space_distances
from viaspline.planning.problem.method import Found
from viaspline.space.routing.pass_gates import NO_GATES
from viaspline.space.routing.route_query import (
    RouteQuery,
    checked_ends,
    checked_norm,
    checked_required,
)
from viaspline.space.routing.search_room import SearchRoom
from viaspline.space.routing.taut_route import (
    LENGTH,
    Norm,
    SpaceGaveUp,
    SpaceOutcome,
    SpaceRefusal,
    TautRoute,
)

_HAIR = 1e-3  # of the body's size: what is kept beyond the clearance, so that rounding takes none
_REACH = 0.05  # of the body's size: what is no further beyond that counts as touched
_LEAST_SIZE_M = 1e-3
_CHEAPER = 10  # places among voxels alone for one among solids
_COARSE = 1.1  # times what a taut way may cost: a way through a lattice that becomes it
_ROUNDING = 1e-6  # of such a hair: by what answers about cubes may differ from those of a world
_ABOUT = 1.0  # of the way as the crow flies: what lies so near to its ends is as large as it
_GREEDY = 2.0  # weight of the estimate for ways that are dearer than is worth while
_WORTH = 1.01  # times the best so far: what a way may cost before it is pulled taut


@dataclass(frozen=True)
class SpaceRouter:
    """Finds routes in a room.

    Attributes:
        room: Where.
        weight: Of the estimate in lattice searches, from 1 on: greater is faster, and longer.
        cube_weight: Of it in a world in which voxels alone stand.
        least_cut: A corner is cut off where that gains as much, as a share of the whole cost.
        most_places: Contacts that are looked at.
        most_lines: Lines between contacts that are looked at.
        most_nodes: Places of each lattice that are looked at; ten times as many among voxels alone.
        most_cells: Cells that are looked at for a proof.
        halvings: How often a lattice is halved.
        goes_back: Whether lattices are searched from the goal as well.
        most_cost: A route that costs more needn't be found [m or s].
        worth: A route that costs more needn't be the cheapest of its kind [m or s].
    """

    room: SearchRoom
    weight: float = 1.1
    cube_weight: float = 1.05
    least_cut: float = 2e-4
    most_places: int = 1024
    most_lines: int = 1000
    most_nodes: int = 100_000
    most_cells: int = 400_000
    halvings: int = 2
    goes_back: bool = True
    most_cost: float = math.inf
    worth: float = math.inf

    @property
    def quick(self) -> SpaceRouter:
        """This one for ways that needn't be there: on one lattice, there alone, without a proof."""
        return replace(self.without_proof, halvings=0, goes_back=False)

    @property
    def without_proof(self) -> SpaceRouter:
        """This one for ways of which nobody asks why there is none."""
        return replace(self, most_cells=0)

    def best_up_to(self, cost: float) -> SpaceRouter:
        """This one for ways of which those that cost more [m or s] are only to be told of."""
        return replace(self, worth=cost)

    def up_to(self, cost: float) -> SpaceRouter:
        """This one for ways that cost so much at most [m or s]: searches end where others begin."""
        return replace(self, most_cost=cost)

    def find(
        self,
        start: ArrayLike,
        goal: ArrayLike,
        required: float,
        norm: Norm = LENGTH,
        gates: Floats = NO_GATES,
    ) -> SpaceOutcome:
        """The cheapest route that is found.

        Args:
            start: [m], (3,).
            goal: [m], (3,).
            required: Distance to be kept from everything [m]: the clearance, and a ball's radius.
            norm: Speeds, for a route that takes little time; ``LENGTH`` for a short one.
            gates: Sides on which solids may be passed; see ``pass_gates``, (g, 8).

        Returns:
            The route with its cost; a proof that there is none; or that neither was found.

        Raises:
            GeometryError: For something else than that.
        """
        ends = checked_ends(start, goal)
        radius = checked_required(required)
        speeds = checked_norm(norm)
        for side in range(2):
            if refusal := self._refused_end(ends, side, radius):
                return refusal
        if way_is_free(self.room.packed, gates, ends, radius):
            route = TautRoute(ends, float(way_cost(speeds, ends)), radius)
            return Found(route, route.cost)
        query = RouteQuery(ends, radius, speeds, gates, 2.0 * (radius + self.room.body))
        reach = _ABOUT * float(np.linalg.norm(ends[1] - ends[0]))
        lattice = self.room.lattice(ends[0], ends[1], query.margin, reach=reach)
        best = self._by_lattice(query, lattice)
        best = self._better(query, self._by_contacts(query, best), best)
        return self._by_finer(query, lattice) if best is None else Found(best, best.cost)

    def _by_finer(self, query: RouteQuery, tried: PlaceLattice) -> SpaceOutcome:
        """A route through lattices of all that there is, where one that suits its ends has none."""
        resolution = 0.0
        for halvings in range(self.halvings + 1):
            lattice = self.room.lattice(query.ends[0], query.ends[1], query.margin, halvings)
            resolution = float(lattice.frame[3])
            if resolution != tried.frame[3]:
                best = self._by_lattice(query, lattice)
                if best is not None:
                    return Found(best, best.cost)
            if refusal := self._refused(query, halvings):
                return refusal
        return self._gave_up(query, resolution)

    def pulled(
        self, way: Floats, required: float, norm: Norm = LENGTH, gates: Floats = NO_GATES
    ) -> TautRoute:
        """A free way pulled taut.

        Args:
            way: Its vertices [m], (n, 3).
            required: Distance that it keeps from everything [m].
            norm: See ``find``.
            gates: See ``find``.

        Raises:
            GeometryError: The way isn't free.
        """
        points = np.array(numbers_from("way", way))
        radius = checked_required(required)
        if not way_is_free(self.room.packed, gates, points, radius):
            raise GeometryError("the way isn't free at that distance; give one that is")
        return self._pulled(points, radius, checked_norm(norm), gates)

    def _by_lattice(self, query: RouteQuery, lattice: PlaceLattice) -> TautRoute | None:
        """The better of two routes through the lattice, searched there and mostly back.

        What isn't found there, isn't back.
        """
        there = self._there(query, lattice)
        best = self._better(query, there, None)
        if best is None or best.cost > self.worth or not self.goes_back:
            return best
        return self._better(query, self._there(query.reversed, lattice)[::-1].copy(), best)

    def _there(self, query: RouteQuery, lattice: PlaceLattice) -> Floats:
        """A way through the lattice, searched from the start."""
        packed, space = self.room.packed, self.room.searched(query.radius, query.ends)
        way = self._searched(space, query, lattice)
        if space is packed or way_is_free(packed, query.gates, way, query.radius):
            return way
        return self._searched(packed, query, lattice)  # the quick one was off by a rounding

    def _searched(
        self, space: PackedSpace | VoxelBlock, query: RouteQuery, lattice: PlaceLattice
    ) -> Floats:
        """A way through the lattice that is free in a space."""
        weight = self.weight if isinstance(space, PackedSpace) else self.cube_weight
        if least_travel(query.gates, query.norm, *query.ends) > self.worth:
            weight = max(weight, _GREEDY)
        way: Floats = lattice_way(
            space, query.gates, query.norm, lattice, query.ends[0], query.ends[1], query.radius,
            weight, _COARSE * self.most_cost, self._most_nodes(space),
        )[0]  # fmt: skip
        return way

    def _most_nodes(self, space: PackedSpace | VoxelBlock) -> int:
        return self.most_nodes * (1 if isinstance(space, PackedSpace) else _CHEAPER)

    def _by_contacts(self, query: RouteQuery, best: TautRoute | None) -> Floats:
        """One from contact to contact, if it may be cheaper than the best."""
        if self.room.cubes is not None:
            return np.empty((0, 3))  # cubes have no contacts
        bound = _WORTH * (self.most_cost if best is None else min(best.cost, self.most_cost))
        way: Floats = contact_way(
            self.room.packed, query.gates, query.norm, query.ends[0], query.ends[1], query.radius,
            bound, self.most_places, self.most_lines,
        )[0]  # fmt: skip
        return way

    def _better(self, query: RouteQuery, way: Floats, best: TautRoute | None) -> TautRoute | None:
        """A way pulled taut, if it is there and cheaper than the best; else the best."""
        if not len(way):
            return best
        route = self._pulled(way, query.radius, query.norm, query.gates)
        return route if best is None or route.cost < best.cost else best

    def _pulled(self, way: Floats, radius: float, norm: Floats, gates: Floats) -> TautRoute:
        packed = self.room.packed
        size = max(radius + self.room.body, _LEAST_SIZE_M)
        kept = radius
        for hair in (_HAIR * size, 0.1 * _HAIR * size, 0.01 * _HAIR * size):
            if way_is_free(packed, gates, way, radius + hair):
                kept = radius + hair
                break
        least = self.least_cut * float(way_cost(norm, way))
        space = self.room.searched(kept, way)
        points = taut_way(space, gates, norm, way, kept, _REACH * size, least)
        if space is not packed:
            held = kept - _ROUNDING * (kept - radius)
            if way_is_free(packed, gates, points, held):
                return TautRoute(points, float(way_cost(norm, points)), held)
            points = taut_way(packed, gates, norm, way, kept, _REACH * size, least)
        return TautRoute(points, float(way_cost(norm, points)), kept)

    def _refused_end(self, ends: Floats, side: int, radius: float) -> SpaceRefusal | None:
        """That the start (0) or the goal (1) isn't free."""
        place = ends[side]
        if way_is_free(self.room.packed, NO_GATES, place[None].repeat(2, axis=0), radius):
            return None
        name = ("start", "goal")[side]
        where = (float(place[0]), float(place[1]), float(place[2]))
        distance, index = space_distances(self.room.packed, place[None])
        if distance[0] >= radius and distance[0] > 0.0:
            return SpaceRefusal(f"the {name} is outside of the heights allowed", None, where)
        return SpaceRefusal(
            f"the {name} keeps {distance[0]:.3g} m, and {radius:g} m are required",
            None,
            where,
            int(index[0]),
        )

    def _refused(self, query: RouteQuery, halvings: int) -> SpaceRefusal | None:
        """That cells that could be free don't connect the two places."""
        ends, radius = query.ends, query.radius
        cells = self.room.cells(ends[0], ends[1], query.margin, halvings)
        found, side = are_apart(self.room.packed, cells, ends[0], ends[1], radius, self.most_cells)
        if found != APART:
            return None
        place = ends[side]
        return SpaceRefusal(
            f"the {('start', 'goal')[side]} is shut in: no gap leads out of there that is "
            f"{2.0 * (radius + self.room.body):g} m wide",
            None,
            (float(place[0]), float(place[1]), float(place[2])),
        )

    def _gave_up(self, query: RouteQuery, resolution: float) -> SpaceGaveUp:
        most = self._most_nodes(self.room.searched(query.radius, query.ends))
        return SpaceGaveUp(
            tried=(
                "contacts",
                f"lattices down to {resolution:.3g} m, with {most} places each",
            ),
            would_help="a finer lattice, a smaller clearance",
            reason=f"no route was found at a resolution of {resolution:.3g} m",
            resolution=resolution,
        )
