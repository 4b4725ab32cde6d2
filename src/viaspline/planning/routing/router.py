"""The shortest route between two places, by whichever method finds it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from operator import attrgetter

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.planning.problem.method import Method, Outcome, first_settled
from viaspline.planning.routing.exact_route import ExactRoute
from viaspline.planning.routing.fatter_route import FatterRoute
from viaspline.planning.routing.fine_route import FineRoute
from viaspline.planning.routing.lattice_route import LatticeRoute
from viaspline.planning.routing.lattices import CELLS_SHORTEST
from viaspline.planning.routing.route_problem import (
    SHORTEST_MARGINS_M,
    RouteProblem,
    SearchSpace,
    for_nothing,
)
from viaspline.planning.routing.taut_path import TautPath

RouteMethod = Method[RouteProblem, TautPath]

MAX_EXACT_OBSTACLES = 16  # in the way of a leg, beyond which a lattice is asked first
# A search among half as many again takes a millisecond more where the lattice takes ten. What it
# finds is worth it if it is another way round; by less than the gain the two turn corners apart.
MAX_EXACT_AGAIN, LEAST_GAIN_AGAIN = 40, 1e-3

ROUTE_METHODS: tuple[RouteMethod, ...] = (
    ExactRoute(max_met=MAX_EXACT_OBSTACLES),
    LatticeRoute(),
    ExactRoute(MAX_EXACT_OBSTACLES, MAX_EXACT_AGAIN, LEAST_GAIN_AGAIN),
    FineRoute(max_met=MAX_EXACT_AGAIN),
    FatterRoute(),
)
AMONG_MADE: tuple[RouteMethod, ...] = (
    ROUTE_METHODS[0],
    LatticeRoute(lattices=SearchSpace.made_lattices),
    *ROUTE_METHODS[2:-1],
)
SHORTEST_METHODS: tuple[RouteMethod, ...] = (
    ROUTE_METHODS[0],
    LatticeRoute(lattices=attrgetter("fine_lattices"), more_than=MAX_EXACT_OBSTACLES),
    *ROUTE_METHODS[1:],
)
"""Where it is the length that counts: of ways that hardly differ, fine cells tell the shortest."""


@dataclass(frozen=True)
class Router(SearchSpace):
    """Finds the shortest routes in a space.

    With few obstacles in the way the search is exact among them alone. Among many, and on maps,
    a guide through a lattice of free cells is pulled taut; the better of the two is taken.

    Attributes:
        methods: In the order in which they are asked.
    """

    methods: tuple[RouteMethod, ...] = ROUTE_METHODS

    def find(
        self,
        start: Floats,
        goal: Floats,
        barriers: Floats,
        active: Flags,
        spend: Callable[[float], None] = for_nothing,
    ) -> Outcome[TautPath]:
        """The shortest route that keeps the distance from everything and crosses no barrier.

        Args:
            start: [m], at least (2,).
            goal: [m], at least (2,).
            barriers: Segments not to cross, (b, 4).
            active: (n,): obstacles to begin with; those met are added in place.
            spend: Takes off what work costs; see ``Requirements``.
        """
        problem = RouteProblem(self, start, goal, barriers, active, spend)
        return first_settled(self.methods, problem)

    @property
    def for_shortest(self) -> Router:
        """This one where it is the length of a path that counts."""
        return replace(
            self, methods=SHORTEST_METHODS, most_cells=CELLS_SHORTEST, margins=SHORTEST_MARGINS_M
        )

    @cached_property
    def among_made(self) -> Router:
        """This one without any finer lattices than those that are made by now.

        Another way than the one that was found is worth no finer ones.
        """
        other = replace(self, methods=AMONG_MADE)
        vars(other).update({name: getattr(self, name) for name in ("_lattices", "pulled")})
        return other

    def is_dense(self, active: Flags) -> bool:
        """Whether routes are sought on a lattice first: on maps, and among many obstacles."""
        return self.has_maps or bool(np.count_nonzero(active) > MAX_EXACT_OBSTACLES)
