"""What of a mission goes onto a vehicle: the one place that decides it.

Tested through ``commands/test_upload_command``.
"""

from __future__ import annotations

from viaspline.formats.items import Itinerary, LatLon
from viaspline.formats.outgoing import itinerary_of
from viaspline.mission.model import Mission


def via_points(mission: Mission, origin: LatLon) -> Itinerary:
    """The mission's own points, with its fences: what the vehicle drives between them isn't proven.

    Args:
        mission: It.
        origin: Latitude and longitude of its 0, 0 [deg].

    Raises:
        OutputError: The mission reaches too far for one flat frame.
    """
    return itinerary_of(mission, origin)
