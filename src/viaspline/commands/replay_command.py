"""``viaspline replay``: does the navigator decide today what a bag says that it decided?"""

from __future__ import annotations

from pathlib import Path

import click

from viaspline.bags.rosbag2_reader import NO_SUCH_BAG
from viaspline.bounded_file import is_there
from viaspline.commands.command_steps import progress_bar
from viaspline.errors import BagError
from viaspline.exit_codes import NOT_REACHED
from viaspline.report.terminal_lines import say, say_error


@click.command()
@click.argument("bag", type=click.Path(path_type=Path))
@click.option(
    "--tolerance", type=click.FloatRange(min=0.0, max=1.0), default=1e-9, show_default=True,
    help="What numbers may differ by, as a part of 1 and of themselves.",
)  # fmt: skip
@click.option("--quiet", "-q", is_flag=True, help="Say nothing when all goes well.")
def replay(bag: Path, tolerance: float, quiet: bool) -> None:
    r"""Drive again what `viaspline run --bag` has recorded, and compare what is decided.

    The navigator is given, step by step, what it was given then. Says at which step it decides
    otherwise, if at any: then the exit code is 4. Of a bag that is cut short, what is whole is
    driven again. Needs pip install 'viaspline[bags]'.

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
