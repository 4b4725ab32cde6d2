"""What the commands do with a mission in space, and what they write of it.

Tested through ``commands/test_space_steps``.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from viaspline.commands.command_steps import (
    PLAN_NAMES,
    RUN_NAMES,
    default_folder,
    film_file,
    progress_bar,
    result_folder,
    say_written,
)

if TYPE_CHECKING:
    from viaspline.mission.model import Mission


def plan_spatial_mission(asked: Mission, file: Path, out: Path | None, *, quiet: bool) -> None:
    """Plan a mission in space, write its files and say what it is.

    Args:
        asked: What was read.
        file: From where.
        out: The folder for the results; None: the usual one.
        quiet: Say nothing when all goes well.
    """
    with (
        result_folder(out or default_folder(file), PLAN_NAMES) as folder,
        progress_bar(quiet) as watch,
    ):
        with watch.stage("plan", "planning"):
            from viaspline.space.plan_spatial import plan_spatial

            planned = plan_spatial(asked)
        with watch.stage("report", "drawing and writing"):
            from viaspline.report.files import results
            from viaspline.report.space.spatial_results import spatial_plan_contents

            contents = spatial_plan_contents(planned, file.stem)
            contents |= results.mission_contents(planned.mission, folder.path)
        files = results.write_all(folder, contents, watch.times)
    if not quiet:
        from viaspline.report.space.spatial_tables import spatial_plan_tables
        from viaspline.report.terminal.terminal_tables import show

        show(spatial_plan_tables(planned, file.stem))
        say_written(files)


def run_spatial_mission(
    asked: Mission, file: Path, out: Path | None, *, seed: int, animate: Path | None, quiet: bool
) -> None:
    """Plan a mission in space, fly it, write the files of both and say what came of it.

    Args:
        asked: What was read.
        file: From where.
        out: The folder for the results; None: the usual one.
        seed: Of the noise of its sensor.
        animate: The file of a film; None: there is none.
        quiet: Say nothing when all goes well.
    """
    with (
        result_folder(out or default_folder(file), RUN_NAMES) as folder,
        film_file(animate) as film,
        progress_bar(quiet) as watch,
    ):
        with watch.stage("plan", "planning"):
            from viaspline.space.plan_spatial import plan_spatial

            planned = plan_spatial(asked)
        with watch.stage("simulate", "flying"):
            from viaspline.space.online.fly import fly

            flown = fly(planned, seed=seed)
        with watch.stage("report", "drawing and writing"):
            from viaspline.report.files import results
            from viaspline.report.space.spatial_results import (
                spatial_plan_contents,
                spatial_run_contents,
            )

            contents = spatial_plan_contents(planned, file.stem)
            contents |= results.mission_contents(planned.mission, folder.path)
            contents |= spatial_run_contents(flown, file.stem)
            if film is not None:
                from viaspline.report.space.spatial_film import film_flight

                with watch.stage("animate", f"filming {film.path.name}"):
                    film_flight(flown, file.stem, film, watch.fraction)
        files = results.write_all(folder, contents, watch.times)
    if not quiet:
        from viaspline.report.space.spatial_tables import spatial_plan_tables, spatial_run_tables
        from viaspline.report.terminal.terminal_tables import show

        show(spatial_plan_tables(planned, file.stem), spatial_run_tables(flown, file.stem))
        say_written([*files, *([] if film is None else [film.path])])
    if not flown.reached:
        import click

        from viaspline.exit_codes import NOT_REACHED
        from viaspline.report.terminal.terminal_lines import say_error

        say_error(f"the robot did not reach its goal: {flown.reason}")
        click.get_current_context().exit(NOT_REACHED)
