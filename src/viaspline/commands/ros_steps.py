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
from viaspline.report.terminal.interrupts import undone_at_the_end
from viaspline.report.terminal.terminal_lines import say, say_error

if TYPE_CHECKING:
    from viaspline.links.ros.ros_link import RosPlace
    from viaspline.mission.model import Mission
    from viaspline.robot.navigator import Navigator


class RosOptions(NamedTuple):
    """How a robot is reached over ROS, and driven.

    Attributes:
        place: Where its nodes are.
        rate: Steps in a second, where no scan comes sooner [Hz].
        from_here: Whether the path begins where it stands, however far from the mission's start.
        stays: Whether goals are waited for at the end.
    """

    place: RosPlace
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
    from viaspline.links.ros.ros_link import check_link, open_link
    from viaspline.links.ros.ros_runner import RosRunner
    from viaspline.links.ros.ros_topics import heard_topics, said_topics
    from viaspline.mission.model import Mission
    from viaspline.ros_messages.message_book import standard_book

    check_link(options.place)
    mission = load_asked(file)
    if not isinstance(mission, Mission):
        raise click.UsageError("a robot drives the mission of one robot; this is a fleet")
    within = math.inf if options.from_here else START_WITHIN_M
    bridge = RosBridge.of(mission, start_within=within)
    period = 1.0 / options.rate
    planned = _planner(quiet, period)
    planned(mission)  # is there a path at all; and all that steps need is compiled
    tell = _telling(quiet)
    hears, says = heard_topics(mission.ros, bridge.inputs.has_lidar), said_topics(mission.ros)
    link = open_link(options.place, hears, says, standard_book())
    with closing(link):
        tell(f"listens over {options.place}")
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
    """Makes the navigator of a mission; that loads all that its steps need."""

    def make(mission: Mission) -> Navigator:
        from viaspline.robot.navigator import Navigator

        with progress_bar(quiet, mission, drives=True) as watch:
            plan = watched_plan(mission, watch)
            with watch.stage("steer", "getting ready to steer"):
                nav = Navigator(plan.mission, plan, period=period)
        return nav

    return make


def _telling(quiet: bool) -> Callable[[str], None]:
    def tell(words: str) -> None:
        if not quiet:
            say(words)

    return tell
