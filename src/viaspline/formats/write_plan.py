"""Missions to QGroundControl's ``.plan`` files, version 1.

Format: https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html
"""

from __future__ import annotations

import json
import math
from typing import Any, Final

from viaspline.formats.items import FenceArea, Item, LatLon
from viaspline.formats.outgoing import Written, itinerary_of, lost_of
from viaspline.mission.model import Mission

ARDUPILOT: Final = 3
GROUND_ROVER: Final = 10


def plan_text(mission: Mission, origin: LatLon | None) -> Written:
    """A mission as a plan, for a rover.

    Start, via points and goal are way points with their dwells as hold times; obstacles are
    exclusion fences, fences and bounds inclusion fences; the greatest speed is both of the plan's
    speeds. The origin, and whether heights are meant, stand under a key of viaspline's own, which
    others pass over, so that reading the plan gives the same metres.

    Args:
        mission: The mission.
        origin: Latitude and longitude of its 0, 0 [deg]; `viaspline.formats.load.origin_of` tells
            that of a file.

    Raises:
        OutputError: There is no origin, or the mission reaches too far from it.

    >>> from viaspline.formats.qgc_plan import parse_qgc_plan
    >>> mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [90, 0]}})
    >>> text, lost = plan_text(mission, (47.0, 8.0))
    >>> parse_qgc_plan(text, "x.plan").origin, lost
    ((47.0, 8.0), ())
    """
    itinerary = itinerary_of(mission, origin)
    home = itinerary.home
    assert home is not None
    plan = {
        "fileType": "Plan",
        "version": 1,
        "groundStation": "viaspline",
        "mission": {
            "version": 2,
            "firmwareType": ARDUPILOT,
            "vehicleType": GROUND_ROVER,
            "globalPlanAltitudeMode": 1,
            "cruiseSpeed": itinerary.speed,
            "hoverSpeed": itinerary.speed,
            "plannedHomePosition": [home.latitude, home.longitude, home.altitude],
            "items": [_item(item) for item in itinerary.items],
        },
        "geoFence": {
            "version": 2,
            "polygons": [_polygon(area) for area in itinerary.fences if area.center is None],
            "circles": [_circle(area) for area in itinerary.fences if area.center is not None],
        },
        "rallyPoints": {"version": 2, "points": []},
        "viaspline": {"origin": itinerary.origin, "heights": not itinerary.is_flat},
    }
    text = json.dumps(plan, indent=4, sort_keys=True, allow_nan=False)
    return Written(text + "\n", lost_of(itinerary))


def _item(item: Item) -> dict[str, Any]:
    params = [None if math.isnan(param) else param for param in item.params]
    return {
        "type": "SimpleItem",
        "AMSLAltAboveTerrain": None,
        "Altitude": item.altitude,
        "AltitudeMode": 1,
        "autoContinue": True,
        "command": item.command,
        "doJumpId": item.number,
        "frame": item.frame,
        "params": [*params, item.latitude, item.longitude, item.altitude],
    }


def _polygon(area: FenceArea) -> dict[str, Any]:
    return {"inclusion": area.inclusion, "polygon": area.corners, "version": 1}


def _circle(area: FenceArea) -> dict[str, Any]:
    circle = {"center": area.center, "radius": area.radius}
    return {"circle": circle, "inclusion": area.inclusion, "version": 1}
