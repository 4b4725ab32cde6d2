"""The ways past what stands on a leg: the cheapest, and one on each side of what is nearest.

Tested through ``space/test_plan_spatial``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from viaspline.curve.certificate import Certificate
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.routing.way_checks import way_cost
from viaspline.maps.voxels import Voxels
from viaspline.mission.model import Mission
from viaspline.mission.shapes.solids import Solid
from viaspline.planning.problem.ledger import PassingSide
from viaspline.planning.problem.method import Found
from viaspline.space.asked_passes import AskedPass, asked_passes, gates_of_leg, passes_of_leg
from viaspline.space.gates_crossed import side_of, straight_crossings
from viaspline.space.legs_without_way import given_up_leg, refused_leg, shut_leg
from viaspline.space.routing.pass_gates import SIDE_BITS, gate
from viaspline.space.routing.search_room import SearchRoom
from viaspline.space.routing.side_seeds import seeds
from viaspline.space.routing.space_router import SpaceRouter
from viaspline.space.routing.taut_route import (
    LENGTH,
    Norm,
    SpaceGaveUp,
    SpaceOutcome,
    SpaceRefusal,
    TautRoute,
)
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.weighed_ways import TautWay

ROOM: Final = (0.3, 1.0, 3.0)
"""Of the body and its clearance: what ways keep beyond that, so that corners can be gentle."""

LEAST_BODY_M: Final = 0.1

DEARER: Final = 1.3
"""Ways with more room that cost more, of the cheapest, aren't taken for any gentler corners."""

LONGER: Final = 1.05
"""Ways on other sides of voxels that cost more, of the cheapest, aren't the shortest with corners
rounded either."""

NEARLY: Final = 1.18
"""By so much at least a side has to be cheaper than that to be looked for with more room."""

SAME_M: Final = 1e-3
"""Ways whose corners are nearer to each other are one."""


@dataclass(frozen=True)
class LegRouter:
    """Finds the ways of the legs of a mission.

    Attributes:
        problem: What is asked.
        mission: Whose obstacles have sides on which they are to be passed.
    """

    problem: SpatialProblem
    mission: Mission

    @cached_property
    def _router(self) -> SpaceRouter:
        world = self.problem.world
        solids = [obstacle.solid() for obstacle in self.mission.world.standing]
        return SpaceRouter(SearchRoom.of_world(world).knowing(world, solids))

    @cached_property
    def _asked(self) -> tuple[AskedPass, ...]:
        return asked_passes(self.mission)

    @cached_property
    def _norm(self) -> Norm:
        limits = self.problem.limits
        if self.problem.objective == "length":
            return LENGTH
        top = limits.along.max_speed
        up = top if limits.climb is None else limits.climb
        down = top if limits.descent is None else limits.descent
        return top, up, down

    @property
    def _body(self) -> float:
        """Radius of the body and its clearance together [m]."""
        return self.problem.required + float(self.problem.world.packed.core[0])

    def gates(self, leg: int) -> Floats:
        """What a leg has to pass on which sides, (g, 8)."""
        return self._gates_between(*self._ends(leg))

    def _gates_between(self, first: Floats, last: Floats) -> Floats:
        return gates_of_leg(self._asked, first, last, self._body)

    def _shut_passes(self, first: Floats, last: Floats) -> list[AskedPass]:
        """What is to be passed between two places on sides none of which there is."""
        required, room = self.problem.required, self._router.room
        near = passes_of_leg(self._asked, first, last, self._body)
        return [one for one in near if one.is_shut(room, first, last, required)]

    def between(self, first: Floats, last: Floats) -> SpaceOutcome:
        """The cheapest way between any two places [m], (3,) each, on the sides that are asked.

        Where there is none, it isn't said why.
        """
        if shut := self._shut_passes(first, last):
            return SpaceRefusal(f"nothing passes {shut[0].words}", None, (*first.tolist(),))
        gates = self._gates_between(first, last)
        return self._router.without_proof.find(
            first, last, self.problem.required, self._norm, gates
        )

    def straight_cost(self, first: Floats, last: Floats) -> float:
        """What the straight way between two places costs [m or s], whatever stands there."""
        return float(way_cost(np.array(self._norm), np.array([first, last], np.float64)))

    def ways(self, leg: int, proof: Certificate) -> Sequence[TautWay]:
        """The cheapest way of a leg, ones with more room, and ways on other sides of what is near.

        Without these where they are looked for later: see ``defers``.

        Args:
            leg: Which one.
            proof: What is nearest to the curve that it would have, which isn't as it should be.

        Raises:
            NoPathError: There is none, proven.
            GaveUpError: None was found.
        """
        gates = self.gates(leg)
        solid = self._in_the_way(proof)
        taut = self._taut(leg)
        cheapest = _way_of(solid, taut)
        most = DEARER * taut.cost
        roomy = list(self._with_room(leg, gates, cheapest.side, most))
        if solid is None or len(gates) or self.defers(proof):
            return _different([cheapest, *roomy])
        ends = self._ends(leg)
        router = self._router.best_up_to(most)
        if isinstance(solid, Voxels):
            router = router.up_to(most)
        past = seeds(router, solid, *ends, self.problem.required, self._norm, taut)
        ways = [_way(seed.side, seed.route) for seed in past]
        for seed in past:
            if seed.side != cheapest.side and NEARLY * seed.route.cost <= most:
                one_side = gate(solid, *ends, [seed.side])
                roomy += self._with_room(leg, one_side, seed.side, most)
        return _different([cheapest, *ways, *roomy])

    def defers(self, proof: Certificate) -> bool:
        """Whether ways on other sides of what is near are looked for only to be told of.

        Sides of voxels are those of all of them together: seldom what the leg has to pass, and no
        shorter than the cheapest way, which is where the length counts.

        Args:
            proof: See ``ways``.
        """
        by_length = self.problem.objective == "length"
        return by_length and isinstance(self._in_the_way(proof), Voxels)

    def others(self, leg: int, proof: Certificate) -> Sequence[TautWay]:
        """Ways on other sides of what is near that aren't much longer than the cheapest.

        Args:
            leg: Which one.
            proof: See ``ways``.
        """
        solid = self._in_the_way(proof)
        if solid is None or len(self.gates(leg)):
            return ()
        taut = self._taut(leg)
        router = self._router.up_to(LONGER * taut.cost).best_up_to(taut.cost)
        past = seeds(router, solid, *self._ends(leg), self.problem.required, self._norm, taut)
        ways = [_way(seed.side, seed.route) for seed in past]
        return _different([_way_of(solid, taut), *ways])[1:]

    def pulled(self, leg: int, way: Floats) -> Floats | None:
        """The corners of a way (n, 3) [m] of a leg pulled taut, (k, 3); None: it isn't free."""
        try:
            taut = self._router.pulled(way, self.problem.required, self._norm, self.gates(leg))
        except GeometryError:
            return None
        return taut.points[1:-1]

    def cheapest(self, leg: int, proof: Certificate) -> TautWay:
        """The cheapest way of a leg alone: found soon, and compared with no other.

        Args:
            leg: Which one.
            proof: See ``ways``.

        Raises:
            NoPathError: There is none, proven.
            GaveUpError: None was found.
        """
        return _way_of(self._in_the_way(proof), self._taut(leg))

    def _taut(self, leg: int) -> TautRoute:
        """The cheapest way of a leg."""
        first, last = self._ends(leg)
        if shut := self._shut_passes(first, last):
            raise shut_leg(self.problem, leg, shut)
        gates = self.gates(leg)
        outcome = self._router.find(first, last, self.problem.required, self._norm, gates)
        if isinstance(outcome, SpaceRefusal):
            raise refused_leg(self.problem, leg, outcome)
        if isinstance(outcome, SpaceGaveUp):
            raise given_up_leg(self.problem, leg, outcome, self._sides_in_the_way(leg))
        return outcome.value

    def _ends(self, leg: int) -> tuple[Floats, Floats]:
        return self.problem.vias[leg].at, self.problem.vias[leg + 1].at

    def _with_room(
        self, leg: int, gates: Floats, side: PassingSide, most: float
    ) -> Iterator[TautWay]:
        """The cheapest ways that keep more than has to be: room for gentle corners.

        Where the length counts there are none: they are longer.
        """
        if self.problem.objective == "length":
            return
        first, last = self._ends(leg)
        kept, quick = self.problem.required, self._router.quick.up_to(most)
        body = max(kept + float(self.problem.world.packed.core[0]), LEAST_BODY_M)
        for share in ROOM:
            outcome = quick.find(first, last, kept + share * body, self._norm, gates)
            if not isinstance(outcome, Found) or outcome.cost > most:
                return  # where there is no room for less, there is none for more
            yield _way(side, outcome.value)

    def _in_the_way(self, proof: Certificate) -> Solid | None:
        """The solid that a curve is nearest to; None if that is something else."""
        names = list(self.problem.world.names)
        if proof.holds or proof.obstacle not in names:
            return None
        return self.mission.world.standing[names.index(proof.obstacle)].solid()

    def _sides_in_the_way(self, leg: int) -> str:
        """The asked sides of a leg, if there is a way without them; else nothing."""
        first, last = self._ends(leg)
        asked = passes_of_leg(self._asked, first, last, self._body)
        if not asked or not isinstance(
            self._router.find(first, last, self.problem.required, self._norm), Found
        ):
            return ""
        return " and ".join(one.words for one in asked)


def _different(ways: Sequence[TautWay]) -> Sequence[TautWay]:
    """Ways without those that run where one before them runs."""
    kept: list[TautWay] = []
    for way in ways:
        if not any(
            way.inner.shape == one.inner.shape and np.allclose(way.inner, one.inner, atol=SAME_M)
            for one in kept
        ):
            kept.append(way)
    return kept


def _way(side: PassingSide, route: TautRoute) -> TautWay:
    """A route as the way of a leg, on a side."""
    return TautWay(side, route.points[1:-1], route.cost)


def _way_of(solid: Solid | None, route: TautRoute) -> TautWay:
    """A route as the way of a leg, named by its side of a solid."""
    return _way(_side_past(solid, route), route)


def _side_past(solid: Solid | None, route: TautRoute) -> PassingSide:
    """On which side a route passes a solid; over, where it doesn't cross its gate."""
    if route.is_direct:
        return "straight"
    if solid is None:
        return "over"
    rows = gate(solid, route.points[0], route.points[-1], SIDE_BITS)
    for row in rows:
        for place in straight_crossings(route.points, row):
            bit = side_of(row, place)
            return next(side for side, own in SIDE_BITS.items() if own == bit)
    return "over"
