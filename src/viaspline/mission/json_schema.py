"""The JSON Schema of a mission file, for editors that check and complete while one types."""

from __future__ import annotations

import inspect
import re
from typing import Any, Final

from pydantic import BaseModel

from viaspline.mission.drives.drive import DRIVE_KINDS, Drive
from viaspline.mission.model import Mission
from viaspline.mission.parts import (
    Corridor,
    EndPoint,
    MapSpec,
    Route,
    SpeedZone,
    SplineSpec,
    ViaPoint,
    WorldSpec,
)
from viaspline.mission.robot_parts import (
    Lidar,
    Localization,
    RobotSpec,
    Sensor,
)
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle

_DOCUMENTED: Final[tuple[type[BaseModel], ...]] = (
    Mission, WorldSpec, Obstacle, Circle, MapSpec, SpeedZone, RobotSpec, Drive,
    *DRIVE_KINDS.values(), Localization, Sensor, Lidar, Route, ViaPoint, EndPoint, Corridor,
    SplineSpec,
)  # fmt: skip

_ONE_OF: Final = {
    "Sensor": ("range_m", "lidar"),
    "Drive": tuple(DRIVE_KINDS),
}
_ATTRIBUTE: Final = re.compile(r"^    (\w+): (.*(?:\n        .*)*)", re.MULTILINE)


def json_schema() -> dict[str, Any]:
    """The schema of a mission file: JSON Schema, draft 2020-12.

    It says what one key can say; what takes several (a via point inside an obstacle) is left to
    the reader.

    >>> json_schema()["required"]
    ['route']
    """
    schema = Mission.model_json_schema(mode="validation")
    _add_maps(schema)
    for model in _DOCUMENTED:
        target = schema if model is Mission else schema["$defs"].get(model.__name__)
        if target is not None:
            _describe(target, model)
    obstacle = schema["$defs"]["Obstacle"]
    obstacle["oneOf"] = [{"required": ["circle"]}, {"required": ["polygon"]}]
    obstacle["dependentRequired"] = {"holes": ["polygon"]}
    for name, kinds in _ONE_OF.items():
        schema["$defs"][name]["oneOf"] = [{"required": [key]} for key in kinds]
    schema["$defs"]["RobotSpec"]["not"] = {"required": ["radius_m", "footprint"]}
    spline = schema["$defs"]["SplineSpec"]
    spline["not"] = {"required": ["tension", "slack"]}
    _limit(spline["properties"]["tension"], {"maximum": 1})
    _limit(spline["properties"]["slack"], {"minimum": 0})
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **schema,
        "title": "A mission of viaspline",
    }


def _add_maps(schema: dict[str, Any]) -> None:
    """Maps may stand where obstacles stand."""
    schema["$defs"]["MapSpec"] = MapSpec.model_json_schema(mode="validation")
    kinds = [{"$ref": "#/$defs/Obstacle"}, {"$ref": "#/$defs/MapSpec"}]
    for key in ("known", "unseen"):
        schema["$defs"]["WorldSpec"]["properties"][key]["items"] = {"anyOf": kinds}


def _limit(prop: dict[str, Any], limit: dict[str, float]) -> None:
    """Limit the numbers of "one number, or a list of them"."""
    for choice in prop["anyOf"]:
        if choice.get("const"):
            continue
        if choice["type"] == "number":
            choice.update(limit)
        elif choice["type"] == "array":
            choice["items"].update(limit)


def _describe(schema: dict[str, Any], model: type) -> None:
    """Put what a class's docstring says of its attributes beside the properties."""
    documented: dict[str, str] = {}
    for base in reversed(model.__mro__):
        text = inspect.cleandoc(base.__dict__.get("__doc__") or "")
        attributes = text.partition("Attributes:\n")[2].partition("\n\n")[0]
        documented |= {name: _plain(words) for name, words in _ATTRIBUTE.findall(attributes)}
    schema["description"] = _plain(inspect.getdoc(model) or "").partition(". ")[0].rstrip(".") + "."
    for name, prop in schema["properties"].items():
        if name in documented:
            prop["description"] = documented[name]


def _plain(text: str) -> str:
    """Docstring text on one line, without the marks of literals."""
    return " ".join(text.partition("\n\n")[0].replace("``", "").split())
