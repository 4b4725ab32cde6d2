"""Length, proven clearance and curvature of a candidate's curve.

Tested through ``planning/problem/test_ledger``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.disc import STILL, tightest
from viaspline.kernels.curve.measure import length_and_curvature
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.checking.driving_time import leg_time
from viaspline.planning.problem.objective import Objective
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import PROOF_S, PROOF_SPAN_S
from viaspline.world.world import World

CLEARANCE_TOLERANCE_M = 1e-2  # of a candidate; the path's own certificate is proven anew


@dataclass(frozen=True, eq=False)
class CandidateCost:
    """What a curve costs; what it isn't chosen by is reckoned where it is asked for.

    Attributes:
        spans: The curve: Bézier control polygons [m], shape (m, 4, d).
        duration: The time in which it is driven, as far as its shape tells [s].
        prove: Tells its proven clearance [m].
    """

    spans: Floats
    duration: float
    prove: Callable[[], float]

    @cached_property
    def clearance(self) -> float:
        """Proven, of the body [m]."""
        return self.prove()

    @property
    def length(self) -> float:
        """[m]."""
        return self._length_and_curvature[0]

    @property
    def max_curvature(self) -> float:
        """Its sharpest bend [1/m]."""
        return self._length_and_curvature[1]

    @cached_property
    def _length_and_curvature(self) -> tuple[float, float]:
        length, sharpest = length_and_curvature(self.spans)
        return float(length), float(sharpest)

    def of(self, objective: Objective) -> float:
        """What it is chosen by [s or m]."""
        return self.duration if objective.is_time else self.length


def measure(
    spans: Floats, world: World, requirements: Requirements, ends: tuple[bool, bool]
) -> CandidateCost:
    """What a curve costs.

    Args:
        spans: A curve that is known to keep what is required, shape (m, 4, d).
        world: The known world.
        requirements: What it keeps.
        ends: Whether the robot stands still where it begins, and where it ends.
    """
    requirements.spend(PROOF_S + PROOF_SPAN_S * len(spans))
    duration = leg_time(spans, requirements.objective.pace, ends)
    return CandidateCost(spans, duration, partial(_proven, spans, world, requirements))


def _proven(spans: Floats, world: World, requirements: Requirements) -> float:
    """The clearance of a disc on a curve that is known to keep what is required [m]."""
    lower = float(tightest(world.packed, spans, STILL, CLEARANCE_TOLERANCE_M)[0])
    return max(lower - requirements.radius, requirements.kept)


def measure_body(
    spans: Floats, world: World, requirements: Requirements, ends: tuple[bool, bool]
) -> CandidateCost:
    """What a curve costs that a body drives, whether it keeps what is required or not."""
    clearance = proven(PiecewiseCubic(spans), world, requirements).clearance
    duration = leg_time(spans, requirements.objective.pace, ends)
    return CandidateCost(spans, duration, partial(float, clearance))
