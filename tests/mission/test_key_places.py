import re

import pytest

from viaspline.mission.annotations import Unit
from viaspline.mission.json_schema import documentation
from viaspline.mission.key_places import Model, keys_of, models_below, options
from viaspline.mission.mission_parts import MissionParts

MODELS = [model for _, model in models_below(MissionParts)]
SUFFIXES = {
    "m": "m", "s": "s", "deg": "deg", "mps": "m/s", "mps2": "m/s²", "mps3": "m/s³",
    "degps": "deg/s", "degps2": "deg/s²",
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
