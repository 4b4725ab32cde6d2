"""Options of the commands that talk to a vehicle.

Tested through ``commands/test_upload_command``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from viaspline.links.mavlink.conversation import Conversation

PATIENCE_S = 30.0
"""How long to wait for an autopilot, and for it to be ready, where nothing is said [s]."""

ADDRESSES = "udp:HOST:PORT, udpout:HOST:PORT, tcp:HOST:PORT or serial:DEVICE[:BAUD]."

SYSTEM = click.option(
    "--system", type=click.IntRange(1, 255), metavar="N",
    help="Which vehicle, if there are several on the link.",
)  # fmt: skip
ORIGIN = click.option(
    "--origin", metavar="LAT,LON",
    help="Latitude and longitude of the mission's 0, 0, if its file is in metres.  "
    "[default: as set in the studio]",
)  # fmt: skip
WAIT = click.option(
    "--wait", type=click.FloatRange(min=1.0, max=86400.0), default=PATIENCE_S, show_default=True,
    metavar="SECONDS", help="How long to wait for an autopilot, and for it to be ready.",
)  # fmt: skip


@contextmanager
def talking_to(address: str) -> Iterator[Conversation]:
    """Within the block there is a conversation over an address.

    Raises:
        LinkError: The address is none, or can't be had.
    """
    from viaspline.links.mavlink.addresses import parse_address
    from viaspline.links.mavlink.conversation import Conversation
    from viaspline.links.mavlink.transport import open_transport

    where = parse_address(address)
    conversation = Conversation(open_transport(where), where)
    try:
        yield conversation
    finally:
        conversation.close()


def telling(quiet: bool) -> Callable[[str], Any]:
    """Who is told what goes on: the error stream, or nobody."""
    from viaspline.report.terminal.terminal_lines import say_error

    return (lambda words: None) if quiet else (lambda words: say_error(words, prefix=""))
