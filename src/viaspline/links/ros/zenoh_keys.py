"""How rmw_zenoh calls things: keys of topics, liveliness tokens, and what goes beside messages.

By its design document, as of Jazzy. Type hashes are part of the keys; Humble knows none.
"""

from __future__ import annotations

import hashlib
import struct
from typing import Final, Literal, NamedTuple

ADMIN: Final = "@ros2_lv"
NODE_ID: Final = 0
GID_BYTES: Final = 16
Side = Literal["MP", "MS"]
"""A publisher, or a subscription."""


class Qos(NamedTuple):
    """How messages of a topic are delivered.

    Attributes:
        reliable: Whether none may be lost.
        stays: Whether who comes later gets the last ones (transient local).
        depth: How many are kept.
    """

    reliable: bool = True
    stays: bool = False
    depth: int = 10

    @property
    def key(self) -> str:
        """As it stands in tokens; what is usual is left out.

        >>> Qos().key, Qos(reliable=False, stays=True, depth=1).key
        ('::,10:,:,:,,', '2:1:,1:,:,:,,')
        """
        reliability, durability = "" if self.reliable else "2", "1" if self.stays else ""
        return f"{reliability}:{durability}:,{self.depth}:,:,:,,"


def type_key(kind: str) -> str:
    """A type's name as DDS has it.

    >>> type_key("std_msgs/msg/String")
    'std_msgs::msg::dds_::String_'
    """
    package, room, name = kind.split("/")
    return f"{package}::{room}::dds_::{name}_"


def topic_key(domain: int, topic: str, kind: str, type_hash: str) -> str:
    """The key on which a topic's messages are said.

    >>> topic_key(0, "/chatter", "std_msgs/msg/String", "RIHS01_ab")
    '0/chatter/std_msgs::msg::dds_::String_/RIHS01_ab'
    """
    return f"{domain}/{topic.strip('/')}/{type_key(kind)}/{type_hash}"


def node_token(domain: int, session: str, node: str) -> str:
    """The token by which a node is known to be there.

    >>> node_token(2, "aac3178e146ba6f1fc6e6a4085e77f21", "listener")
    '@ros2_lv/2/aac3178e146ba6f1fc6e6a4085e77f21/0/0/NN/%/%/listener'
    """
    return f"{ADMIN}/{domain}/{session}/{NODE_ID}/{NODE_ID}/NN/%/%/{node}"


def endpoint_token(
    domain: int, session: str, node: str, number: int, side: Side, topic: str, kind: str,
    type_hash: str, qos: Qos,
) -> str:  # fmt: skip
    """The token by which a publisher or a subscription is known to be there.

    >>> endpoint_token(2, "ab", "talker", 10, "MP", "/a/b", "std_msgs/msg/String", "R", Qos())
    '@ros2_lv/2/ab/0/10/MP/%/%/talker/%a%b/std_msgs::msg::dds_::String_/R/::,10:,:,:,,'
    """
    name = "%" + topic.strip("/").replace("/", "%")
    return (
        f"{ADMIN}/{domain}/{session}/{NODE_ID}/{number}/{side}/%/%/{node}/{name}/"
        f"{type_key(kind)}/{type_hash}/{qos.key}"
    )


def attachment(number: int, time_ns: int, token: str) -> bytes:
    """What goes beside a message: its number, when it was said, and by whom.

    Args:
        number: Of the message, from 1.
        time_ns: By the clock on the wall [ns].
        token: Of the publisher.

    >>> len(attachment(1, 2, "token"))
    33
    """
    who = hashlib.blake2b(token.encode(), digest_size=GID_BYTES).digest()
    return struct.pack("<qqB", number, time_ns, GID_BYTES) + who
