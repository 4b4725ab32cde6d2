"""Routes for robots so slim that the cells of no lattice are small beside them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.routing.lattice_route import LatticeRoute
from viaspline.planning.routing.route_problem import RouteProblem
from viaspline.planning.routing.taut_path import TautPath


@dataclass(frozen=True)
class FatterRoute:
    """What is found for the slimmest robot that cells are small beside.

    Cells that aren't are closed where any place in them may lack the room, so gaps that are wide
    enough for a somewhat fatter robot are lost: it would find a way where this one finds none.
    """

    def lay(self, problem: RouteProblem, bound: float = math.inf) -> Found[TautPath] | GaveUp:
        """See ``Method``."""
        if math.isfinite(bound):
            return GaveUp(("a fatter robot, where there is a route already",))
        fatter = problem.space.of_fatter
        if fatter is None:
            return GaveUp(())
        found = LatticeRoute().lay(replace(problem, space=fatter))
        if isinstance(found, Found):
            return found
        return GaveUp((f"what a robot finds that needs {fatter.required:.3g} m",))
