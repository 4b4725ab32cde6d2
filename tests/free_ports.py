"""Ports that no other test has."""

from __future__ import annotations

import itertools
import os
import socket

_ASKED = itertools.count()


def free_port(kind: socket.SocketKind = socket.SOCK_DGRAM) -> int:
    """A port that nobody has: of this process of the tests alone, and none that systems hand out.

    One that a system hands out may be another process's before it is taken here.
    """
    worker = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
    while True:
        port = 20_000 + 500 * (worker % 20) + next(_ASKED) % 500
        with socket.socket(socket.AF_INET, kind) as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
            return port
