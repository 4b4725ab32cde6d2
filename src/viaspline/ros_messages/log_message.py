"""Events as lines of ``/rosout``: ``rcl_interfaces/Log``."""

from __future__ import annotations

from typing import Any, Final

from viaspline.robot.run import Event, EventKind
from viaspline.ros_messages.stamps import stamp_of

NODE: Final = "viaspline"
INFO, WARN, ERROR = 20, 30, 40
_GRAVE: Final[frozenset[EventKind]] = frozenset({"contact", "stopped"})
_ODD: Final[frozenset[EventKind]] = frozenset({"braked", "skipped", "premise"})


def level_of(kind: EventKind) -> int:
    """How grave an event is, in ROS's levels.

    >>> level_of("via"), level_of("skipped"), level_of("contact")
    (20, 30, 40)
    """
    if kind in _GRAVE:
        return ERROR
    return WARN if kind in _ODD else INFO


def log_line(time: float, event: Event) -> dict[str, Any]:
    """An event as a message.

    Args:
        time: When it is told [s].
        event: What happened.

    >>> log_line(1.0, Event("via", 1.0, (3.0, 4.0), "passes 'pump'"))["msg"]
    "via: passes 'pump' at 3.00, 4.00 m"
    """
    place = ", ".join(f"{value:.2f}" for value in event.at)
    return {
        "stamp": stamp_of(time),
        "level": level_of(event.kind),
        "name": NODE,
        "msg": f"{event.kind}: {event.message} at {place} m",
        "file": "",
        "function": "",
        "line": 0,
    }
