"""What is told where no path keeps what the robot gets beside one of them."""

from __future__ import annotations

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs

RADIUS = 0.3
CLEARANCE = 0.1

DRIVES = {
    "differential": {"differential": {"track_m": 0.5}},
    "steered": {"ackermann": {"wheelbase_m": 0.6, "max_steer_deg": 35.0}},
}


def door_mission(width: float, drive: str, noise: float, reverse: bool) -> vs.Mission:
    """Through a door in a wall that is as long as the world is wide."""
    wall = [
        {"polygon": [[5.0, -4.0], [5.4, -4.0], [5.4, -width / 2], [5.0, -width / 2]]},
        {"polygon": [[5.0, width / 2], [5.4, width / 2], [5.4, 4.0], [5.0, 4.0]]},
    ]
    ends = [[1.0, 1.0], [9.0, -1.0]]
    robot = {
        "radius_m": RADIUS, "clearance_m": CLEARANCE, "max_speed_mps": 1.0,
        "drive": {**DRIVES[drive], "lag_s": 0.2},
        "localization": {"position_noise_m": noise},
    }  # fmt: skip
    if drive == "differential":
        robot["sensor"] = {"range_m": 4.0}
    return vs.Mission.model_validate(
        {
            "world": {"bounds": [0, -4, 10, 4], "known": wall},
            "robot": robot,
            "route": {"start": ends[reverse], "goal": ends[not reverse]},
        }
    )


@settings(deadline=None, max_examples=5)
@given(
    width=st.floats(0.6, 1.3),
    drive=st.sampled_from(sorted(DRIVES)),
    noise=st.floats(0.0, 0.05),
    reverse=st.booleans(),
)
@example(width=0.82, drive="differential", noise=0.03, reverse=False)
@example(width=0.82, drive="steered", noise=0.03, reverse=False)
@example(width=0.7, drive="steered", noise=0.03, reverse=True)
def test_no_way_is_told_of_doors_alone_that_are_too_narrow_whatever_is_kept(
    width: float, drive: str, noise: float, reverse: bool
) -> None:
    told = outcome(door_mission(width, drive, noise, reverse))
    fits = width - 2 * (RADIUS + CLEARANCE)
    if fits < -0.002:
        assert told == "no path"
    elif fits > 0.01:
        assert told == "planned" or "for how far the robot gets beside" in told


def outcome(mission: vs.Mission) -> str:
    """What a plan of a mission ends in."""
    try:
        plan = vs.plan(mission)
    except vs.NoPathError:
        return "no path"
    except vs.GaveUpError as gave_up:
        return f"gave up: {gave_up.tried}"
    assert plan.certificate.holds
    return "planned"


@pytest.mark.parametrize("drive", sorted(DRIVES))
def test_a_door_for_the_body_but_not_for_what_it_gets_beside_its_path_is_given_up(
    drive: str,
) -> None:
    mission = door_mission(0.82, drive, noise=0.03, reverse=False)
    with pytest.raises(vs.GaveUpError, match="tracking_error_m") as gave_up:
        vs.plan(mission)
    assert "beside" in gave_up.value.tried[0]
    assert gave_up.value.obstacles
    assert gave_up.value.changes
