"""The standard vector worlds: 500 m x 500 m, 10 discs and 10 convex polygons, gaps of 8 m or more.

Dense ones have more obstacles, as much smaller, and gaps that may be narrower than the robot.
Random numbers are drawn in a fixed order, so that a seed is a world.
"""

from __future__ import annotations

import math

import numpy as np
from shapely.geometry import LineString, MultiPoint, Point, Polygon

from viaspline import Mission, Obstacle

START, GOAL, RADIUS, SIZE = (15.0, 15.0), (485.0, 485.0), 2.0, 500.0


def obstacles(seed: int, count: int = 20) -> list[Obstacle]:
    """Discs and polygons in turn, none near another, the edge, the start or the goal."""
    random = np.random.default_rng(seed)
    found: list[Obstacle] = []
    shapes: list = []
    while len(found) < count:
        centre = random.uniform(45, 455, 2)
        if len(found) % 2 == 0:
            radius = random.uniform(15, 45)
            shape = Point(centre).buffer(radius, quad_segs=64)
            obstacle = {"circle": {"center": centre.tolist(), "radius": float(radius)}}
        else:
            corners = random.integers(5, 9)
            angles = np.sort(random.uniform(0, 2 * np.pi, corners))
            reach = random.uniform(15, 50, (corners, 1))
            hull = MultiPoint(centre + np.c_[np.cos(angles), np.sin(angles)] * reach).convex_hull
            shape = hull
            if hull.geom_type != "Polygon":
                continue
            obstacle = {"polygon": np.array(hull.exterior.coords)[:-1].tolist()}
        x0, y0, x1, y1 = shape.bounds
        free = min(shape.distance(Point(START)), shape.distance(Point(GOAL))) >= 12
        inside = min(x0, y0) >= 8 and max(x1, y1) <= SIZE - 8
        apart = all(shape.distance(other) >= 8 for other in shapes)
        if shape.area >= 200 and free and inside and apart:
            found.append(Obstacle.model_validate(obstacle))
            shapes.append(shape)
    return found


def dense(seed: int, count: int, radius: float) -> list[Obstacle]:
    """Discs and polygons in turn, between which a robot gets through in some places only.

    Args:
        seed: Of the random numbers.
        count: Of the obstacles; they are the smaller, the more there are.
        radius: Of the robot [m]; gaps are from 0.55 to 1.65 times as wide as it is.
    """
    random = np.random.default_rng(seed)
    found: list[Obstacle] = []
    reaches, centres = np.empty(count), np.empty((count, 2))
    ends = np.array((START, GOAL))
    scale = 1.35 * math.sqrt(20 / count)
    while len(found) < count:
        n = len(found)
        centre, reach = random.uniform(5, SIZE - 5, 2), scale * random.uniform(15, 45)
        gap = 2.2 * radius * random.uniform(0.5, 1.5)
        corners = random.integers(5, 9)
        angles = np.sort(random.uniform(0, 2 * np.pi, corners))
        spokes = random.uniform(0.5 * reach, reach, (corners, 1))
        near = np.hypot(*(centres[:n] - centre).T) - reaches[:n] - reach
        if (near < gap).any() or (np.hypot(*(ends - centre).T) < reach + 12).any():
            continue
        if n % 2 == 0:
            obstacle = {"circle": {"center": centre.tolist(), "radius": float(reach)}}
        else:
            hull = MultiPoint(centre + np.c_[np.cos(angles), np.sin(angles)] * spokes).convex_hull
            if hull.geom_type != "Polygon":
                continue
            obstacle = {"polygon": np.array(hull.exterior.coords)[:-1].tolist()}
        found.append(Obstacle.model_validate(obstacle))
        centres[n], reaches[n] = centre, reach
    return found


def mission(seed: int) -> Mission:
    """From corner to corner with a body of 2 m."""
    return crossing(obstacles(seed))


def crossing(found: list[Obstacle], radius: float = RADIUS) -> Mission:
    """From corner to corner of a world."""
    return Mission.model_validate(
        {
            "world": {"bounds": [0, 0, SIZE, SIZE], "known": found},
            "robot": {"radius_m": radius, "clearance_m": 0},
            "route": {"start": START, "goal": GOAL},
        }
    )


def inflated(found: list[Obstacle], segments: int = 8, radius: float = RADIUS) -> list[np.ndarray]:
    """Outlines at the robot's radius for planners of corner paths: circumscribed, so safe."""
    outlines = []
    for obstacle in found:
        if obstacle.circle is not None:
            count = 4 * segments
            reach = (obstacle.circle.radius + radius) / math.cos(math.pi / count)
            angles = np.arange(count) * 2 * np.pi / count
            outline = obstacle.circle.center + reach * np.c_[np.cos(angles), np.sin(angles)]
        else:
            # arcs of the buffer may take one and a half nominal steps
            reach = radius / math.cos(0.75 * math.pi / (2 * segments))
            ring = Polygon(obstacle.polygon).buffer(reach, quad_segs=segments)
            outline = np.array(ring.exterior.coords)[:-1]
        outlines.append(outline)
    return outlines


def clearance(points: np.ndarray, found: list[Obstacle]) -> float:
    """Distance between a polyline and the obstacles by shapely [m]; 0 where it touches one."""
    line = LineString(points)
    return min(
        line.distance(Point(o.circle.center)) - o.circle.radius
        if o.circle is not None
        else line.distance(Polygon(o.polygon))
        for o in found
    )


def length(points: np.ndarray) -> float:
    """Length of a polyline [m]."""
    return float(np.linalg.norm(np.diff(np.asarray(points, float), axis=0), axis=1).sum())
