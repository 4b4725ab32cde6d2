"""The JSON Schema of a mission file, for editors that check and complete while one types."""

from __future__ import annotations

import inspect
import re
from typing import Any, Final

from viaspline.mission.key_places import key_name
from viaspline.mission.value import Value

_ATTRIBUTE: Final = re.compile(r"^    (\w+): (.*(?:\n        .*)*)", re.MULTILINE)


def json_schema() -> dict[str, Any]:
    """The schema of a mission file: JSON Schema, draft 2020-12.

    It says what one key can say; what takes several (a via point inside an obstacle) is left to
    the reader.

    >>> json_schema()["required"]
    ['route']
    """
    from viaspline.mission.model import Mission

    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **Mission.model_json_schema(mode="validation"),
        "title": "A mission of viaspline",
    }


def describe_keys(model: type[Value], schema: dict[str, Any]) -> None:
    """Put into a model's schema what its class says: descriptions, and which keys go together.

    Args:
        model: The class.
        schema: What pydantic makes of it; changed.
    """
    documented = documentation(model)
    schema["description"] = _plain(inspect.getdoc(model) or "").partition(". ")[0].rstrip(".") + "."
    for name, field in model.model_fields.items():
        prop = schema["properties"].get(key_name(name, field))
        if prop is not None and name in documented:
            prop["description"] = documented[name]
    rules = model.key_rules
    if "exactly_one" in rules:
        told = [key for key in rules["exactly_one"] if key in schema["properties"]]
        schema["oneOf"] = [{"required": [key]} for key in told]
    if "excluding" in rules:
        schema["not"] = {"anyOf": [{"required": list(pair)} for pair in rules["excluding"]]}
    if "needing" in rules:
        schema["dependentRequired"] = {key: [other] for key, other in rules["needing"]}


def documentation(model: type) -> dict[str, str]:
    """What the docstrings of a class and of its bases say of each attribute, on one line.

    >>> from viaspline.mission.sensor_spec import Lidar
    >>> documentation(Lidar)["range_m"]
    'The length of a beam [m].'
    """
    documented: dict[str, str] = {}
    for base in reversed(model.__mro__):
        text = inspect.cleandoc(base.__dict__.get("__doc__") or "")
        attributes = text.partition("Attributes:\n")[2].partition("\n\n")[0]
        documented |= {name: _plain(words) for name, words in _ATTRIBUTE.findall(attributes)}
    return documented


def _plain(text: str) -> str:
    """Docstring text on one line, without the marks of literals."""
    return " ".join(text.partition("\n\n")[0].replace("``", "").split())
