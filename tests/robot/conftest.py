"""Small missions in one line, and shapely as an independent judge of clearance."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
import shapely

from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle

Make = Callable[..., Mission]


def disc(x: float, y: float, radius: float, name: str | None = None) -> dict[str, Any]:
    shape: dict[str, Any] = {"circle": {"center": [x, y], "radius": radius}}
    return shape if name is None else {**shape, "name": name}


def box(x0: float, y0: float, x1: float, y1: float, name: str) -> dict[str, Any]:
    return {"name": name, "polygon": [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]}


def make_mission(
    *points: Any,
    known: Sequence[Any] = (),
    unseen: Sequence[Any] = (),
    bounds: Sequence[float] | None = None,
    closed: bool = False,
    **robot: Any,
) -> Mission:
    """A mission through these points; the robot sees 10 m far if nothing else is said."""
    start, *via = points
    route: dict[str, Any] = {"start": start, "via": via, "closed": closed}
    if not closed:
        route["goal"] = via.pop()
    world = {"known": list(known), "unseen": list(unseen), "bounds": bounds}
    robot = {"sensor": {"range_m": 10.0}, **robot}
    return Mission.model_validate({"world": world, "robot": robot, "route": route})


def outline(obstacle: Obstacle) -> shapely.Geometry:
    if obstacle.circle is not None:
        return shapely.Point(obstacle.circle.center)
    return shapely.Polygon(obstacle.polygon, obstacle.holes)


def smallest_gap(positions: np.ndarray, obstacles: Sequence[Obstacle]) -> float:
    """Smallest distance between points and obstacles, by shapely; discs by their centres."""
    points = shapely.points(positions[:, :2])
    gaps = [np.inf]
    for obstacle in obstacles:
        radius = 0.0 if obstacle.circle is None else obstacle.circle.radius
        gaps.append(float(shapely.distance(points, outline(obstacle)).min()) - radius)
    return min(gaps)


@pytest.fixture(scope="session")
def mission_of() -> Make:
    return make_mission


@pytest.fixture(scope="session")
def gap_of() -> Callable[..., float]:
    return smallest_gap


@pytest.fixture(scope="session")
def disc_at() -> Callable[..., dict[str, Any]]:
    return disc


@pytest.fixture(scope="session")
def box_at() -> Callable[..., dict[str, Any]]:
    return box
