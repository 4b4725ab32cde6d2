"""``viaspline tension``: which tension to take, and what each does.

Tested through ``test_cli``.
"""

from __future__ import annotations

from pathlib import Path

import click

from viaspline.commands.command_steps import (
    default_folder,
    load_asked,
    progress_bar,
    result_folder,
    say_written,
)
from viaspline.commands.common_options import MISSION, OUT, QUIET


@click.command()
@MISSION
@OUT
@QUIET
def tension(mission: Path, out: Path | None, quiet: bool) -> None:
    r"""Advise a tension: plan with many, and say what each does.

    Whole plans are compared, first by time, then by peak curvature. What it suggests is no worse
    than -0.5, 0 or 0.5 for all spans, nor than none stated, nor than what the mission says; where
    tension makes no difference, it says so. Writes tension.png. A mission with spline: {tension:
    auto} takes what would be suggested.

    \b
    Example:
      viaspline tension examples/fig8-patrol.yaml --out advice
    """
    asked = load_asked(mission)
    from viaspline.mission.model import Mission

    if not isinstance(asked, Mission):
        raise click.UsageError("a tension is advised for the mission of one robot; this is a fleet")
    if asked.is_spatial:
        raise click.UsageError(
            "a tension is advised for a mission in the plane; in space spline: {tension: auto} "
            "takes the soonest of a few"
        )
    with (
        result_folder(out or default_folder(mission), ("tension.png",)) as folder,
        progress_bar(quiet, asked) as watch,
    ):
        with watch.stage("advise", "trying tensions"):
            from viaspline.advice import advise_tension
            from viaspline.whole_plan import in_order

            served, world = in_order(asked)
            advice = advise_tension(served, world=world)
        with watch.stage("report", "drawing and writing"):
            from viaspline.report.tension_picture import tension_picture

            file = folder.write("tension.png", tension_picture(advice, mission.stem))
    if not quiet:
        from viaspline.report.terminal.advice_tables import advice_tables
        from viaspline.report.terminal.terminal_tables import show

        show(advice_tables(advice, mission.stem))
        say_written([file])
