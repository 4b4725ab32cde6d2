"""Every number of a mission, as small and as large as it may be, and beyond, has an answer."""

import copy
import math
import warnings
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.mission.json_schema import json_schema

SCHEMA = json_schema()

BASE: dict[str, Any] = {
    "world": {
        "bounds": [-30, -30, 40, 30],
        "known": [
            {"circle": {"center": [5, 0], "radius": 1}},
            {"capsule": {"from": [9, 4], "to": [9, 8], "radius": 0.5}},
        ],
        "speed_zones": [{"polygon": [[0, 0], [2, 0], [2, 2]], "max_speed_mps": 0.5}],
    },
    "robot": {"radius_m": 0.3, "clearance_m": 0.2},
    "route": {
        "start": {"at": [0, 0], "heading_deg": 0},
        "via": [{"at": [8, 0], "dwell_s": 1}],
        "goal": [12, 5],
    },
    "spline": {"tension": 0.0},
}
"""Small, so that a plan takes milliseconds."""

PLACES = ["world.bounds.2", "world.known.0.circle.center.0", "route.via.0.at.1", "route.goal.0"]
KEYS = {
    "world.known.0.circle.radius": "Circle.radius",
    "world.known.1.capsule.radius": "Capsule.radius",
    "world.speed_zones.0.max_speed_mps": "SpeedZone.max_speed_mps",
    "robot.radius_m": "RobotSpec.radius_m",
    "robot.clearance_m": "RobotSpec.clearance_m",
    "robot.max_speed_mps": "RobotSpec.max_speed_mps",
    "robot.max_accel_mps2": "RobotSpec.max_accel_mps2",
    "robot.max_brake_mps2": "RobotSpec.max_brake_mps2",
    "robot.max_lateral_accel_mps2": "RobotSpec.max_lateral_accel_mps2",
    "robot.max_yaw_rate_degps": "RobotSpec.max_yaw_rate_degps",
    "robot.max_yaw_accel_degps2": "RobotSpec.max_yaw_accel_degps2",
    "robot.max_jerk_mps3": "RobotSpec.max_jerk_mps3",
    "robot.tracking_error_m": "RobotSpec.tracking_error_m",
    "route.start.heading_deg": "EndPoint.heading_deg",
    "route.via.0.dwell_s": "ViaPoint.dwell_s",
}


def limits(name: str) -> tuple[float, float]:
    """The least and the greatest value that the schema states for a key."""
    model, key = name.split(".")
    prop = SCHEMA["$defs"][model]["properties"][key]
    number = prop if "minimum" in prop else next(p for p in prop["anyOf"] if "minimum" in p)
    return number["minimum"], number["maximum"]


RANGES = {path: limits(name) for path, name in KEYS.items()} | dict.fromkeys(
    PLACES, (-1000000000.0, 1000000000.0)
)


def with_values(values: dict[str, Any]) -> dict[str, Any]:
    data = copy.deepcopy(BASE)
    for path, value in values.items():
        *parents, last = [int(part) if part.isdigit() else part for part in path.split(".")]
        node: Any = data
        for part in parents:
            node = node[part]
        node[last] = value
    return data


def answered(values: dict[str, Any]) -> str:
    """Which answer a mission has; anything else than an answer comes through."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            mission = vs.Mission.model_validate(with_values(values))
        except vs.MissionError:
            return "refused"
        try:
            plan = vs.plan(mission)
        except (vs.NoPathError, vs.GaveUpError, vs.GeometryError) as error:
            return type(error).__name__
    assert math.isfinite(plan.path.length)
    assert math.isfinite(plan.trajectory.duration)
    return "plan"


def all_numbers(schema: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Every number of the schema, with the key that it is under."""
    for model, definition in schema["$defs"].items():
        for key, prop in definition.get("properties", {}).items():
            for found in _numbers(prop):
                yield f"{model}.{key}", found


def _numbers(part: Any) -> Iterator[dict[str, Any]]:
    if isinstance(part, dict):
        if part.get("type") in ("number", "integer"):
            yield part
        for inner in part.values():
            yield from _numbers(inner)
    elif isinstance(part, list):
        for inner in part:
            yield from _numbers(inner)


def test_every_number_of_the_schema_has_a_least_and_a_greatest_value() -> None:
    lacking = [
        name
        for name, number in all_numbers(SCHEMA)
        if not {"minimum", "exclusiveMinimum"} & number.keys()
        or not {"maximum", "exclusiveMaximum"} & number.keys()
    ]
    assert not lacking


@pytest.mark.parametrize("path", RANGES)
def test_what_lies_outside_is_refused(path: str) -> None:
    low, high = RANGES[path]
    outside = [math.nextafter(low, -math.inf), math.nextafter(high, math.inf)]
    for value in [*outside, math.nan, math.inf, -math.inf, 1e300, -1e300, 10**400, True, "1"]:
        assert answered({path: value}) == "refused", value


@pytest.mark.parametrize("path", RANGES)
def test_the_ends_of_a_range_and_almost_nothing_have_an_answer(path: str) -> None:
    for value in [*RANGES[path], 1e-300, 0.5 * sum(RANGES[path])]:
        answered({path: value})


@given(
    st.dictionaries(
        st.sampled_from(sorted(RANGES)),
        st.sampled_from(["least", "greatest", "middle"]),
        max_size=6,
    )
)
@settings(max_examples=60)
def test_extremes_together_have_an_answer(ends: dict[str, str]) -> None:
    of = {"least": lambda r: r[0], "greatest": lambda r: r[1], "middle": lambda r: 10.0}
    answered({path: of[end](RANGES[path]) for path, end in ends.items()})
