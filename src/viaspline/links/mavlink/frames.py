"""MAVLink frames: messages as bytes on a wire, and back.

What is sent is version 2, unsigned; what is read may be version 1 or signed (the signature isn't
looked at). Source: https://mavlink.io/en/guide/serialization.html
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

from viaspline.links.mavlink.checksum import checksum
from viaspline.links.mavlink.common_messages import MESSAGES
from viaspline.links.mavlink.message import MavlinkMessage

_VERSION_2: Final = 0xFD
_VERSION_1: Final = 0xFE
_SIGNED: Final = 0x01
_SIGNATURE: Final = 13
_FLAGS: Final = (b"", b"\0", b"\x01")
"""What a frame may say that its reader has to understand: nothing, or that it is signed."""
_LONGEST: Final = 280


class Heard(NamedTuple):
    """A message and who has sent it.

    Attributes:
        system: Of the sender.
        component: Of the sender: 1 is an autopilot.
        message: It.
    """

    system: int
    component: int
    message: MavlinkMessage


def frame_of(message: MavlinkMessage, *, system: int, component: int, sequence: int) -> bytes:
    """A message as a frame of version 2.

    Args:
        message: It.
        system: Of the sender, 1 to 255.
        component: Of the sender, 1 to 255.
        sequence: How many frames were sent before it; only its last eight bits are sent.

    >>> from viaspline.links.mavlink.common_messages import MissionRequestList
    >>> frame_of(MissionRequestList(1, 1, 0), system=245, component=190, sequence=3).hex(" ")
    'fd 02 00 00 03 f5 be 2b 00 00 01 01 7c 60'
    """
    payload = message.packed().rstrip(b"\0") or b"\0"
    number = message.NUMBER.to_bytes(3, "little")
    head = bytes((len(payload), 0, 0, sequence & 0xFF, system, component)) + number
    crc = checksum(head + payload + bytes((message.EXTRA,)))
    return bytes((_VERSION_2,)) + head + payload + crc.to_bytes(2, "little")


@dataclass(frozen=True)
class FrameReader:
    """Bytes that have come and are no whole frame yet.

    Attributes:
        rest: They.
        broken: How many frames of known kinds had a wrong checksum so far.
    """

    rest: bytes = b""
    broken: int = 0

    def fed(self, data: bytes) -> tuple[FrameReader, tuple[Heard, ...]]:
        """The reader after some more bytes, and the messages that have become whole with them.

        Frames of unknown kinds are passed over, as is everything that is no frame. After a wrong
        checksum the search goes on at the byte behind the frame's first.
        """
        left, found, broken, at = self.rest + data, [], self.broken, 0
        while (at := _next_start(left, at)) < len(left):
            if left[at] == _VERSION_2 and left[at + 2 : at + 3] not in _FLAGS:
                at += 1
                continue
            cut = _cut(left, at)
            if cut is None:
                break
            kind = MESSAGES.get(cut.number)
            if kind is None:
                # Whether it is whole can't be known: a frame may begin in what looks like one.
                at += cut.size if _ends_well(left, at + cut.size) else 1
                continue
            body = left[at + 1 : at + cut.head + cut.length] + bytes((kind.EXTRA,))
            end = at + cut.head + cut.length
            if checksum(body) != int.from_bytes(left[end : end + 2], "little"):
                broken, at = broken + 1, at + 1
                continue
            message = kind.unpacked(left[at + cut.head : end])
            found.append(Heard(cut.system, cut.component, message))
            at += cut.size
        return FrameReader(left[at:][-_LONGEST:], broken), tuple(found)


class _Cut(NamedTuple):
    """What the head of a frame says: sizes in bytes, sender, and number of its message."""

    head: int
    length: int
    size: int
    system: int
    component: int
    number: int


def _next_start(data: bytes, at: int) -> int:
    starts = (data.find(bytes((byte,)), at) for byte in (_VERSION_1, _VERSION_2))
    return min((start for start in starts if start >= 0), default=len(data))


def _ends_well(data: bytes, end: int) -> bool:
    """Whether at the end of a frame nothing follows, or another one."""
    return end == len(data) or data[end] in (_VERSION_1, _VERSION_2)


def _cut(data: bytes, at: int) -> _Cut | None:
    """The frame that begins at a place; None if not all of it has come."""
    head = 10 if data[at] == _VERSION_2 else 6
    if len(data) < at + head:
        return None
    length = data[at + 1]
    if data[at] == _VERSION_2:
        signature = _SIGNATURE if data[at + 2] & _SIGNED else 0
        number = int.from_bytes(data[at + 7 : at + 10], "little")
        system, component = data[at + 5], data[at + 6]
    else:
        signature, number, system, component = 0, data[at + 5], data[at + 3], data[at + 4]
    size = head + length + 2 + signature
    if len(data) < at + size:
        return None
    return _Cut(head, length, size, system, component, number)
