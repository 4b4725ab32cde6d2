"""Passive safety, in the simulator: whatever moves, the robot stands before it is touched."""

from __future__ import annotations

import numpy as np
import pytest

import viaspline as vs

TOP_MPS = 1.5


def among(seed: int, safety: str) -> vs.Mission:
    """Discs that turn at will every second or two, none faster than ``TOP_MPS``."""
    random = np.random.default_rng(seed)
    unseen = []
    for i in range(7):
        place, time = random.uniform((3, -6), (21, 6)), 0.0
        frames = [[time, *place.tolist()]]
        while time < 40.0:
            lasts, angle = float(random.uniform(1.0, 2.5)), float(random.uniform(0, 2 * np.pi))
            speed = float(random.uniform(0.2, TOP_MPS))
            place = place + speed * lasts * np.array([np.cos(angle), np.sin(angle)])
            time += lasts
            frames.append([time, *place.tolist()])
        shape = {"circle": {"center": [0, 0], "radius": 0.4}}
        unseen.append({**shape, "name": f"d{i}", "motion": {"keyframes": frames, "after": "stay"}})
    return vs.Mission.model_validate(
        {
            "world": {"unseen": unseen},
            "robot": {
                "radius_m": 0.25,
                "clearance_m": 0.05,
                "sensor": {"range_m": 8},
                "moving": {"max_speed_mps": TOP_MPS, "safety": safety},
            },
            "route": {"start": [0, 0], "goal": [24, 0]},
        }
    )


@pytest.mark.parametrize("seed", range(4))
def test_nothing_touches_a_robot_that_moves(seed: int) -> None:
    run = vs.simulate(among(seed, "passive"), step=0.1)
    assert run.encounters is not None
    assert [contact for contact in run.encounters.contacts if contact.robot_speed > 0.0] == []
    assert run.speeds.max() <= 2.0 + 1e-9


def test_who_does_without_drives_as_if_nothing_came_from_out_of_sight() -> None:
    calm, bold = (vs.simulate(among(3, safety), step=0.1) for safety in ("passive", "none"))
    assert bold.duration <= calm.duration
