"""How a path in space is flown if nothing moves: headings, stops, and the fastest law.

Tested through ``space/test_plan_spatial``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from viaspline.curve.path import Path, PathVia
from viaspline.kernels.arrays import Floats
from viaspline.space.laying.laid_route import LaidRoute
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.timing.retime_in_space import retime_in_space
from viaspline.space.timing.yaw_profile import YawProfile, yaw_profile
from viaspline.trajectory.limits import Station
from viaspline.trajectory.trajectory import Trajectory

TAKE_OFF, LANDING = "take-off", "landing"
"""What the places on the ground are called."""

SAME_STOP_M = 1e-9
"""Stops no farther apart along the path are one."""


def headings_of(problem: SpatialProblem, path: Path) -> YawProfile:
    """Where the body looks along a path."""
    a_lap = len(problem.vias) - 1
    faced = {
        via.index + lap * a_lap: via.look_at
        for lap in range(problem.laps)
        for via in problem.vias
        if via.look_at is not None and via.index is not None
    }
    looks = [(k, faced[via.index]) for k, (via, _) in enumerate(path.stops) if via.index in faced]
    return yaw_profile(path, problem.facing, looks)


def stops_of(problem: SpatialProblem, path: Path) -> Iterator[Station]:
    """Where the robot hovers: its stations, and the tops of take-off and landing.

    A station right over the landing, or where the climb ends, is one stop with that.
    """
    last: Station | None = None
    for via, distance in zip(path.vias, path.via_distances.tolist(), strict=True):
        if not (via.dwell > 0.0 or via.name in (TAKE_OFF, LANDING)):
            continue
        if last is not None and distance - last.distance <= SAME_STOP_M:
            name = last.name if last.dwell > 0.0 else via.name
            last = Station(last.distance, last.dwell + via.dwell, name)
            continue
        if last is not None:
            yield last
        last = Station(distance, via.dwell, via.name)
    if last is not None:
        yield last


def part_of_route(problem: SpatialProblem, spans: Floats, first: int, joints: list[int]) -> Path:
    """The curve of a part of a route.

    Args:
        problem: Whose route it is.
        spans: Of the curve [m], (m, 4, 3).
        first: The via point where it begins.
        joints: At which of its joints that and the next ones lie.
    """
    vias = problem.vias[first : first + len(joints)]
    return Path(spans, [
        PathVia(via.name, (*via.at.tolist(),), "user", float(u), via.dwell or 0.0, via.index)
        for via, u in zip(vias, joints, strict=True)
    ])  # fmt: skip


def law_of(problem: SpatialProblem, path: Path) -> Trajectory:
    """The fastest law along a part of a route, from rest to rest.

    It stops at the stations that lie within, however long they take.
    """
    stops = tuple(
        Station(distance, 0.0, via.name)
        for via, distance in path.stops
        if via.dwell > 0.0 and 0.0 < distance < path.length
    )
    ahead = YawProfile(np.array([0.0, path.length]), np.zeros(2))
    yaw = ahead if problem.limits.yaw_rate is None else headings_of(problem, path)
    return retime_in_space(path, problem.limits, stops, yaw, zones=problem.zones)


def cost_of(problem: SpatialProblem) -> Callable[[LaidRoute], float]:
    """By what routes are chosen: time, from rest to rest, or length."""

    def cost(laid: LaidRoute) -> float:
        path = part_of_route(problem, laid.spans, 0, laid.joints.tolist())
        return path.length if problem.objective == "length" else law_of(problem, path).duration

    return cost
