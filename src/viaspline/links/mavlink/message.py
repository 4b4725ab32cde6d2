"""What a MAVLink message is: numbers in a fixed order, packed without gaps.

A message is a frozen dataclass whose fields stand in the order of the wire: by the size of their
type, largest first, then what later versions have added. What is missing at the end is zero.
Source: https://mavlink.io/en/guide/serialization.html

Tested through ``links/mavlink/test_frames``.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, fields
from typing import ClassVar, Final, Self, TypeAlias

U8: TypeAlias = int
U16: TypeAlias = int
I16: TypeAlias = int
U32: TypeAlias = int
I32: TypeAlias = int
U64: TypeAlias = int
F32: TypeAlias = float
Text50: TypeAlias = bytes

_CODES: Final = {
    "U8": "B", "U16": "H", "I16": "h", "U32": "I", "I32": "i", "U64": "Q", "F32": "f",
    "Text50": "50s",
}  # fmt: skip


@dataclass(frozen=True)
class MavlinkMessage:
    """A message; each kind is a class in ``common_messages``.

    Attributes:
        NUMBER: Of its kind.
        EXTRA: What its kind adds to the checksum, so that both ends mean the same fields.
        PACKING: How it is packed, by its fields.
    """

    NUMBER: ClassVar[int]
    EXTRA: ClassVar[int]
    PACKING: ClassVar[struct.Struct]

    def __init_subclass__(cls, *, number: int, extra: int) -> None:
        cls.NUMBER, cls.EXTRA = number, extra
        codes = (_CODES[str(kind)] for kind in cls.__annotations__.values())
        cls.PACKING = struct.Struct("<" + "".join(codes))

    def packed(self) -> bytes:
        """All of its bytes.

        Raises:
            struct.error: A number doesn't fit its field.
        """
        return self.PACKING.pack(*(getattr(self, one.name) for one in fields(self)))

    @classmethod
    def unpacked(cls, payload: bytes) -> Self:
        """The message that some bytes hold.

        Args:
            payload: Its bytes; zeros at the end may be missing, and more than it knows is left out.
        """
        size = cls.PACKING.size
        return cls(*cls.PACKING.unpack(payload[:size].ljust(size, b"\0")))
