"""What formats of way points, fences and a home on earth have in common."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from viaspline.formats.interpret import mission_of, origin_in
from viaspline.formats.items import Itinerary, LatLon
from viaspline.formats.mission_format import MissionFormat
from viaspline.mission.model import Mission

if TYPE_CHECKING:
    from viaspline.mission.space.ground_spec import GroundSpec


@runtime_checkable
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

    def read_over(self, text: str, source: str, ground: Mapping[str, Any] | GroundSpec) -> Mission:
        """The mission in space of a text, over a ground that the file can't say.

        Args:
            text: What the file holds.
            source: The file, as errors name it.
            ground: As ``world.ground`` of a mission; files are looked for from here.
        """
        return mission_of(replace(self.parse(text, source), ground=ground))

    def origin(self, text: str, source: str) -> LatLon | None:
        """Latitude and longitude of the mission's 0, 0 [deg]; None if nothing has a position."""
        return origin_in(self.parse(text, source))
