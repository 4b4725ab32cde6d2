"""A robot with a drive that something runs into stands: it doesn't creep to its place meanwhile."""

from __future__ import annotations

from typing import Any

import pytest

import viaspline as vs

DIFFERENTIAL = {"differential": {"track_m": 0.4}, "delay_s": 0.1, "lag_s": 0.1}
ACROSS = {"max_speed_along_mps": 1.5, "max_speed_across_mps": 1.0, "hold_heading_deg": 30}
WALL = [[-2.0, 0.6], [12.0, 0.6], [12.0, 0.8], [-2.0, 0.8]]


def head_on(drive: dict[str, Any], speed: float, place: float) -> vs.Mission:
    """A cart that comes through a corridor which is too narrow for both."""
    walls = [{"polygon": [[x, side * y] for x, y in WALL]} for side in (-1, 1)]
    frames = [[0, place, 0], [(place + 2.0) / speed, -2.0, 0]]
    cart = {
        "name": "cart",
        "circle": {"center": [0, 0], "radius": 0.3},
        "motion": {"keyframes": frames, "after": "vanish"},
    }
    robot = {
        "radius_m": 0.25,
        "clearance_m": 0.05,
        "max_speed_mps": 1.0,
        "sensor": {"range_m": 4},
        "moving": {"max_speed_mps": speed, "safety": "passive"},
        "drive": drive,
        "localization": {"position_noise_m": 0.01, "heading_noise_deg": 0.5},
    }
    return vs.Mission.model_validate(
        {
            "world": {"known": walls, "unseen": [cart]},
            "robot": robot,
            "route": {"start": [0, 0], "goal": [5, 0]},
        }
    )


@pytest.mark.parametrize(
    ("drive", "speed", "place"),
    [(DIFFERENTIAL, 1.5, 10.0), (DIFFERENTIAL, 1.0, 9.0), ({"omnidirectional": ACROSS}, 1.5, 9.0)],
)
def test_one_that_something_runs_into_stands(
    drive: dict[str, Any], speed: float, place: float
) -> None:
    """It was touched at 0.002 to 0.02 m/s: by its lag, and by what its measured place was off."""
    run = vs.simulate(head_on(drive, speed, place))
    assert run.encounters is not None
    assert [one.robot_speed for one in run.encounters.contacts] == [0.0]
    assert run.reached
