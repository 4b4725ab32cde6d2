"""How a DDS participant says which node it is: what ``ros2 node list`` shows.

Source: rmw_dds_common.

Tested through ``links/ros/test_dds_link``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Final

from viaspline.links.ros.ros_topics import Qos
from viaspline.ros_messages.message_book import MessageBook

GRAPH_TOPIC: Final = "ros_discovery_info"
GRAPH_KIND: Final = "rmw_dds_common/msg/ParticipantEntitiesInfo"
GRAPH_QOS: Final = Qos(stays=True, depth=1)
HUMBLE: Final = "humble"
NODE: Final = "viaspline"
"""What our node is called."""
GID_BYTES, GID_BYTES_HUMBLE = 16, 24


def gid_bytes(distro: str) -> int:
    """How long the identity of a reader or writer is.

    >>> gid_bytes("humble"), gid_bytes("jazzy")
    (24, 16)
    """
    return GID_BYTES_HUMBLE if distro == HUMBLE else GID_BYTES


def graph_book(distro: str) -> MessageBook:
    """The types in which a participant says that."""
    return MessageBook(
        {
            "rmw_dds_common/msg/Gid": f"uint8[{gid_bytes(distro)}] data",
            "rmw_dds_common/msg/NodeEntitiesInfo": (
                "string<=256 node_namespace\nstring<=256 node_name\n"
                "Gid[] reader_gid_seq\nGid[] writer_gid_seq"
            ),
            GRAPH_KIND: "Gid gid\nNodeEntitiesInfo[] node_entities_info_seq",
        }
    )


def graph_message(
    node: str, participant: bytes, readers: Iterable[bytes], writers: Iterable[bytes], distro: str
) -> Mapping[str, Any]:
    """A participant with one node.

    Args:
        node: Its name.
        participant: Its identity.
        readers: Those of all that it hears with.
        writers: Those of all that it says with.
        distro: Of ROS, in small letters.

    >>> graph_message("viaspline", b"a" * 16, [b"b" * 16], [], "jazzy")["gid"]["data"][:2]
    [97, 97]
    """
    size = gid_bytes(distro)

    def gid(identity: bytes) -> dict[str, list[int]]:
        return {"data": list(identity.ljust(size, b"\0"))}

    node_info = {
        "node_namespace": "/",
        "node_name": node,
        "reader_gid_seq": [gid(one) for one in readers],
        "writer_gid_seq": [gid(one) for one in writers],
    }
    return {"gid": gid(participant), "node_entities_info_seq": [node_info]}
