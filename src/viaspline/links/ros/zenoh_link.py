"""Speaks to ROS 2 nodes over rmw_zenoh: a zenoh session that looks like a node.

Tested through ``links/ros/test_zenoh_link``.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterator, Mapping
from importlib.util import find_spec
from typing import Any

from viaspline.errors import LinkError
from viaspline.links.ros.ros_graph import HUMBLE, NODE
from viaspline.links.ros.ros_mailbox import RosMailbox
from viaspline.links.ros.ros_topics import Qos, qos_for
from viaspline.links.ros.zenoh_keys import (
    Side,
    attachment,
    endpoint_token,
    node_token,
    topic_key,
)
from viaspline.ros_messages.message_book import MessageBook


def check_zenoh() -> None:
    """Refuse to go on without the extra.

    Raises:
        LinkError: Saying what to install.
    """
    if find_spec("zenoh") is None:
        problem = "eclipse-zenoh is not installed"
        raise LinkError("--ros", problem, "pip install 'viaspline[ros]'")


class ZenohLink:
    """A session with the topics that are heard and said; to be closed.

    Args:
        endpoint: The router's address, such as ``tcp/localhost:7447``.
        domain: Of ROS (``ROS_DOMAIN_ID``).
        hears: Topics with their types.
        says: Likewise.
        book: The types.
        distro: Of the robot's ROS, in small letters; in Humble types have no hashes.

    Raises:
        LinkError: The extra isn't installed, or there is no router.
    """

    def __init__(
        self, endpoint: str, domain: int, hears: Mapping[str, str], says: Mapping[str, str],
        book: MessageBook, *, distro: str = "jazzy",
    ) -> None:  # fmt: skip
        check_zenoh()
        import zenoh

        self._book, self._domain = book, domain
        self._hash_of = book.hash if distro != HUMBLE else _no_hash
        self.mailbox = RosMailbox(hears, book)
        config = zenoh.Config()
        config.insert_json5("mode", json.dumps("client"))
        config.insert_json5("connect/endpoints", json.dumps([endpoint]))
        config.insert_json5("scouting/multicast/enabled", "false")
        config.insert_json5("timestamping/enabled", "true")  # what stays is told apart by that
        try:
            self._session = zenoh.open(config)
        except zenoh.ZError as error:
            remedy = "start it: ros2 run rmw_zenoh_cpp rmw_zenohd; or give --connect"
            raise LinkError(
                endpoint, f"no zenoh router answers ({_brief(error)})", remedy
            ) from None
        self._id = str(self._session.zid())
        live = self._session.liveliness()
        self._tokens = [live.declare_token(node_token(domain, self._id, NODE))]
        self._numbers = 10
        self._publishers: dict[str, tuple[Any, str, str]] = {}
        self._counts: dict[str, int] = {}
        self._subscribers = [self._hear(topic, kind) for topic, kind in hears.items()]
        for topic, kind in says.items():
            self._say(topic, kind)

    def _token(self, side: Side, topic: str, kind: str, qos: Qos) -> str:
        token = endpoint_token(
            self._domain, self._id, NODE, self._numbers, side, topic, kind, self._hash_of(kind),
            qos,
        )  # fmt: skip
        self._numbers += 1
        self._tokens.append(self._session.liveliness().declare_token(token))
        return token

    def _hear(self, topic: str, kind: str) -> Any:
        from zenoh import ext

        qos = qos_for(topic, kind)
        key = topic_key(self._domain, topic, kind, "*")

        def heard(sample: Any) -> None:
            self.mailbox.put(topic, sample.payload.to_bytes())

        self._token("MS", topic, kind, qos)
        if not qos.stays:
            return self._session.declare_subscriber(key, heard)
        history = ext.HistoryConfig(detect_late_publishers=True, max_samples=qos.depth)
        return ext.declare_advanced_subscriber(self._session, key, heard, history=history)

    def _say(self, topic: str, kind: str) -> None:
        from zenoh import ext

        qos = qos_for(topic, kind)
        key = topic_key(self._domain, topic, kind, self._hash_of(kind))
        cache = ext.CacheConfig(qos.depth) if qos.stays else None
        publisher = ext.declare_advanced_publisher(
            self._session, key, cache=cache, publisher_detection=qos.stays or None
        )
        self._publishers[topic] = publisher, kind, self._token("MP", topic, kind, qos)

    def publish(self, topic: str, message: Mapping[str, Any]) -> None:
        """Say something on one of the topics.

        Raises:
            MessageError: It doesn't fit the topic's type.
        """
        publisher, kind, token = self._publishers[topic]
        count = self._counts[topic] = self._counts.get(topic, 0) + 1
        data = self._book.encoded(kind, message)
        publisher.put(data, attachment=attachment(count, time.time_ns(), token))

    def messages(self, patience: float) -> Iterator[tuple[float, str, dict[str, Any]]]:
        """What was heard, and when [s]; waits so long for something [s]: see ``RosMailbox``."""
        return self.mailbox.messages(patience)

    def close(self) -> None:
        """End the session; tokens and all go with it."""
        self._session.close()  # type: ignore[no-untyped-call]


def _no_hash(kind: str) -> str:
    """What stands in place of a type's hash in Humble."""
    return "TypeHashNotSupported"


def _brief(error: Exception) -> str:
    return " ".join(str(error).split())[:80]
