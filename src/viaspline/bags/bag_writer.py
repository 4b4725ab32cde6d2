"""Writes MCAP files as ROS 2 has them: CDR messages, schemas as texts, QoS of every topic."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec
from types import MappingProxyType
from typing import IO, Final

from viaspline import __version__
from viaspline.errors import OutputError
from viaspline.ros_messages.message_book import Message, MessageBook
from viaspline.ros_messages.stamps import nanoseconds

REMEDY: Final = "pip install 'viaspline[bags]'"
PROFILE: Final = "ros2"
LATCHED: Final = frozenset({"/map", "/tf_static", "/plan", "/viaspline/markers"})
"""Topics whose last message who comes later gets, too (transient local)."""

_FOREVER: Final = "{sec: 9223372036, nsec: 854775807}"


def check_mcap(path: object) -> None:
    """Refuse to write or read a bag without the extra.

    Raises:
        OutputError: Saying what to install.
    """
    if find_spec("mcap") is None:
        raise OutputError(path, f"a bag needs mcap, which is not installed: {REMEDY}")


def qos_of(topic: str) -> str:
    """The QoS that a topic is offered with, as rosbag2 has it in YAML.

    >>> print(qos_of("/map")[:61])
    - {history: 1, depth: 1, reliability: 1, durability: 1, deadl
    """
    depth, durability = (1, 1) if topic in LATCHED else (10, 2)
    return (
        f"- {{history: 1, depth: {depth}, reliability: 1, durability: {durability}, "
        f"deadline: {_FOREVER}, lifespan: {_FOREVER}, liveliness: 1, "
        f"liveliness_lease_duration: {_FOREVER}, avoid_ros_namespace_conventions: false}}\n"
    )


class BagWriter:
    """A bag under way; the same messages give the same bytes.

    Args:
        file: Where to; open for writing bytes.
        book: The types of its messages.
    """

    def __init__(self, file: IO[bytes], book: MessageBook) -> None:
        from mcap.writer import CompressionType, Writer

        self._book = book
        self._writer = Writer(file, compression=CompressionType.ZSTD)
        self._writer.start(PROFILE, f"viaspline {__version__}")
        # rosbag2 takes its QoS for that of before Jazzy then, which all of them understand
        self._writer.add_metadata("rosbag2", {"ROS_DISTRO": "humble"})
        self._channels: dict[str, tuple[int, str]] = {}
        self._schemas: dict[str, int] = {}
        self._counts: dict[str, int] = {}

    def attach(self, name: str, kind: str, data: bytes) -> None:
        """Add a file.

        Args:
            name: Of the file.
            kind: Its media type.
            data: What it holds.
        """
        self._writer.add_attachment(0, 0, name, kind, data)

    def note(self, name: str, values: Mapping[str, str]) -> None:
        """Add a record of words by names."""
        self._writer.add_metadata(name, dict(values))

    def write(self, topic: str, kind: str, time: float, message: Message) -> None:
        """Add a message.

        Args:
            topic: Where it is said.
            kind: Its type's full name; always the same on a topic.
            time: When [s].
            message: It.

        Raises:
            MessageError: It doesn't fit its type.
        """
        if topic not in self._channels:
            self._channels[topic] = self._channel(topic, kind), kind
        channel, _ = self._channels[topic]
        data = self._book.encoded(kind, message)
        count = self._counts[topic] = self._counts.get(topic, -1) + 1
        moment = nanoseconds(time)
        self._writer.add_message(channel, moment, data, moment, count)

    def _channel(self, topic: str, kind: str) -> int:
        if kind not in self._schemas:
            schema = self._book.schema(kind).encode()
            self._schemas[kind] = self._writer.register_schema(kind, "ros2msg", schema)
        about = {"offered_qos_profiles": qos_of(topic), "topic_type_hash": self._book.hash(kind)}
        return self._writer.register_channel(topic, "cdr", self._schemas[kind], about)

    @property
    def counts(self) -> Mapping[str, int]:
        """How many messages each topic has so far."""
        return MappingProxyType({topic: last + 1 for topic, last in self._counts.items()})

    def finish(self) -> None:
        """Write the end, by which readers find their way."""
        self._writer.finish()  # type: ignore[no-untyped-call]
