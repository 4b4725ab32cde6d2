"""A mission onto a vehicle: fence, rally points and mission sent, read back and compared."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

from viaspline.errors import LinkError
from viaspline.formats.items import Home, Itinerary
from viaspline.links.mavlink.common_messages import Heartbeat, MissionItemInt
from viaspline.links.mavlink.conversation import Conversation
from viaspline.links.mavlink.exchange import Failure
from viaspline.links.mavlink.item_differences import differences, same_until
from viaspline.links.mavlink.mav_words import (
    ARMED,
    FENCE,
    LISTS,
    MISSION,
    MISSION_ERROR,
    MISSION_UNSUPPORTED,
    RALLY,
)
from viaspline.links.mavlink.mission_download import MissionDownload
from viaspline.links.mavlink.mission_items import Lists, addressed
from viaspline.links.mavlink.mission_upload import MissionUpload
from viaspline.links.mavlink.vehicle import Vehicle

ORDER: Final = (FENCE, RALLY, MISSION)
"""The mission comes last: it is on board only where what keeps it in is."""

Tell = Callable[[str], object]


class Uploaded(NamedTuple):
    """What is on board now.

    Attributes:
        vehicle: Whose board that is.
        counts: How many items of each list, by its MAV_MISSION_TYPE; a home isn't counted.
    """

    vehicle: Vehicle
    counts: dict[int, int]


def refuse_under_way(link: str, vehicle: Vehicle, heartbeat: Heartbeat) -> None:
    """Refuse to change the mission of a vehicle that is driving one.

    Raises:
        LinkError: It is.
    """
    is_armed = bool(heartbeat.base_mode & ARMED)
    if is_armed and vehicle.modes and heartbeat.custom_mode == vehicle.modes.mission:
        mode = vehicle.mode_name(heartbeat.custom_mode)
        problem = f"{vehicle} is armed and drives its mission ({mode}): nothing was sent"
        raise LinkError(link, problem, "stop it, or change its mode, first")


def refuse_copter_on_ground(link: str, vehicle: Vehicle, itinerary: Itinerary) -> None:
    """Refuse to send a copter along items whose heights nobody has said: those are 0 above home.

    Raises:
        LinkError: It would be sent so.
    """
    if vehicle.is_copter and itinerary.is_flat:
        problem = (
            f"the mission has no heights: {vehicle} would fly 0 m above home; nothing was sent"
        )
        raise LinkError(link, problem, "give its points heights, or send a .plan's own with --vias")


def upload_mission(
    conversation: Conversation,
    vehicle: Vehicle,
    lists: Lists,
    home: Home | None,
    tell: Tell = lambda words: None,
) -> Uploaded:
    """Send lists of items to a vehicle, read them back, and compare.

    Args:
        conversation: On its link.
        vehicle: It.
        lists: Their items; a list that isn't there is left as it is on board, an empty one is
            cleared.
        home: Where the mission's home is.
        tell: Is told what is done, in words.

    Raises:
        LinkError: The vehicle refuses an item, falls silent or keeps something else; what is on
            board then is said, list by list.
    """
    counts: dict[int, int] = {}
    for kind in (one for one in ORDER if one in lists):
        items = addressed(lists[kind], kind, vehicle, home)
        tell(f"sending the {LISTS[kind]}: {len(items)} items …")
        sent = _sent(conversation, MissionUpload(vehicle, kind, items), tell)
        tell(f"reading the {LISTS[kind]} back …")
        read = conversation.carried_out(MissionDownload(vehicle, kind), vehicle)
        _check(conversation.name, vehicle, sent, read, counts)
        counts[kind] = len(lists[kind])
    return Uploaded(vehicle, counts)


def _sent(conversation: Conversation, upload: MissionUpload, tell: Tell) -> MissionUpload:
    """An upload at its end; who breaks it off is told what that means."""
    try:
        return conversation.carried_out(upload, upload.vehicle)
    except BaseException:
        tell(
            f"the {LISTS[upload.kind]} was broken off: what is on board now isn't known; "
            "viaspline download shows it"
        )
        raise


def _check(
    link: str, vehicle: Vehicle, sent: MissionUpload, read: MissionDownload, done: dict[int, int]
) -> None:
    """Whether what is on board is what was sent: that counts, whatever was answered.

    Raises:
        LinkError: It isn't, or that can't be known.
    """
    skip = sent.kind == MISSION and vehicle.item_0_is_home
    name, whole = LISTS[sent.kind], f"{vehicle}"
    if read.is_done:
        unlike = differences(sent.items, read.items, skip_first=skip)
        if not unlike or _both_empty(sent.items, read.items, skip_first=skip):
            return
        board = _on_board(sent.items, read.items, name, skip_first=skip)
    else:
        assert read.failure is not None
        asked = read.failure.words(read.count or 0, name)
        unlike, board = (), f"isn't known, as it couldn't be read back ({asked})"
    if sent.failure is not None:
        what = sent.failure.words(len(sent.items), name)
    elif unlike:
        what = f"it keeps the {name} otherwise: {'; '.join(unlike)}"
    else:
        what = f"it took the {name}"
    earlier = "".join(f"; the {LISTS[one]} is on board as sent" for one in done)
    remedy = _remedy(sent.kind, sent.failure)
    raise LinkError(link, f"{whole}: {what}\n  on board: {board}{earlier}", remedy)


def _both_empty(
    sent: Sequence[MissionItemInt], read: Sequence[MissionItemInt], *, skip_first: bool
) -> bool:
    """Whether nothing was sent and nothing but a home is on board."""
    return not sent and len(read) <= (1 if skip_first else 0)


def _on_board(
    sent: Sequence[MissionItemInt], read: Sequence[MissionItemInt], name: str, *, skip_first: bool
) -> str:
    """What a vehicle has on board, beside what it was sent."""
    same = same_until(sent, read, skip_first=skip_first)
    own = 1 if skip_first else 0
    if len(read) <= own:
        return f"no {name} at all"
    if same <= own:
        return f"another {name}, of {len(read)} items"
    first = f"items 0 to {same - 1} of what was sent"
    rest = len(read) - same
    if rest:
        return f"{first}, and behind them {rest} others: a {name} that nobody has meant"
    return f"{first}, and no more"


def _remedy(kind: int, failure: Failure | None) -> str:
    no_fences = (MISSION_ERROR, MISSION_UNSUPPORTED)  # what one says that knows none
    if kind == FENCE and failure is not None and failure.result in no_fences:
        return "if it knows no fences, --no-fence sends the mission alone"
    return "mend it and send it again before anyone starts it"
