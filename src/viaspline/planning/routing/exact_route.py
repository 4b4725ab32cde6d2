"""The exact shortest route among few obstacles: a search of their tangent graph."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.routing.tangent_graph import has_narrow_gap, shortest_route
from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.routing.route_problem import (
    TURN_MARGINS_M,
    TURN_STEPS_RAD,
    RouteProblem,
)
from viaspline.planning.routing.taut_path import TautPath


@dataclass(frozen=True)
class ExactRoute:
    """The shortest route in the tangent graph of the obstacles that it meets.

    The search is among those alone, so it is quick where they are few and slow where they are
    many. Round corners are circumscribed, a millimetre or less too far out: where it finds nothing,
    that is no proof that there is nothing.

    Attributes:
        more_than: Obstacles met up to which it is left to the others.
        max_met: Obstacles met beyond which it gives up.
        least_gain: Part of the bound by which a route has to be shorter.
        level: How close corners are to what they are of: of ``TURN_MARGINS_M``.
    """

    more_than: int = -1
    max_met: int = 16
    least_gain: float = 0.0
    level: int = 0

    def lay(self, problem: RouteProblem, bound: float = math.inf) -> Found[TautPath] | GaveUp:
        """See ``Method``."""
        if problem.space.has_maps:
            return GaveUp(("corners, which a map has too many of",))
        if not self.more_than < problem.active_count <= self.max_met:
            return self._gave_up(problem)
        start, goal = (np.ascontiguousarray(end[:2]) for end in (problem.start, problem.goal))
        space, margin = problem.space, _margin(problem, self.level)
        corners = shortest_route(
            space.world.packed, start, goal, space.required + margin,
            space.floor, TURN_STEPS_RAD[self.level], problem.barriers, problem.active, self.max_met,
        )  # fmt: skip
        if not len(corners):
            return self._gave_up(problem)
        taut_path = TautPath.through(corners)
        if not taut_path.length <= (1.0 - self.least_gain) * bound:
            return GaveUp((f"a route of {taut_path.length:.3f} m, which is not shorter",))
        is_taut = len(taut_path.bends) > 0 and not taut_path.is_wound
        is_settled = is_taut and _is_surely_shortest(problem, self.level)
        return Found(taut_path, taut_path.length, is_settled)

    def _gave_up(self, problem: RouteProblem) -> GaveUp:
        met = problem.active_count
        limit = f", of at most {self.max_met}" if met > self.max_met else ""
        return GaveUp((f"the tangents of {met} obstacles{limit}",))


def _margin(problem: RouteProblem, level: int) -> float:
    """How far off what is required corners stand [m]."""
    return min(TURN_MARGINS_M[level], problem.space.margins[0])


def _is_surely_shortest(problem: RouteProblem, level: int) -> bool:
    """Whether circumscribed corners close no gap that the arcs themselves leave open.

    Nor stand beyond an end, which then has no tangent to them.
    """
    space, active = problem.space, problem.active
    if not active.any():
        return True
    if space.world.enclosures:
        return False
    met = (space.world.obstacles[i].ring for i in np.flatnonzero(active))
    turned = 0.5 * TURN_STEPS_RAD[level]  # at a corner, to either side; half of that on a disc
    excess = max(
        (ring.radius + space.required)
        * (1.0 / math.cos(turned * (0.5 if ring.is_disc else 1.0)) - 1.0)
        for ring in met
        if ring is not None
    )
    reach = space.required + _margin(problem, level) + excess
    ends = np.array([problem.start[:2], problem.goal[:2]])
    if float(space.world.distance(ends).min()) < reach:
        return False
    return not has_narrow_gap(space.world.packed, active, 2.0 * space.floor, 2.0 * reach)
