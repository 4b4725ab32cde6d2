"""What carries messages between a drive and the nodes of ROS: one face, by zenoh or by DDS.

Tested through ``links/ros/test_dds_link`` and ``links/ros/test_zenoh_link``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Final, Literal, NamedTuple, Protocol

from viaspline.ros_messages.message_book import MessageBook

Rmw = Literal["zenoh", "dds"]
ROUTER: Final = "tcp/localhost:7447"
"""Where rmw_zenoh's router listens."""


class RosLink(Protocol):
    """What carries messages."""

    def publish(self, topic: str, message: Mapping[str, Any]) -> None:
        """Say something on a topic."""

    def messages(self, patience: float) -> Iterator[tuple[float, str, dict[str, Any]]]:
        """What was heard and when [s]; waits so long for something [s]."""

    def close(self) -> None:
        """End it."""


class RosPlace(NamedTuple):
    """Where the nodes are.

    Attributes:
        rmw: By what they speak.
        domain: Of ROS (``ROS_DOMAIN_ID``).
        distro: Of ROS, in small letters.
        router: The address of zenoh's router.
    """

    rmw: Rmw = "zenoh"
    domain: int = 0
    distro: str = "jazzy"
    router: str = ROUTER

    def __str__(self) -> str:
        where = f" on {self.router}" if self.rmw == "zenoh" else ""
        return f"{self.rmw}{where}, domain {self.domain}"


def check_link(place: RosPlace) -> None:
    """Refuse to go on without the extra.

    Raises:
        LinkError: Saying what to install.
    """
    if place.rmw == "dds":
        from viaspline.links.ros.dds_link import check_cyclonedds

        check_cyclonedds()
    else:
        from viaspline.links.ros.zenoh_link import check_zenoh

        check_zenoh()


def open_link(
    place: RosPlace, hears: Mapping[str, str], says: Mapping[str, str], book: MessageBook
) -> RosLink:
    """A link to the nodes at a place; to be closed.

    Args:
        place: Where they are.
        hears: Topics with their types.
        says: Likewise.
        book: The types.

    Raises:
        LinkError: The extra isn't installed, or nobody can be reached.
    """
    if place.rmw == "dds":
        from viaspline.links.ros.dds_link import DdsLink

        return DdsLink(place.domain, hears, says, book, distro=place.distro)
    from viaspline.links.ros.zenoh_link import ZenohLink

    return ZenohLink(place.router, place.domain, hears, says, book, distro=place.distro)
