"""The forms of drives: what a person can type there is what a mission takes."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from viaspline.mission.drives.drive import DRIVE_KINDS
from viaspline.studio.drive_forms import drive_forms

FORMS = {form["key"]: form for form in drive_forms()}


@pytest.fixture(params=list(DRIVE_KINDS))
def form(request: pytest.FixtureRequest) -> dict[str, Any]:
    return FORMS[request.param]


def test_every_key_of_every_drive_has_a_field(form: dict[str, Any]) -> None:
    assert [field["key"] for field in form["fields"]] == list(DRIVE_KINDS[form["key"]].model_fields)


def test_what_a_form_begins_with_is_a_drive(form: dict[str, Any]) -> None:
    DRIVE_KINDS[form["key"]].model_validate(form["example"])


def test_the_ends_of_every_field_are_allowed_and_what_lies_beyond_is_not(
    form: dict[str, Any],
) -> None:
    kind = DRIVE_KINDS[form["key"]]
    for field in form["fields"]:
        for end, way in (("min", -1.0), ("max", 1.0)):
            if end not in field:
                continue
            kind.model_validate({**form["example"], field["key"]: field[end]})
            with pytest.raises(ValidationError):
                kind.model_validate({**form["example"], field["key"]: field[end] + 0.11 * way})


def test_what_may_be_left_out_has_a_placeholder(form: dict[str, Any]) -> None:
    for field in form["fields"]:
        required = DRIVE_KINDS[form["key"]].model_fields[field["key"]].is_required()
        assert ("placeholder" in field) != required


def test_units_are_those_of_the_keys() -> None:
    units = {field["key"]: field["unit"] for form in FORMS.values() for field in form["fields"]}
    assert units["track_m"] == "m"
    assert units["max_wheel_speed_mps"] == "m/s"
    assert units["max_steer_deg"] == "°"
    assert units["max_steer_rate_degps"] == "°/s"
    assert units["slip"] == ""
