"""Drives among obstacles that come and go, and shapely's view of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest
import shapely

from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import LidarSensor

STEP = 0.05


def shapely_of(obstacle: Obstacle) -> shapely.Geometry:
    if obstacle.circle is not None:
        return shapely.Point(obstacle.circle.center).buffer(obstacle.circle.radius, quad_segs=64)
    return shapely.Polygon(obstacle.polygon, obstacle.holes)


def drive_among(
    mission: Mission, there: Callable[[float], Sequence[Obstacle]], until: float = 120.0
) -> tuple[Navigator, list[Navigator]]:
    """Follow exactly among obstacles that may come and go."""
    assert mission.robot.sensor is not None
    assert mission.robot.sensor.lidar is not None
    nav, states = Navigator(mission), []
    for tick in range(round(until / STEP)):
        time = tick * STEP
        state = nav.reference(time)
        sensor = LidarSensor(there(time), mission.robot.sensor.lidar)
        _, nav = nav.step(state, sensor.scan(state.position, state.heading, tick), time)
        states.append(nav)
        if nav.finished:
            break
    return nav, states


def crossings_at(states: Sequence[Navigator], x: float) -> list[int]:
    """On which side each new path crosses a line of constant x."""
    found = []
    for replan in (replan for nav in states for replan in nav.replans):
        points = np.asarray(replan.path.at_distance(np.linspace(0, replan.path.length, 2000)))
        found.append(int(np.sign(points[np.abs(points[:, 0] - x).argmin(), 1])))
    return found


@pytest.fixture(scope="session")
def shape_of() -> Callable[[Obstacle], shapely.Geometry]:
    return shapely_of


@pytest.fixture(scope="session")
def drive() -> Callable[..., tuple[Navigator, list[Navigator]]]:
    return drive_among


@pytest.fixture(scope="session")
def sides_at() -> Callable[[Sequence[Navigator], float], list[int]]:
    return crossings_at
