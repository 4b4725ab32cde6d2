"""Kinds of drives: one of them is given, and each says enough of itself for everybody who asks."""

from __future__ import annotations

import math
from typing import Any

import pytest

import viaspline as vs
from viaspline.kernels.tracking.actuators import Actuators
from viaspline.mission.drives.drive import DRIVE_KINDS, Drive
from viaspline.mission.drives.drive_kind import FormField
from viaspline.mission.key_words import expectation


def mission_with(drive: dict[str, Any], **robot: Any) -> vs.Mission:
    data = {"robot": {**robot, "drive": drive}, "route": {"start": [0, 0], "goal": [10, 0]}}
    return vs.Mission.model_validate(data)


@pytest.fixture(params=list(DRIVE_KINDS))
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_a_drive_is_of_the_kind_that_is_given(name: str) -> None:
    drive = Drive.model_validate({name: DRIVE_KINDS[name].example, "delay_s": 0.2})
    assert type(drive.kind) is DRIVE_KINDS[name]
    assert drive.kind == DRIVE_KINDS[name].model_validate(DRIVE_KINDS[name].example)


def test_every_kind_says_what_each_of_its_keys_expects(name: str) -> None:
    kind = DRIVE_KINDS[name]
    assert kind.label
    assert kind.cannot
    for key, field in kind.model_fields.items():
        (said,) = (part for part in field.metadata if isinstance(part, FormField))
        assert said.label
        assert expectation(("robot", "drive", name, key)).startswith("a number")
        assert bool(said.placeholder) != field.is_required()


def test_every_kind_has_actuators_of_finite_size_or_without_limit(name: str) -> None:
    kind = Drive.model_validate({name: DRIVE_KINDS[name].example}).kind
    actuators = kind.actuators()
    assert isinstance(actuators, Actuators)
    assert all(isinstance(number, float | int) for number in actuators)
    assert (actuators.wheelbase > 0.0) == (kind.turn_radius is not None)
    assert math.isnan(actuators.held_heading) == (kind.held_heading is None)


def test_a_mission_with_each_kind_is_sound_and_is_written_as_it_was_read(name: str) -> None:
    mission = mission_with({name: dict(DRIVE_KINDS[name].example), "lag_s": 0.1})
    again = vs.Mission.model_validate(mission.model_dump(exclude_none=True))
    assert again == mission


def test_no_kind_and_two_kinds_are_refused_by_name() -> None:
    with pytest.raises(vs.MissionError) as none:
        mission_with({"delay_s": 0.1})
    assert all(name in str(none.value) for name in DRIVE_KINDS)
    first, second = list(DRIVE_KINDS)[:2]
    with pytest.raises(vs.MissionError, match=f"keep one of {first} and {second}"):
        mission_with({key: DRIVE_KINDS[key].example for key in (first, second)})


def test_what_is_wrong_with_a_key_is_said_in_the_words_of_its_drive(name: str) -> None:
    kind = DRIVE_KINDS[name]
    key = next(iter(kind.model_fields))
    with pytest.raises(vs.MissionError) as refused:
        mission_with({name: {**kind.example, key: "wide"}})
    assert expectation(("robot", "drive", name, key)) in str(refused.value)
    assert f"robot.drive.{name}.{key}" in str(refused.value)
