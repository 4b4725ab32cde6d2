import re

import pytest

from viaspline.mission.annotations import Unit
from viaspline.mission.key_places import (
    Model,
    is_union,
    keys_of,
    models_below,
    options,
    options_at,
    path_of_error,
)
from viaspline.mission.key_rules import documentation
from viaspline.mission.mission_parts import MissionParts

MODELS = [model for _, model in models_below(MissionParts)]
SUFFIXES = {
    "m": "m", "s": "s", "deg": "deg", "mps": "m/s", "mps2": "m/s²", "mps3": "m/s³",
    "degps": "deg/s", "dps": "deg/s", "degps2": "deg/s²",
}  # fmt: skip


def test_every_model_is_found_once_those_near_the_mission_first() -> None:
    names = [model.__name__ for model in MODELS]
    assert len(names) == len(set(names))
    assert names[:5] == ["MissionParts", "WorldSpec", "RobotSpec", "Route", "SplineSpec"]
    assert {"Circle", "MapSpec", "Lidar", "Ackermann", "EndPoint", "Corridor"} <= set(names)


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.__name__)
def test_every_key_is_documented_in_its_class(model: Model) -> None:
    documented = documentation(model)
    assert [name for name in model.model_fields if name not in documented] == []


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.__name__)
def test_unit_name_and_documentation_of_a_key_agree(model: Model) -> None:
    documented = documentation(model)
    for key, field in keys_of(model).items():
        found = options(field.annotation, tuple(field.metadata))
        units = {item.symbol for option in found for item in option.said if isinstance(item, Unit)}
        suffix = SUFFIXES.get(key.rpartition("_")[2]) if "_" in key else None
        if suffix is None:
            assert not units or f"[{units.pop()}]" in documented[key], key
            continue
        (unit,) = units
        assert re.match(rf"{re.escape(suffix)}\b|{re.escape(suffix)}$", unit), key
        assert f"[{unit}]" in documented[key], key


def test_only_what_pydantic_tries_itself_is_a_union() -> None:
    assert is_union(options_at(("spline", "tension"), MissionParts))
    # An obstacle may have a map in its place, but that has been read by then.
    for path in (("world", "known", 0), ("world", "known", 0, "pass_on"), ("route", "start")):
        assert not is_union(options_at(path, MissionParts))


def test_the_path_of_an_error_keeps_keys_and_leaves_out_branches() -> None:
    loc = ("spline", "tension", "function-before[plain(), tuple[float, ...]]", 2)
    assert path_of_error(loc, MissionParts) == ("spline", "tension", 2)
    loc = ("world", "known", 3, "pass_on", "extra")
    assert path_of_error(loc, MissionParts) == loc
