"""``viaspline plan``: the path, its proof and what it was chosen from.

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
@QUIET
def plan(
    mission: Path, out: Path | None, improve: float, workers: int | None, scheduler: str | None,
    quiet: bool,
) -> None:  # fmt: skip
    r"""Plan a mission: its path, its proof, and the ways not taken.

    Writes plan.json, path.csv, plan.png, planned-mission.yaml and timing.json; vs.load_plan reads
    that folder again. For a fleet it writes fleet.json, fleet.png, courses.npz, planned-fleet.yaml
    and timing.json, and a folder for each robot with its plan.json and path.csv;
    vs.load_fleet_plan reads those again.

    \b
    Example:
      viaspline plan examples/fig7-obstacles.yaml --out detour
    """
    check_workers(workers, scheduler)
    asked = load_placed(mission)
    from viaspline.mission.model import Mission

    if isinstance(asked, Mission):
        check_of_fleets(improve, workers, scheduler)
        if asked.is_spatial:
            from viaspline.commands.space_steps import plan_spatial_mission

            plan_spatial_mission(asked, mission, out, quiet=quiet)
            return
        from viaspline.commands.mission_steps import plan_mission

        plan_mission(asked, mission, out, quiet=quiet)
    else:
        from viaspline.commands.fleet_steps import LaidBy, plan_fleet_file

        laid_by = LaidBy(workers, scheduler)
        plan_fleet_file(asked, mission, out, improve=improve, laid_by=laid_by, quiet=quiet)
