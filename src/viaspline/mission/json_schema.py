"""The JSON Schema of a mission file, for editors that check and complete while one types."""

from __future__ import annotations

from typing import Any, Final

from pydantic.json_schema import GenerateJsonSchema, JsonSchemaValue

from viaspline.mission.model import Mission

_AS_DECLARED: Final = frozenset({"properties", "default", "examples"})


class SchemaInOrder(GenerateJsonSchema):
    """A schema with its own words sorted, and keys and examples as they were declared."""

    def sort(self, value: JsonSchemaValue, parent_key: str | None = None) -> JsonSchemaValue:
        """The schema, or a part of it, sorted."""
        return dict(_sorted(value, parent_key))


def _sorted(value: Any, parent_key: str | None) -> Any:
    if parent_key in ("default", "examples"):
        return value
    if isinstance(value, dict):
        keys = value if parent_key in _AS_DECLARED else sorted(value)
        return {key: _sorted(value[key], key) for key in keys}
    if isinstance(value, list):
        return [_sorted(item, parent_key) for item in value]
    return value


def json_schema() -> dict[str, Any]:
    """The schema of a mission file: JSON Schema, draft 2020-12.

    It says what one key can say; what takes several (a via point inside an obstacle) is left to
    the reader.

    >>> json_schema()["required"]
    ['route']
    """
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **Mission.model_json_schema(schema_generator=SchemaInOrder, mode="validation"),
        "title": "A mission of viaspline",
    }
