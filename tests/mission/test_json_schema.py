from collections.abc import Callable
from typing import Any, TypeAlias

import jsonschema
import pytest

from viaspline.mission.json_schema import json_schema

Make: TypeAlias = Callable[..., dict[str, Any]]


VALIDATOR = jsonschema.Draft202012Validator(json_schema())


def test_the_schema_is_a_schema_and_every_key_is_described() -> None:
    schema = json_schema()
    jsonschema.Draft202012Validator.check_schema(schema)
    for part in (schema, *schema["$defs"].values()):
        for name, prop in part["properties"].items():
            assert prop.get("description"), name


@pytest.mark.parametrize(
    "route",
    [
        {"start": [0, 0], "goal": [1, 1]},
        {"start": {"at": [0, 0], "heading_deg": 3}, "via": [[1, 2, 3], {"at": [1, 2]}]},
    ],
)
def test_good_missions_pass(route: dict[str, Any], good: Make) -> None:
    VALIDATOR.validate(good())
    VALIDATOR.validate({"route": route})


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("extra", 1),
        ("robot.radius_m", -1),
        ("robot.radius_m", True),
        ("robot.radius_m", "0.5"),
        ("robot.clearence_m", 1),
        ("route.start", [1]),
        ("route.start", [1, 2, 3, 4]),
        ("route.via.0", {"name": "x"}),
        ("route.via.0", {"at": [0, 0], "heading_deg": 1}),
        ("world.known.0", {}),
        ("world.known.1.circle", {"center": [1, 2], "radius": 1}),
        ("world.known.1.polygon", [[0, 0], [1, 1]]),
        ("world.known.0.holes", [[[0, 0], [1, 0], [0, 1]]]),
        ("spline.slack", 0.2),
        ("spline.tension", 2),
        ("spline.tension", [0, 2]),
        ("spline.knots", "even"),
    ],
)
def test_bad_missions_fail(path: str, value: Any, spoiled: Make) -> None:
    with pytest.raises(jsonschema.ValidationError):
        VALIDATOR.validate(spoiled(path, value))
