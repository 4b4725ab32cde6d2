"""A vehicle's mission, fence and rally points as a plan file.

Tested through ``links/mavlink/test_upload_mission``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from viaspline.errors import LinkError
from viaspline.links.mavlink.conversation import Conversation
from viaspline.links.mavlink.mav_words import FENCE, LISTS, MISSION, RALLY
from viaspline.links.mavlink.mission_download import MissionDownload
from viaspline.links.mavlink.mission_items import Lists
from viaspline.links.mavlink.vehicle import Vehicle


class Downloaded(NamedTuple):
    """What is on board of a vehicle.

    Attributes:
        lists: Its items by their MAV_MISSION_TYPE.
        lacking: The lists that it doesn't give, in words.
    """

    lists: Lists
    lacking: tuple[str, ...]


def download_mission(
    conversation: Conversation,
    vehicle: Vehicle,
    tell: Callable[[str], object] = lambda words: None,
) -> Downloaded:
    """Ask a vehicle for all that it has on board.

    Args:
        conversation: On its link.
        vehicle: It.
        tell: Is told what is done, in words.

    Raises:
        LinkError: The mission doesn't come; a fence or rally points may be lacking.
    """
    lists: Lists = {}
    lacking: list[str] = []
    for kind in (MISSION, FENCE, RALLY):
        tell(f"reading the {LISTS[kind]} …")
        read = conversation.carried_out(MissionDownload(vehicle, kind), vehicle)
        if read.failure is None:
            lists[kind] = read.items
            continue
        words = read.failure.words(read.count or 0, LISTS[kind])
        if kind == MISSION:
            problem = f"{vehicle}: {words}"
            raise LinkError(conversation.name, problem, "move nearer, or look at the link")
        lacking.append(words)
    return Downloaded(lists, tuple(lacking))
