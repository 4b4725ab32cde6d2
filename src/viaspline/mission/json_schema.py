"""The JSON Schema of a mission file, for editors that check and complete while one types."""

from __future__ import annotations

from typing import Any

from viaspline.mission.model import Mission


def json_schema() -> dict[str, Any]:
    """The schema of a mission file: JSON Schema, draft 2020-12.

    It says what one key can say; what takes several (a via point inside an obstacle) is left to
    the reader.

    >>> json_schema()["required"]
    ['route']
    """
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **Mission.model_json_schema(mode="validation"),
        "title": "A mission of viaspline",
    }
