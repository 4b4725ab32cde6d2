"""What a vehicle has made of the items that it was sent."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

from viaspline.formats.commands import command_name
from viaspline.links.mavlink.common_messages import MissionItemInt

_HEIGHT_M: Final = 0.011
"""Heights are kept to a centimetre on board."""

_SAME_FRAME: Final = {5: 0, 6: 3, 11: 10}
"""MAV_FRAMEs that mean others."""

_LARGEST_SHOWN: Final = 5


def differences(
    sent: Sequence[MissionItemInt], read: Sequence[MissionItemInt], *, skip_first: bool
) -> tuple[str, ...]:
    """Where what is on board isn't what was sent, in words.

    Commands, frames, places (to 1e-7 degrees), heights (to a centimetre) and the first parameter
    count: it is how long the vehicle stays, how many corners there are, or a radius. The others
    are kept by no autopilot alike.

    Args:
        sent: The items.
        read: What came back.
        skip_first: Whether the first one is the vehicle's home, which it knows better.

    >>> differences((), (), skip_first=False)
    ()
    """
    if len(sent) != len(read):
        return (f"{len(sent)} items were sent, {len(read)} are on board",)
    found = [
        f"item {k}: {words}"
        for k, (one, other) in enumerate(zip(sent, read, strict=True))
        if not (skip_first and k == 0) and (words := _difference(one, other))
    ]
    more = len(found) - _LARGEST_SHOWN
    return (*found[:_LARGEST_SHOWN], *((f"and {more} more",) if more > 0 else ()))


def same_until(
    sent: Sequence[MissionItemInt], read: Sequence[MissionItemInt], *, skip_first: bool
) -> int:
    """How many items from the first on are on board as they were sent."""
    for k, (one, other) in enumerate(zip(sent, read, strict=False)):
        if not (skip_first and k == 0) and _difference(one, other):
            return k
    return min(len(sent), len(read))


def _difference(one: MissionItemInt, other: MissionItemInt) -> str:
    if one.command != other.command:
        return f"{command_name(one.command)} became {command_name(other.command)}"
    frames = (_SAME_FRAME.get(one.frame, one.frame), _SAME_FRAME.get(other.frame, other.frame))
    has_place = bool(one.x or one.y)
    if has_place and frames[0] != frames[1]:
        return f"frame {one.frame} became {other.frame}"
    if has_place and max(abs(one.x - other.x), abs(one.y - other.y)) > 1:
        return f"its place became {other.x / 1e7:.7f}, {other.y / 1e7:.7f}"
    if has_place and not abs(one.z - other.z) <= _HEIGHT_M:
        return f"its height of {one.z:g} m became {other.z:g} m"
    if not math.isclose(one.param1, other.param1, rel_tol=1e-5, abs_tol=1e-3):
        return f"its first parameter {one.param1:g} became {other.param1:g}"
    return ""
