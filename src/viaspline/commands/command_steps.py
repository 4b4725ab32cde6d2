"""What the commands have in common: read, plan with progress, write into a folder, say so.

Tested through ``test_cli``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Final

from viaspline.report.terminal.interrupts import undone_at_the_end
from viaspline.report.terminal.terminal_lines import say, say_error

if TYPE_CHECKING:
    from viaspline.bags.bag_file import BagFile
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.model import Mission
    from viaspline.planner import Plan
    from viaspline.report.files.result_files import ResultFolder
    from viaspline.report.terminal.progress_bar import ProgressBar
    from viaspline.report.video_file import VideoFile

PLAN_NAMES: Final = (
    "plan.json", "path.csv", "plan.png", "planned-mission.yaml", "timing.json"
)  # fmt: skip
RUN_NAMES: Final = (*PLAN_NAMES, "run.json", "run.csv", "run.png")
"""The files that are written of the mission of one robot, planned and driven."""


def default_folder(mission: Path) -> Path:
    """Where the results of a mission go if nobody says."""
    return Path("viaspline-out") / (mission.stem or "mission")


def load_asked(path: Path) -> Mission | Fleet:
    """Read a mission or a fleet; what takes longer than a second is said."""
    from threading import Timer

    from viaspline.formats.load import load

    patience = Timer(1.0, say_error, [f"reading {path} …"], {"prefix": ""})
    patience.daemon = True
    patience.start()
    try:
        return load(path)
    finally:
        patience.cancel()


def load_placed(path: Path) -> Mission | Fleet:
    """Read a mission or a fleet, which lies where it says, or else as was set in the studio."""
    return placed_by_studio(load_asked(path), path)


def placed_by_studio(asked: Mission | Fleet, path: Path) -> Mission | Fleet:
    """What was read from a file, lying as was set in the studio where it doesn't say so itself."""
    from viaspline.errors import MissionError
    from viaspline.formats.studio_origin import studio_origin

    if asked.world.origin_deg is not None:
        return asked
    try:
        origin = studio_origin(path)
    except MissionError as error:
        say_error(f"{error}: it is passed over", prefix="note: ")
        return asked
    return asked if origin is None else asked.lying_at(origin)


@contextmanager
def result_folder(path: Path, names: Iterable[str]) -> Iterator[ResultFolder]:
    """The folder of the results, tried before the work and not left empty by a failure."""
    from viaspline.report.files.result_files import ResultFolder

    folder = ResultFolder(path, names)
    old = folder.holds_earlier_results()
    try:
        with undone_at_the_end(folder.forget_if_empty):
            yield folder
    except BaseException:
        folder.forget_if_empty()
        if old:
            say_error(f"what {path} holds is from an earlier run", prefix="note: ")
        raise


@contextmanager
def film_file(path: Path | None) -> Iterator[VideoFile | None]:
    """The file of the animation, tried before the work."""
    from viaspline.report.video_file import VideoFile

    film = None if path is None else VideoFile(path)
    try:
        yield film
    except BaseException:
        if film is not None:
            film.folder.forget_if_empty()
        raise


@contextmanager
def bag_file(path: Path | None) -> Iterator[BagFile | None]:
    """The file of the log, tried before the work."""
    if path is None:
        yield None
        return
    from viaspline.bags.bag_file import BagFile

    log = BagFile(path)
    try:
        yield log
    except BaseException:
        log.folder.forget_if_empty()
        raise


@contextmanager
def progress_bar(
    quiet: bool, asked: Mission | Fleet | None = None, *, drives: bool = False
) -> Iterator[ProgressBar]:
    """Progress, which hears of every kernel that is compiled within the block.

    Args:
        quiet: Say nothing.
        asked: What is planned, if anything.
        drives: Whether it is driven as well.
    """
    from viaspline.report.terminal.progress_bar import ProgressBar

    watch = ProgressBar(quiet=quiet)
    with watch.stage("start", "starting"):
        from viaspline.kernels.compile_events import compile_progress
        from viaspline.precompile import Job, jobs_of, second_compiler
        from viaspline.warming.first_run import first_run
    jobs: tuple[Job, ...] = ("curves",) if asked is None else jobs_of(asked, drives=drives)
    with (
        first_run(jobs) as notice,
        compile_progress(partial(watch.compiling, notice)),
        second_compiler(jobs),
    ):
        yield watch


def watched_plan(mission: Mission, watch: ProgressBar) -> Plan:
    """Plan a mission, with progress."""
    with watch.stage("plan", "planning"):
        from viaspline import planner

        return planner.plan(mission)


def say_remarks(asked: Mission, plan: Plan) -> None:
    """Say what a plan of a mission leaves out."""
    from viaspline.report.remarks import plan_remarks

    say(*(f"note: {words}" for words in plan_remarks(asked, plan)))


def say_written(files: list[Path]) -> None:
    """Say which files were written into which folders."""
    folders: dict[Path, list[str]] = {}
    for file in files:
        folders.setdefault(file.parent, []).append(file.name)
    say(*(f"wrote {', '.join(names)} into {folder}" for folder, names in folders.items()))
