"""Datagrams: listening at a port, or speaking first to one.

Tested through ``links/mavlink/test_transports``.
"""

from __future__ import annotations

import errno
import select
import socket
from contextlib import suppress
from typing import Any, Final

from viaspline.errors import LinkError
from viaspline.links.mavlink.addresses import LinkAddress

_LARGEST: Final = 65536
_MOST_PEERS: Final = 16


class UdpTransport:
    """A socket, and everyone who has spoken to it: each of them is sent what is said."""

    def __init__(self, link: socket.socket, peers: tuple[Any, ...]) -> None:
        self._link = link
        self._peers = peers

    @classmethod
    def at(cls, address: LinkAddress) -> UdpTransport:
        """The transport that listens at an address, or speaks to it first.

        Raises:
            LinkError: The name isn't known, the port is taken, or it is no address of this machine.
        """
        try:
            found = socket.getaddrinfo(address.place, address.number, type=socket.SOCK_DGRAM)
        except (OSError, UnicodeError) as error:
            remedy = "give an IP address, or look at the network"
            raise LinkError(address, f"the name isn't known ({error})", remedy) from None
        # Autopilots speak IPv4: "localhost" may have both.
        family, _, _, _, place = min(found, key=lambda one: one[0] != socket.AF_INET)
        link = socket.socket(family, socket.SOCK_DGRAM)
        try:
            if address.kind == "udp":
                link.bind(place)
        except OSError as error:
            link.close()
            raise _cannot_listen(address, error) from None
        link.setblocking(False)
        return cls(link, () if address.kind == "udp" else (place,))

    def read(self, timeout: float) -> bytes:
        """What has come, of whoever has sent it."""
        select.select([self._link], [], [], max(timeout, 0.0))
        data = b""
        with suppress(BlockingIOError, ConnectionRefusedError):
            while len(data) < _LARGEST:
                more, peer = self._link.recvfrom(_LARGEST)
                data += more
                if peer not in self._peers:
                    self._peers = (*self._peers, peer)[-_MOST_PEERS:]
        return data

    def write(self, data: bytes) -> None:
        """Send a frame to everyone who has spoken."""
        with suppress(BlockingIOError, ConnectionRefusedError):
            for peer in self._peers:
                self._link.sendto(data, peer)

    def close(self) -> None:
        """Close the socket."""
        self._link.close()


def _cannot_listen(address: LinkAddress, error: OSError) -> LinkError:
    if error.errno == errno.EADDRINUSE:
        remedy = "end what listens there (a ground station?), or have the vehicle send elsewhere"
        return LinkError(address, "the port is taken", remedy)
    if error.errno == errno.EADDRNOTAVAIL:
        other = f"udpout:{address.place}:{address.number}"
        problem = f"{address.place} isn't an address of this machine, so nobody can listen there"
        return LinkError(address, problem, f"{other} speaks to it; udp:0.0.0.0:PORT listens")
    why = (error.strerror or str(error)).lower()
    return LinkError(address, f"can't listen ({why})", "try another port")
