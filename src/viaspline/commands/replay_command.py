"""``viaspline replay``: does the navigator decide today what a bag says that it decided?"""

from __future__ import annotations

from pathlib import Path

import click

from viaspline.bags.rosbag2_reader import NO_SUCH_BAG
from viaspline.bounded_file import is_there
from viaspline.commands.command_steps import progress_bar
from viaspline.commands.common_options import QUIET
from viaspline.errors import BagError
from viaspline.exit_codes import NOT_REACHED
from viaspline.report.terminal.terminal_lines import say, say_error


@click.command()
@click.argument("bag", type=click.Path(path_type=Path))
@click.option(
    "--tolerance", type=click.FloatRange(min=0.0, max=1.0), default=1e-9, show_default=True,
    help="Largest difference between two numbers, absolute and relative.",
)  # fmt: skip
@QUIET
def replay(bag: Path, tolerance: float, quiet: bool) -> None:
    r"""Replay a log of `run --bag`: does it decide the same today?

    The navigator is given step by step what it was given then. Where it decides otherwise, the step
    is printed and the exit code is 4. A bag that was cut short is replayed up to its last whole
    step. Needs pip install 'viaspline[bags]'.

    \b
    Example:
      viaspline run examples/fig8-patrol.yaml --bag run.mcap && viaspline replay run.mcap
    """
    if not is_there(bag):
        raise BagError(bag, NO_SUCH_BAG)
    with progress_bar(quiet) as watch, watch.stage("replay", "driving again"):
        from viaspline.bags.replay import replay as drive_again

        done = drive_again(bag, tolerance=tolerance)
    if done.damage is not None:
        say_error(
            f"{bag} is cut short ({done.damage}); "
            f"it is whole up to step {done.steps}, at {done.until:.2f} s",
            prefix="note: ",
        )
    if done.difference is not None:
        one = done.difference
        say_error(
            f"decides otherwise in step {one.step}, at {one.time:.2f} s: "
            f"{one.what} is {one.now}; recorded is {one.recorded}",
            f"  {bag} was recorded by viaspline {done.version}",
        )
        click.get_current_context().exit(NOT_REACHED)
    if not quiet:
        say(f"{bag}: the same in all of its {done.steps} steps, up to {done.until:.2f} s")
