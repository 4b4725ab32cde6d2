"""Plans in space as the page draws them: from above as others, and what they are in height.

Tested through ``studio/space/test_spatial_server``.
"""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np

from viaspline.planning.problem.ledger import Candidate
from viaspline.report.files.drivability_json import drivability_data
from viaspline.report.files.json_text import plain
from viaspline.report.space.heights_json import heights_rows
from viaspline.space.route_law import LANDING, TAKE_OFF
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.studio.page_numbers import finite, flat, rounded
from viaspline.studio.plan_messages import (
    from_above,
    grids,
    law_data,
    problem_data,
    proof_data,
)
from viaspline.studio.space.planned_spatial import PlannedSpatial

MAX_SIDES_TOLD: Final = 4


def spatial_answer(planned: PlannedSpatial, revision: int, scene: str | None) -> dict[str, Any]:
    """What the page is told of a plan in space, or of why there is none.

    Args:
        planned: What came of the document.
        revision: What the page calls it.
        scene: The name of what stands in its world; None if that isn't sound.
    """
    head: dict[str, Any] = {
        "type": "planned", "rev": revision, "ms": round(1e3 * planned.seconds, 3),
        "grids": grids(planned), "tracks": [], "timing": None,
    }  # fmt: skip
    plan = planned.plan
    if plan is None:
        problems = [problem_data(problem) for problem in planned.problems]
        space: dict[str, Any] = {"scene": scene}
        return {
            **head, "ok": False, "gave_up": planned.gave_up, "problems": problems, "space": space,
        }  # fmt: skip
    space = {"scene": scene, "is_whole": planned.is_whole, **_in_space(plan)}
    return {**head, "ok": True, **_from_above(plan), **law_data(plan.trajectory), "space": space}


def _from_above(plan: SpatialPlan) -> dict[str, Any]:
    """What a plan in space has in common with one in the plane."""
    path, proof = plan.path, plan.certificate
    kinds = ["upright" if v.kind == "user" and v.index is None else v.kind for v in path.vias]
    return {
        **from_above(path, kinds),
        "curvature": 1.0 / plan.sharpest_radius,
        "certificate": proof_data(proof),
        "drivability": plain(drivability_data(plan.drivability)),
        "corridor": [],
    }


def _in_space(plan: SpatialPlan) -> dict[str, Any]:
    """Heights of a plan, and what is proven of them."""
    path = plan.path
    bends = np.ones(len(plan.yaw.headings), bool)
    bends[1:-1] = np.abs(np.diff(plan.yaw.headings, 2)) > 1e-12
    return {
        "spans": np.ascontiguousarray(path.spans).reshape(-1).tolist(),
        "heights": rounded([via.at[2] for via in path.vias], 4),
        "stops": _stops(plan),
        "yaw": {
            "distances": rounded(plan.yaw.distances[bends], 4),
            "headings": rounded(plan.yaw.headings[bends], 5),
        },
        "tightest_z": rounded(plan.certificate.tightest_at[2], 4),
        "rows": heights_rows(plan),
        "band": [finite(limit) for limit in plan.world.band.numbers],
        "limits": [plan.mission.robot.climb_speed, plan.mission.robot.descent_speed],
    }


def _stops(plan: SpatialPlan) -> list[dict[str, Any]]:
    """The points of the route where they are passed in the air, each lap's once more."""
    vias = plan.path.vias
    found = []
    for k, via in enumerate(vias):
        if via.kind != "user" or via.index is None:
            continue
        aloft = via
        if k + 1 < len(vias) and vias[k + 1].name == TAKE_OFF and vias[k + 1].index is None:
            aloft = vias[k + 1]
        elif k > 0 and vias[k - 1].name == LANDING and vias[k - 1].index is None:
            aloft = vias[k - 1]
        found.append({
            "index": via.index,
            "at": rounded(aloft.at, 4),
            "ground": finite(float(plan.world.ground_at(np.array(aloft.at)))),
            "distance": round(float(plan.path.distance(aloft.u)), 4),
        })  # fmt: skip
    return found


def spatial_ledger(planned: PlannedSpatial, revision: int) -> dict[str, Any]:
    """What stood in the way of each leg, and the best way on each side of it."""
    plan, unfolded = planned.plan, planned.unfolded
    assert plan is not None
    assert unfolded is not None
    standing = [i for i, one in enumerate(plan.mission.world.known) if one.motion is None]
    items = dict(zip(plan.world.names, standing, strict=True))
    entries = []
    for entry in plan.ledger:
        members = [items[name] for name in entry.members if name in items]
        places = [unfolded.original(("world", "known", item))[2] for item in members]
        entries.append({
            "members": list(entry.members),
            "items": sorted(set(places)),
            "leg": entry.leg,
            "forceable": bool(members),
            "forced": _forced(plan, members),
            "candidates": [_way(one) for one in _best_of_sides(entry.candidates)],
        })  # fmt: skip
    return {"type": "ledger", "rev": revision, "entries": entries}


def _forced(plan: SpatialPlan, members: list[int]) -> str | None:
    """The side on which the first of some obstacles has to be passed."""
    return plan.mission.world.known[members[0]].pass_on if members else None


def _best_of_sides(candidates: tuple[Candidate, ...]) -> list[Candidate]:
    """One candidate a side: the one that was taken, or else the one that costs least."""
    best: dict[str, Candidate] = {}
    for one in candidates:
        held = best.get(one.side)
        if held is None or (not held.chosen and (one.chosen or _cost(one) < _cost(held))):
            best[one.side] = one
    return list(best.values())[:MAX_SIDES_TOLD]


def _cost(candidate: Candidate) -> float:
    cost = candidate.length if candidate.duration is None else candidate.duration
    return math.inf if cost is None else cost


def _way(candidate: Candidate) -> dict[str, Any]:
    spans = np.asarray(candidate.spans)
    shown = not candidate.chosen and len(spans) > 0
    return {
        "side": candidate.side,
        "chosen": candidate.chosen,
        "spans": flat(spans) if shown else [],
        "spans3": np.ascontiguousarray(spans).reshape(-1).tolist() if shown else [],
        "length": candidate.length,
        "duration": candidate.duration,
        "clearance": finite(candidate.clearance),
        "impossible": candidate.impossible,
        "passedOver": candidate.passed_over,
    }
