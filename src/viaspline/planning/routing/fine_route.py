"""Routes through gaps that are hardly wider than a robot much smaller than what it goes round."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.problem.work_budget import FINE_ROUTE_OBSTACLES_S
from viaspline.planning.routing.exact_route import ExactRoute
from viaspline.planning.routing.route_problem import TURN_STEPS_RAD, RouteProblem
from viaspline.planning.routing.taut_path import TautPath


@dataclass(frozen=True)
class FineRoute:
    """The exact search with corners ever closer to round obstacles, where nothing was found yet.

    A disc wrapped in a dozen corners takes a hundredth of its radius from the gaps beside it. That
    is much for a robot that is a thousand times smaller than its world, and there the cells of a
    lattice are as wide as the robot.

    Attributes:
        max_met: Obstacles met beyond which it gives up.
    """

    max_met: int

    def lay(self, problem: RouteProblem, bound: float = math.inf) -> Found[TautPath] | GaveUp:
        """See ``Method``."""
        if math.isfinite(bound):
            return GaveUp(("finer tangents, where there is a route already",))
        tried: tuple[str, ...] = ()
        for level in range(1, len(TURN_STEPS_RAD)):
            problem.spend(FINE_ROUTE_OBSTACLES_S * problem.active_count**2)
            found = ExactRoute(max_met=self.max_met, level=level).lay(problem)
            if isinstance(found, Found):
                return found
            tried = found.tried
        return GaveUp(tried)
