"""Ways that a turning circle takes where it can't follow the shortest."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

import viaspline as vs
from viaspline.curve.bending import curvature_bound

CIRCLE, BODY = 4.0, 2.0
DISCS = [
    ((277.13, 295.59), 7.15), ((291.26, 320.3), 14.86), ((256.03, 327.51), 7.39),
    ((241.56, 296.6), 11.18), ((256.64, 254.51), 6.92),
]  # fmt: skip
RINGS = [
    [(286.34, 261.74), (278.94, 282.31), (278.21, 284.45), (291.04, 282.4), (286.84, 263.04)],
    [(256.68, 271.69), (254.33, 277.28), (255.91, 278.56), (261.86, 275.85)],
]
PLUG = {"circle": {"center": (278, 286.5), "radius": 1.0}}  # in the slot that turns too sharply


def obstacles() -> list[dict[str, Any]]:
    round_ones: list[dict[str, Any]] = [{"circle": {"center": at, "radius": r}} for at, r in DISCS]
    return round_ones + [{"polygon": ring} for ring in RINGS]


def mission(start: Any, goal: Any, circle: float | None, known: Any) -> vs.Mission:
    robot = {"radius_m": BODY, "clearance_m": 0, "min_turn_radius_m": circle}
    route = {"start": start, "goal": goal}
    return vs.Mission.model_validate({"world": {"known": known}, "robot": robot, "route": route})


def line_of(path: vs.Path) -> shapely.LineString:
    return shapely.LineString(path.evaluate(np.linspace(*path.domain, 20_001)))


def gap(path: vs.Path) -> float:
    """Between the path at samples and the nearest obstacle, by shapely [m]."""
    line = line_of(path)
    gaps = [line.distance(shapely.Point(at)) - r for at, r in DISCS]
    return min(gaps + [line.distance(shapely.Polygon(ring)) for ring in RINGS])


@pytest.mark.parametrize("turned", [False, True])
def test_where_the_shortest_way_turns_too_sharply_the_next_is_taken(turned):
    ends = [(238.0, 240.0), (335.0, 337.0)][:: -1 if turned else 1]
    path = vs.plan(mission(*ends, CIRCLE, obstacles())).path
    shortest = vs.plan(mission(*ends, None, obstacles())).path
    next_one = vs.plan(mission(*ends, None, [*obstacles(), PLUG])).path
    slot = shapely.Point(PLUG["circle"]["center"]).buffer(0.5)
    assert line_of(shortest).intersects(slot)
    assert not line_of(path).intersects(slot)
    assert path.length <= 1.01 * next_one.length
    assert curvature_bound(path)[0] * CIRCLE <= 1.0
    assert gap(path) >= BODY - 1e-6


def test_in_the_open_the_next_way_goes_round_the_outside():
    known = [obstacles()[0], obstacles()[5], obstacles()[6]]
    path = vs.plan(mission((259.6, 266.0), (300.0, 304.0), CIRCLE, known)).path
    found = vs.World([vs.Obstacle(**one) for one in known])
    points = path.evaluate(np.linspace(*path.domain, 5001))
    assert path.length < 69.0
    assert curvature_bound(path)[0] * CIRCLE <= 1.0
    assert found.distance(points).min() >= BODY - 1e-6
