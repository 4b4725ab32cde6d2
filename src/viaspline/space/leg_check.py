"""Whether a leg's curve in space is proven to be as it should, and where it isn't.

Tested through ``space/test_plan_spatial``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from viaspline.curve.certificate import Certificate, certify
from viaspline.curve.height_certificate import certify_heights
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.space.gates_crossed import wrong_side
from viaspline.space.spatial_problem import SpatialProblem


def proven(problem: SpatialProblem, spans: Floats) -> Certificate:
    """What is proven of the clearance of a curve, (m, 4, 3) [m]."""
    curve = PiecewiseCubic(spans)
    return certify(curve, problem.world, problem.clearance, radius=problem.radius)


@dataclass(frozen=True, eq=False)
class LegCheck:
    """What a leg's curve has to pass: clearance, limits of its height, sides that are asked for.

    Attributes:
        problem: What is asked.
        gates: From a leg to what it has to pass on which sides, (g, 8).
        known: What was proven of curves that have been looked at, by their spans: ways that are
            weighed alone are laid once more in their route, and most legs as they were before.
        passed: Where legs with such curves fail, likewise.
    """

    problem: SpatialProblem
    gates: Callable[[int], Floats]
    known: dict[bytes, Certificate] = field(default_factory=dict)
    passed: dict[tuple[int, bytes], Floats | None] = field(default_factory=dict)

    def __call__(self, leg: int, spans: Floats) -> Floats | None:
        """Where it fails worst [m], (3,); None: it passes.

        Args:
            leg: Which one.
            spans: Its Bézier control polygons [m], shape (m, 4, 3).
        """
        key = leg, spans.tobytes()
        if key not in self.passed:
            self.passed[key] = self._failing(leg, spans)
        return self.passed[key]

    def proof(self, spans: Floats) -> Certificate:
        """What is proven of the clearance of a curve, (m, 4, 3) [m]."""
        key = spans.tobytes()
        if key not in self.known:
            self.known[key] = proven(self.problem, spans)
        return self.known[key]

    def _failing(self, leg: int, spans: Floats) -> Floats | None:
        """Where a leg's curve fails worst [m], (3,)."""
        certificate = self.proof(spans)
        if not certificate.holds:
            return np.array(certificate.tightest_at)
        if (place := self._wrong_height(spans)) is not None:
            return place
        return wrong_side(spans, self.gates(leg))

    def _wrong_height(self, spans: Floats) -> Floats | None:
        """Where a curve leaves its limits of height worst [m], (3,)."""
        world = self.problem.world
        z, band = spans[:, :, 2], world.band
        if not band.knows_ground and z.min() >= band.lowest and z.max() <= band.highest:
            return None  # no curve leaves the hull of its control polygons
        heights = certify_heights(PiecewiseCubic(spans), world)
        worst = heights.tightest_at
        return None if heights.holds or worst is None else np.array(worst.at)
