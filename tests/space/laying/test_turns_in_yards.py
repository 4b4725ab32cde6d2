"""Flights through yards of blocks whose turns were sharper than the body."""

from __future__ import annotations

import numpy as np
import pytest

import viaspline as vs
from viaspline.mission.model import Mission


def yard(seed: int) -> Mission:
    """Four places among blocks that stand between them, a few metres off."""
    rng = np.random.default_rng(seed)
    heights = rng.uniform(0, 60, (4, 2)), rng.uniform(6, 14, 4)
    points = np.round(np.column_stack(heights), 1)
    known = []
    for _ in range(5):
        leg = int(rng.integers(3))
        middle = 0.5 * (points[leg] + points[leg + 1]) + rng.normal(0, 4, 3)
        half = rng.uniform(2, 7, 2)
        (a, b), (c, d) = np.round(middle[:2] - half, 1), np.round(middle[:2] + half, 1)
        if any((np.abs(point[:2] - middle[:2]) < half + 3).all() for point in points):
            continue
        ring = [[a, b], [c, b], [c, d], [a, d]]
        known.append({"polygon": ring, "height_m": [0, 20]})
    start, *vias, goal = points.tolist()
    return Mission.model_validate({
        "world": {"ground": {"flat_m": 0}, "known": known},
        "robot": {"radius_m": 0.6, "half_height_m": 0.3, "clearance_m": 1.0, "max_speed_mps": 6,
                  "max_accel_mps2": 2, "max_climb_mps": 2},
        "route": {"start": {"at": start}, "via": [{"at": at} for at in vias],
                  "goal": {"at": goal}},
    })  # fmt: skip


@pytest.mark.parametrize(
    "seed", [6, 18, 48, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (22, 40))]
)
def test_where_there_is_room_no_turn_is_sharper_than_the_body(seed: int) -> None:
    plan = vs.plan(yard(seed))
    assert isinstance(plan, vs.SpatialPlan)
    assert plan.certificate.holds
    assert plan.drivability.verdict == "good", plan.drivability.reasons
