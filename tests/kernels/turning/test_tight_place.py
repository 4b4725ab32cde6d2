import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.turning.tight_place import (
    ALONG_X,
    ALONG_Y,
    GAP,
    OFF_X,
    OFF_Y,
    U,
    X,
    Y,
    tight_place,
)
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

SAMPLES, STEP = 9, 1e-6


def discs(rng, count):
    return World(
        [
            Obstacle(
                circle={"center": tuple(rng.uniform(-4, 14, 2)), "radius": rng.uniform(0.1, 1)}
            )
            for _ in range(count)
        ]
    )


@given(st.integers(0, 10**6))
def test_it_is_the_nearest_sample_with_the_ways_along_the_curve_and_off_the_world(seed):
    rng = np.random.default_rng(seed)
    world, spans = discs(rng, 6), rng.uniform(0, 10, (int(rng.integers(1, 4)), 4, 2))
    spans[1:, 0] = spans[:-1, 3]
    curve = PiecewiseCubic(spans)
    found = tight_place(world.packed, spans, SAMPLES, STEP)
    parameters = np.linspace(0, len(spans), SAMPLES * len(spans))
    gaps = world.distance(curve.evaluate(parameters))
    place = found[[X, Y]]
    assert abs(gaps.min() - found[GAP]) < 1e-9
    assert np.allclose(curve.evaluate(found[U]), place, atol=1e-9)
    assert np.isclose(parameters, found[U], atol=1e-9).any()
    heading = curve.heading(found[U])
    assert np.allclose(found[[ALONG_X, ALONG_Y]], [np.cos(heading), np.sin(heading)], atol=1e-6)
    if len(np.unique(world.nearest(place + np.array([[1e-3, 0], [-1e-3, 0], [0, 1e-3]]))[1])) == 1:
        away = place - world.obstacles[int(world.nearest(place)[1])].circle.center
        assert np.allclose(found[[OFF_X, OFF_Y]], away / np.linalg.norm(away), atol=1e-3)


def test_of_places_equally_near_it_is_the_first():
    straight = np.linspace([0.0, 0.0], [3.0, 0.0], 4)[None]
    wall = World([Obstacle(polygon=[(-5, 1), (8, 1), (8, 3), (-5, 3)])])
    found = tight_place(wall.packed, straight, SAMPLES, STEP)
    assert found[[U, X, Y, GAP]].tolist() == [0.0, 0.0, 0.0, 1.0]
    assert np.allclose(found[[OFF_X, OFF_Y]], [0.0, -1.0])


def test_a_place_without_a_direction_is_told_as_along_x():
    stuck = np.zeros((1, 4, 2))
    found = tight_place(World().packed, stuck, SAMPLES, STEP)
    assert found[[ALONG_X, ALONG_Y]].tolist() == [1.0, 0.0]
    assert found[GAP] == np.inf
