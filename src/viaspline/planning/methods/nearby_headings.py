"""Turns with headings at those via points alone about which they have no room without.

At all via points together headings take long to choose; at most of them the turn that a path makes
of itself, with half of it before the via point and half behind it, is as good as any.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.planning.methods.joint_headings import JointHeadings
from viaspline.planning.problem.method import Found, GaveUp
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.headings import costs_between
from viaspline.planning.turning.turn_problem import TurnProblem


@dataclass(frozen=True)
class NearbyHeadings:
    """Lays turns between headings where turns that come of themselves are too tight.

    Attributes:
        headings: Chooses them, and says how many are tried.
    """

    headings: JointHeadings

    def lay(self, problem: TurnProblem, bound: float = math.inf) -> Found[SplinePath] | GaveUp:
        """See ``Method``."""
        sought = self._sought(problem)
        is_other = sought or problem.spots
        poses = self.headings.poses(problem, sought, bound) if is_other else None
        if poses is None:
            return GaveUp(("headings at the via points about what is tight",))
        spline_path = problem.laid(poses)
        roomy = problem.without_blocked_spots(spline_path)
        if roomy is not None:
            return self.lay(roomy, bound)
        return Found(spline_path, problem.path.cost(spline_path))

    def _sought(self, problem: TurnProblem) -> frozenset[int]:
        """Where headings are sought: as well where there are no turns between those otherwise."""
        sought, more = frozenset[int](), problem.tight_vias
        while more:
            sought |= more
            legs = problem.heading_legs(sought, self.headings.headings)
            costs = costs_between(legs, problem.path.requirements)
            found = zip(legs, costs, strict=True)
            more = frozenset().union(
                *(leg.inner_vias for leg, its in found if not np.isfinite(its).any())
            )
        return sought
