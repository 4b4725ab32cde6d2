"""A plan of QGroundControl's as JSON: items, fences, rally points.

Tested through ``formats/test_qgc_plan`` and ``commands/test_upload_command``.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, Final

from viaspline.formats.items import ABSOLUTE, TERRAIN, FenceArea, Item, Itinerary

RELATIVE_ALTITUDE: Final = 1
ABSOLUTE_ALTITUDE: Final = 2
ABOVE_TERRAIN: Final = 3
TERRAIN_FRAME: Final = 4
"""Some of QGroundControl's AltitudeModes."""

ALTITUDE_MODES: Final = MappingProxyType(
    {
        0: "mixed",
        RELATIVE_ALTITUDE: "above home",
        ABSOLUTE_ALTITUDE: "above sea level",
        ABOVE_TERRAIN: "above terrain, reckoned by QGroundControl",
        TERRAIN_FRAME: "above terrain, kept by the vehicle",
        5: "none",
    }
)
"""All of them, in words."""


def plan_document(
    itinerary: Itinerary, vehicle: Mapping[str, Any], rally: Sequence[Sequence[float]],
    own: Mapping[str, Any],
) -> str:  # fmt: skip
    """The text of a plan.

    Args:
        itinerary: Its items and fences.
        vehicle: What the mission says of its vehicle: firmware, kind, speeds, planned home.
        rally: Latitude, longitude [deg] and altitude [m] of each rally point.
        own: What stands beside the parts of QGroundControl.
    """
    fences = itinerary.fences
    plan = {
        "fileType": "Plan",
        "version": 1,
        "groundStation": "viaspline",
        "mission": {
            "version": 2,
            "globalPlanAltitudeMode": RELATIVE_ALTITUDE,
            "items": [_item_json(item) for item in itinerary.items],
            **vehicle,
        },
        "geoFence": {
            "version": 2,
            "polygons": [_polygon_json(area) for area in fences if area.center is None],
            "circles": [_circle_json(area) for area in fences if area.center is not None],
        },
        "rallyPoints": {"version": 2, "points": rally},
        **own,
    }
    return json.dumps(plan, indent=4, sort_keys=True, allow_nan=False) + "\n"


def _item_json(item: Item) -> dict[str, Any]:
    """An item."""
    params = [None if math.isnan(param) else param for param in item.params]
    mode = TERRAIN_FRAME if item.frame in TERRAIN else RELATIVE_ALTITUDE
    return {
        "type": "SimpleItem",
        "AMSLAltAboveTerrain": None,
        "Altitude": item.altitude,
        "AltitudeMode": ABSOLUTE_ALTITUDE if item.frame in ABSOLUTE else mode,
        "autoContinue": True,
        "command": item.command,
        "doJumpId": item.number,
        "frame": item.frame,
        "params": [*params, item.latitude, item.longitude, item.altitude],
    }


def _polygon_json(area: FenceArea) -> dict[str, Any]:
    """A fence that is a polygon."""
    return {"inclusion": area.inclusion, "polygon": area.corners, "version": 1}


def _circle_json(area: FenceArea) -> dict[str, Any]:
    """A fence that is a circle."""
    circle = {"center": area.center, "radius": area.radius}
    return {"circle": circle, "inclusion": area.inclusion, "version": 1}
