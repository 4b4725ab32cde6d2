"""The kinds of files with missions that there are, in the order in which they are asked."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Final, TypeAlias, cast

from viaspline.formats.file_faults import refusal
from viaspline.formats.items import Place
from viaspline.formats.mission_format import MissionFormat

if TYPE_CHECKING:
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.model import Mission

AnyFormat: TypeAlias = "MissionFormat[Mission] | MissionFormat[Fleet]"

FORMATS: Final = (
    "fleet_yaml:FleetYaml",
    "mission_yaml:MissionYaml",
    "qgc_plan:QgcPlan",
    "qgc_wpl:QgcWpl",
)
"""The file of each here, and its class. Fleets are YAML as well, told by their keys."""


_ROUTE: Final = (
    "list the points of a route under route: in a YAML of viaspline (.yaml, .yml), or plan it in "
    "QGroundControl (.plan, QGC WPL 110)"
)
OTHERS: Final = (
    ('"proven_means"', "is a result of viaspline's, not a mission",
     "give the planned-*.yaml of its folder"),
    ('"FeatureCollection"', "is GeoJSON, not a mission",
     f"areas in metres are a map: world: {{known: [{{map: areas.geojson}}]}}; {_ROUTE}"),
    ("<kml", "is KML, not a mission", _ROUTE),
    ("<gpx", "is GPX, not a mission", _ROUTE),
)  # fmt: skip
"""Files that may be taken for missions: what is in them, what they are, and what to do."""


def formats() -> Iterator[AnyFormat]:
    """All formats. Each is imported when its turn comes: YAML doesn't wait for what others need.

    >>> [ending for each in formats() for ending in each.saved_endings]
    ['.yaml', '.yml', '.plan', '.waypoints', '.txt']
    """
    for entry in FORMATS:
        module, _, name = entry.partition(":")
        yield cast("AnyFormat", getattr(import_module(f"viaspline.formats.{module}"), name)())


def format_of(path: Path, text: str) -> AnyFormat:
    """The format of a file.

    Args:
        path: The file.
        text: What it holds.

    Raises:
        MissionError: It is empty, or of no kind that is understood.
    """
    is_tree = text.lstrip()[:1] in ("{", "<")
    for within, problem, remedy in OTHERS:
        if is_tree and within in text:
            raise refusal(str(path), Place(""), problem, remedy)
    found = next((each for each in formats() if each.sniff(path, text)), None)
    if found is not None:
        return found
    is_empty = not text or text.isspace()
    problem = "the file is empty" if is_empty else "is a kind of file that isn't understood"
    *most, last = (each.description for each in formats())
    remedy = f"understood are {', '.join(most)} and {last}"
    raise refusal(str(path), Place(""), problem, remedy)


def format_to_save(path: Path) -> MissionFormat[Mission] | None:
    """The format in which a mission is written to a file of such a name, None if there is none."""
    found = (each for each in formats() if path.suffix.lower() in each.saved_endings)
    return cast("MissionFormat[Mission] | None", next(found, None))
