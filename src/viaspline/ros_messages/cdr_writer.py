"""Messages as bytes: CDR as ROS 2 has it, little endian, each number aligned to its size."""

from __future__ import annotations

import struct
from collections.abc import Callable, Mapping
from operator import itemgetter
from typing import Any, Final

import numpy as np

from viaspline.errors import MessageError, with_article
from viaspline.ros_messages.message_types import PRIMITIVES, MessageField, MessageType, needed_by

LITTLE_ENDIAN: Final = b"\x00\x01\x00\x00"
"""The header of the encoding; places in a message count from behind it."""

_Put = Callable[[bytearray, Any], None]
_PADDING: Final = (b"", b"\0", b"\0\0", b"\0\0\0", b"\0\0\0\0", b"\0" * 5, b"\0" * 6, b"\0" * 7)


def writer_of(name: str, types: Mapping[str, MessageType]) -> Callable[[Mapping[str, Any]], bytes]:
    r"""What makes bytes of messages of a type.

    Args:
        name: Of the type.
        types: It and all that it is made of, by full names.

    Raises:
        MessageError: A type isn't there; or, when it is called, a message doesn't fit its type.

    >>> from viaspline.ros_messages.message_types import parse_definition
    >>> write = writer_of("demo/msg/A", parse_definition("demo/msg/A", "uint8 a\nfloat64 b"))
    >>> write({"a": 7, "b": 1.0}).hex()
    '000100000700000000000000000000000000f03f'
    """
    needed_by(name, types)  # all of it is there
    put = _message(types[name], types)

    def write(message: Mapping[str, Any]) -> bytes:
        buffer = bytearray(LITTLE_ENDIAN)
        try:
            put(buffer, message)
        except KeyError as error:
            raise MessageError(f"{with_article(name)} needs the field {error.args[0]!r}") from None
        except (struct.error, TypeError, ValueError, OverflowError, AttributeError) as error:
            raise MessageError(f"that makes no {name}: {error}") from None
        return bytes(buffer)

    return write


def _align(buffer: bytearray, size: int) -> None:
    buffer += _PADDING[(4 - len(buffer)) % size]


def _message(kind: MessageType, types: Mapping[str, MessageType]) -> _Put:
    letters = _letters(kind, types)
    if letters is not None:
        return _numbers(kind, types, letters)
    puts = [(one.name, _field(one, types)) for one in kind.fields]

    def put(buffer: bytearray, message: Any) -> None:
        for name, one in puts:
            one(buffer, message[name])

    return put


def _letters(kind: MessageType, types: Mapping[str, MessageType]) -> str | None:
    """The letters of a message that is nothing but numbers of one size; None: it is more."""
    found = ""
    for one in kind.fields:
        if one.many != "one":
            return None
        inner = PRIMITIVES.get(one.base)
        if inner is None and one.base in types:
            inner = _letters(types[one.base], types)
        if inner is None:
            return None
        found += inner
    return found if len({struct.calcsize(letter) for letter in found}) == 1 else None


def _numbers(kind: MessageType, types: Mapping[str, MessageType], letters: str) -> _Put:
    """All numbers at once: between those of one size there is no padding."""
    packer, values = struct.Struct("<" + letters), _values(kind, types)
    size = struct.calcsize(letters[0])

    def put(buffer: bytearray, message: Any) -> None:
        _align(buffer, size)
        buffer += packer.pack(*values(message))

    return put


def _values(
    kind: MessageType, types: Mapping[str, MessageType]
) -> Callable[[Any], tuple[Any, ...]]:
    """What takes the numbers out of a message that has nothing else."""
    names = [one.name for one in kind.fields]
    if all(one.base in PRIMITIVES for one in kind.fields):
        if len(names) > 1:
            return itemgetter(*names)
        return lambda message: (message[names[0]],)
    parts = [
        (one.name, _values(types[one.base], types) if one.base in types else None)
        for one in kind.fields
    ]

    def values(message: Any) -> tuple[Any, ...]:
        found: tuple[Any, ...] = ()
        for name, inner in parts:
            value = message[name]
            found += (value,) if inner is None else inner(value)
        return found

    return values


def _field(field: MessageField, types: Mapping[str, MessageType]) -> _Put:
    if field.base in PRIMITIVES:
        return _number(field.base) if field.many == "one" else _numbers_of(field)
    if field.base == "wstring":
        raise MessageError(f"the field {field.name} is a wstring, which isn't written here")
    one = _text(field) if field.base == "string" else _message(types[field.base], types)
    return one if field.many == "one" else _items(field, one)


def _number(base: str) -> _Put:
    packer = struct.Struct("<" + PRIMITIVES[base])

    def put(buffer: bytearray, value: Any) -> None:
        _align(buffer, packer.size)
        buffer += packer.pack(value)

    return put


def _numbers_of(field: MessageField) -> _Put:
    dtype = np.dtype("<" + PRIMITIVES[field.base])
    count = _count_of(field)

    def put(buffer: bytearray, values: Any) -> None:
        numbers = np.asarray(values, dtype).ravel()
        count(buffer, len(numbers))
        if len(numbers) or field.many == "array":
            _align(buffer, dtype.itemsize)
        buffer += numbers.tobytes()

    return put


def _items(field: MessageField, one: _Put) -> _Put:
    count = _count_of(field)

    def put(buffer: bytearray, values: Any) -> None:
        count(buffer, len(values))
        for value in values:
            one(buffer, value)

    return put


def _count_of(field: MessageField) -> Callable[[bytearray, int], None]:
    """What notes how many there are, and refuses another number than the type has."""
    number = _number("uint32")

    def put(buffer: bytearray, count: int) -> None:
        wrong = count != field.size if field.many == "array" else 0 < field.size < count
        if wrong:
            raise MessageError(f"the field {field.name} has {count} items, not {field.size}")
        if field.many == "sequence":
            number(buffer, count)

    return put


def _text(field: MessageField) -> _Put:
    number = _number("uint32")

    def put(buffer: bytearray, value: Any) -> None:
        data = value.encode()
        if 0 < field.text_size < len(data):
            raise MessageError(f"the field {field.name} has more than {field.text_size} bytes")
        number(buffer, len(data) + 1)
        buffer += data + b"\0"

    return put
