"""A drive over real sockets: how soon a scan is answered by cmd_vel, and whether memory grows.

    python benchmarks/ros_round_trip.py [--rmw zenoh|dds] [--minutes M] [--beams N] [--laps L]

A pretended robot, in a process of its own, says odometry at 40 Hz and scans at 20 Hz, and goes as
it is told; what it is told of a scan is timed at its end of the sockets. Processor time is that of
the driving thread alone, from when it has a scan until cmd_vel is out. Run it on a machine that
does nothing else, or read the load that is printed beside it.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import os
import socket
import sys
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, nullcontext
from multiprocessing.synchronize import Event
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from tests.links.ros.pretend_robot import PretendRobot

import viaspline as vs
from viaspline.links.ros.ros_bridge import RosBridge
from viaspline.links.ros.ros_link import Rmw, RosLink, RosPlace, open_link
from viaspline.links.ros.ros_runner import RosRunner
from viaspline.links.ros.ros_topics import heard_topics, said_topics
from viaspline.mission.ros_spec import RosSpec
from viaspline.ros_messages.message_book import standard_book

DOMAIN = 97
POSTS = [(4.0, 2.1), (9.0, 4.0), (4.0, 4.0), (-1.0, 3.0), (3.0, 9.0)]
START = (1.0, 2.0, 0.0)
TICK_S = 0.025


def patrol(beams: int, laps: int) -> vs.Mission:
    """Round a square of 6 m by 4 m, with posts that only the lidar tells of."""
    return vs.Mission.model_validate(
        {
            "robot": {
                "radius_m": 0.3, "clearance_m": 0.15, "max_speed_mps": 0.8, "max_accel_mps2": 0.8,
                "tracking_error_m": 0.1,
                "drive": {"differential": {"track_m": 0.4}, "delay_s": 0.1},
                "sensor": {"lidar": {"range_m": 4, "fov_deg": 360, "beams": beams}},
            },
            "route": {
                "start": START[:2], "via": [[7, 2], [7, 6], [1, 6]], "closed": True, "laps": laps,
            },
        }
    )  # fmt: skip


def live(place: RosPlace, mission: vs.Mission, over: Event, answers: Any) -> None:
    """The robot, until it is told that all is over; then it says how soon it was answered [s]."""
    names, book = RosSpec(), standard_book()
    hears = {topic: said_topics(names)[topic] for topic in (names.cmd_vel_topic,)}
    says = {
        topic: kind
        for topic, kind in heard_topics(names, has_lidar=True).items()
        if topic in (names.odom_topic, names.scan_topic, "/tf", "/tf_static")
    }
    sensor = mission.robot.sensor
    assert sensor is not None
    posts = [vs.Obstacle(circle={"center": at, "radius": 0.3}) for at in POSTS]
    robot, link = PretendRobot(posts, sensor.lidar, START), open_link(place, hears, says, book)
    asked, found = [0.0], []

    def listen() -> None:
        while not over.is_set():
            for at, _, message in link.messages(0.05):
                robot.hears(at - began, message)
                del robot.told[:-50]
                if asked[0]:
                    found.append(at - asked[0])
                    asked[0] = 0.0

    began = time.monotonic()
    threading.Thread(target=listen, daemon=True).start()
    tick, before = 0, 0.0
    while not over.is_set():
        now = time.monotonic() - began
        robot.moves(now, now - before)
        before, tick = now, tick + 1
        if tick % 10 == 1:
            link.publish("/tf", robot.map_to_odom(now))
            link.publish("/tf_static", robot.laser_mount(now))
        link.publish(names.odom_topic, robot.odometry(now))
        if tick % 2 == 0:
            scan = robot.scan(now)
            asked[0] = time.monotonic()
            link.publish(names.scan_topic, scan)
        time.sleep(max(0.0, began + tick * TICK_S - time.monotonic()))
    answers.put((found, robot.nearest))
    link.close()


class TimedLink:
    """A link whose driver's processor time from a scan to cmd_vel is noted, and the memory."""

    def __init__(self, link: RosLink, until: float) -> None:
        self._link, self._until, self._since = link, until, 0.0
        self.costs: list[float] = []
        self.memory: list[tuple[float, float]] = []

    def publish(self, topic: str, message: Mapping[str, Any]) -> None:
        """Say it; what follows a scan is timed."""
        self._link.publish(topic, message)
        if topic == "/cmd_vel" and self._since:
            self.costs.append(time.thread_time() - self._since)
            self._since = 0.0

    def messages(self, patience: float) -> Iterator[tuple[float, str, dict[str, Any]]]:
        """What was heard; a drive that is over is interrupted."""
        now = time.monotonic()
        if now > self._until:
            raise KeyboardInterrupt
        if not self.memory or now > self.memory[-1][0] + 10.0:
            self.memory.append((now, resident_mb()))
        began = time.thread_time()
        for at, topic, message in self._link.messages(patience):
            if topic == "/scan":
                self._since = began
            yield at, topic, message

    def close(self) -> None:
        """End it."""
        self._link.close()


def resident_mb() -> float:
    """The memory of this process [MB]."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


@contextmanager
def zenoh_router() -> Iterator[str]:
    """A router of zenoh, as rmw_zenoh's is one: its address."""
    import zenoh

    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        address = f"tcp/127.0.0.1:{one.getsockname()[1]}"
    config = zenoh.Config()
    config.insert_json5("mode", json.dumps("router"))
    config.insert_json5("scouting/multicast/enabled", "false")
    config.insert_json5("listen/endpoints", json.dumps([address]))
    with zenoh.open(config):
        yield address


def measured(rmw: Rmw, minutes: float, beams: int, laps: int) -> None:
    """Drive for so long and print what was found."""
    mission = patrol(beams, laps)
    nav = vs.Navigator(mission, period=0.05)
    router = zenoh_router() if rmw == "zenoh" else nullcontext("")
    spawn = multiprocessing.get_context("spawn")
    with router as address:
        place = RosPlace(rmw, DOMAIN, router=address)
        over, answers = spawn.Event(), spawn.Queue()
        robot = spawn.Process(target=live, args=(place, mission, over, answers))
        robot.start()
        topics = heard_topics(mission.ros, has_lidar=True), said_topics(mission.ros)
        link = TimedLink(
            open_link(place, *topics, standard_book()), time.monotonic() + 60.0 * minutes
        )
        runner = RosRunner(
            link, RosBridge.of(mission), lambda _: nav, time.monotonic, period=0.05, tell=print
        )
        try:
            print(runner.run())
        except KeyboardInterrupt:
            print(f"driven for {minutes:g} minutes")
        finally:
            over.set()
            found, nearest = answers.get(timeout=60.0)
            robot.join()
            link.close()
    load = os.getloadavg()
    print(
        f"load {load[0]:.1f} and {load[1]:.1f} on {os.cpu_count()} cores, over {rmw}, {beams} beams"
    )
    for what, seconds in (("scan to cmd_vel, wall", found), ("driver's processor", link.costs)):
        low, high, most = 1e3 * np.percentile(seconds, [50, 99, 100])
        print(f"{what}: median {low:.1f}, p99 {high:.1f}, most {most:.1f} ms of {len(seconds)}")
    driven = runner.bridge.nav
    far = 0.0 if driven is None else driven.driven + driven.distance
    print(f"{far:.0f} m driven, nearest to a post {nearest:.2f} m, memory [MB]:",
          *(f"{mb:.0f}" for _, mb in link.memory[:: max(1, len(link.memory) // 20)]))  # fmt: skip


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rmw", choices=["zenoh", "dds"], default="zenoh")
    parser.add_argument("--minutes", type=float, default=1.0)
    parser.add_argument("--beams", type=int, default=720)
    parser.add_argument("--laps", type=int, default=500)
    asked = parser.parse_args()
    measured(asked.rmw, asked.minutes, asked.beams, asked.laps)
