"""The hash of a type of messages: RIHS01, as REP 2016 has it.

Tested through ``ros_messages/test_message_book``.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any, Final

from viaspline.ros_messages.message_types import MessageField, MessageType, needed_by

_IDS: Final[Mapping[str, int]] = {
    "int8": 2, "uint8": 3, "int16": 4, "uint16": 5, "int32": 6, "uint32": 7, "int64": 8,
    "uint64": 9, "float32": 10, "float64": 11, "char": 3, "bool": 15, "byte": 16, "string": 17,
    "wstring": 18,
}  # fmt: skip
_NESTED, _BOUNDED_STRING, _BOUNDED_WSTRING = 1, 21, 22
_ARRAY, _BOUNDED, _UNBOUNDED = 48, 96, 144
"""What is added for arrays, sequences with a bound, and sequences without one."""


def type_hash(name: str, types: Mapping[str, MessageType]) -> str:
    """The hash of a type.

    Args:
        name: In full.
        types: It and all that it is made of, by full names.

    Raises:
        MessageError: One of them isn't there.
    """
    needed = needed_by(name, types)
    described = {
        "type_description": _described(types[name]),
        "referenced_type_descriptions": [_described(types[one]) for one in sorted(needed)],
    }
    digest = hashlib.sha256(json.dumps(described).encode()).hexdigest()
    return f"RIHS01_{digest}"


def _described(kind: MessageType) -> dict[str, Any]:
    fields = [{"name": one.name, "type": _field(one)} for one in kind.fields]
    return {"type_name": kind.name, "fields": fields}


def _field(field: MessageField) -> dict[str, Any]:
    number = _IDS.get(field.base, _NESTED)
    if field.text_size:
        number = _BOUNDED_STRING if field.base == "string" else _BOUNDED_WSTRING
    if field.many == "array":
        number += _ARRAY
    elif field.many == "sequence":
        number += _BOUNDED if field.size else _UNBOUNDED
    return {
        "type_id": number,
        "capacity": field.size,
        "string_capacity": field.text_size,
        "nested_type_name": field.base if "/" in field.base else "",
    }
