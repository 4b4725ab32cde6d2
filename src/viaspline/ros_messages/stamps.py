"""Times of ROS: seconds and nanoseconds; and headers, which have one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from viaspline.errors import MessageError

NANO: Final = 1_000_000_000
MAP_FRAME: Final = "map"
ODOM_FRAME: Final = "odom"
BASE_FRAME: Final = "base_link"
LASER_FRAME: Final = "laser"


def nanoseconds(time: float) -> int:
    """A time [s] in nanoseconds.

    >>> nanoseconds(0.1)
    100000000
    """
    return round(time * NANO)


def stamp_of(time: float) -> dict[str, int]:
    """A time [s] as a message ``builtin_interfaces/Time``.

    Raises:
        MessageError: It is below 0, or more than its seconds can say.

    >>> stamp_of(1.25)
    {'sec': 1, 'nanosec': 250000000}
    """
    sec, nanosec = divmod(nanoseconds(time), NANO)
    if not 0 <= sec < 2**31:
        raise MessageError(f"the time {time} s can't be a stamp; give 0 to {2**31} s")
    return {"sec": sec, "nanosec": nanosec}


def seconds_of(stamp: Mapping[str, int]) -> float:
    """The time of a stamp [s].

    >>> seconds_of({"sec": 1, "nanosec": 250000000})
    1.25
    """
    return stamp["sec"] + stamp["nanosec"] / NANO


def header(time: float, frame: str) -> dict[str, Any]:
    """A message ``std_msgs/Header``.

    >>> header(2.0, "map")
    {'stamp': {'sec': 2, 'nanosec': 0}, 'frame_id': 'map'}
    """
    return {"stamp": stamp_of(time), "frame_id": frame}
