"""Reports of robots as kernels take them, and what became of those that aren't believed.

Tested through ``fleet/execution/test_fleet_navigator``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_messages import ProgressReport
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.fleet_run import FleetEvent
from viaspline.fleet.execution.judged_reports import NOISE_M, KnownFleet, judged
from viaspline.fleet.execution.strayed_robots import (
    beyond,
    overran,
    pushed_back,
    pushed_on,
)
from viaspline.kernels.arrays import Floats, Ints


def believed(
    fleet: DrivenFleet, state: FleetProgressState, reports: Sequence[ProgressReport], margin: float
) -> tuple[Ints, Floats, list[FleetEvent]]:
    """The reports that can be true, in the order of their times, and why the others can't.

    Args:
        fleet: What is driven.
        state: How far it has come; who was heard, has arrived and how fast it is are written to.
        reports: In any order; those of patrols with distances over all laps.
        margin: How much farther than it says a robot has to be [m].

    Returns:
        Whose reports they are, (k,); when and where each was, how far it takes itself to be let,
        and of when the last command is that it has heard, (k, 4); and what is to be told of them
        and of the others.
    """
    known, robots, rows = state.known(fleet), [], []
    events: list[FleetEvent] = []
    counted = [_counted(report, known, state.driven) for report in reports]
    for report in sorted(counted, key=_by_time):
        event = judged(report, known, state.time, margin)
        if event is not None:
            events.append(event)
            if event.kind == "refused":
                _doubt(state, known, report, margin)
            continue
        robot = known.names[report.name]
        length = float(known.lengths[robot])
        noise, come = NOISE_M + margin, min(float(known.progress[robot]), length)
        if report.distance > state.packed.promised[robot] + noise:
            events.append(overran(state, fleet, robot, report, margin))
        elif report.distance < come - noise:
            events.append(pushed_back(state, robot, report, margin))
            known.progress[robot] = state.packed.progress[robot]
        elif report.distance > known.farthest(report, robot, margin) + noise:
            events.append(pushed_on(state, report))
        if report.time >= state.doubted[robot, 0]:
            state.doubted[robot] = math.inf
        place = min(max(report.distance - margin, 0.0), length)
        if report.arrived:
            place = math.inf if fleet.rides.vanishes[robot] else length
            if not state.arrived[robot]:
                words = f"{report.name} arrives"
                events.append(FleetEvent("arrived", report.time, report.name, words))
            state.arrived[robot] = True
        state.heard[robot], state.silent[robot] = report.time, False
        state.speeds[robot] = abs(report.speed)
        state.places[robot] = min(max(report.distance, 0.0), length)
        known.progress[robot] = max(known.progress[robot], place)
        robots.append(robot)
        rows.append((report.time, place, *_answer(report, state, fleet, robot, margin)))
    return np.array(robots, np.int64), np.array(rows, float).reshape(-1, 4), events


def _doubt(
    state: FleetProgressState, known: KnownFleet, report: ProgressReport, margin: float
) -> None:
    """Keep what a robot said that isn't believed, unless it goes on saying the same."""
    robot = known.names.get(report.name)
    if robot is None or not math.isfinite(report.time + report.distance):
        return
    if not known.goes_on(report, robot, margin):
        state.doubted[robot] = report.time, report.distance


def _answer(
    report: ProgressReport, state: FleetProgressState, fleet: DrivenFleet, robot: int, margin: float
) -> tuple[float, float]:
    """How far a robot takes itself to be let, and of when the last command is that it has heard.

    One that is beyond that may be where it is, and as far as it needs to stop. One that doesn't say
    that isn't asked to let another pass first: it might obey, and nobody would know, so that both
    would wait for ever.
    """
    packed = state.packed
    if report.holds is not None and report.heard is not None:
        if math.isinf(packed.recalled_at[robot]):
            packed.recalled_at[robot] = state.time
        holds = report.holds
        if report.distance > holds + NOISE_M + margin:
            holds = beyond(fleet, robot, report, margin)
        return holds, report.heard
    packed.recall[robot], packed.recall_place[robot] = -1, math.inf
    packed.recalled_at[robot] = math.inf
    return 0.0, -math.inf


def _counted(report: ProgressReport, known: KnownFleet, driven: Floats) -> ProgressReport:
    """A report of a patrol with distances from where those of its plan begin."""
    robot = known.names.get(report.name)
    past = 0.0 if robot is None else float(driven[robot])
    if past == 0.0:
        return report
    holds = None if report.holds is None else report.holds - past
    return replace(report, distance=report.distance - past, holds=holds)


def _by_time(report: ProgressReport) -> tuple[float, str]:
    """A time that is no number has its place as well."""
    return (-math.inf if math.isnan(report.time) else report.time, str(report.name))
