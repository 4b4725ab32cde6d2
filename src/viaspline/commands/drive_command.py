"""``viaspline drive``: a mission with a real vehicle, over the link that is asked for."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from viaspline.commands.common_options import MISSION, QUIET
from viaspline.commands.link_options import ADDRESSES, ORIGIN, SYSTEM, WAIT
from viaspline.commands.rmw_option import RMW

if TYPE_CHECKING:
    from viaspline.links.ros.ros_link import Rmw


@click.command()
@MISSION
@click.option("--mavlink", metavar="ADDRESS", help=f"An autopilot: {ADDRESSES}")
@click.option("--ros", is_flag=True, help="A robot that speaks ROS 2.")
@click.option("--from-here", is_flag=True, help="Begin the path where the vehicle stands.")
@click.option("--arm", is_flag=True, help="MAVLink: arm the vehicle; otherwise a person has to.")
@ORIGIN
@SYSTEM
@WAIT
@RMW
@click.option("--connect", metavar="ENDPOINT",
              help="ROS: the rmw_zenoh router.  [default: tcp/localhost:7447]")  # fmt: skip
@click.option("--domain", type=click.IntRange(0, 232), default=0, show_default=True, metavar="N",
              envvar="ROS_DOMAIN_ID", help="ROS: ROS_DOMAIN_ID.")  # fmt: skip
@click.option("--distro", default="jazzy", show_default=True, metavar="NAME", envvar="ROS_DISTRO",
              help="ROS: the robot's ROS_DISTRO.")  # fmt: skip
@click.option("--rate", type=click.FloatRange(10.0, 200.0), default=20.0, show_default=True,
              metavar="HZ", help="ROS: least steps per second; each scan is one, too.")  # fmt: skip
@click.option("--stay", is_flag=True, help="ROS: wait for further goals at the end, until Ctrl-C.")
@QUIET
def drive(
    mission: Path, mavlink: str | None, ros: bool, from_here: bool, arm: bool, origin: str | None,
    system: int | None, wait: float, rmw: Rmw, connect: str | None, domain: int, distro: str,
    rate: float, stay: bool, quiet: bool,
) -> None:  # fmt: skip
    r"""Drive a mission with a real vehicle: its motors move.

    Over MAVLink the vehicle is put into GUIDED (ArduPilot) or OFFBOARD (PX4) and led along the
    path. At the end, on Ctrl-C and when the link is lost it is stopped and holds. Whoever changes
    its mode takes it over from then on.

    Over ROS 2 it subscribes to odometry, tf, scans, maps and goals, and publishes cmd_vel, the path
    and its progress. Topics are named by the mission's key ros; Nav2's names are the defaults. The
    robot stands while anything that it needs is older than 0.2 s, at the end, and on Ctrl-C. Its
    base has to stop by itself when cmd_vel ceases. --rmw zenoh reaches nodes with rmw_zenoh, --rmw
    dds those with rmw_fastrtps (ROS 2's default) or rmw_cyclonedds.

    \b
    Examples:
      viaspline drive patrol.yaml --mavlink udp:0.0.0.0:14550 --origin 47.1,8.2 --from-here
      viaspline drive patrol.yaml --ros --from-here
      viaspline drive patrol.yaml --ros --rmw dds --domain 5
    """
    if (mavlink is None) != ros:
        raise click.UsageError("say how the vehicle is reached: --mavlink ADDRESS or --ros")
    if mavlink is not None:
        from viaspline.commands.mavlink_steps import MavlinkLink, drive_over_mavlink

        link = MavlinkLink(mavlink, system, origin, arm, from_here, wait)
        drive_over_mavlink(mission, link, quiet=quiet)
        return
    if connect is not None and rmw != "zenoh":
        raise click.UsageError("--connect is for --rmw zenoh; DDS finds its peers by itself, or by "
                               "what CYCLONEDDS_URI says")  # fmt: skip
    from viaspline.commands.ros_steps import RosOptions, drive_over_ros
    from viaspline.links.ros.ros_link import ROUTER, RosPlace

    place = RosPlace(rmw, domain, distro.lower(), connect or ROUTER)
    options = RosOptions(place, rate, from_here, stay)
    drive_over_ros(mission, options, quiet=quiet)
