"""The form of every kind of drive, as the page builds it: from what each says of its keys."""

from __future__ import annotations

from typing import Any, Final

from viaspline.mission.drives.drive import DRIVE_KINDS
from viaspline.mission.drives.drive_kind import DriveKind, FormField
from viaspline.mission.fields import MAX_LENGTH_M

UNITS: Final = (
    ("_degps", "°/s", 0.1, 1.0),
    ("_deg", "°", 0.1, 1.0),
    ("_mps", "m/s", 0.001, 0.1),
    ("_m", "m", 0.001, 0.05),
    ("", "", 0.01, 0.05),
)
"""Endings of keys, their units, the least that is more than nothing, and the step of a key."""


def drive_forms() -> list[dict[str, Any]]:
    """What the page is told of every kind of drive.

    Returns:
        Of each its key in a mission, its label, what it begins with, what it can't do, and its
        fields: key, label, unit, placeholder, step and the limits that there are.

    >>> [form["key"] for form in drive_forms()][:2]
    ['differential', 'ackermann']
    """
    return [
        {
            "key": key,
            "label": kind.label,
            "example": dict(kind.example),
            "cannot": kind.cannot,
            "fields": _fields(kind),
        }
        for key, kind in DRIVE_KINDS.items()
    ]


def _fields(kind: type[DriveKind]) -> list[dict[str, Any]]:
    properties = kind.model_json_schema()["properties"]
    return [
        _field(key, said, properties[key])
        for key, field in kind.model_fields.items()
        for said in field.metadata
        if isinstance(said, FormField)
    ]


def _field(key: str, said: FormField, schema: dict[str, Any]) -> dict[str, Any]:
    unit, least, step = next(rest for ending, *rest in UNITS if key.endswith(ending))
    number = schema | next(iter(schema.get("anyOf", ())), {})
    field: dict[str, Any] = {"key": key, "label": said.label, "unit": unit, "step": step}
    if "minimum" in number:
        lowest = number["minimum"]
        field["min"] = max(lowest, least) if lowest > 0 else lowest
    if "exclusiveMaximum" in number:
        field["max"] = round(number["exclusiveMaximum"] - least, 6)
    if number.get("maximum", MAX_LENGTH_M) < MAX_LENGTH_M:
        field["max"] = number["maximum"]
    return field | ({"placeholder": said.placeholder} if said.placeholder else {})
