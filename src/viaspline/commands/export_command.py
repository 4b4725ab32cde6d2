"""``viaspline export``: the proven path in other people's formats."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from viaspline.bounded_file import is_folder, is_there
from viaspline.commands.command_steps import (
    load_asked,
    placed_by_studio,
    progress_bar,
    result_folder,
)
from viaspline.commands.common_options import QUIET
from viaspline.report.proven_reference import with_meaning
from viaspline.report.terminal.terminal_lines import say

if TYPE_CHECKING:
    from viaspline.exports.export_options import ExportOptions
    from viaspline.exports.export_path import Exported
    from viaspline.fleet.fleet_plan import FleetPlan
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.model import Mission
    from viaspline.planner import Plan
    from viaspline.report.terminal.progress_bar import ProgressBar
    from viaspline.space.spatial_plan import SpatialPlan

METRES = click.FloatRange(min=0.0, max=1e4)


@click.command("export")
@click.argument("mission", metavar="IN", type=click.Path(path_type=Path))
@click.argument("out", metavar="OUT", type=click.Path(path_type=Path))
@click.option(
    "--origin", metavar="LAT,LON",
    help="Latitude and longitude of the mission's 0, 0.  [default: the mission's, or as set "
    "in the studio]",
)  # fmt: skip
@click.option(
    "--chord-error", type=METRES, metavar="M",
    help="How far the lines may be from the curve.  [default: a tenth of the clearance, 0.01 to "
    "0.25]",
)  # fmt: skip
@click.option(
    "--acceptance", type=METRES, metavar="M",
    help="How near to a way point the vehicle turns to the next.  [default: as can be proven]",
)  # fmt: skip
@click.option(
    "--spacing", type=METRES, metavar="M",
    help="Longest line.  [default: 0.1 for nav_msgs/Path, else no limit]",
)  # fmt: skip
@QUIET
def export_command(
    mission: Path, out: Path, origin: str | None, chord_error: float | None,
    acceptance: float | None, spacing: float | None, quiet: bool,
) -> None:  # fmt: skip
    r"""Write a mission's proven path in another program's format.

    IN is a mission in any format, or the folder of a saved plan, which is proven again instead of
    planned. The ending of OUT says the format: .plan (QGroundControl), .waypoints or .txt (QGC WPL
    110), .path.yaml or .mcap (nav_msgs/Path), .geojson, .kml, .gpx, .csv or .json. The path becomes
    few straight lines, which are proven again as the file has them. For a fleet each robot gets its
    own file: OUT with the robot's name in it.

    \b
    Examples:
      viaspline export examples/fence-survey.plan survey.kml
      viaspline export examples/fig8-patrol.yaml patrol.plan --origin 47.3977,8.5456
      viaspline export fig8-patrol/ patrol.path.yaml
    """
    from viaspline.exports.export_options import ExportOptions
    from viaspline.exports.path_format import path_format_of
    from viaspline.exports.tabled_path import check_origin

    kind = path_format_of(out)  # what can't be is refused before the long work
    options = ExportOptions(_place(origin), chord_error, acceptance, spacing).checked()
    asked, note = None, None
    if not _is_saved(mission):  # of a saved plan, its mission may say where it is
        read = load_asked(mission)
        asked = placed_by_studio(read, mission)
        check_origin(kind, options.placed(asked), str(out))
        if asked is not read and kind.is_geographic and origin is None:
            note = _studio_note(mission, asked)
    with result_folder(out.parent, (out.name,)), progress_bar(quiet, asked) as watch:
        planned = _loaded(mission, watch) if asked is None else _planned(asked, watch)
        with watch.stage("export", "cutting and proving"):
            done = _exported(planned, out, options)
    if not quiet:
        told = (f"{robot}: {one.words}" if robot else one.words for robot, one in done.items())
        say(*with_meaning(*told))
        first = next(iter(done.values()), None)
        if first is not None:
            say(*(f"not carried: {words}" for words in first.lost))
            notes = first.notes if note is None else (*first.notes, note)
            say(*(f"note: {words}" for words in notes))
            say(f"wrote {', '.join(str(one.path) for one in done.values())}")
    _end_unserved(planned)


def _planned(asked: Mission | Fleet, watch: ProgressBar) -> Plan | SpatialPlan | FleetPlan:
    from viaspline.mission.model import Mission

    if isinstance(asked, Mission):
        with watch.stage("plan", "planning"):
            from viaspline.plan_mission import plan

            return plan(asked)
    from viaspline.commands.fleet_steps import LaidBy, watched_fleet_plan

    return watched_fleet_plan(asked, watch, 0.0, LaidBy())


def _exported(
    planned: Plan | SpatialPlan | FleetPlan, out: Path, options: ExportOptions
) -> dict[str, Exported]:
    """What was written, by the robot's name; a single one has none."""
    from viaspline.exports.export_path import export, export_fleet
    from viaspline.fleet.fleet_plan import FleetPlan

    if isinstance(planned, FleetPlan):
        return export_fleet(planned, out, options)
    done = export(
        planned, out, origin=options.origin, chord_error=options.chord_error,
        acceptance=options.acceptance, spacing=options.spacing,
    )  # fmt: skip
    return {"": done}


def _end_unserved(planned: Plan | SpatialPlan | FleetPlan) -> None:
    """End with the code for it if robots of a fleet have no path, and so no file."""
    from viaspline.fleet.fleet_plan import FleetPlan

    if isinstance(planned, FleetPlan):
        from viaspline.commands.fleet_steps import end_unserved

        end_unserved(planned)


def _is_saved(given: Path) -> bool:
    """Whether it is a plan that was saved: its folder, or ``plan.json`` or ``fleet.json`` in it."""
    from viaspline.saved_plans.load_plan import FLEET_NAME, PLAN_NAME

    return is_folder(given) or given.name in (PLAN_NAME, FLEET_NAME)


def _loaded(given: Path, watch: ProgressBar) -> Plan | SpatialPlan | FleetPlan:
    """A plan that was saved, proven again with the mission or fleet that stands beside it."""
    from viaspline.saved_plans.load_plan import FLEET_NAME, PLAN_NAME

    with watch.stage("load", "proving the plan again"):
        of_fleet = given.name == FLEET_NAME or is_there(given / FLEET_NAME)
        if of_fleet and not is_there(given / PLAN_NAME):
            from viaspline.fleet.saved.load_fleet_plan import load_fleet_plan

            return load_fleet_plan(given)
        from viaspline.saved_plans.load_plan import load_plan

        return load_plan(given)


def _studio_note(mission: Path, asked: Mission | Fleet) -> str:
    """Where it lies, which the user hasn't said."""
    from viaspline.formats.studio_origin import studio_note

    assert asked.world.origin_deg is not None  # it was placed
    return studio_note(mission, asked.world.origin_deg)


def _place(said: str | None) -> tuple[float, float] | None:
    """Latitude and longitude as the option gives them."""
    if said is None:
        return None
    try:
        latitude, longitude = (float(part) for part in said.split(","))
    except ValueError:
        raise click.UsageError(f"--origin {said} isn't LAT,LON such as 47.3977,8.5456") from None
    return latitude, longitude
