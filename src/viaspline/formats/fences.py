"""Fences, from a file's own list of them and from mission items that are fence corners.

Tested through ``formats/test_qgc_plan``.
"""

from __future__ import annotations

import math

from viaspline.errors import Fault, MissionError
from viaspline.formats.commands import (
    EXCLUSION_CIRCLE,
    EXCLUSION_CORNER,
    FENCE_COMMANDS,
    INCLUSION_CIRCLE,
    INCLUSION_CORNER,
)
from viaspline.formats.file_faults import fault_at
from viaspline.formats.items import FenceArea, Item, Itinerary


def fence_areas(
    itinerary: Itinerary,
) -> tuple[tuple[FenceArea, ...], tuple[tuple[str, str], ...]]:
    """All fences of an itinerary, and what about them can't be represented.

    Raises:
        MissionError: A fence has too few corners or no radius.
    """
    areas = (*itinerary.fences, *_from_items(itinerary))
    faults = [fault for area in areas for fault in _faults(itinerary.source, area)]
    if faults:
        raise MissionError(faults)
    circles = [area.place.key for area in areas if area.center is not None and area.inclusion]
    note = "inclusion circle, taken as the polygon of 64 corners inside of it: the circle itself"
    return areas, ((note, ", ".join(circles)),) if circles else ()


def _faults(source: str, area: FenceArea) -> list[Fault]:
    if area.center is None and len(area.corners) < 3:
        problem = f"the fence has {len(area.corners)} corners"
        return [fault_at(source, area.place, problem, "give at least three")]
    if area.center is not None and not (math.isfinite(area.radius) and area.radius > 0):
        problem = f"the fence's radius is {area.radius:g}"
        return [fault_at(source, area.place, problem, "give a number of metres greater than 0")]
    numbers = [x for corner in (*area.corners, area.center or (0.0, 0.0)) for x in corner]
    if not all(map(math.isfinite, numbers)):
        problem = "the fence has a coordinate that isn't a number"
        return [fault_at(source, area.place, problem, "give latitude and longitude in degrees")]
    return []


def _from_items(itinerary: Itinerary) -> list[FenceArea]:
    """Fences in the mission itself: a corner an item, each saying how many there are."""
    areas: list[FenceArea] = []
    corners: list[Item] = []
    for item in itinerary.items:
        if item.command not in FENCE_COMMANDS:
            continue
        if item.command in (INCLUSION_CIRCLE, EXCLUSION_CIRCLE):
            center = (item.latitude, item.longitude)
            inclusion = item.command == INCLUSION_CIRCLE
            areas.append(FenceArea(inclusion, (), center, item.params[0], item.place))
            continue
        if corners and corners[0].command != item.command:
            areas.append(_polygon(corners))
            corners = []
        corners.append(item)
        if len(corners) >= corners[0].params[0]:
            areas.append(_polygon(corners))
            corners = []
    if corners:
        areas.append(_polygon(corners))
    return areas


def _polygon(corners: list[Item]) -> FenceArea:
    assert corners[0].command in (INCLUSION_CORNER, EXCLUSION_CORNER)
    outline = tuple((corner.latitude, corner.longitude) for corner in corners)
    inclusion = corners[0].command == INCLUSION_CORNER
    return FenceArea(inclusion, outline, None, 0.0, corners[0].place)
