"""What carries bytes to a vehicle and back.

Tested through ``links/mavlink/test_transports``.
"""

from __future__ import annotations

from typing import Protocol

from viaspline.links.mavlink.addresses import LinkAddress


class Transport(Protocol):
    """A way for bytes; both directions may raise ``OSError`` where it breaks."""

    def read(self, timeout: float) -> bytes:
        """What has come, as soon as something comes; nothing if nothing does in that time [s]."""
        ...

    def write(self, data: bytes) -> None:
        """Send a frame."""
        ...

    def close(self) -> None:
        """Let go of it."""
        ...


def open_transport(address: LinkAddress) -> Transport:
    """The transport to an address.

    Raises:
        LinkError: It can't be had.
    """
    if address.kind == "tcp":
        from viaspline.links.mavlink.tcp_transport import TcpTransport

        return TcpTransport.to(address)
    if address.kind == "serial":
        from viaspline.links.mavlink.serial_transport import SerialTransport

        return SerialTransport.to(address)
    from viaspline.links.mavlink.udp_transport import UdpTransport

    return UdpTransport.at(address)
