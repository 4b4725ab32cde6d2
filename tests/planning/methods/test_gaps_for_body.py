"""A car before a door that it is too wide for is refused, with what would let it through."""

from __future__ import annotations

from typing import Any

import pytest

import viaspline as vs

CAR = [[-0.3, -0.6], [2.2, -0.6], [2.2, 0.6], [-0.3, 0.6]]  # less behind its axle than beside it


def asked(door: float, **robot: Any) -> vs.Mission:
    low, high = 10.0 - 0.5 * door, 10.0 + 0.5 * door
    walls = [
        {"name": "south", "polygon": [[20, 0], [21, 0], [21, low], [20, low]]},
        {"name": "north", "polygon": [[20, high], [21, high], [21, 20], [20, 20]]},
    ]
    car = {"footprint": CAR, "clearance_m": 0.2, "min_turn_radius_m": 2.0, "max_speed_mps": 2}
    return vs.Mission.model_validate(
        {
            "world": {"bounds": [0, 0, 40, 20], "known": walls},
            "robot": {**car, **robot},
            "route": {"start": {"at": [5, 10], "heading_deg": 0}, "goal": {"at": [35, 10]}},
        }
    )


def refusal_of(mission: vs.Mission) -> vs.NoPathError:
    with pytest.raises(vs.NoPathError) as told:
        vs.plan(mission)
    return told.value


def test_the_gap_is_named_with_its_width_and_what_is_needed() -> None:
    told = refusal_of(asked(1.5))
    assert "between 'south' and 'north'" in told.reason
    assert "1.500 m of room, 1.600 m are needed" in told.reason
    assert told.where == pytest.approx((20.5, 10.0), abs=0.51)
    assert set(told.obstacles) == {"south", "north"}


@pytest.mark.parametrize("door", [1.25, 1.45, 1.59])
def test_with_the_clearance_that_is_named_there_is_a_way(door: float) -> None:
    (change,) = refusal_of(asked(door)).changes
    assert change.key == "robot.clearance_m"
    plan = vs.plan(asked(door, clearance_m=change.value))
    assert plan.certificate.holds


def test_a_door_narrower_than_the_body_is_to_be_widened_or_the_body_made_slimmer() -> None:
    told = refusal_of(asked(1.1))
    assert told.changes == ()
    assert "at most 0.700 m wide there or widen it to more than 1.600 m" in told.remedy


def test_a_door_as_wide_as_the_body_and_what_it_keeps_is_driven_through() -> None:
    assert vs.plan(asked(1.61)).certificate.holds
