"""What ``viaspline drive --ros`` does.

Tested through ``commands/test_drive_command``.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from viaspline.commands.command_steps import load_asked, progress_bar, watched_plan
from viaspline.exit_codes import NOT_REACHED
from viaspline.report.interrupts import undone_at_the_end
from viaspline.report.terminal_lines import say, say_error

if TYPE_CHECKING:
    from viaspline.mission.model import Mission
    from viaspline.robot.navigator import Navigator
    from viaspline.robot.perception.lidar import Scan


class RosOptions(NamedTuple):
    """How a robot is reached over ROS, and driven.

    Attributes:
        connect: Address of the zenoh router.
        domain: Of ROS.
        distro: Of the robot's ROS, such as ``jazzy``.
        rate: Steps in a second, where no scan comes sooner [Hz].
        from_here: Whether the path begins where it stands, however far from the mission's start.
        stays: Whether goals are waited for at the end.
    """

    connect: str
    domain: int
    distro: str
    rate: float
    from_here: bool
    stays: bool


def drive_over_ros(file: Path, options: RosOptions, *, quiet: bool) -> None:
    """Drive a mission with a robot that speaks ROS 2, and say what came of it.

    Args:
        file: The mission.
        options: How it is reached and driven.
        quiet: Say nothing when all goes well.
    """
    from viaspline.links.ros.ros_bridge import START_WITHIN_M, RosBridge
    from viaspline.links.ros.ros_runner import RosRunner
    from viaspline.links.ros.zenoh_link import ZenohLink, check_zenoh
    from viaspline.mission.model import Mission
    from viaspline.ros_messages.message_book import standard_book

    check_zenoh()
    mission = load_asked(file)
    if not isinstance(mission, Mission):
        raise click.UsageError("a robot drives the mission of one robot; this is a fleet")
    within = math.inf if options.from_here else START_WITHIN_M
    bridge = RosBridge.of(mission, start_within=within)
    period = 1.0 / options.rate
    planned = _planner(quiet, period)
    planned(mission)  # is there a path at all; and all that steps need is compiled
    tell = _telling(quiet)
    link = ZenohLink(
        options.connect, options.domain, bridge.listens_to(), bridge.says(), standard_book(),
        distro=options.distro.lower(),
    )  # fmt: skip
    with closing(link):
        tell(f"listens on {options.connect}, domain {options.domain}")
        runner = RosRunner(
            link, bridge, planned, time.monotonic, period=period, tell=tell, stays=options.stays
        )
        with undone_at_the_end(runner.stop):
            ended = runner.run()
    words = f"{ended.words}; {ended.steps} steps, held {ended.stops} times for what was missing"
    if ended.reached:
        if not quiet:
            say(f"the robot {words}")
        return
    say_error(f"the robot {words}")
    click.get_current_context().exit(NOT_REACHED)


def _planner(quiet: bool, period: float) -> Callable[[Mission], Navigator]:
    """Makes the navigator of a mission, and has it make its first steps: they compile."""

    def make(mission: Mission) -> Navigator:
        from viaspline.robot.navigator import Navigator

        with progress_bar(quiet, mission, drives=True) as watch:
            plan = watched_plan(mission, watch)
            with watch.stage("steer", "getting ready to steer"):
                nav = Navigator(plan.mission, plan, period=period)
                tried = nav
                for tick in range(3):
                    here = tried.reference(tick * period)
                    _, tried = tried.step(
                        here, _nothing_seen(mission, here.position), tick * period
                    )
        return nav

    return make


def _nothing_seen(mission: Mission, at: tuple[float, ...]) -> Scan | tuple[()]:
    """What the robot's sensor would show where there is nothing."""
    sensor = mission.robot.sensor
    if sensor is None or sensor.lidar is None:
        return ()
    from viaspline.robot.perception.lidar import LidarSensor

    return LidarSensor((), sensor.lidar).scan(at, 0.0)


def _telling(quiet: bool) -> Callable[[str], None]:
    def tell(words: str) -> None:
        if not quiet:
            say(words)

    return tell
