"""What a vehicle has on board as a plan of QGroundControl's: every item as it is.

Tested through ``commands/test_upload_command``.
"""

from __future__ import annotations

from collections.abc import Sequence

from viaspline.formats.items import Itinerary
from viaspline.formats.plan_parts import plan_document
from viaspline.links.mavlink.common_messages import MissionItemInt
from viaspline.links.mavlink.mav_words import RALLY
from viaspline.links.mavlink.mission_items import Lists, itinerary_on_board
from viaspline.links.mavlink.vehicle import Vehicle


def board_plan(lists: Lists, vehicle: Vehicle) -> str:
    """The text of a plan.

    Args:
        lists: What is on board.
        vehicle: Whose board it is.
    """
    itinerary = itinerary_on_board(lists, vehicle, f"{vehicle}")
    flown_by = {
        "firmwareType": vehicle.autopilot,
        "vehicleType": vehicle.kind,
        "plannedHomePosition": _home(itinerary),
        **_speeds(itinerary.speed),
    }
    return plan_document(itinerary, flown_by, _rally(lists.get(RALLY, ())), {})


def _home(itinerary: Itinerary) -> list[float]:
    """Its home; where it keeps none, the first place that it goes to."""
    if itinerary.home is not None:
        return [itinerary.home.latitude, itinerary.home.longitude, itinerary.home.altitude]
    places = ([one.latitude, one.longitude, 0.0] for one in itinerary.items if one.has_position)
    return next(places, [0.0, 0.0, 0.0])


def _speeds(speed: float | None) -> dict[str, float]:
    return {} if speed is None else {"cruiseSpeed": speed, "hoverSpeed": speed}


def _rally(items: Sequence[MissionItemInt]) -> list[list[float]]:
    return [[item.x / 1e7, item.y / 1e7, item.z] for item in items]
