"""Bodies that turn within almost no way, and at cusps: by their corners, and by shapely."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import example, given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.motion.moving_clearance import moving_tightest
from viaspline.machine.turns_on_spot import corners
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.moving_certificate import certify_moving
from viaspline.trajectory.retime import retime
from viaspline.trajectory.timed_body import timed_path
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.outline import outline

FRONT, REAR, HALF = 1.2, 0.5, 0.3
BODY = [(-REAR, -HALF), (FRONT, -HALF), (FRONT, HALF), (-REAR, HALF)]
LIMITS = Limits(max_speed=1.0, max_accel=1.0)
TOLERANCE_M = 1e-3


def lamp(radius: float, **motion: Any) -> MovingObstacles:
    return MovingObstacles([Obstacle(circle={"center": (0, 0), "radius": radius}, motion=motion)])


@given(st.floats(-9.0, -3.0), st.sampled_from([-1.0, 1.0]), st.sampled_from([-1.0, 1.0]))
@example(-9.0, 1.0, 1.0)
def test_where_a_path_nearly_turns_back_a_body_is_in_all_headings_of_its_turn_and_in_no_other(
    exponent: float, turns: float, beside: float
) -> None:
    wide = turns * 10.0**exponent
    path = PiecewiseCubic([[(0, 0), (4, 0), (4, wide), (0, wide)]])  # back on one side of its way
    law = retime(path, LIMITS)
    lit = lamp(0.1, keyframes=[[0, 3, 2 * beside]], after="stay")
    found = certify_moving(path, law, lit, 0.1, footprint=BODY)
    reach = math.hypot(FRONT if turns == beside else REAR, HALF)
    assert found.clearance == pytest.approx(2.0 - 0.1 - reach, abs=2e-3)


def test_while_it_stands_at_a_cusp_a_body_may_turn_either_way() -> None:
    path = CardinalSpline([(0, 0), (10, 0), (4, 0)])
    at = float(corners(path)[0][0])
    law = retime(path, LIMITS, [Station(at, 4.0, "turn")])
    x, begin = float(path.at_distance(at)[0]), float(law.times[law.distances >= at - 1e-6][0])
    away, near = [x, 9.0], [x, 2.0]
    passes = [[begin + 1.0, *away], [begin + 2.0, *near], [begin + 3.0, *away]]
    lit = lamp(0.3, keyframes=passes, after="vanish")
    found = certify_moving(path, law, lit, 0.1, footprint=BODY)
    assert found.clearance == pytest.approx(2.0 - 0.3 - math.hypot(FRONT, HALF), abs=2e-3)


def drawn(seed: int) -> tuple[CardinalSpline, Obstacle]:
    """A path that turns back, more or less, and what passes it there or elsewhere."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(0, 12, (int(rng.integers(3, 6)), 2))
    points[2] = points[1] + (points[0] - points[1]) * rng.uniform(0.2, 1.2)
    points[2] += rng.normal(0, 1, 2) * 10.0 ** rng.uniform(-12, -1)
    path = CardinalSpline(points, tension=float(rng.uniform(-0.5, 1)))
    u = np.linspace(0, len(path.spans), 2000)
    sharpest = float(u[np.abs(path.curvature(u)).argmax()])
    at = np.asarray(path.evaluate(sharpest if rng.random() < 0.7 else u[rng.integers(2000)]))
    when, speed = float(path.distance(sharpest)) + rng.uniform(-1, 1), rng.uniform(-1, 1, 2)
    start = at + rng.uniform(-2, 2, 2) - when * speed
    long, wide = rng.uniform(0.1, 1.2, 2)
    ring = ((-long, -wide), (long, -wide), (long, wide), (-long, wide))
    motion = {"from": start.tolist(), "velocity_mps": speed.tolist()}
    return path, Obstacle(polygon=ring, motion=motion)


@given(st.integers(0, 100_000))
@example(24)
def test_the_distance_of_a_body_is_known_to_a_millimetre_wherever_it_turns(seed: int) -> None:
    path, passing = drawn(seed)
    law, moving = retime(path, LIMITS), MovingObstacles([passing])
    timed, body = timed_path(path, law), outline(BODY)
    lower, upper, *_ = moving_tightest(timed, moving.packed, body, math.nan, 0.0, TOLERANCE_M, 0.1)
    assert upper - lower <= TOLERANCE_M + 1e-9
    times = np.linspace(law.start_time, law.end_time, 3000)
    s = np.clip(law.distance_at(times), 1e-6, path.length - 1e-6)
    headings = np.asarray(path.heading(path.parameter(s)))[:, None]
    cos, sin, places = np.cos(headings), np.sin(headings), np.asarray(path.at_distance(s))
    x, y = np.array(BODY).T
    bodies = np.stack([cos * x - sin * y + places[:, :1], sin * x + cos * y + places[:, 1:]], 2)
    assert passing.motion is not None
    moved = np.array(passing.motion.from_) + times[:, None] * np.array(passing.motion.velocity_mps)
    rings = np.asarray(passing.polygon)[None] + moved[:, None]
    gaps = shapely.distance(shapely.polygons(bodies), shapely.polygons(rings))
    assert lower <= gaps.min() + 1e-5
