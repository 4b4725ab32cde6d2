"""``viaspline upload``: a mission onto a vehicle."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from viaspline.command_steps import load_asked
from viaspline.commands.link_options import (
    ADDRESSES,
    ORIGIN,
    QUIET,
    SYSTEM,
    WAIT,
    talking_to,
    telling,
)
from viaspline.report.terminal_lines import say

if TYPE_CHECKING:
    from viaspline.formats.items import Itinerary, LatLon


@click.command()
@click.argument("mission", type=click.Path(path_type=Path))
@click.option("--to", "address", required=True, metavar="ADDRESS", help=ADDRESSES)
@click.option("--no-fence", is_flag=True, help="Leave the fence on board as it is.")
@ORIGIN
@SYSTEM
@WAIT
@QUIET
def upload(
    mission: Path, address: str, no_fence: bool, origin: str | None, system: int | None,
    wait: float, quiet: bool,
) -> None:  # fmt: skip
    r"""Send a mission, its fences and rally points to a vehicle, read them back and compare.

    What is sent are the mission's own points. The vehicle drives straight between them.

    \b
    Example:
      viaspline upload survey.plan --to udp:0.0.0.0:14550
    """
    from viaspline.links.mavlink.geographic_origin import mission_origin
    from viaspline.links.mavlink.mav_words import FENCE, LISTS
    from viaspline.links.mavlink.mission_items import lists_of
    from viaspline.links.mavlink.rally_points import rally_points
    from viaspline.links.mavlink.upload_mission import refuse_under_way, upload_mission

    itinerary = _itinerary(mission, mission_origin(mission, origin))
    lists = lists_of(itinerary, rally_points(mission))
    if no_fence:
        lists.pop(FENCE)
    tell = telling(quiet)
    with talking_to(address) as conversation:
        tell(f"waiting for an autopilot on {conversation.name}")
        vehicle, heartbeat = conversation.find(system, wait)
        refuse_under_way(conversation.name, vehicle, heartbeat)
        done = upload_mission(conversation, vehicle, lists, itinerary.home, tell)
    if not quiet:
        parts = ", ".join(f"{LISTS[kind]}: {count} items" for kind, count in done.counts.items())
        say(f"{vehicle} has on board what was sent: {parts}")


def _itinerary(mission: Path, origin: LatLon) -> Itinerary:
    """What is sent of a mission's file."""
    from viaspline.links.mavlink.way_to_upload import via_points
    from viaspline.mission.model import Mission

    asked = load_asked(mission)
    if not isinstance(asked, Mission):
        raise click.UsageError("a vehicle takes the mission of one robot; this is a fleet")
    return via_points(asked, origin)
