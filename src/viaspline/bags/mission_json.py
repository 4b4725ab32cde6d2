"""A mission, or an obstacle, as JSON that needs no other file: maps of squares are in it."""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from viaspline.errors import GeometryError, MessageError
from viaspline.maps.grid import Grid
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle

_SQUARES: Final = "squares_of"
_MOST_CELLS: Final = 2**30


def mission_text(mission: Mission) -> str:
    """A mission in the plane as JSON; reading it gives an equal mission.

    Raises:
        GeometryError: The mission is one in space.

    >>> mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [9.5, 0]}})
    >>> mission_text(mission)
    '{"route": {"start": {"at": [0.0, 0.0]}, "goal": {"at": [9.5, 0.0]}}}'
    >>> mission_from(mission_text(mission)) == mission
    True
    """
    if mission.is_spatial:
        raise GeometryError("the mission is one in space; only one in the plane goes into a bag")
    return _text(mission.model_dump(exclude_defaults=True, by_alias=True))


def mission_from(text: str) -> Mission:
    """The mission that a text holds.

    Raises:
        MessageError: The text isn't JSON.
        MissionError: What it holds is no mission.
    """
    return Mission.model_validate(_data(text))


def obstacle_text(obstacle: Obstacle) -> str:
    """An obstacle as JSON.

    >>> obstacle_text(Obstacle(circle={"center": (1, 2), "radius": 3}, name="rock"))
    '{"circle": {"center": [1.0, 2.0], "radius": 3.0}, "name": "rock"}'
    """
    return _text(obstacle.model_dump(exclude_defaults=True, by_alias=True))


def obstacle_from(text: str) -> Obstacle:
    """The obstacle that a text holds.

    Raises:
        MessageError: The text isn't JSON.
        MissionError: What it holds is no obstacle.
    """
    return Obstacle.model_validate(_data(text))


def _text(data: Any) -> str:
    return json.dumps(_packed(data), ensure_ascii=False, allow_nan=False)


def _packed(value: Any) -> Any:
    """Values of JSON: squares as bits, everything else as it is."""
    if isinstance(value, Mapping):
        if isinstance(value.get("blocked"), np.ndarray):
            return _grid_data(value)
        return {str(key): _packed(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_packed(item) for item in value]
    return value


def _grid_data(parts: Mapping[str, Any]) -> dict[str, Any]:
    cells = parts["blocked"]
    bits = zlib.compress(np.packbits(cells).tobytes(), 9)
    return {
        _SQUARES: cells.shape,
        "resolution": parts["resolution"],
        "origin": parts["origin"],
        "source": parts["source"],
        "bits": base64.b64encode(bits).decode(),
    }


def _data(text: str) -> Any:
    try:
        return json.loads(text, object_hook=_unpacked)
    except (ValueError, RecursionError, zlib.error, KeyError, TypeError) as error:
        raise MessageError(f"that isn't the JSON of a mission: {error}") from None


def _unpacked(value: dict[str, Any]) -> Any:
    """A mapping of JSON, or the grid that it holds."""
    if _SQUARES not in value:
        return value
    height, width = (int(size) for size in value[_SQUARES])
    count = height * width
    if not 0 < count <= _MOST_CELLS:
        raise ValueError(f"a map of {height} x {width} squares")
    data = zlib.decompressobj().decompress(base64.b64decode(value["bits"]), (count + 7) // 8)
    cells = np.unpackbits(np.frombuffer(data, np.uint8), count=count).reshape(height, width)
    x, y, yaw = value["origin"]
    return Grid(cells.astype(bool), value["resolution"], (x, y, yaw), value["source"])
