"""The types that are known, and what is made of them once: schemas, writers and readers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import Any

from viaspline.errors import MessageError
from viaspline.ros_messages.cdr_reader import reader_of
from viaspline.ros_messages.cdr_writer import writer_of
from viaspline.ros_messages.message_definitions import DEFINITIONS
from viaspline.ros_messages.message_types import MessageType, needed_by, parse_definition
from viaspline.ros_messages.type_hash import type_hash

Message = Mapping[str, Any]
"""A message: its fields by name; messages within it are such mappings, too."""


class MessageBook:
    """Types of messages, by their definitions.

    Args:
        definitions: The fields of each type by its full name; a text may bring further types.

    Raises:
        MessageError: A definition can't be read.

    Example:
        >>> book = MessageBook(DEFINITIONS)
        >>> data = book.encoded("std_msgs/msg/String", {"data": "go"})
        >>> data.hex(" ")
        '00 01 00 00 03 00 00 00 67 6f 00'
        >>> book.decoded("std_msgs/msg/String", data)
        {'data': 'go'}
        >>> book.hash("std_msgs/msg/String")[:20]
        'RIHS01_df668c740482b'
    """

    def __init__(self, definitions: Mapping[str, str]) -> None:
        self._texts = dict(definitions)
        self._types: dict[str, MessageType] = {}
        for name, text in definitions.items():
            self._types |= parse_definition(name, text)

    @cached_property
    def _writers(self) -> dict[str, Callable[[Message], bytes]]:
        return {}

    @cached_property
    def _readers(self) -> dict[str, Callable[[bytes], dict[str, Any]]]:
        return {}

    def __contains__(self, name: str) -> bool:
        return name in self._types

    @property
    def types(self) -> Mapping[str, MessageType]:
        """All that are known, by full names."""
        return MappingProxyType(self._types)

    def schema(self, name: str) -> str:
        """A type's definition with those that it needs, as schemas of MCAP have it.

        >>> print(MessageBook(DEFINITIONS).schema("geometry_msgs/msg/Twist")[:58])
        geometry_msgs/Vector3 linear
        geometry_msgs/Vector3 angular
        """
        parts = [self._text(name)]
        for needed in needed_by(name, self._types):
            package, _, short = needed.split("/")
            parts.append(f"MSG: {package}/{short}\n{self._text(needed)}")
        return f"\n{'=' * 80}\n".join(parts) + "\n"

    def _text(self, name: str) -> str:
        if name not in self._texts:
            raise MessageError(f"the type {name} isn't known; known are {', '.join(self._texts)}")
        return self._texts[name]

    def encoded(self, name: str, message: Message) -> bytes:
        """A message's bytes: CDR, little endian, with the header of its encoding.

        Raises:
            MessageError: The type isn't known, or the message has no such fields.
        """
        if name not in self._writers:
            self._writers[name] = writer_of(name, self._types)
        return self._writers[name](message)

    def decoded(self, name: str, data: bytes) -> dict[str, Any]:
        """The message that bytes hold; sequences of numbers are arrays.

        Raises:
            MessageError: The type isn't known, or the bytes hold no such message.
        """
        if name not in self._readers:
            self._readers[name] = reader_of(name, self._types)
        return self._readers[name](data)

    def hash(self, name: str) -> str:
        """The hash of a type by which ROS 2 since Iron tells types apart: ``RIHS01_…``.

        Raises:
            MessageError: The type isn't known.
        """
        return type_hash(name, self._types)


def standard_book() -> MessageBook:
    """The types of ROS 2 that viaspline speaks."""
    return MessageBook(DEFINITIONS)
