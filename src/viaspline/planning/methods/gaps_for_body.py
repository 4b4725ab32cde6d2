"""Proves that a body is too wide for every way, before poses are searched for one."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.planning.problem.method import GaveUp, Outcome, Refusal
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import GAPS_OBSTACLE_S, GAPS_S
from viaspline.planning.routing.bottleneck import Bottleneck, body_bottleneck, gaps_for_body
from viaspline.planning.routing.gap_graph import GapGraph, is_soon_made
from viaspline.planning.routing.leg_refusals import explain_narrow_leg
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.turn_problem import TurnProblem


@dataclass(frozen=True)
class GapsForBody:
    """Finds no path, and refuses where the body gets through none of the gaps of a leg.

    Routes are those of the largest disc about its reference point: behind the axle of a car there
    is less of it than it is wide.
    """

    def lay(self, problem: TurnProblem, bound: float = math.inf) -> Outcome[SplinePath]:
        """See ``Method``."""
        path = problem.path
        sequence, world, requirements = path.sequence, path.world, path.requirements
        is_disc = requirements.narrowest_gap <= 2.0 * requirements.required
        is_under_way = requirements.budget is not None
        if is_disc or (is_under_way and not is_soon_made(world)):
            return GaveUp(())
        for leg in range(len(sequence.legs)):
            gap = _bottleneck(path, leg)
            if gap is not None:
                error = explain_narrow_leg(sequence, leg, world, requirements, gap)
                via = (leg + 1) % len(sequence.vias)
                return Refusal("every gap on the way there is too narrow", via, error=error)
        return GaveUp(())


def _bottleneck(path: DrivenProblem, leg: int) -> Bottleneck | None:
    """What closes a leg for the body, if anything does: the same with turns of any radius."""
    world, requirements = path.world, path.requirements
    start, goal = (via.at[:2] for via in path.sequence.ends(leg))

    def measured() -> GapGraph:
        requirements.spend(GAPS_S + GAPS_OBSTACLE_S * len(world))
        return gaps_for_body(world, requirements)

    def told() -> Bottleneck | None:
        graph = requirements.recalled(("gaps", world), measured)
        return body_bottleneck(graph, start, goal, requirements)

    return requirements.recalled(("gaps for body", world, *start.tolist(), *goal.tolist()), told)
