"""A search among poses, leg by leg: the last resort in tight space."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.planning.problem.method import Found, GaveUp, Outcome, Refusal
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.hybrid_astar.pose_search import SEARCH_EFFORTS, Effort
from viaspline.planning.turning.hybrid_astar.search_outcome import NotFound
from viaspline.planning.turning.hybrid_astar.via_route import via_route_chains
from viaspline.planning.turning.laid_turns import through_spans
from viaspline.planning.turning.turn_path import RAMP
from viaspline.planning.turning.turn_problem import TurnProblem


@dataclass(frozen=True)
class HybridAStar:
    """Searches poses between the via points, forwards and in doubt backwards.

    Where it has seen everything at its finest resolution, it proves that there is no path with
    turns of that radius. For a robot without a turning circle that is no proof: it may turn more
    sharply yet.

    Attributes:
        efforts: How finely and how long it looks, one after the other.
        max_poses_s: What it may spend on poses in all [s of the reference machine].
        max_gain_s: The same where there is a path already, for a cheaper one: what it finds of that
            it mostly finds within half a second.
    """

    efforts: Sequence[Effort] = SEARCH_EFFORTS
    max_poses_s: float = 12.0
    max_gain_s: float = 3.0

    def lay(self, problem: TurnProblem, bound: float = math.inf) -> Outcome[SplinePath]:
        """See ``Method``."""
        path, rho = problem.path, problem.rho
        most = self.max_poses_s if math.isinf(bound) else self.max_gain_s
        with (path.requirements.poses or WorkBudget(math.inf)).share(most) as poses:
            chains = via_route_chains(
                path.sequence, path.world, path.requirements, rho, RAMP * rho, problem.spots,
                poses, self.efforts, [sides.closed for sides in path.sides],
            )  # fmt: skip
        if isinstance(chains, NotFound):
            return _nothing(path, rho, chains)
        spans = np.concatenate([chain.spans for chain in chains])
        joints = np.cumsum([0, *(len(chain.spans) for chain in chains)])
        spline_path = through_spans(path.sequence, spans, joints, ())
        if not path.is_clear(spans):  # the search knows the body by the discs that cover it
            roomy = problem.without_blocked_spots(spline_path)
            if roomy is not None:
                return self.lay(roomy, bound)
            return GaveUp(("a search among poses, whose path the body itself doesn't clear",))
        if not path.keeps_sides(spline_path):
            return GaveUp(("a search among poses, whose path takes another side",))
        return Found(spline_path, path.cost(spline_path))


def _nothing(path: DrivenProblem, rho: float, failed: NotFound) -> Refusal | GaveUp:
    """A refusal where the search has seen everything."""
    via = failed.goal + (0 if failed.reason.is_at_start else 1)
    via %= len(path.sequence.vias)
    has_circle = path.requirements.turn_radius is not None
    if failed.reason.is_proof and (has_circle or not failed.reason.is_of_turns):
        return Refusal(failed.reason.value, via)
    poses = f"a search among {failed.expanded} poses with turns of at least {rho:.3g} m"
    return GaveUp((poses,), "more room round the via points", via, failed.reason.value)
