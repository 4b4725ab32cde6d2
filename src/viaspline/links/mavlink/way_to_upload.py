"""What of a mission goes onto a vehicle: the one place that decides it.

Tested through ``commands/test_upload_command``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final, NamedTuple

from viaspline.bounded_file import MISSION_FILE, read_text
from viaspline.exports.export_options import ExportOptions
from viaspline.exports.path_items import path_itinerary
from viaspline.exports.plan_of_path import PlanOfPath
from viaspline.exports.tabled_path import rendered
from viaspline.formats.format_registry import format_of
from viaspline.formats.items import Itinerary, LatLon
from viaspline.formats.outgoing import itinerary_of
from viaspline.formats.waypoint_format import WaypointFormat
from viaspline.mission.model import Mission
from viaspline.planner import Plan
from viaspline.space.spatial_plan import SpatialPlan

_RALLY: Final = "rally point"
"""Rally points are sent, though a mission has none."""

_UNPROVEN: Final = (
    "the straight lines between its own points, which the vehicle drives, are unproven"
)


class WayToUpload(NamedTuple):
    """What is sent, and what has to be known of it.

    Attributes:
        itinerary: Home, items and fences.
        notes: What isn't sent, and what has to be known to drive it, a thing a line.
        proof: What is proven of it, in a sentence.
    """

    itinerary: Itinerary
    notes: tuple[str, ...]
    proof: str


def own_points(file: Path, mission: Mission, origin: LatLon) -> WayToUpload:
    """A mission's own points with its fences.

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
        itinerary = kind.parse(text, str(file))
    else:
        itinerary = itinerary_of(mission, origin)
    left_out = (note for note in itinerary.notes if note[0] != _RALLY)
    notes = tuple(f"not sent: {kind}: {where}".removesuffix(": ") for kind, where in left_out)
    return WayToUpload(itinerary, notes, _UNPROVEN)


def proven_way(plan: Plan | SpatialPlan, origin: LatLon, name: str) -> WayToUpload:
    """A plan's path as straight lines that are proven again, acceptance radius and all.

    Args:
        plan: What was planned.
        origin: Latitude and longitude of its 0, 0 [deg].
        name: What errors call the mission.

    Raises:
        OutputError: No lines were found that are clear.
    """
    _, table = rendered(plan, PlanOfPath(), ExportOptions(origin=origin), name, name)
    fences = itinerary_of(plan.mission, origin).fences
    notes = (*table.notes, *(f"not sent: {words}" for words in table.lost))
    return WayToUpload(path_itinerary(table, fences), notes, table.proof_words())
