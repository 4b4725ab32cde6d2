"""``viaspline upload``: a mission onto a vehicle."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from viaspline.commands.command_steps import load_asked, progress_bar, watched_plan
from viaspline.commands.common_options import MISSION, QUIET
from viaspline.commands.link_options import (
    ADDRESSES,
    ORIGIN,
    SYSTEM,
    WAIT,
    talking_to,
    telling,
)
from viaspline.report.proven_reference import with_meaning
from viaspline.report.terminal.terminal_lines import say

if TYPE_CHECKING:
    from viaspline.formats.items import LatLon
    from viaspline.links.mavlink.way_to_upload import WayToUpload


@click.command()
@MISSION
@click.option("--to", "address", required=True, metavar="ADDRESS", help=ADDRESSES)
@click.option("--vias", is_flag=True, help="Send the mission's own via points as they are.")
@click.option("--no-fence", is_flag=True, help="Leave the fence that is on board.")
@ORIGIN
@SYSTEM
@WAIT
@QUIET
def upload(
    mission: Path, address: str, vias: bool, no_fence: bool, origin: str | None,
    system: int | None, wait: float, quiet: bool,
) -> None:  # fmt: skip
    r"""Send a mission to a vehicle, with its fences and rally points.

    Then it is read back and compared. What is sent is the planned path as straight lines, which are
    proven again, with the acceptance radius within which the vehicle may cut corners. With --vias
    it is the mission's own via points, between which nothing is proven. What was on board is
    replaced; rally points only if the file has some.

    \b
    Examples:
      viaspline upload survey.plan --to udp:0.0.0.0:14550
      viaspline upload patrol.yaml --to serial:/dev/ttyUSB0:57600 --origin 47.1,8.2
    """
    from viaspline.links.mavlink.geographic_origin import mission_origin, origin_note
    from viaspline.links.mavlink.mav_words import FENCE, LISTS
    from viaspline.links.mavlink.mission_items import lists_of
    from viaspline.links.mavlink.rally_points import rally_points
    from viaspline.links.mavlink.upload_mission import (
        refuse_copter_on_ground,
        refuse_under_way,
        upload_mission,
    )

    way = _way(mission, mission_origin(mission, origin), vias=vias, quiet=quiet)
    if (note := origin_note(mission, origin)) and not quiet:
        say(f"note: {note}")
    lists = lists_of(way.itinerary, rally_points(mission))
    if no_fence:
        lists.pop(FENCE)
    tell = telling(quiet)
    with talking_to(address) as conversation:
        tell(f"waiting for an autopilot on {conversation.name} …")
        vehicle, heartbeat = conversation.find(system, wait)
        refuse_under_way(conversation.name, vehicle, heartbeat)
        refuse_copter_on_ground(conversation.name, vehicle, way.itinerary)
        done = upload_mission(conversation, vehicle, lists, way.itinerary.home, tell)
    if not quiet:
        parts = ", ".join(f"{LISTS[kind]}: {count} items" for kind, count in done.counts.items())
        say(*with_meaning(way.proof), *(f"note: {words}" for words in way.notes))
        say(f"{vehicle} has on board what was sent: {parts}")


def _way(file: Path, origin: LatLon, *, vias: bool, quiet: bool) -> WayToUpload:
    """What is sent of a mission's file."""
    from viaspline.links.mavlink.way_to_upload import own_points, proven_way
    from viaspline.mission.model import Mission

    asked = load_asked(file)
    if not isinstance(asked, Mission):
        raise click.UsageError("a vehicle takes the mission of one robot; this is a fleet")
    if vias:
        return own_points(file, asked, origin)
    with progress_bar(quiet, asked) as watch:
        if asked.is_spatial:
            with watch.stage("plan", "planning"):
                from viaspline.space.plan_spatial import plan_spatial

                plan = plan_spatial(asked)
            with watch.stage("prove", "proving its straight lines"):
                return proven_way(plan, origin, str(file))
        planned = watched_plan(asked, watch)
        with watch.stage("prove", "proving its straight lines"):
            return proven_way(planned, origin, str(file))
