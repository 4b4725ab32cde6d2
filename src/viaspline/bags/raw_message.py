"""A message of a bag as it stands there, and what a bag has beside its messages."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from viaspline.errors import MessageError
from viaspline.ros_messages.message_book import MessageBook
from viaspline.ros_messages.message_definitions import DEFINITIONS
from viaspline.ros_messages.stamps import NANO

Wanted = Callable[[str, str], bool]
"""Whether the messages of a topic with a type are read."""


class RawMessage(NamedTuple):
    """A message.

    Attributes:
        topic: Where it was said.
        kind: Its type, in full.
        definition: Of its type, with those that it needs; nothing if the bag doesn't say.
        encoding: Of its bytes; ``cdr`` is read.
        logged: When it was written down [ns].
        data: Its bytes.
    """

    topic: str
    kind: str
    definition: str
    encoding: str
    logged: int
    data: bytes

    @property
    def time(self) -> float:
        """When it was written down [s]."""
        return self.logged / NANO


@dataclass
class BagExtent:
    """What is found in a bag while it is read.

    Attributes:
        topics: The type of every topic.
        attachments: Files in it, by their names.
        notes: Records of words, by their names.
        damage: Why it ends before its end; None: it doesn't.
        ended_at: When the last message was written down [s].
    """

    topics: dict[str, str] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    notes: dict[str, Mapping[str, str]] = field(default_factory=dict)
    damage: str | None = None
    ended_at: float = 0.0


class MessageDecoder:
    """Reads messages by the definitions that come with them, or by those that are known.

    >>> decoder = MessageDecoder()
    >>> decoder.read(RawMessage(
    ...     "/word", "std_msgs/msg/String", "string data", "cdr", 0,
    ...     bytes.fromhex("00010000 03000000 676f00"),
    ... ))
    {'data': 'go'}
    """

    def __init__(self) -> None:
        self._books: dict[tuple[str, str], MessageBook] = {}
        self._known = MessageBook(DEFINITIONS)

    def read(self, message: RawMessage) -> dict[str, Any]:
        """What a message says.

        Raises:
            MessageError: It isn't CDR, or its type isn't known or doesn't fit.
        """
        if message.encoding != "cdr":
            problem = f"{message.topic} is encoded as {message.encoding or 'nothing'}"
            raise MessageError(f"{problem}; only cdr is read")
        if not message.definition:
            return self._known.decoded(message.kind, message.data)
        key = message.kind, message.definition
        if key not in self._books:
            self._books[key] = MessageBook({message.kind: message.definition})
        return self._books[key].decoded(message.kind, message.data)
