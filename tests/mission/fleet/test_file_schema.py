"""One JSON Schema for the files of missions and of fleets."""

from typing import Any

import jsonschema
import pytest

from viaspline.mission.fleet.file_schema import file_schema

VALIDATOR = jsonschema.Draft202012Validator(file_schema())
ROUTE = {"start": [0, 0], "goal": [9, 0]}
FLEET = {
    "world": {"bounds": [-9, -9, 20, 20]},
    "separation_m": 1,
    "robots": {"cart": {"radius_m": 0.5}},
    "fleet": [
        {
            "name": "r1",
            "robot": "cart",
            "route": ROUTE,
            "priority": 2,
            "depart_s": 0,
            "rest": "stay",
        },
        {"name": "r2", "mission": "r2.yaml"},
    ],
    "spline": {"tension": 0.1},
}


def test_it_is_a_schema_and_every_key_is_described() -> None:
    schema = file_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    for part in (schema, *schema["$defs"].values()):
        for name, prop in part["properties"].items():
            assert prop.get("description"), name
    assert "asked" not in schema["$defs"]["MemberSpec"]["properties"]


@pytest.mark.parametrize(
    "data",
    [
        FLEET,
        {"fleet": [{"name": "r1", "route": ROUTE}]},
        {"route": ROUTE, "robot": {"radius_m": 1}, "world": {}, "spline": {}},
    ],
)
def test_good_missions_and_fleets_pass(data: dict[str, Any]) -> None:
    VALIDATOR.validate(data)


@pytest.mark.parametrize(
    "data",
    [
        {},
        {**FLEET, "route": ROUTE},
        {**FLEET, "robot": {"radius_m": 1}},
        {"route": ROUTE, "separation_m": 1},
        {"robots": {}, "route": ROUTE},
        {**FLEET, "fleet": []},
        {**FLEET, "separation_m": -1},
        {**FLEET, "robots": {"cart": {"radius": 1}}},
        {**FLEET, "fleet": [{"name": "r1", "route": ROUTE, "mission": "r1.yaml"}]},
        {**FLEET, "fleet": [{"name": "r1", "route": ROUTE, "rest": "go"}]},
        {**FLEET, "fleet": [{"route": ROUTE}]},
        {**FLEET, "colour": "red"},
    ],
)
def test_bad_missions_and_fleets_fail(data: dict[str, Any]) -> None:
    with pytest.raises(jsonschema.ValidationError):
        VALIDATOR.validate(data)
