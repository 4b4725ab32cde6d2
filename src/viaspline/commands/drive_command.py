"""``viaspline drive``: a mission with a real vehicle, over the link that is asked for."""

from __future__ import annotations

from pathlib import Path

import click

from viaspline.commands.link_options import ADDRESSES, ORIGIN, QUIET, SYSTEM, WAIT


@click.command()
@click.argument("mission", type=click.Path(path_type=Path))
@click.option("--mavlink", metavar="ADDRESS", help=f"An autopilot: {ADDRESSES}")
@click.option("--arm", is_flag=True, help="Arm it; else a person has to.")
@click.option("--from-here", is_flag=True, help="The path begins where the vehicle stands.")
@ORIGIN
@SYSTEM
@WAIT
@QUIET
def drive(
    mission: Path, mavlink: str | None, arm: bool, from_here: bool, origin: str | None,
    system: int | None, wait: float, quiet: bool,
) -> None:  # fmt: skip
    r"""Drive a mission with a real vehicle: its motors move.

    Over MAVLink it is put into GUIDED (ArduPilot) or OFFBOARD (PX4) and led along the path; at the
    end, on Ctrl-C and when the link is lost it is stopped and holds. Whoever changes its mode has
    it from then on.

    \b
    Example:
      viaspline drive patrol.yaml --mavlink udp:0.0.0.0:14550 --origin 47.1,8.2 --from-here
    """
    if mavlink is None:
        raise click.UsageError("say how the vehicle is reached: --mavlink ADDRESS")
    from viaspline.commands.mavlink_steps import MavlinkLink, drive_over_mavlink

    link = MavlinkLink(mavlink, system, origin, arm, from_here, wait)
    drive_over_mavlink(mission, link, quiet=quiet)
