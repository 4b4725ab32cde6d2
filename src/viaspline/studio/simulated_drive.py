"""A simulated drive as the page plays it.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from itertools import count
from threading import Event as Flag
from typing import Any

import numpy as np

from viaspline.mission.sensor_spec import Lidar
from viaspline.planner import Plan
from viaspline.report.files.json_text import plain
from viaspline.robot.perception.belief import ON_MAP_M
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate
from viaspline.studio.page_numbers import finite, flat, rounded
from viaspline.world.moving_obstacles import MovingObstacles

MAX_TRACE_SAMPLES = 6000
LIDAR_SCANS_SHOWN = 400  # looks of a lidar that are shown
MAX_BEAMS_SHOWN = 180  # of each
PROGRESS_EVERY_S = 0.1  # between two words of progress [s]


class StoppedError(Exception):
    """The drive was broken off by the person at the page."""


def drive(plan: Plan, *, seed: int, stop: Flag, tell: Callable[[float], None]) -> Run:
    """Simulate a plan.

    Args:
        plan: What is driven.
        seed: For the noise of a lidar.
        stop: Set to break it off.
        tell: Hears ten times a second how much is done, from 0 to 1.

    Raises:
        StoppedError: It was broken off.
    """
    last = 0.0

    def progress(_: float, distance: float, length: float) -> None:
        nonlocal last
        if stop.is_set():
            raise StoppedError
        now = time.monotonic()
        if now - last > PROGRESS_EVERY_S:
            last = now
            tell(distance / length if length > 0 else 1.0)

    return simulate(plan.mission, seed=seed, progress=progress, plan=plan)


def driven(run: Run) -> dict[str, Any]:
    """What the page is told of a drive."""
    last = len(run.times) - 1
    some = np.unique(np.linspace(0, last, min(last + 1, MAX_TRACE_SAMPLES)).round().astype(int))
    return {
        "type": "driven",
        "reached": run.reached,
        "reason": run.reason,
        "duration": run.duration,
        "distance": run.path.length,
        "clearance": finite(run.least_clearance),
        "touched": "" if run.encounters is None else run.encounters.touched,
        "samples": {
            "time": rounded(run.times[some], 3),
            "x": rounded(run.positions[some, 0], 4),
            "y": rounded(run.positions[some, 1], 4),
            "heading": rounded(np.unwrap(run.headings)[some], 4),
            "speed": rounded(run.speeds[some], 4),
        },
        "events": [
            {
                "kind": event.kind,
                "time": event.time,
                "at": event.at[:2],
                "message": event.message,
                "data": plain(event.data),
            }
            for event in run.events
        ],
        "replans": [
            {
                "time": replan.time,
                "at": replan.at[:2],
                "obstacles": replan.obstacles,
                "spans": flat(replan.path.spans),
            }
            for replan in run.replans
        ],
        "sight": sight(run),
    }


def sight(run: Run) -> dict[str, Any] | None:
    """What the sensor shows, and when; None without a sensor."""
    sensor = run.plan.mission.robot.sensor
    if sensor is None:
        return None
    if sensor.lidar is not None:
        return _beams(run, sensor.lidar)
    standing = count(len(run.plan.world))
    seen: list[float | None] = []
    for obstacle in run.plan.mission.world.unseen:
        if obstacle.motion is None:
            away = run.world.distances_to(next(standing), run.positions)
        else:
            away = MovingObstacles([obstacle]).distance(run.positions, run.times)
        near = np.flatnonzero(away <= sensor.reach)
        seen.append(float(run.times[near[0]]) if near.size else None)
    return {"kind": "range", "reach": sensor.reach, "seen": seen}


def _beams(run: Run, spec: Lidar) -> dict[str, Any]:
    """The fan of a lidar at some moments, and the points off the map that it hit first then."""
    exact = spec.model_copy(update={"noise_m": 0.0, "beams": min(spec.beams, MAX_BEAMS_SHOWN)})
    lidar = LidarSensor(run.world.obstacles, exact, moving=run.moving)
    some = np.unique(np.linspace(0, len(run.times) - 1, LIDAR_SCANS_SHOWN).round().astype(int))
    grain = spec.range_m / 150
    known: set[tuple[int, int]] = set()
    fans, hits = [], []
    for k in some.tolist():
        now = float(run.times[k])
        scan = lidar.scan(tuple(run.positions[k].tolist()), float(run.headings[k]), time=now)
        fans.append(rounded(scan.free, 2))
        points = scan.hits
        if len(run.plan.world) and len(points):
            points = points[run.plan.world.distance(points) > ON_MAP_M]
        points = points[run.moving.distance(points, now) > ON_MAP_M]  # those that stay
        for cell in map(tuple, np.round(points / grain).astype(int).tolist()):
            if cell not in known:
                known.add(cell)
                x, y = cell
                hits.append([round(x * grain, 3), round(y * grain, 3), now])
    return {
        "kind": "lidar",
        "reach": spec.range_m,
        "times": rounded(run.times[some], 3),
        "first": scan.first_direction - float(run.headings[some[-1]]),
        "step": scan.angle_increment,
        "fans": fans,
        "hits": hits,
    }
