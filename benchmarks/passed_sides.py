"""On which side a path passes what stands in the way of its legs: an oracle of its own.

It knows nothing of the planner. It walks along dense points of a leg and adds up the angle that
they sweep about a place inside of an obstacle: a path that leaves it on the robot's right turns
clockwise about it. Between the same two ends the sides are a full turn apart.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
import shapely

import viaspline as vs

POINTS_PER_SPAN = 200
MOST_STEP_RAD = 1.0  # from a point to the next, about an obstacle
SAME_TURN_RAD = 1e-6
NEAR_RATIO = 1.99  # of what is required: a path nearer than that passes an obstacle by its side


def wrong_sides(path: vs.Path, obstacles, required: float) -> list[str]:
    """What a path passes on the other side than is asked for, by name, with the leg.

    Args:
        path: What is driven, by its user via points.
        obstacles: Circles and polygons.
        required: Distance that the path keeps from them [m].
    """
    sided = [(one, _shape(one)) for one in obstacles if one.forced_side is not None]
    found = []
    for number, points in enumerate(_legs(path)):
        for obstacle, shape in sided:
            if not _is_passed_as_asked(points, shape, obstacle.forced_side, required):
                found.append(f"leg {number + 1} of '{obstacle.name}' ({obstacle.forced_side})")
    return found


def _legs(path: vs.Path) -> list[np.ndarray]:
    """Dense points of the path from user via point to user via point, each (n, 2) [m]."""
    ends = [via.u for via in path.vias if via.kind == "user"]
    legs = []
    for first, last in itertools.pairwise(ends):
        count = 1 + POINTS_PER_SPAN * max(1, round(last - first))
        legs.append(path.evaluate(np.linspace(first, last, count))[:, :2])
    return legs


def _shape(obstacle: vs.Obstacle):
    if obstacle.circle is not None:
        return shapely.Point(obstacle.circle.center).buffer(obstacle.circle.radius, 64)
    return shapely.Polygon(obstacle.polygon)


def _is_passed_as_asked(points: np.ndarray, shape, side: str, required: float) -> bool:
    ends, heart = points[[0, -1]], np.array(shape.representative_point().coords[0])
    (ax, ay), (bx, by) = ends - heart
    straight = math.atan2(ax * by - ay * bx, ax * bx + ay * by)  # by the straight line
    left = straight if straight < 0.0 else straight - math.tau
    asked = left if side == "left" else left + math.tau
    keeps_anyway = asked == straight
    in_the_way = shapely.LineString(ends).distance(shape) < required
    is_near = shapely.LineString(points).distance(shape) < NEAR_RATIO * required
    if not (in_the_way or is_near or keeps_anyway):
        return True
    return abs(_swept(points, heart) - asked) < SAME_TURN_RAD


def _swept(points: np.ndarray, about: np.ndarray) -> float:
    """The angle that a line sweeps about a place [rad]."""
    off = points - about
    turns = np.diff(np.unwrap(np.arctan2(off[:, 1], off[:, 0])))
    assert np.abs(turns).max() < MOST_STEP_RAD, "the points are too far apart to tell"
    return float(turns.sum())
