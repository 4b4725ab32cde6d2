"""Landings: right under where a flight is, through nothing, and with a stay above them."""

from __future__ import annotations

import tempfile

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.errors import NoPathError
from viaspline.mission.model import Mission

RADIUS, HALF, CLEARANCE = 0.5, 0.25, 1.0


@settings(max_examples=10, deadline=None)
@given(
    height=st.floats(3.0, 40.0), takes_off=st.booleans(), roof=st.floats(0.0, 1.5),
    climb=st.floats(0.5, 3.0),
)  # fmt: skip
def test_a_drone_lands_right_under_where_it_is(
    height: float, takes_off: bool, roof: float, climb: float
) -> None:
    route: dict[str, object] = {"start": [5, 5, height], "via": [], "land": {"at": [5, 5]}}
    if takes_off:
        route |= {"start": [5, 5], "takeoff": {"to_agl_m": height}}
    box = {"box": {"min": [7, 0, 0], "max": [12, 10, roof + 0.1]}}
    robot = {"radius_m": RADIUS, "half_height_m": HALF, "clearance_m": CLEARANCE}
    plan = vs.plan(Mission.model_validate({
        "world": {"ground": {"flat_m": 0}, "known": [box]},
        "robot": {**robot, "max_climb_mps": climb}, "route": route,
    }))  # fmt: skip
    assert plan.path.length == pytest.approx((height - HALF) * (1 + takes_off))
    assert CLEARANCE <= plan.certificate.clearance <= 1.5 + 1e-6  # from the box
    assert plan.heights.greatest.height == pytest.approx(height)
    assert vs.fly(plan).reached
    with tempfile.TemporaryDirectory() as folder:
        plan.save(folder)
        assert vs.load_plan(folder) == plan


ROOF = {"name": "roof", "box": {"min": [15, -3, 5], "max": [25, 3, 6]}}


def test_a_station_right_over_its_landing_is_stayed_at() -> None:
    """As in files of way points, whose last one is where the vehicle lands."""
    last: dict[str, object] = {"at": [60, 10, 30]}
    route = {"start": [0, 0, 20], "via": [[30, 0, 20], last], "land": {"at": [60, 10]}}
    asked = {"world": {"ground": {"flat_m": 0}}, "route": route}
    soon = vs.plan(Mission.model_validate(asked)).trajectory
    last["dwell_s"] = 7
    late = vs.plan(Mission.model_validate(asked)).trajectory
    assert late.duration - soon.duration == pytest.approx(7)
    assert [(stop.dwell, stop.name) for stop in late.stations] == [(7, "via 2")]


HIGH: dict[str, object] = {"start": [0, 0, 9], "via": [[10, 0, 9]]}


@pytest.mark.parametrize("at", [[20.0, 0.0], [13.9, 0.0], [20.0, 4.4]])
@pytest.mark.parametrize(
    ("route", "error"),
    [
        (HIGH, vs.MissionError),
        ({"start": [0, 0], "takeoff": {"to_agl_m": 9}}, vs.MissionError),
        ({**HIGH, "via": [[10, 0, 9], [5, 5, 9]], "order": "shortest"}, NoPathError),
    ],
)
def test_no_landing_leads_through_a_roof(
    route: dict[str, object], error: type[Exception], at: list[float]
) -> None:
    robot = {"radius_m": RADIUS, "half_height_m": HALF, "clearance_m": CLEARANCE}
    asked = {"world": {"ground": {"flat_m": 0}, "known": [ROOF]}, "robot": robot}
    with pytest.raises(error, match=r"descent to the landing .* 'roof'"):
        vs.plan(Mission.model_validate({**asked, "route": {**route, "land": {"at": at}}}))
    beside = {**route, "land": {"at": [20, 9]}}
    assert vs.plan(Mission.model_validate({**asked, "route": beside})).certificate.holds


def test_a_landing_under_a_roof_is_flown_from_under_it() -> None:
    robot = {"radius_m": RADIUS, "half_height_m": HALF, "clearance_m": CLEARANCE}
    route = {"start": [0, 0, 9], "via": [[10, 0, 2.5]], "land": {"at": [20, 0]}}
    world = {"ground": {"flat_m": 0}, "known": [ROOF]}
    plan = vs.plan(Mission.model_validate({"world": world, "robot": robot, "route": route}))
    assert plan.certificate.holds
