"""Types of messages: read from the texts that define them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final, Literal

from viaspline.errors import MessageError

PRIMITIVES: Final[Mapping[str, str]] = {
    "bool": "?", "byte": "B", "char": "B", "int8": "b", "uint8": "B", "int16": "h",
    "uint16": "H", "int32": "i", "uint32": "I", "int64": "q", "uint64": "Q",
    "float32": "f", "float64": "d",
}  # fmt: skip
"""Types of numbers, with their letters in ``struct``."""

SEPARATOR: Final = re.compile(r"^={40,}[ \t]*$", re.MULTILINE)
_FIELD: Final = re.compile(
    r"(?P<base>[A-Za-z][\w/]*?)(?:<=(?P<text>\d+))?(?:\[(?P<at_most><=)?(?P<size>\d*)\])?"
    r"\s+(?P<name>[A-Za-z]\w*)(?P<rest>.*)"
)

Many = Literal["one", "array", "sequence"]


@dataclass(frozen=True)
class MessageField:
    """One field of a message.

    Attributes:
        name: Of the field.
        base: The type of its items: a primitive, ``string``, ``wstring``, or a full type name.
        many: One item, an array of a fixed size, or a sequence of any length.
        size: Of the array, or the most items of the sequence; 0: no bound.
        text_size: The most bytes of a string; 0: no bound.
    """

    name: str
    base: str
    many: Many = "one"
    size: int = 0
    text_size: int = 0


@dataclass(frozen=True)
class MessageType:
    """A type of messages.

    Attributes:
        name: In full, such as ``geometry_msgs/msg/Twist``.
        fields: In their order.
    """

    name: str
    fields: tuple[MessageField, ...]


def full_name(name: str, package: str = "") -> str:
    """The full name of a type.

    >>> full_name("nav_msgs/Path"), full_name("Point", "geometry_msgs"), full_name("a/msg/B")
    ('nav_msgs/msg/Path', 'geometry_msgs/msg/Point', 'a/msg/B')
    """
    parts = name.split("/")
    if len(parts) == 1:
        parts = [package, *parts]
    return f"{parts[0]}/msg/{parts[-1]}"


def parse_definition(name: str, text: str) -> dict[str, MessageType]:
    r"""The types that a definition has: that of its name, and those that follow it.

    Args:
        name: Of the first type.
        text: Fields a line each; further types after a line of ``=`` and one with ``MSG: name``,
            as schemas of the encoding ``ros2msg`` have them.

    Raises:
        MessageError: A line makes no field.

    >>> types = parse_definition("demo_msgs/msg/Spot", "float64[2] at  # [m]\nint32 KIND=3")
    >>> types["demo_msgs/msg/Spot"].fields
    (MessageField(name='at', base='float64', many='array', size=2, text_size=0),)
    """
    types = {}
    first, *others = SEPARATOR.split(text.replace("\r\n", "\n"))
    parts = [(full_name(name), first)]
    for other in others:
        head, _, body = other.strip("\n").partition("\n")
        if not head.startswith("MSG:"):
            raise MessageError(f"the definition of {name} has the line {head[:60]!r}, not MSG: …")
        parts.append((full_name(head[4:].strip()), body))
    for part, body in parts:
        types[part] = MessageType(part, tuple(_fields(part, body)))
    return types


def _fields(name: str, body: str) -> Iterator[MessageField]:
    """The fields of a type; constants and comments are no fields."""
    package, found = name.split("/")[0], False
    for line in body.split("\n"):
        line = line.partition("#")[0].strip() if "'" not in line and '"' not in line else line
        if not line.strip() or line.strip().startswith("#"):
            continue
        match = _FIELD.fullmatch(line.strip())
        if match is None:
            raise MessageError(f"the definition of {name} has the line {line[:60]!r}: no field")
        if match["rest"].strip().startswith("=") and not match["rest"].strip().startswith("=="):
            continue  # a constant
        found = True
        base = match["base"]
        if base not in PRIMITIVES and base not in ("string", "wstring"):
            base = full_name(base, package)
        size, text = int(match["size"] or 0), int(match["text"] or 0)
        many: Many = "one"
        if match["size"] is not None:
            many = "array" if match["size"] and not match["at_most"] else "sequence"
        yield MessageField(match["name"], base, many, size, text)
    if not found:  # C has no empty structures, and so there is a byte
        yield MessageField("structure_needs_at_least_one_member", "uint8")


def needed_by(name: str, types: Mapping[str, MessageType]) -> list[str]:
    """The full names of the types that a type is made of, each once, in the order they are met.

    Raises:
        MessageError: One of them isn't among the types.
    """
    found: dict[str, None] = {}
    ahead = [name]
    while ahead:
        one = ahead.pop(0)
        if one not in types:
            raise MessageError(f"the type {one} isn't defined; give its definition too")
        if one in found:
            continue
        found[one] = None
        ahead += [field.base for field in types[one].fields if "/" in field.base]
    return list(found)[1:]
