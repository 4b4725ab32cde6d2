"""How rmw_zenoh calls things: keys of topics, liveliness tokens, and what goes beside messages.

By its design document, as of Jazzy. Type hashes are part of the keys; Humble knows none.
"""

from __future__ import annotations

import hashlib
import struct
from typing import Final, Literal

from viaspline.links.ros.ros_topics import Qos, dds_type

ADMIN: Final = "@ros2_lv"
NODE_ID: Final = 0
GID_BYTES: Final = 16
Side = Literal["MP", "MS"]
"""A publisher, or a subscription."""


def qos_key(qos: Qos) -> str:
    """A QoS as it stands in tokens; what is usual is left out.

    >>> qos_key(Qos()), qos_key(Qos(reliable=False, stays=True, depth=1))
    ('::,10:,:,:,,', '2:1:,1:,:,:,,')
    """
    reliability, durability = "" if qos.reliable else "2", "1" if qos.stays else ""
    return f"{reliability}:{durability}:,{qos.depth}:,:,:,,"


def topic_key(domain: int, topic: str, kind: str, type_hash: str) -> str:
    """The key on which a topic's messages are said.

    >>> topic_key(0, "/chatter", "std_msgs/msg/String", "RIHS01_ab")
    '0/chatter/std_msgs::msg::dds_::String_/RIHS01_ab'
    """
    return f"{domain}/{topic.strip('/')}/{dds_type(kind)}/{type_hash}"


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
        f"{dds_type(kind)}/{type_hash}/{qos_key(qos)}"
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
