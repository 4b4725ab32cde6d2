"""Marks in a picture: ``visualization_msgs/Marker``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Final

from viaspline.ros_messages.pose_message import point, pose
from viaspline.ros_messages.stamps import MAP_FRAME, header

Colour = tuple[float, float, float, float]

SPHERE, LINE_STRIP, TEXT = 2, 4, 9
_ADD, _DELETE_ALL = 0, 3
_NO_TIME: Final = {"sec": 0, "nanosec": 0}


def _marker(
    time: float, space: str, number: int, kind: int, at: Sequence[float], size: Sequence[float],
    colour: Colour,
) -> dict[str, Any]:  # fmt: skip
    return {
        "header": header(time, MAP_FRAME),
        "ns": space,
        "id": number,
        "type": kind,
        "action": _ADD,
        "pose": pose(at, 0.0),
        "scale": dict(zip("xyz", size, strict=True)),
        "color": dict(zip("rgba", colour, strict=True)),
        "lifetime": _NO_TIME,
        "frame_locked": False,
        "points": (),
        "colors": (),
        "texture_resource": "",
        "texture": {"header": {"stamp": _NO_TIME, "frame_id": ""}, "format": "", "data": ()},
        "uv_coordinates": (),
        "text": "",
        "mesh_resource": "",
        "mesh_file": {"filename": "", "data": ()},
        "mesh_use_embedded_materials": False,
    }


def forget_all(time: float) -> dict[str, Any]:
    """A mark that takes all earlier ones away.

    >>> forget_all(0.0)["action"]
    3
    """
    none = (0.0, 0.0, 0.0)
    colour = (0.0, 0.0, 0.0, 0.0)
    return {**_marker(time, "", 0, SPHERE, none, none, colour), "action": _DELETE_ALL}


def ball(
    time: float, space: str, number: int, at: Sequence[float], size: float, colour: Colour
) -> dict[str, Any]:
    """A ball of a diameter [m] at a place [m].

    >>> ball(0.0, "detours", 1, (1.0, 2.0), 0.3, (1.0, 0.0, 0.0, 1.0))["scale"]["x"]
    0.3
    """
    return _marker(time, space, number, SPHERE, at, (size, size, size), colour)


def words(
    time: float, space: str, number: int, at: Sequence[float], size: float, colour: Colour,
    text: str,
) -> dict[str, Any]:  # fmt: skip
    """Words of a height [m] at a place [m].

    >>> words(0.0, "events", 1, (1.0, 2.0), 0.3, (1.0, 1.0, 1.0, 1.0), "hello")["text"]
    'hello'
    """
    mark = _marker(time, space, number, TEXT, at, (0.0, 0.0, size), colour)
    return {**mark, "text": text}


def line(
    time: float, space: str, number: int, points: Iterable[Sequence[float]], width: float,
    colour: Colour,
) -> dict[str, Any]:  # fmt: skip
    """A line of a width through points [m].

    >>> mark = line(0.0, "sides", 1, [(0.0, 0.0), (1.0, 0.0)], 0.05, (1.0, 1.0, 1.0, 0.5))
    >>> len(mark["points"])
    2
    """
    mark = _marker(time, space, number, LINE_STRIP, (0.0, 0.0), (width, 0.0, 0.0), colour)
    return {**mark, "points": [point(at) for at in points]}
