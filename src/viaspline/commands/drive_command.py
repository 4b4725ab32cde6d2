"""``viaspline drive``: a mission with a real vehicle, over the link that is asked for."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.argument("mission", type=click.Path(path_type=Path))
@click.option("--ros", is_flag=True, help="A robot that speaks ROS 2, over rmw_zenoh.")
@click.option("--connect", default="tcp/localhost:7447", show_default=True, metavar="ENDPOINT",
              help="The router of rmw_zenoh.")  # fmt: skip
@click.option("--domain", type=click.IntRange(0, 232), default=0, show_default=True, metavar="N",
              envvar="ROS_DOMAIN_ID", help="ROS_DOMAIN_ID.")  # fmt: skip
@click.option("--distro", default="jazzy", show_default=True, metavar="NAME", envvar="ROS_DISTRO",
              help="ROS_DISTRO of the robot.")  # fmt: skip
@click.option("--rate", type=click.FloatRange(10.0, 200.0), default=20.0, show_default=True,
              metavar="HZ", help="Steps in a second, where no scan comes sooner.")  # fmt: skip
@click.option("--stay", is_flag=True, help="Wait for goals at the end, until Ctrl-C.")
@click.option("--from-here", is_flag=True, help="The path begins where the vehicle stands.")
@click.option("--quiet", "-q", is_flag=True, help="Say nothing when all goes well.")
def drive(
    mission: Path, ros: bool, connect: str, domain: int, distro: str, rate: float, stay: bool,
    from_here: bool, quiet: bool,
) -> None:  # fmt: skip
    r"""Drive a mission with a real vehicle: its motors move.

    Over ROS 2 it hears odometry, tf, scans, maps and goals, and says cmd_vel, the path and how it
    goes; the mission's ros: says how they are called, Nav2's names are the defaults. It stands
    while anything that it needs is older than 0.2 s, at the end, and on Ctrl-C. The robot's base
    has to stop by itself when cmd_vel ceases.

    \b
    Example:
      viaspline drive patrol.yaml --ros --from-here
    """
    if not ros:
        raise click.UsageError("say how the vehicle is reached: --ros")
    from viaspline.commands.ros_steps import RosOptions, drive_over_ros

    options = RosOptions(connect, domain, distro, rate, from_here, stay)
    drive_over_ros(mission, options, quiet=quiet)
