"""How a path drives, as ``plan.json`` and the studio have it.

Tested through ``report/files/test_plan_json``.
"""

from __future__ import annotations

import math
from typing import Any

from viaspline.machine.drivability import Drivability, PathPlace


def drivability_data(drive: Drivability) -> dict[str, Any]:
    """The verdict, why, and what it was made of; a radius is null where all is straight."""
    return {
        "verdict": drive.verdict,
        "reasons": [{"text": why.text, **_place(why.place)} for why in drive.reasons],
        "sharpest_radius_m": drive.sharpest_radius,
        "sharpest_at": _at(drive.sharpest),
        "sharpest_distance_m": None if drive.sharpest is None else drive.sharpest.distance,
        "sharpest_near": None if drive.sharpest is None else drive.sharpest.near,
        "least_radius_m": drive.least_radius,
        "max_lateral_accel_mps2": drive.max_lateral_accel,
        "max_lateral_accel_at": _at(drive.max_lateral_at),
        "curvature_jumps": drive.curvature_jumps,
        "largest_curvature_jump_1pm": drive.largest_jump,
        "largest_curvature_jump_at": _at(drive.largest_jump_at),
        "curvature_sign_changes": drive.sign_changes,
        "near_cusps": [
            {
                "turn_deg": math.degrees(cusp.turn),
                "length_m": cusp.length,
                "radius_m": cusp.radius,
                **_place(cusp.place),
            }
            for cusp in drive.near_cusps
        ],
        "turns_on_spot": [
            {
                "turn_deg": math.degrees(turn.turn),
                "time_s": turn.time,
                "speed_mps": turn.speed,
                "asked": turn.asked,
                **_place(turn.place),
            }
            for turn in drive.turns_on_spot
        ],
    }


def _at(place: PathPlace | None) -> tuple[float, ...] | None:
    return None if place is None else place.at


def _place(place: PathPlace | None) -> dict[str, Any]:
    if place is None:
        return {"at": None, "distance_m": None, "near": None}
    return {"at": place.at, "distance_m": place.distance, "near": place.near}
