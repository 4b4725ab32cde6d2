"""``viaspline download``: what a vehicle has on board, as a plan."""

from __future__ import annotations

from pathlib import Path

import click

from viaspline.commands.common_options import QUIET
from viaspline.commands.link_options import ADDRESSES, SYSTEM, WAIT, talking_to, telling
from viaspline.report.terminal.terminal_lines import say


@click.command()
@click.argument("out", type=click.Path(path_type=Path), metavar="OUT.plan")
@click.option("--from", "address", required=True, metavar="ADDRESS", help=ADDRESSES)
@SYSTEM
@WAIT
@QUIET
def download(out: Path, address: str, system: int | None, wait: float, quiet: bool) -> None:
    r"""Read a vehicle's mission into a .plan file, over MAVLink.

    With its fence and its rally points.

    \b
    Example:
      viaspline download --from udp:0.0.0.0:14550 onboard.plan
    """
    if out.suffix.lower() != ".plan":
        raise click.UsageError(f"{out} doesn't end with .plan, which is what is written")
    from viaspline.formats.whole_file import write_whole
    from viaspline.links.mavlink.board_plan import board_plan
    from viaspline.links.mavlink.download_mission import download_mission
    from viaspline.links.mavlink.mav_words import LISTS

    tell = telling(quiet)
    with talking_to(address) as conversation:
        tell(f"waiting for an autopilot on {conversation.name} …")
        vehicle, _ = conversation.find(system, wait)
        read = download_mission(conversation, vehicle, tell)
    write_whole(out, board_plan(read.lists, vehicle))
    if not quiet:
        parts = ", ".join(
            f"{LISTS[kind]}: {len(items)} items" for kind, items in read.lists.items()
        )
        say(f"{vehicle}: {parts}", *(f"note: {words}" for words in read.lacking), f"wrote {out}")
