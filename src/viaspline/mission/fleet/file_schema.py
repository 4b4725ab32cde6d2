"""The JSON Schema of a file with a mission or a fleet, for editors that check while one types."""

from __future__ import annotations

from typing import Any, Final

from viaspline.mission.fleet.fleet import Fleet
from viaspline.mission.json_schema import SchemaInOrder, json_schema

_ONE_ROBOT: Final = ("robot", "route")
_MANY_ROBOTS: Final = ("separation_m", "robots", "fleet")


def file_schema() -> dict[str, Any]:
    """The schema of what a file may hold: JSON Schema, draft 2020-12.

    With the key ``fleet`` it is a fleet, else a mission.

    >>> schema = file_schema()
    >>> list(schema["properties"])
    ['world', 'robot', 'route', 'spline', 'ros', 'separation_m', 'robots', 'fleet']
    >>> schema["then"]["required"], schema["else"]["required"]
    (['fleet'], ['route'])
    """
    mission = json_schema()
    fleet = Fleet.model_json_schema(schema_generator=SchemaInOrder, mode="validation")
    return {
        "$schema": mission["$schema"],
        "$defs": {**mission["$defs"], **fleet["$defs"]},
        "title": "A mission or a fleet of viaspline",
        "description": f"{mission['description']} Or a fleet: {fleet['description']}",
        "type": "object",
        "properties": {
            **mission["properties"],
            **{key: fleet["properties"][key] for key in _MANY_ROBOTS},
        },
        "additionalProperties": False,
        "if": {"required": ["fleet"]},
        "then": {"required": fleet["required"], "not": _any_of(_ONE_ROBOT)},
        "else": {"required": mission["required"], "not": _any_of(_MANY_ROBOTS)},
    }


def _any_of(keys: tuple[str, ...]) -> dict[str, Any]:
    return {"anyOf": [{"required": [key]} for key in keys]}
