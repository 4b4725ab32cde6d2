"""What of a mission goes onto a vehicle: the one place that decides it.

Tested through ``commands/test_upload_command``.
"""

from __future__ import annotations

from pathlib import Path

from viaspline.bounded_file import MISSION_FILE, read_text
from viaspline.formats.format_registry import format_of
from viaspline.formats.items import Itinerary, LatLon
from viaspline.formats.outgoing import itinerary_of
from viaspline.formats.waypoint_format import WaypointFormat
from viaspline.mission.model import Mission

RALLY: str = "rally point"
"""Rally points are sent, though a mission has none."""


def own_points(file: Path, mission: Mission, origin: LatLon) -> Itinerary:
    """A mission's own points with its fences: what a vehicle drives between them isn't proven.

    Args:
        file: Where it was read from: items of way-point files are taken as they stand there.
        mission: It.
        origin: Latitude and longitude of its 0, 0 [deg].

    Raises:
        OutputError: The mission reaches too far for one flat frame.
        MissionError: The file has faults.
    """
    text = read_text(file, MISSION_FILE)
    kind = format_of(file, text)
    if isinstance(kind, WaypointFormat):
        return kind.parse(text, str(file))
    return itinerary_of(mission, origin)


def left_out(itinerary: Itinerary) -> tuple[str, ...]:
    """What isn't sent of an itinerary, a kind a line."""
    notes = (note for note in itinerary.notes if note[0] != RALLY)
    return tuple(f"{kind}: {where}" if where else kind for kind, where in notes)
