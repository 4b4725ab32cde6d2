"""Length, proven clearance and curvature of a candidate's curve.

Tested through ``planning/problem/test_ledger``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.disc import STILL, tightest
from viaspline.kernels.curve.measure import length_and_curvature
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import PROOF_S, PROOF_SPAN_S
from viaspline.world.world import World

CLEARANCE_TOLERANCE_M = 1e-2  # of a candidate; the path's own certificate is proven anew


@dataclass(frozen=True)
class CandidateCost:
    """What a curve costs: length [m], proven clearance of the body [m], sharpest bend [1/m]."""

    length: float
    clearance: float
    max_curvature: float


def measure(spans: Floats, world: World, requirements: Requirements) -> CandidateCost:
    """What a curve costs.

    Args:
        spans: A curve that is known to keep what is required, shape (m, 4, d).
        world: The known world.
        requirements: What it keeps.
    """
    requirements.spend(PROOF_S + PROOF_SPAN_S * len(spans))
    lower = float(tightest(world.packed, spans, STILL, CLEARANCE_TOLERANCE_M)[0])
    length, sharpest = length_and_curvature(spans)
    return CandidateCost(
        float(length), max(lower - requirements.radius, requirements.kept), float(sharpest)
    )


def measure_body(spans: Floats, world: World, requirements: Requirements) -> CandidateCost:
    """What a curve costs that a body drives, whether it keeps what is required or not."""
    length, sharpest = length_and_curvature(spans)
    clearance = proven(PiecewiseCubic(spans), world, requirements).clearance
    return CandidateCost(float(length), clearance, float(sharpest))
