"""What the commands do with a fleet: check, plan and drive it, and write what comes of it.

Tested through ``commands/test_fleet_steps``.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

import click

from viaspline.commands.command_steps import (
    default_folder,
    film_file,
    progress_bar,
    result_folder,
    say_written,
)
from viaspline.exit_codes import GAVE_UP, NO_PATH, NOT_REACHED
from viaspline.report.terminal.terminal_lines import say, say_error

if TYPE_CHECKING:
    from viaspline.fleet.execution.fleet_run import FleetRun
    from viaspline.fleet.fleet_plan import FleetPlan
    from viaspline.fleet.laying.laying_workers import LayingWorkers
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.report.files.results import Contents
    from viaspline.report.terminal.progress_bar import ProgressBar


@dataclass(frozen=True)
class LaidBy:
    """Who lays the paths of a fleet, as the command line has it.

    Attributes:
        processes: So many of this machine; None: as many as it is worth.
        scheduler: In their place the workers of a cluster, by the address of its scheduler.
    """

    processes: int | None = None
    scheduler: str | None = None

    def workers(self, robots: int) -> AbstractContextManager[LayingWorkers]:
        """Workers for so many robots, for as long as the block lasts."""
        from viaspline.fleet.laying.chosen_workers import (
            cluster_workers,
            local_workers,
            usual_count,
        )

        if self.scheduler is not None:
            return cluster_workers(self.scheduler)
        return local_workers(usual_count(robots) if self.processes is None else self.processes)


MAX_NAMED: Final = 6
"""How many robots are named, before the rest is left."""


def check_fleet(fleet: Fleet) -> list[tuple[str, str]]:
    """What a sound fleet is, and what may not be meant in it."""
    from viaspline.report.fleet_summary import fleet_remarks, fleet_summary

    return [*fleet_summary(fleet), *(("note", words) for words in fleet_remarks(fleet))]


def plan_fleet_file(
    fleet: Fleet, file: Path, out: Path | None, *,
    improve: float, laid_by: LaidBy, quiet: bool,
) -> None:  # fmt: skip
    """Plan a fleet, write its files and say what it is.

    Args:
        fleet: What was read.
        file: From where.
        out: The folder for the results; None: the usual one.
        improve: For so long sooner orders are sought [s].
        laid_by: Who lays the paths.
        quiet: Say nothing when all goes well.
    """
    from viaspline.report.earlier_robots import earlier_robots
    from viaspline.report.files.fleet_results import FLEET_FILES, check_robot_folders

    target = out or default_folder(file)
    with (
        result_folder(target, FLEET_FILES) as folder,
        progress_bar(quiet, fleet) as watch,
    ):
        check_robot_folders(target, (one.name for one in fleet.members))
        earlier = earlier_robots(target)
        planned = watched_fleet_plan(fleet, watch, improve, laid_by)
        with watch.stage("report", "writing"):
            from viaspline.report.files.fleet_results import (
                fleet_contents,
                forget_earlier,
                planned_fleet_contents,
                write_robots,
            )
            from viaspline.report.files.results import write_all

            folders = write_robots(planned, target, watch.fraction)
            contents = fleet_contents(planned, file.stem)
            contents = {**contents, **planned_fleet_contents(fleet, target)}
        files = write_all(folder, contents, watch.times)
        removed = forget_earlier(target, earlier, folders)
    if not quiet:
        from viaspline.report.fleet_summary import fleet_plan_remarks
        from viaspline.report.terminal.fleet_tables import fleet_tables
        from viaspline.report.terminal.terminal_tables import show

        show(fleet_tables(planned, file.stem))
        say(*(f"note: {words}" for words in fleet_plan_remarks(fleet)))
        say_written(files)
        say_folders(folders, removed)
    end_unserved(planned)


def run_fleet_file(
    fleet: Fleet, file: Path, out: Path | None, *,
    improve: float, laid_by: LaidBy, seed: int, animate: Path | None, quiet: bool,
) -> None:  # fmt: skip
    """Plan a fleet, drive it, write the files of both and say what came of it.

    Args:
        fleet: What was read.
        file: From where.
        out: The folder for the results; None: the usual one.
        improve: For so long sooner orders are sought [s].
        laid_by: Who lays the paths.
        seed: Of what is random.
        animate: The file of a film; None: there is none.
        quiet: Say nothing when all goes well.
    """
    from viaspline.report.earlier_robots import earlier_robots
    from viaspline.report.files.fleet_results import FLEET_RUN_FILES, check_robot_folders

    target = out or default_folder(file)
    with (
        result_folder(target, FLEET_RUN_FILES) as folder,
        film_file(animate) as film,
        progress_bar(quiet, fleet, drives=True) as watch,
    ):
        check_robot_folders(target, (one.name for one in fleet.members))
        earlier = earlier_robots(target)
        planned = watched_fleet_plan(fleet, watch, improve, laid_by)
        with watch.stage("simulate", "driving"):
            from viaspline.fleet.execution.simulate_fleet import simulate_fleet

            done = simulate_fleet(fleet, plan=planned, seed=seed)
        with watch.stage("report", "writing"):
            from viaspline.report.files.fleet_results import forget_earlier, write_robots
            from viaspline.report.files.results import write_all

            folders = write_robots(planned, target, watch.fraction)
            contents = _driven_contents(fleet, planned, done, target, file.stem, seed)
            if film is not None:
                from viaspline.report.fleet.fleet_film import FilmedFleet, film_fleet

                with watch.stage("animate", f"filming {film.path.name}"):
                    filmed = FilmedFleet.of_run(planned, done, file.stem)
                    film_fleet(filmed, film, watch.fraction)
        files = write_all(folder, contents, watch.times)
        removed = forget_earlier(target, earlier, folders)
    if not quiet:
        from viaspline.report.fleet_summary import fleet_plan_remarks
        from viaspline.report.terminal.fleet_tables import fleet_run_table, fleet_tables
        from viaspline.report.terminal.terminal_tables import show

        show(fleet_tables(planned, file.stem), fleet_run_table(done, file.stem))
        say(*(f"note: {words}" for words in fleet_plan_remarks(fleet)))
        say_written([*files, *([] if film is None else [film.path])])
        say_folders(folders, removed)
    end_unserved(planned)
    end_not_reached(done)


def _driven_contents(
    fleet: Fleet, planned: FleetPlan, done: FleetRun, target: Path, name: str, seed: int
) -> Contents:
    """What is written of a fleet that was planned and driven, but for its robots' folders."""
    from viaspline.report.files.fleet_results import (
        fleet_contents,
        fleet_run_contents,
        planned_fleet_contents,
    )

    return {
        **fleet_contents(planned, name),
        **planned_fleet_contents(fleet, target),
        **fleet_run_contents(planned, done, name, seed=seed),
    }


def end_not_reached(done: FleetRun) -> None:
    """Say which robots came too near, or did not reach their goals; end with the code for that."""
    from viaspline.report.terminal.fleet_tables import too_near_words

    near = too_near_words(done.certificate)
    if near is not None:
        say_error(near, prefix="warning: ")
    if done.reached:
        return
    late = [name for name in done.names if name not in done.arrivals]
    say_error(
        f"{len(late)} of {len(done.names)} robots did not reach their goals: {_some_of(late)}"
    )
    click.get_current_context().exit(NOT_REACHED)


def watched_fleet_plan(
    fleet: Fleet, watch: ProgressBar, improve: float, laid_by: LaidBy
) -> FleetPlan:
    """Plan a fleet, with progress."""
    with watch.stage("load", "loading"):
        from viaspline.fleet.plan_fleet import plan_fleet
    with laid_by.workers(len(fleet.members)) as workers, _stages(watch) as stages:
        return plan_fleet(fleet, improve=improve, progress=stages.told, workers=workers)


class _Stages:
    """Stages that a planner tells as it comes to them.

    Args:
        watch: Hears of each.
        open_stage: What is open, and is closed when the next one begins.
    """

    def __init__(self, watch: ProgressBar, open_stage: ExitStack) -> None:
        self._watch = watch
        self._open = open_stage
        self._words = ""
        self._begin("plan", "planning")

    def told(self, words: str, share: float) -> None:
        """Hear what is being done, and the share of it that is done."""
        if words != self._words:
            self._begin(words.replace(" ", "_"), words)
        self._watch.fraction(share)

    def _begin(self, name: str, words: str) -> None:
        self._open.close()
        self._open.enter_context(self._watch.stage(name, words))
        self._words = words


@contextmanager
def _stages(watch: ProgressBar) -> Iterator[_Stages]:
    with ExitStack() as open_stage:
        yield _Stages(watch, open_stage)


def say_folders(folders: list[Path], removed: list[str]) -> None:
    """Say which robots have a folder of their own, and which have none any more."""
    from viaspline.report.summary import counted

    if folders:
        names = [folder.name for folder in folders]
        say(f"wrote plan.json, path.csv for each of {len(names)} robots: {_some_of(names)}")
    if removed:
        whose = f"{counted(len(removed), 'robot')}: {_some_of(removed)}"
        say(f"removed what an earlier run left of {whose}")


def _some_of(names: list[str]) -> str:
    return ", ".join(names[:MAX_NAMED]) + (" …" if len(names) > MAX_NAMED else "")


def end_unserved(planned: FleetPlan) -> None:
    """Say which robots are not served, and end with the code for it; nothing if all are."""
    if planned.served:
        return
    from viaspline.report.terminal.fleet_tables import unserved_lines

    say_error(*unserved_lines(planned))
    refused = any(one.outcome == "refused" for one in planned.not_served)
    click.get_current_context().exit(NO_PATH if refused else GAVE_UP)
