"""Messages from bytes: CDR as ROS 2 has it, of either order of bytes."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np

from viaspline.errors import MessageError, with_article
from viaspline.ros_messages.message_types import PRIMITIVES, MessageField, MessageType, needed_by

HEADER_BYTES: Final = 4
_ORDERS: Final[Mapping[bytes, str]] = {b"\x00\x00": ">", b"\x00\x01": "<"}
"""The plain encodings by the first two bytes of their header."""

_Take = Callable[[bytes, int], tuple[Any, int]]
"""Takes a value from bytes at a place, and says where the next one begins."""


def reader_of(name: str, types: Mapping[str, MessageType]) -> Callable[[bytes], dict[str, Any]]:
    r"""What makes messages of a type from bytes.

    Args:
        name: Of the type.
        types: It and all that it is made of, by full names.

    Raises:
        MessageError: A type isn't there; or, when it is called, the bytes hold no such message.

    >>> from viaspline.ros_messages.message_types import parse_definition
    >>> read = reader_of("demo/msg/A", parse_definition("demo/msg/A", "uint8 a\nuint16[] b"))
    >>> read(bytes.fromhex("00000000 07000000 00000001 0102"))
    {'a': 7, 'b': array([258], dtype=uint16)}
    """
    needed_by(name, types)  # all of it is there
    takes = {order: _message(types[name], types, order) for order in _ORDERS.values()}

    def read(data: bytes) -> dict[str, Any]:
        order = _ORDERS.get(bytes(data[:2])) if len(data) >= HEADER_BYTES else None
        if order is None:
            raise MessageError(
                f"{with_article(name)} begins with the bytes {bytes(data[:4]).hex()}: no CDR"
            )
        try:
            message: dict[str, Any] = takes[order](data, HEADER_BYTES)[0]
        except (struct.error, ValueError, MemoryError) as error:
            raise MessageError(f"the bytes hold no {name}: {error}") from None
        return message

    return read


def _aligned(place: int, size: int) -> int:
    return place + (HEADER_BYTES - place) % size


def _message(kind: MessageType, types: Mapping[str, MessageType], order: str) -> _Take:
    takes = [(one.name, _field(one, types, order)) for one in kind.fields]

    def take(data: bytes, place: int) -> tuple[Any, int]:
        message = {}
        for name, one in takes:
            message[name], place = one(data, place)
        return message, place

    return take


def _field(field: MessageField, types: Mapping[str, MessageType], order: str) -> _Take:
    if field.base in PRIMITIVES:
        letter = PRIMITIVES[field.base]
        return _number(letter, order) if field.many == "one" else _numbers(field, order)
    if field.base == "wstring":
        raise MessageError(f"the field {field.name} is a wstring, which isn't read here")
    one = _text(order) if field.base == "string" else _message(types[field.base], types, order)
    return one if field.many == "one" else _items(field, one, order)


def _number(letter: str, order: str) -> _Take:
    packer = struct.Struct(order + letter)

    def take(data: bytes, place: int) -> tuple[Any, int]:
        place = _aligned(place, packer.size)
        return packer.unpack_from(data, place)[0], place + packer.size

    return take


def _numbers(field: MessageField, order: str) -> _Take:
    dtype, count = np.dtype(order + PRIMITIVES[field.base]), _number("I", order)
    native = dtype.newbyteorder("=")

    def take(data: bytes, place: int) -> tuple[Any, int]:
        size = field.size
        if field.many == "sequence":
            size, place = count(data, place)
        if size:
            place = _aligned(place, dtype.itemsize)
        numbers = np.frombuffer(data, dtype, size, place) if size else np.zeros(0, dtype)
        return numbers.astype(native, copy=False), place + size * dtype.itemsize

    return take


def _items(field: MessageField, one: _Take, order: str) -> _Take:
    count = _number("I", order)

    def take(data: bytes, place: int) -> tuple[Any, int]:
        size = field.size
        if field.many == "sequence":
            size, place = count(data, place)
        if size > len(data):  # each has a byte at least
            raise ValueError(f"{field.name} says that it has {size} items in {len(data)} bytes")
        items = []
        for _ in range(size):
            item, place = one(data, place)
            items.append(item)
        return items, place

    return take


def _text(order: str) -> _Take:
    count = _number("I", order)

    def take(data: bytes, place: int) -> tuple[Any, int]:
        size, place = count(data, place)
        end = place + size
        if end > len(data):
            raise ValueError(f"a text of {size} bytes goes on behind the end")
        return bytes(data[place:end]).rstrip(b"\0").decode("utf-8", "replace"), end

    return take
