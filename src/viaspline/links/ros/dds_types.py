"""Types of messages as Cyclone DDS needs them to find its peers; bytes are made elsewhere.

Cyclone's own encoder goes through every number of a scan in Python. So samples carry bytes that
``MessageBook`` has made, or will read; Cyclone only learns the types, by which peers match.

Tested through ``links/ros/test_dds_link``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from viaspline.links.ros.ros_topics import dds_type
from viaspline.ros_messages.message_types import MessageField, MessageType

NUMBERS: Final[Mapping[str, str]] = {
    "byte": "uint8", "char": "uint8", "int8": "int8", "uint8": "uint8", "int16": "int16",
    "uint16": "uint16", "int32": "int32", "uint32": "uint32", "int64": "int64",
    "uint64": "uint64", "float32": "float32", "float64": "float64",
}  # fmt: skip
"""Cyclone's names of the types of numbers."""


def sample_class(name: str, types: Mapping[str, MessageType]) -> Any:
    """Cyclone's class of a topic's samples: each has its bytes in ``cdr``.

    Args:
        name: Of the type, in full.
        types: It and all that it is made of, by full names.
    """
    made = _struct(name, types, {})

    def serialize(self: Any, **_: Any) -> bytes:
        return bytes(self.cdr)

    def deserialize(cls: Any, /, data: bytes, **_: Any) -> Any:
        return sample_of(cls, data)

    made.serialize, made.deserialize = serialize, classmethod(deserialize)
    return made


def sample_of(made: Any, cdr: bytes) -> Any:
    """A sample of such a class."""
    sample = made.__new__(made)
    sample.cdr = cdr
    return sample


def _struct(name: str, types: Mapping[str, MessageType], known: dict[str, Any]) -> Any:
    from cyclonedds.idl import make_idl_struct

    if name not in known:
        fields = {one.name: _field(one, types, known) for one in types[name].fields}
        whole = dds_type(name)
        known[name] = make_idl_struct(whole.rpartition("::")[2], whole, fields)
    return known[name]


def _field(field: MessageField, types: Mapping[str, MessageType], known: dict[str, Any]) -> Any:
    from cyclonedds.idl import types as made

    idl: Any = made
    one: Any
    if field.base == "string":
        one = idl.bounded_str[field.text_size] if field.text_size else str
    elif field.base == "bool":
        one = bool
    elif field.base in NUMBERS:
        one = getattr(idl, NUMBERS[field.base])
    else:
        one = _struct(field.base, types, known)
    if field.many == "array":
        return idl.array[one, field.size]
    if field.many == "sequence":
        return idl.sequence[one, field.size] if field.size else idl.sequence[one]
    return one
