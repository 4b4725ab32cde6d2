"""``viaspline run``: plan a mission, drive it and report.

Tested through ``test_cli``.
"""

from __future__ import annotations

from pathlib import Path

import click

from viaspline.commands.command_steps import load_placed
from viaspline.commands.common_options import MISSION, OUT, QUIET
from viaspline.commands.fleet_options import (
    IMPROVE,
    SCHEDULER,
    WORKERS,
    check_of_fleets,
    check_workers,
)


@click.command()
@MISSION
@OUT
@IMPROVE
@WORKERS
@SCHEDULER
@click.option(
    "--seed",
    type=click.IntRange(min=0),
    metavar="N",
    default=0,
    show_default=True,
    help="Seed of what is random in the simulation.",
)
@click.option(
    "--animate",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Film the run: a .gif or .mp4.",
)
@click.option(
    "--bag",
    type=click.Path(path_type=Path),
    metavar="FILE.mcap",
    help="Log the drive for Foxglove, RViz and `viaspline replay`.",
)
@click.option(
    "--real-time",
    is_flag=True,
    help="Give re-plans the time that they take on this machine; no two runs are then alike.",
)
@QUIET
def run(
    mission: Path, out: Path | None, improve: float, workers: int | None, scheduler: str | None,
    seed: int, animate: Path | None, bag: Path | None, real_time: bool, quiet: bool,
) -> None:  # fmt: skip
    r"""Plan a mission, drive it in simulation and report.

    Writes plan.json, path.csv, plan.png, planned-mission.yaml, run.json, run.csv, run.png and
    timing.json. For a fleet it writes fleet.json, fleet.png, courses.npz, planned-fleet.yaml,
    run.json, run.png and timing.json, and a folder for each robot with its plan.json and path.csv.

    \b
    Example:
      viaspline run examples/fig8-patrol.yaml --out patrol --animate patrol/run.gif
    """
    check_workers(workers, scheduler)
    asked = load_placed(mission)
    from viaspline.mission.model import Mission

    if isinstance(asked, Mission):
        check_of_fleets(improve, workers, scheduler)
        if asked.is_spatial:
            check_not_asked({"--bag": bag, "--real-time": real_time}, "in space")
            from viaspline.commands.space_steps import run_spatial_mission

            run_spatial_mission(asked, mission, out, seed=seed, animate=animate, quiet=quiet)
            return
        from viaspline.commands.mission_steps import run_mission

        run_mission(
            asked, mission, out, seed=seed, animate=animate, bag=bag, real_time=real_time,
            quiet=quiet,
        )  # fmt: skip
        return
    check_not_asked({"--bag": bag, "--real-time": real_time}, "of a fleet")
    from viaspline.commands.fleet_steps import LaidBy, run_fleet_file

    run_fleet_file(
        asked, mission, out, improve=improve, laid_by=LaidBy(workers, scheduler), seed=seed,
        animate=animate, quiet=quiet,
    )  # fmt: skip


def check_not_asked(options: dict[str, object], which: str) -> None:
    """Refuse what is for the navigator of one robot in the plane, which is not driven here."""
    for name, value in options.items():
        if value:
            raise click.UsageError(
                f"{name} is for one robot in the plane; this mission is one {which}"
            )
