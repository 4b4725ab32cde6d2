"""What a class of a mission says of its keys, and how the JSON Schema tells it.

Tested through ``mission/test_json_schema``.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Mapping
from typing import Any, Final, TypedDict

from pydantic import BaseModel

_ATTRIBUTE: Final = re.compile(r"^    (\w+): (.*(?:\n        .*)*)", re.MULTILINE)


class KeyRules(TypedDict, total=False):
    """What a class says of its keys together, as keywords of the class; all may be left out.

    Attributes:
        expected: What would be right where the class is asked for, in words; by default a mapping
            with its keys.
        exactly_one: Keys of which exactly one has to be given.
        excluding: Pairs of keys of which one at most may be given.
        needing: Keys that make sense beside another only.
        examples: Mappings as files have them, which show each of its keys.
        foreign: What other programs call its keys, each with the key that is meant or, where that
            alone wouldn't help, ``"key: what to write there"``.
    """

    expected: str
    exactly_one: tuple[str, ...]
    excluding: tuple[tuple[str, str], ...]
    needing: tuple[tuple[str, str], ...]
    examples: tuple[Mapping[str, Any], ...]
    foreign: Mapping[str, str]


def describe_keys(model: type[BaseModel], rules: KeyRules, schema: dict[str, Any]) -> None:
    """Put into a model's schema what its class says: descriptions, and which keys go together.

    Args:
        model: The class.
        rules: What it says of its keys together.
        schema: What pydantic makes of it; changed.
    """
    documented = documentation(model)
    schema["description"] = _plain(inspect.getdoc(model) or "").partition(". ")[0].rstrip(".") + "."
    for name, field in model.model_fields.items():
        prop = schema["properties"].get(field.alias or name)
        if prop is not None and name in documented:
            prop["description"] = documented[name]
    if "examples" in rules:
        schema["examples"] = list(rules["examples"])
        for key, prop in schema["properties"].items():
            prop["examples"] = _distinct(one[key] for one in rules["examples"] if key in one)
    if "exactly_one" in rules:
        told = [key for key in rules["exactly_one"] if key in schema["properties"]]
        schema["oneOf"] = [{"required": [key]} for key in told]
    if "excluding" in rules:
        schema["not"] = {"anyOf": [{"required": list(pair)} for pair in rules["excluding"]]}
    if "needing" in rules:
        schema["dependentRequired"] = {key: [other] for key, other in rules["needing"]}


def _distinct(values: Iterable[Any]) -> list[Any]:
    """Values without those that were there before; they needn't have a hash."""
    found: list[Any] = []
    for value in values:
        if value not in found:
            found.append(value)
    return found


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
