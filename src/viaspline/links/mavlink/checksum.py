"""The checksum of MAVLink frames: CRC-16/MCRF4XX."""

from __future__ import annotations

from typing import Final


def _row(byte: int) -> int:
    for _ in range(8):
        byte = (byte >> 1) ^ (0x8408 if byte & 1 else 0)
    return byte


_TABLE: Final = tuple(_row(byte) for byte in range(256))


def checksum(data: bytes) -> int:
    """The checksum of some bytes, 16 bits.

    >>> hex(checksum(b"123456789"))
    '0x6f91'
    """
    crc = 0xFFFF
    for byte in data:
        crc = (crc >> 8) ^ _TABLE[(crc ^ byte) & 0xFF]
    return crc
