"""Runs of a path between lanes, bent so that they are driven sooner."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viaspline as vs


def between_discs(seed: int) -> vs.Mission:
    """Three via points among ten discs, where a fast robot has to slow down for its turns."""
    random = np.random.default_rng((50, seed))
    discs = [
        {"circle": {"center": random.uniform(0, 100, 2).tolist(), "radius": float(radius)}}
        for radius in random.uniform(2, 8, 10)
    ]
    places: list[list[float]] = []
    while len(places) < 5:
        place = random.uniform(2, 98, 2)
        gaps = (math.dist(place, d["circle"]["center"]) - d["circle"]["radius"] for d in discs)
        if min(gaps) > 2.5:
            places.append(place.tolist())
    robot = {"radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 5, "max_accel_mps2": 1}
    return vs.Mission.model_validate({
        "world": {"known": discs},
        "robot": robot,
        "route": {"start": places[0], "via": places[1:-1], "goal": places[-1]},
    })  # fmt: skip


@pytest.mark.parametrize(
    ("seed", "before"), [(35, 51.1), (29, 71.7), (50, 31.9), (45, 43.6), (36, 46.9)]
)
def test_runs_between_lanes_are_driven_sooner_than_with_turns_as_tight(
    seed: int, before: float
) -> None:
    plan = vs.plan(between_discs(seed))
    assert plan.trajectory.duration < 0.99 * before
    assert plan.certificate.clearance >= 0.5 - 1e-9
    assert plan.drivability.verdict == "good"
