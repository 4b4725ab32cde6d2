"""Where on earth the data of a mission or a fleet says that its 0, 0 is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from pydantic import TypeAdapter, ValidationError

from viaspline.mission.fields import LatLonDeg

if TYPE_CHECKING:
    from viaspline.formats.items import LatLon

KEY: Final = "origin_deg"
"""The key of a world."""
_PLACE: Final[TypeAdapter[tuple[float, float]]] = TypeAdapter(LatLonDeg)


def said_origin(data: Any) -> LatLon | None:
    """What ``world.origin_deg`` says [deg]; None where it says nothing, or what can't be meant.

    Args:
        data: What a file holds, sound or not: its faults are told by who reads all of it.

    >>> said_origin({"world": {"origin_deg": [47.1, 8.5]}}), said_origin({"world": {}})
    ((47.1, 8.5), None)
    """
    world = data.get("world") if isinstance(data, Mapping) else None
    said = world.get(KEY) if isinstance(world, Mapping) else None
    if said is None:
        return None
    try:
        return _PLACE.validate_python(list(said) if isinstance(said, list) else said)
    except ValidationError:
        return None
