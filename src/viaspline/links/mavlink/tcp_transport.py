"""A stream over TCP, as simulators of autopilots offer it.

Tested through ``links/mavlink/test_transports``.
"""

from __future__ import annotations

import select
import socket
from typing import Final

from viaspline.errors import LinkError
from viaspline.links.mavlink.addresses import LinkAddress

_CHUNK: Final = 65536
_PATIENCE_S: Final = 5.0


class TcpTransport:
    """A connected socket."""

    def __init__(self, link: socket.socket) -> None:
        self._link = link

    @classmethod
    def to(cls, address: LinkAddress) -> TcpTransport:
        """The transport to whoever listens at an address.

        Raises:
            LinkError: Nobody does.
        """
        try:
            link = socket.create_connection((address.place, address.number), _PATIENCE_S)
        except (OSError, UnicodeError) as error:
            why = (getattr(error, "strerror", None) or str(error)).lower()
            remedy = "is the vehicle (or its simulator) running, and the network up?"
            raise LinkError(address, f"can't be reached ({why})", remedy) from None
        link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        link.settimeout(_PATIENCE_S)
        return cls(link)

    def read(self, timeout: float) -> bytes:
        """What has come.

        Raises:
            OSError: The other end has closed.
        """
        ready, _, _ = select.select([self._link], [], [], max(timeout, 0.0))
        if not ready:
            return b""
        data = self._link.recv(_CHUNK)
        if not data:
            raise ConnectionResetError("the other end has closed the connection")
        return data

    def write(self, data: bytes) -> None:
        """Send a frame."""
        self._link.sendall(data)

    def close(self) -> None:
        """Close the socket."""
        self._link.close()
