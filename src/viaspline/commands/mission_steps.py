"""What the commands do with the mission of one robot, and what they write of it.

Tested through ``test_cli``.
"""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

import click

from viaspline.commands.command_steps import (
    PLAN_NAMES,
    RUN_NAMES,
    bag_file,
    default_folder,
    film_file,
    progress_bar,
    result_folder,
    say_remarks,
    say_written,
    watched_plan,
)
from viaspline.exit_codes import NOT_REACHED
from viaspline.report.terminal.terminal_lines import say_error

if TYPE_CHECKING:
    from viaspline.mission.model import Mission
    from viaspline.robot.run import Run


def check_mission(mission: Mission) -> list[tuple[str, str]]:
    """What a sound mission is, and what may not be meant in it."""
    from viaspline.report.remarks import remarks
    from viaspline.report.summary import summary

    return [*summary(mission), *(("note", words) for words in remarks(mission))]


def plan_mission(asked: Mission, file: Path, out: Path | None, *, quiet: bool) -> None:
    """Plan a mission, write its files and say what it is.

    Args:
        asked: What was read.
        file: From where.
        out: The folder for the results; None: the usual one.
        quiet: Say nothing when all goes well.
    """
    with (
        result_folder(out or default_folder(file), PLAN_NAMES) as folder,
        progress_bar(quiet, asked) as watch,
    ):
        planned = watched_plan(asked, watch)
        with watch.stage("report", "drawing and writing"):
            from viaspline.report.files import results

            contents = results.plan_contents(planned, file.stem)
            contents |= results.mission_contents(planned.mission, folder.path)
        files = results.write_all(folder, contents, watch.times)
    if not quiet:
        from viaspline.report.terminal.plan_tables import plan_tables
        from viaspline.report.terminal.terminal_tables import show

        show(plan_tables(planned, file.stem))
        say_remarks(asked, planned)
        say_written(files)


def run_mission(
    asked: Mission, file: Path, out: Path | None, *,
    seed: int, animate: Path | None, bag: Path | None, real_time: bool, quiet: bool,
) -> None:  # fmt: skip
    """Plan a mission, drive it, write the files of both and say what came of it.

    Args:
        asked: What was read.
        file: From where.
        out: The folder for the results; None: the usual one.
        seed: Of what is random.
        animate: The file of a film; None: there is none.
        bag: The file of a log; None: there is none.
        real_time: Whether re-plans take what they take here, by the clock.
        quiet: Say nothing when all goes well.
    """
    with (
        result_folder(out or default_folder(file), RUN_NAMES) as folder,
        film_file(animate) as film,
        bag_file(bag) as log,
        progress_bar(quiet, asked) as watch,
    ):
        plan = watched_plan(asked, watch)
        with watch.stage("simulate", "driving"):
            from viaspline.robot.simulation.driven_step import unwatched
            from viaspline.robot.simulation.pace import by_clock, by_work
            from viaspline.robot.simulator import simulate

            pace = by_clock if real_time else by_work
            recording = (
                nullcontext(unwatched) if log is None else log.recording(asked, plan, seed=seed)
            )
            with recording as step:
                done = simulate(
                    plan.mission, seed=seed, progress=watch.driven, plan=plan, pace=pace,
                    watch=step,
                )  # fmt: skip
        with watch.stage("report", "drawing and writing"):
            from viaspline.report.files import results

            contents = results.plan_contents(plan, file.stem)
            contents |= results.mission_contents(plan.mission, folder.path)
            contents |= results.run_contents(done, file.stem, seed=seed)
            if film is not None:
                from viaspline.report.animation import film_run

                with watch.stage("animate", f"filming {film.path.name}"):
                    film_run(done, file.stem, film, watch.fraction)
        files = results.write_all(folder, contents, watch.times, done)
    if not quiet:
        from viaspline.report.terminal.plan_tables import plan_tables
        from viaspline.report.terminal.run_tables import run_tables
        from viaspline.report.terminal.terminal_tables import show

        show(plan_tables(plan, file.stem), run_tables(done, file.stem))
        say_remarks(asked, plan)
        say_written([*files, *(one.path for one in (film, log) if one is not None)])
    _end_not_reached(done)


def _end_not_reached(done: Run) -> None:
    """Say why a robot did not reach its goal, if it didn't, and end with the code for it."""
    if done.reached:
        return
    from viaspline.report.units import place, seconds

    where = place(tuple(done.positions[-1].tolist()))
    say_error(
        f"the robot did not reach its goal: {done.reason}",
        f"  it stands at {where} since {seconds(done.duration)}",
    )
    click.get_current_context().exit(NOT_REACHED)
