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


DEAD_END = [
    {"circle": {"center": [12.17, 4.41], "radius": 1.238}},
    {"circle": {"center": [3.68, 5.91], "radius": 2.159}},
    {"polygon": [[12.083, -0.307], [12.667, 0.343], [12.017, 0.927], [11.433, 0.277]]},
    {"polygon": [[10.684, 6.437], [9.248, 8.051], [8.568, 6.001]]},
    {"circle": {"center": [13.98, 10.55], "radius": 0.692}},
]


def there_and_back(mirrored: bool) -> vs.Plan:
    """To a via point behind a disc and back past that, then on."""

    def at(x: float, y: float) -> list[float]:
        return [x, -y if mirrored else y]

    known: list[dict[str, Any]] = [
        {"circle": {"center": at(*one["circle"]["center"]), "radius": one["circle"]["radius"]}}
        if "circle" in one
        else {"polygon": [at(*corner) for corner in one["polygon"]]}
        for one in DEAD_END
    ]
    robot = {"radius_m": 0.5, "clearance_m": 0.4, "min_turn_radius_m": 1.6}
    route = {"start": at(5.88, 9.45), "via": [at(1.43, 0.91)], "goal": at(16.96, 13.07)}
    return vs.plan(
        vs.Mission.model_validate({"world": {"known": known}, "robot": robot, "route": route})
    )


def test_where_left_is_right_a_robot_turns_back_at_a_via_point_as_well():
    plan, image = there_and_back(mirrored=False), there_and_back(mirrored=True)
    # As near as strips come to rest, from the turns that either was laid with.
    assert image.path.length == pytest.approx(plan.path.length, rel=1e-4)
    assert image.trajectory.duration == pytest.approx(plan.trajectory.duration, rel=1e-4)
    assert plan.path.length < 34.5
