"""What is proven of the heights of a plan in space, as data and in words.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

import math
from typing import Any

from viaspline.curve.height_certificate import HeightBound, HeightLimit
from viaspline.report.units import down, metres, place
from viaspline.space.spatial_plan import SpatialPlan

_WORDS: dict[HeightLimit, str] = {
    "lowest": "the least altitude",
    "highest": "the greatest altitude",
    "least_above_ground": "the least height above ground",
    "most_above_ground": "the greatest height above ground",
}


def heights_data(plan: SpatialPlan) -> dict[str, Any]:
    """The proven heights between take-off and landing; null above ground where none is known."""
    proof = plan.heights
    worst = proof.tightest_at
    return {
        "least_m": _bound(proof.least),
        "greatest_m": _bound(proof.greatest),
        "least_agl_m": _bound(proof.least_above_ground),
        "greatest_agl_m": _bound(proof.greatest_above_ground),
        "margins_m": dict(proof.margins),
        "tightest": proof.tightest,
        "tightest_at": None if worst is None else worst.at,
        "holds": proof.holds,
    }


def _bound(bound: HeightBound) -> float | None:
    return bound.height if math.isfinite(bound.height) else None


def heights_rows(plan: SpatialPlan) -> list[tuple[str, str]]:
    """How high the path is, for a table."""
    proof = plan.heights
    span = f"{metres(proof.least.height, 1)} to {metres(proof.greatest.height, 1)}"
    rows = [("height", span)]
    low, high = proof.least_above_ground.height, proof.greatest_above_ground.height
    if math.isfinite(low) and math.isfinite(high):
        rows.append(("above ground, proven", f"{down(low)} to {metres(high, 1)}"))
    worst = proof.tightest_at
    if proof.tightest is not None and worst is not None:
        margin = proof.margins[proof.tightest]
        rows.append(
            ("altitude", f"{down(margin)} from {_WORDS[proof.tightest]}, at {place(worst.at)}")
        )
    return rows
