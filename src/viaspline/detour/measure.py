"""Length, proven clearance and curvature of a candidate's curve."""

from __future__ import annotations

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.detour.brief import Brief
from viaspline.detour.ledger import Candidate
from viaspline.detour.route import Floats
from viaspline.kernels.clearance import tightest
from viaspline.world.world import World

TOLERANCE = 1e-3  # of a candidate's clearance [m]; the path's own certificate is proven anew


def measure(spans: Floats, world: World, brief: Brief) -> Candidate:
    """What a curve costs; the caller gives it its side and via points."""
    curve = PiecewiseCubic(spans)
    lower = float(tightest(world.packed, spans, TOLERANCE)[0])
    return Candidate(
        side="left",
        vias=spans[1:, 0],
        spans=spans,
        length=curve.length,
        clearance=max(lower - brief.radius, brief.clearance),
        max_curvature=curve.max_curvature()[0],
    )
