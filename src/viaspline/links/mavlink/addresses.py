"""Addresses of links: ``udp:``, ``udpout:``, ``tcp:`` and ``serial:``."""

from __future__ import annotations

from typing import Final, NamedTuple

from viaspline.errors import LinkError

KINDS: Final = ("udp", "udpout", "tcp", "serial")
USUAL_BAUD: Final = 57600

_FORMS: Final = (
    "udp:HOST:PORT listens there, udpout:HOST:PORT speaks first, tcp:HOST:PORT, "
    "serial:DEVICE[:BAUD]"
)


class LinkAddress(NamedTuple):
    """Where a vehicle is spoken to.

    Attributes:
        kind: ``udp`` (listens), ``udpout`` (speaks first), ``tcp`` or ``serial``.
        place: A host or a device.
        number: A port or a baud rate.
    """

    kind: str
    place: str
    number: int

    def __str__(self) -> str:
        return f"{self.kind}:{self.place}:{self.number}"


def parse_address(text: str) -> LinkAddress:
    """The address that a text means.

    Args:
        text: Such as ``udp:0.0.0.0:14550`` or ``serial:/dev/ttyUSB0:57600``.

    Raises:
        LinkError: It is none.

    >>> parse_address("tcp:127.0.0.1:5760")
    LinkAddress(kind='tcp', place='127.0.0.1', number=5760)
    >>> parse_address("serial:/dev/ttyACM0").number
    57600
    >>> parse_address("udp:[::1]:14550").place
    '::1'
    """
    kind, _, rest = text.strip().partition(":")
    rest = rest.removeprefix("//")
    if kind == "serial":
        return _serial(text, rest)
    if kind not in KINDS:
        raise LinkError(text, "isn't the address of a vehicle", f"it can be {_FORMS}")
    place, _, digits = rest.rpartition(":")
    if not place or not (digits.isascii() and digits.isdigit()) or not 0 < int(digits) < 65536:
        raise LinkError(text, "names no host and port", f"it can be {_FORMS}")
    return LinkAddress(kind, place.removeprefix("[").removesuffix("]"), int(digits))


def _serial(text: str, rest: str) -> LinkAddress:
    device, _, digits = rest.rpartition(":")
    if not device:
        device, digits = rest, str(USUAL_BAUD)
    if not device or not (digits.isascii() and digits.isdigit()) or not 0 < int(digits) < 10**8:
        raise LinkError(text, "names no device and baud rate", f"it can be {_FORMS}")
    return LinkAddress("serial", device, int(digits))
