"""What formats of way points, fences and a home on earth have in common."""

from __future__ import annotations

from abc import abstractmethod
from typing import Protocol

from viaspline.formats.interpret import mission_of, origin_in
from viaspline.formats.items import Itinerary, LatLon
from viaspline.formats.mission_format import MissionFormat
from viaspline.mission.model import Mission


class WaypointFormat(MissionFormat[Mission], Protocol):
    """A format whose files hold an itinerary in latitudes and longitudes.

    It is read by ``interpret`` and written from what ``outgoing`` makes of a mission.
    """

    @abstractmethod
    def parse(self, text: str, source: str) -> Itinerary:
        """The items, home and fences of a text.

        Raises:
            MissionError: The text has faults: all of them.
        """

    def read(self, text: str, source: str) -> Mission:
        """The mission of a text; its start is at the home position, if that can be meant."""
        return mission_of(self.parse(text, source))

    def origin(self, text: str, source: str) -> LatLon | None:
        """Latitude and longitude of the mission's 0, 0 [deg]; None if nothing has a position."""
        return origin_in(self.parse(text, source))
