"""A serial line, as telemetry radios and USB ports of autopilots are.

Tested through ``links/mavlink/test_transports``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from viaspline.errors import LinkError
from viaspline.links.mavlink.addresses import LinkAddress

if TYPE_CHECKING:
    from serial import Serial

_WRITING_S: Final = 1.0


class SerialTransport:
    """An open device."""

    def __init__(self, line: Serial) -> None:
        self._line = line

    @classmethod
    def to(cls, address: LinkAddress) -> SerialTransport:
        """The transport over a device.

        Raises:
            LinkError: The extra isn't installed, or the device can't be opened.
        """
        try:
            from serial import Serial, SerialException
        except ImportError:
            remedy = "pip install 'viaspline[serial]'"
            raise LinkError(address, "serial lines need pyserial", remedy) from None
        try:
            line = Serial(address.place, address.number, timeout=0.0, write_timeout=_WRITING_S)
        except (SerialException, OSError, ValueError) as error:
            remedy = "is it plugged in, is the name right, and may you open it (group dialout)?"
            raise LinkError(address, f"can't be opened ({error})", remedy) from None
        return cls(line)

    def read(self, timeout: float) -> bytes:
        """What has come."""
        self._line.timeout = max(timeout, 0.0)
        first = self._line.read(1)
        return first + self._line.read(self._line.in_waiting) if first else b""

    def write(self, data: bytes) -> None:
        """Send a frame."""
        self._line.write(data)

    def close(self) -> None:
        """Close the device."""
        self._line.close()
