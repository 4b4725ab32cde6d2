"""What a table of variants says of one of them: its figures, or in words why it has none.

Tested through ``studio/test_variant_comparison``.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from viaspline.planner import Plan
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.studio.page_numbers import finite, flat

if TYPE_CHECKING:
    from viaspline.studio.plan_document import PlannedDocument
    from viaspline.studio.space.planned_spatial import PlannedSpatial


def variant_row(planned: PlannedDocument | PlannedSpatial) -> dict[str, Any]:
    """Length [m], time [s], sharpest radius [m], least clearance [m], curvature jumps, verdict.

    A radius is None where all is straight, a clearance where there is nothing to keep clear of;
    of a path in space neither jumps nor a verdict are told.
    """
    plan = planned.plan
    head = {"ms": round(1e3 * planned.seconds, 3), "ok": plan is not None}
    if plan is None:
        words = [f"{fault.text}: {fault.remedy}".rstrip(": ") for fault in planned.problems]
        return {**head, "gaveUp": planned.gave_up, "words": words}
    proof = plan.certificate
    return {
        **head,
        "spans": flat(plan.path.spans),
        "length": plan.path.length,
        "duration": plan.trajectory.duration,
        "clearance": finite(proof.clearance),
        "required": proof.required,
        "at": proof.tightest_at[:2],
        **_drivability(plan),
    }


def _drivability(plan: Plan | SpatialPlan) -> dict[str, Any]:
    if isinstance(plan, SpatialPlan):
        return {"radius": _radius(plan.sharpest_radius), "jumps": None, "verdict": None, "why": []}
    drive = plan.drivability
    return {
        "radius": _radius(drive.sharpest_radius),
        "jumps": drive.curvature_jumps,
        "verdict": drive.verdict,
        "why": [reason.text for reason in drive.reasons[:6]],
    }


def _radius(radius: float | None) -> float | None:
    return None if radius is None or not math.isfinite(radius) else radius
