"""A planned path into a file of other people's, proven again as it stands there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from viaspline.exports.export_options import ExportOptions
from viaspline.exports.path_format import PathFormat, path_format_of
from viaspline.exports.path_table import ExportProof, PathTable
from viaspline.exports.tabled_path import rendered
from viaspline.formats.items import LatLon
from viaspline.handed_in import check_kind
from viaspline.planner import Plan
from viaspline.report.files.result_files import write
from viaspline.space.spatial_plan import SpatialPlan

if TYPE_CHECKING:
    from viaspline.fleet.fleet_plan import FleetPlan


@dataclass(frozen=True)
class Exported:
    """A path that was exported.

    Attributes:
        path: The file; None if there is none.
        points: How many points it has.
        proof: What is proven of them.
        lost: What of the plan the format can't carry, a thing a line.
        notes: What has to be known to drive it, a thing a line.
        words: What is proven, in a sentence.
    """

    path: Path | None
    points: int
    proof: ExportProof
    lost: tuple[str, ...]
    notes: tuple[str, ...]
    words: str


def export(
    plan: Plan | SpatialPlan,
    path: str | Path,
    *,
    origin: LatLon | None = None,
    chord_error: float | None = None,
    acceptance: float | None = None,
    spacing: float | None = None,
    name: str | None = None,
) -> Exported:
    """Write the path of a plan into a file of other people's, proven again as it stands there.

    The format goes by the ending: ``.plan`` (QGroundControl), ``.waypoints`` and ``.txt`` (``QGC
    WPL 110``), ``.path.yaml`` and ``.mcap`` (``nav_msgs/Path``), ``.geojson``, ``.kml``, ``.gpx``,
    ``.csv`` and ``.json``. The points are few: each straight line is as long as the chord error
    lets it be. Via points of the mission and stations are among them, exactly. Where a line would
    be too near to something, its ends are moved away from it, or it is cut into shorter ones.

    Args:
        plan: What was planned.
        path: The file; an old one is replaced.
        origin: Latitude and longitude of the mission's 0, 0 [deg], for formats that have them.
            None: as ``world.origin_deg`` of the mission says, which files with latitudes and
            longitudes bring along.
        chord_error: How far from the exact curve the lines may be, either way [m]. None: a tenth of
            the clearance, 1 to 25 cm.
        acceptance: For ``.plan`` and ``.waypoints``, how near to a point the vehicle turns to the
            next one [m]. None: as much as can be proven, of 2 m down to 2 cm, else 0.
        spacing: The longest line [m]. None: 0.1 m for ``nav_msgs/Path``, else as long as may be.
        name: What the path is called. None: as the file is.

    Returns:
        What was written, what is proven of it, and what of the plan isn't in there.

    Raises:
        OutputError: The file can't be written, the format needs an origin, or no lines were found
            that are clear.
        GeometryError: An argument can't be meant.

    Example:
        >>> import tempfile
        >>> from viaspline.mission.model import Mission
        >>> from viaspline.planner import plan
        >>> planned = plan(Mission.model_validate({
        ...     "world": {"known": [{"circle": {"center": [25, 0.5], "radius": 4}}]},
        ...     "route": {"start": [0, 0], "goal": [50, 0]},
        ... }))
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     done = export(planned, f"{folder}/round.plan", origin=(47.0, 8.0))
        >>> done.proof.clearance >= 0.5 - 2e-5, done.proof.chord_error <= 0.05
        (True, True)
    """
    check_kind("plan", plan, (Plan, SpatialPlan), "give what viaspline.plan(mission) returns")
    check_kind("path", path, str | Path, "give the file to write")
    if name is not None:
        check_kind("name", name, str, "give a text")
    options = ExportOptions(origin, chord_error, acceptance, spacing).checked()
    file = Path(path)
    kind = path_format_of(file)
    content, table = rendered(plan, kind, options, name or stem_of(file, kind), str(file))
    write(file, content)
    return exported(file, table)


def export_fleet(
    plan: FleetPlan, path: str | Path, options: ExportOptions | None = None
) -> dict[str, Exported]:
    """Write the path of every robot of a fleet that has one into a file of its own.

    Args:
        plan: What was planned.
        path: The file, to whose name each robot's is added, as far as every file system takes it:
            ``round.plan`` is ``round-a.plan``.
        options: How they are exported.

    Returns:
        What was written for each robot, by name.

    Raises:
        OutputError, GeometryError: As ``export``; nothing is written then.

    Example:
        >>> from tempfile import TemporaryDirectory
        >>> import viaspline as vs
        >>> plan = vs.plan_fleet(vs.Fleet.model_validate({"fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
        ... ]}))
        >>> with TemporaryDirectory() as folder:
        ...     done = vs.export_fleet(plan, f"{folder}/round.csv")
        ...     done["a"].path.name
        'round-a.csv'
    """
    from viaspline.fleet.fleet_plan import FleetPlan
    from viaspline.report.files.fleet_results import folder_names

    check_kind("plan", plan, FleetPlan, "give what viaspline.plan_fleet(fleet) returns")
    check_kind("path", path, str | Path, "give the file to write")
    asked = ExportOptions() if options is None else options
    check_kind("options", asked, ExportOptions, "give ExportOptions(chord_error=0.05)")
    checked = asked.checked()
    kind = path_format_of(path)
    stem, ending = stem_of(Path(path), kind), _ending(Path(path), kind)
    ready: list[tuple[str, Path, bytes, PathTable]] = []
    names = folder_names(one.name for one in plan.fleet.members)
    for robot, one in plan.plans.items():
        file = Path(path).with_name(f"{stem}-{names[robot]}{ending}")
        content, table = rendered(one, kind, checked, f"{stem} {robot}", str(file))
        ready.append((robot, file, content, table))
    found = {}
    for robot, file, content, table in ready:
        write(file, content)
        done = exported(file, table)
        lost = "who waits for whom: the robots are proven apart only at the planned times"
        found[robot] = replace(done, lost=(lost, *done.lost))
    return found


def exported(file: Path | None, table: PathTable) -> Exported:
    """What is told of a path that was written."""
    return Exported(
        file, len(table.points), table.proof, table.lost, table.notes, table.proof_words()
    )


def stem_of(file: Path, kind: PathFormat) -> str:
    """The name of a file without its ending, which may have two dots.

    >>> stem_of(Path("a/round.path.yaml"), path_format_of("x.path.yaml"))
    'round'
    """
    ending = _ending(file, kind)
    return file.name[: len(file.name) - len(ending)] or "path"


def _ending(file: Path, kind: PathFormat) -> str:
    ending = next(ending for ending in kind.endings if file.name.lower().endswith(ending))
    return file.name[len(file.name) - len(ending) :]
