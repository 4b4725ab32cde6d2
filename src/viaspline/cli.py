"""The command line: arguments and exit codes, nothing else.

Exit codes: 0 done; 2 the mission or the arguments are wrong; 3 there is no such path, proven; 4 the
robot did not reach its goal; 5 gave up before it was known; 130 interrupted; 143 terminated; 1 a
defect of viaspline itself.
"""

from __future__ import annotations

from pathlib import Path

import click

from viaspline import __version__
from viaspline.command_steps import (
    default_folder,
    load_asked,
    progress_bar,
    result_folder,
    say_written,
)
from viaspline.commands.download_command import download
from viaspline.commands.drive_command import drive
from viaspline.commands.export_command import export_command
from viaspline.commands.identify_command import identify
from viaspline.commands.replay_command import replay
from viaspline.commands.upload_command import upload
from viaspline.commands.warm_command import warm
from viaspline.exit_codes import Commands
from viaspline.report.terminal_lines import say


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="viaspline")
def cli() -> None:
    r"""Lay a spline through your via points: round what stands in the way, proven clear, driven.

    \b
    Example:
      viaspline run examples/fig8-patrol.yaml --out patrol
    """


FIGURE_NAMES = tuple(
    f"{name}.png" for name in ("fig2", "fig3", "fig5", "fig6", "fig7", "fig8", "curvature")
)

MISSION = click.argument("mission", type=click.Path(path_type=Path))
OUT = click.option(
    "--out", type=click.Path(path_type=Path), metavar="DIR",
    help="Folder for the results.  [default: viaspline-out/<name of the mission>]",
)  # fmt: skip
IMPROVE = click.option(
    "--improve", type=click.FloatRange(min=0.0, max=1e6), default=0.0, metavar="SECONDS",
    help="For so long sooner orders of a fleet's robots are sought.  [default: 0]",
)  # fmt: skip
WORKERS = click.option(
    "--workers", type=click.IntRange(1, 61), metavar="N",
    help="So many processes lay a fleet's paths.  [default: one for each core where that pays]",
)  # fmt: skip
SCHEDULER = click.option(
    "--scheduler", metavar="ADDRESS",
    help="A cluster of dask.distributed lays them: the address of its scheduler.",
)  # fmt: skip
QUIET = click.option("--quiet", "-q", is_flag=True, help="Say nothing when all goes well.")


@cli.command()
@MISSION
@OUT
@IMPROVE
@WORKERS
@SCHEDULER
@click.option("--seed", type=int, default=0, show_default=True, help="Of what is random.")
@click.option(
    "--animate", type=click.Path(path_type=Path), metavar="FILE", help="A .gif or .mp4 of the run."
)
@click.option(
    "--bag",
    type=click.Path(path_type=Path),
    metavar="FILE.mcap",
    help="A log of the drive for Foxglove, RViz and `viaspline replay`.",
)
@click.option(
    "--real-time",
    is_flag=True,
    help="Let re-plans take what they take here, by the clock: no two runs are the same then.",
)
@QUIET
def run(
    mission: Path, out: Path | None, improve: float, workers: int | None, scheduler: str | None,
    seed: int, animate: Path | None, bag: Path | None, real_time: bool, quiet: bool,
) -> None:  # fmt: skip
    r"""Plan a mission, drive it and report: the main job.

    Writes plan.json, path.csv, plan.png, planned-mission.yaml, run.json, run.csv, run.png and
    timing.json; of a fleet fleet.json, fleet.png, run.json, run.png and timing.json, and for each
    robot a folder with its plan.json and path.csv.

    \b
    Example:
      viaspline run examples/fig8-patrol.yaml --out patrol --animate patrol/run.gif
    """
    if workers is not None and scheduler is not None:
        raise click.UsageError("give --workers or --scheduler, not both")
    asked = load_asked(mission)
    from viaspline.mission.model import Mission

    if isinstance(asked, Mission):
        check_of_fleets(improve, workers, scheduler)
        if asked.is_spatial:
            check_no_bag(bag, "in space")
            from viaspline.space_steps import run_spatial_mission

            run_spatial_mission(asked, mission, out, animate=animate, quiet=quiet)
            return
        from viaspline.mission_steps import run_mission

        run_mission(
            asked, mission, out, seed=seed, animate=animate, bag=bag, real_time=real_time,
            quiet=quiet,
        )  # fmt: skip
        return
    check_no_bag(bag, "of a fleet")
    if real_time:
        raise click.UsageError("--real-time is for the mission of one robot; this is a fleet")
    from viaspline.fleet_steps import LaidBy, run_fleet_file

    run_fleet_file(
        asked, mission, out, improve=improve, laid_by=LaidBy(workers, scheduler), seed=seed,
        animate=animate, quiet=quiet,
    )  # fmt: skip


@cli.command()
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
    r"""Plan a mission: the path, its proof and what it was chosen from.

    Writes plan.json, path.csv, plan.png, planned-mission.yaml (with which load_plan in Python reads
    the plan again) and timing.json; of a fleet fleet.json, fleet.png and timing.json, and for each
    robot a folder with its plan.json and path.csv.

    \b
    Example:
      viaspline plan examples/fig7-obstacles.yaml --out detour
    """
    if workers is not None and scheduler is not None:
        raise click.UsageError("give --workers or --scheduler, not both")
    asked = load_asked(mission)
    from viaspline.mission.model import Mission

    if isinstance(asked, Mission):
        check_of_fleets(improve, workers, scheduler)
        if asked.is_spatial:
            from viaspline.space_steps import plan_spatial_mission

            plan_spatial_mission(asked, mission, out, quiet=quiet)
            return
        from viaspline.mission_steps import plan_mission

        plan_mission(asked, mission, out, quiet=quiet)
    else:
        from viaspline.fleet_steps import LaidBy, plan_fleet_file

        laid_by = LaidBy(workers, scheduler)
        plan_fleet_file(asked, mission, out, improve=improve, laid_by=laid_by, quiet=quiet)


def check_no_bag(bag: Path | None, which: str) -> None:
    """Refuse the option where there is no navigator to log."""
    if bag is not None:
        raise click.UsageError(f"--bag is for one robot in the plane; this mission is one {which}")


def check_of_fleets(improve: float, workers: int | None, scheduler: str | None) -> None:
    """Refuse options that mean nothing to a single robot."""
    for name, is_given in (
        ("--improve", improve > 0.0),
        ("--workers", workers is not None),
        ("--scheduler", scheduler is not None),
    ):
        if is_given:
            raise click.UsageError(f"{name} is for fleets; this is the mission of one robot")


@cli.command()
@MISSION
@OUT
@QUIET
def tension(mission: Path, out: Path | None, quiet: bool) -> None:
    r"""Advise a tension: plan with many of them, and say what each does and which to take.

    Compared are whole plans, in time first, then in peak curvature. What is suggested is no worse
    than -0.5, 0 or 0.5 for all spans, nor than what stands in the mission; where tension makes no
    difference, that is what it says. Writes tension.png. In a mission, spline: {tension: auto}
    takes what is suggested.

    \b
    Example:
      viaspline tension examples/fig8-patrol.yaml --out advice
    """
    asked = load_asked(mission)
    from viaspline.mission.model import Mission

    if not isinstance(asked, Mission):
        raise click.UsageError("a tension is advised for the mission of one robot; this is a fleet")
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
        from viaspline.report.advice_tables import advice_tables
        from viaspline.report.terminal_tables import show

        show(advice_tables(advice, mission.stem))
        say_written([file])


@cli.command()
@click.argument("mission", type=click.Path(path_type=Path), required=False)
@click.option(
    "--schema", is_flag=True, help="Print the JSON Schema of missions and fleets, for editors."
)
def check(mission: Path | None, schema: bool) -> None:
    r"""Say whether a mission is sound: every fault at once, as file:line:column: key: what.

    \b
    Examples:
      viaspline check examples/fig8-patrol.yaml
      viaspline check --schema > mission.schema.json
    """
    if schema:
        import json

        from viaspline.mission.fleet.file_schema import file_schema

        say(json.dumps(file_schema(), indent=2))
        return
    if mission is None:
        raise click.UsageError("give a mission, or --schema")
    loaded = load_asked(mission)
    from viaspline.mission.model import Mission

    if isinstance(loaded, Mission):
        from viaspline.mission_steps import check_mission

        lines = check_mission(loaded)
    else:
        from viaspline.fleet_steps import check_fleet

        lines = check_fleet(loaded)
    say(f"{mission} is sound", *(f"  {name:<7} {words}" for name, words in lines))


@cli.command()
@click.option(
    "--out", type=click.Path(path_type=Path), metavar="DIR", default=Path("viaspline-out/figures"),
    show_default=True, help="Folder for the figures.",
)  # fmt: skip
@QUIET
def figures(out: Path, quiet: bool) -> None:
    r"""Make the figures of the paper again, and one that it lacks.

    \b
    Example:
      viaspline figures --out figures
    """
    with result_folder(out, FIGURE_NAMES) as folder, progress_bar(quiet) as watch:
        contents = {}
        with watch.stage("load", "loading"):
            from viaspline.report.figures import FIGURES
        for name, (_, draw) in FIGURES.items():
            with watch.stage(name, f"drawing {name}"):
                contents[name] = draw()
        files = [folder.write(name, content) for name, content in contents.items()]
    if not quiet:
        say(*(f"{name:<14} {caption}" for name, (caption, _) in FIGURES.items()))
        say_written(files)


@cli.command()
@click.argument("mission", type=click.Path(path_type=Path), required=False)
@click.option("--port", type=click.IntRange(0, 65535), default=8474, show_default=True,
              help="0 takes any that is free.")  # fmt: skip
@click.option("--host", default="127.0.0.1", show_default=True,
              help="Another address lets others in, with a token.")  # fmt: skip
@click.option("--token", help="What the page's address has to hold.  [default: made up for --host]")
@click.option("--no-browser", is_flag=True, help="Only say where the page is.")
def studio(mission: Path | None, port: int, host: str, token: str | None, no_browser: bool) -> None:
    r"""Lay out a mission or a fleet in the browser, planned live and driven.

    MISSION is the file of either, or a folder of them; only that folder is read and written.

    \b
    Example:
      viaspline studio examples/fig8-patrol.yaml
    """
    from viaspline.studio.serve import serve

    serve(mission, host=host, port=port, token=token, browser=not no_browser, say=say)


cli.add_command(warm)
cli.add_command(upload)
cli.add_command(download)
cli.add_command(drive)
cli.add_command(export_command)
cli.add_command(identify)
cli.add_command(drive)
cli.add_command(replay)
