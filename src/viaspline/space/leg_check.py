"""Whether a leg's curve in space is proven to be as it should, and where it isn't.

Tested through ``space/test_plan_spatial``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viaspline.curve.certificate import certify
from viaspline.curve.height_certificate import certify_heights
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.space.gates_crossed import wrong_side
from viaspline.space.spatial_problem import SpatialProblem


@dataclass(frozen=True, eq=False)
class LegCheck:
    """What a leg's curve has to pass: clearance, limits of its height, sides that are asked for.

    Attributes:
        problem: What is asked.
        gates: From a leg to what it has to pass on which sides, (g, 8).
    """

    problem: SpatialProblem
    gates: Callable[[int], Floats]

    def __call__(self, leg: int, spans: Floats) -> Floats | None:
        """Where it fails worst [m], (3,); None: it passes.

        Args:
            leg: Which one.
            spans: Its Bézier control polygons [m], shape (m, 4, 3).
        """
        asked, curve = self.problem, PiecewiseCubic(spans)
        certificate = certify(curve, asked.world, asked.clearance, radius=asked.radius)
        if not certificate.holds:
            return np.array(certificate.tightest_at)
        heights = certify_heights(curve, asked.world)
        worst = heights.tightest_at
        if not heights.holds and worst is not None:
            return np.array(worst.at)
        return wrong_side(spans, self.gates(leg))
