"""Length, proven clearance and curvature of a candidate's curve."""

from __future__ import annotations

from viaspline.detour.brief import Brief
from viaspline.detour.ledger import Candidate
from viaspline.detour.route import Floats
from viaspline.kernels.clearance import tightest
from viaspline.kernels.measure import length_and_curvature
from viaspline.world.world import World

TOLERANCE = 1e-2  # of a candidate's clearance [m]; the path's own certificate is proven anew


def measure(spans: Floats, world: World, brief: Brief) -> Candidate:
    """What a curve costs; the caller gives it its side and via points.

    Args:
        spans: A curve that is known to keep what the brief requires, shape (m, 4, d).
        world: The known world.
        brief: What it keeps.
    """
    lower = float(tightest(world.packed, spans, TOLERANCE)[0])
    length, sharpest = length_and_curvature(spans)
    return Candidate(
        side="left",
        vias=spans[1:, 0],
        spans=spans,
        length=float(length),
        clearance=max(lower - brief.radius, brief.clearance),
        max_curvature=float(sharpest),
    )
