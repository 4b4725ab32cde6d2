"""Speaks to ROS 2 nodes over DDS, as rmw_cyclonedds and rmw_fastrtps do, and looks like one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from typing import Any, Final

from viaspline.errors import LinkError
from viaspline.links.ros.dds_types import sample_class, sample_of
from viaspline.links.ros.ros_graph import (
    GRAPH_KIND,
    GRAPH_QOS,
    GRAPH_TOPIC,
    HUMBLE,
    NODE,
    graph_book,
    graph_message,
)
from viaspline.links.ros.ros_mailbox import RosMailbox
from viaspline.links.ros.ros_topics import Qos, qos_for
from viaspline.ros_messages.message_book import MessageBook

MOST_TAKEN: Final = 100
"""Messages that are taken from a reader at once."""
BLOCKING_NS: Final = 100_000_000
"""A reliable writer waits no longer than that for who reads too slowly [ns]."""


def check_cyclonedds() -> None:
    """Refuse to go on without the extra.

    Raises:
        LinkError: Saying what to install.
    """
    if find_spec("cyclonedds") is None:
        problem = "cyclonedds is not installed"
        raise LinkError("--rmw dds", problem, "pip install 'viaspline[dds]'")


class DdsLink:
    """A participant with the topics that are heard and said; to be closed.

    Cyclone reads ``CYCLONEDDS_URI`` itself: which networks it uses, and peers that multicast
    doesn't find.

    Args:
        domain: Of ROS (``ROS_DOMAIN_ID``).
        hears: Topics with their types.
        says: Likewise.
        book: The types.
        distro: Of the robot's ROS, in small letters; in Humble types have no hashes.

    Raises:
        LinkError: The extra isn't installed, or there is no network to take part in.
    """

    def __init__(
        self, domain: int, hears: Mapping[str, str], says: Mapping[str, str], book: MessageBook,
        *, distro: str = "jazzy",
    ) -> None:  # fmt: skip
        check_cyclonedds()
        from cyclonedds.core import DDSException
        from cyclonedds.domain import DomainParticipant
        from cyclonedds.qos import Policy
        from cyclonedds.qos import Qos as DdsQos

        self._book, self._distro = book, distro
        self.mailbox = RosMailbox(hears, book)
        try:
            about = Policy.Userdata(b"enclave=/;")
            self._participant: Any = DomainParticipant(domain, qos=DdsQos(about))
        except DDSException as error:
            remedy = "connect a network, or say in CYCLONEDDS_URI which; fewer participants"
            problem = f"no part can be taken in domain {domain} ({error.msg or error})"
            raise LinkError("--rmw dds", problem, remedy) from None
        self._readers = [self._hear(topic, kind) for topic, kind in hears.items()]
        self._writers = {
            topic: self._writer(f"rt{topic}", kind, qos_for(topic, kind), book)
            for topic, kind in says.items()
        }
        self._kinds = dict(says)
        self._graph = self._shown_in_graph()

    def _topic(self, name: str, kind: str, book: MessageBook) -> tuple[Any, Any]:
        from cyclonedds.topic import Topic

        made = sample_class(kind, book.types)
        return made, Topic(self._participant, name, made)

    def _hear(self, topic: str, kind: str) -> Any:
        from cyclonedds.core import Listener
        from cyclonedds.sub import DataReader

        put = self.mailbox.put

        class Heard(Listener):
            """Puts into the mailbox what has come; called by Cyclone's own threads."""

            def on_data_available(self, reader: Any) -> None:
                for sample in reader.take(MOST_TAKEN):
                    if sample.sample_info.valid_data:
                        put(topic, sample.cdr)

        listener: Any = Heard
        _, described = self._topic(f"rt{topic}", kind, self._book)
        qos = self._dds_qos(qos_for(topic, kind), kind, self._book)
        return DataReader(self._participant, described, qos=qos, listener=listener())

    def _writer(self, name: str, kind: str, qos: Qos, book: MessageBook) -> tuple[Any, Any]:
        from cyclonedds.pub import DataWriter

        made, described = self._topic(name, kind, book)
        return made, DataWriter(self._participant, described, qos=self._dds_qos(qos, kind, book))

    def _dds_qos(self, qos: Qos, kind: str, book: MessageBook) -> Any:
        from cyclonedds.qos import Policy
        from cyclonedds.qos import Qos as DdsQos

        reliable, stays = Policy.Reliability, Policy.Durability
        hashed = () if self._distro == HUMBLE else (f"typehash={book.hash(kind)};".encode(),)
        return DdsQos(
            reliable.Reliable(BLOCKING_NS) if qos.reliable else reliable.BestEffort,
            stays.TransientLocal if qos.stays else stays.Volatile,
            Policy.History.KeepLast(qos.depth),
            Policy.DataRepresentation(use_cdrv0_representation=True),
            *(Policy.Userdata(one) for one in hashed),
        )

    def _shown_in_graph(self) -> tuple[Any, Any]:
        """Say once, to all who come, which node this is; the writer that keeps saying so."""
        book = graph_book(self._distro)
        made, writer = self._writer(GRAPH_TOPIC, GRAPH_KIND, GRAPH_QOS, book)
        message = graph_message(
            NODE, self._participant.guid.bytes, (one.guid.bytes for one in self._readers),
            (one.guid.bytes for _, one in self._writers.values()), self._distro,
        )  # fmt: skip
        writer.write(sample_of(made, book.encoded(GRAPH_KIND, message)))
        return made, writer

    def publish(self, topic: str, message: Mapping[str, Any]) -> None:
        """Say something on one of the topics.

        Raises:
            MessageError: It doesn't fit the topic's type.
            LinkError: It can't be said.
        """
        from cyclonedds.core import DDSException

        made, writer = self._writers[topic]
        try:
            writer.write(sample_of(made, self._book.encoded(self._kinds[topic], message)))
        except DDSException as error:
            problem = f"nothing can be said on {topic} ({error.msg or error})"
            raise LinkError("--rmw dds", problem, "see whether whoever reads it hangs") from None

    def messages(self, patience: float) -> Iterator[tuple[float, str, dict[str, Any]]]:
        """What was heard, and when [s]; waits so long for something [s]: see ``RosMailbox``."""
        return self.mailbox.messages(patience)

    def close(self) -> None:
        """Take part no more."""
        for reader in self._readers:
            reader.set_listener(None)
        self._readers.clear()
        self._writers.clear()
        del self._graph, self._participant
