import numpy as np
import pytest

from viaspline.kernels.turning.collision_cache import LOOKED_UP, CollisionCache, is_clear
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

RHO = 4.0
NO_BARRIERS = np.empty((0, 4))


def cache(world, discs, pace=0.02, barriers=NO_BARRIERS):
    rows = np.array(discs, float)
    frame = np.array([-20.0, -20.0, 0.1, pace])
    speeds = np.hypot(1.0 + np.abs(rows[:, 1]) / RHO, rows[:, 0] / RHO)
    rows = np.ascontiguousarray(np.column_stack((rows, speeds)))
    return CollisionCache(
        world.packed, frame, np.zeros((400, 400)), np.zeros((50, 50)), rows, barriers,
        np.zeros(2, np.int64),
    )  # fmt: skip


@pytest.mark.long_without_jit
def test_a_clear_chain_is_clear_by_brute_force_and_a_chain_with_room_to_spare_is_clear(chained):
    rng = np.random.default_rng(5)
    discs = [(0.0, 0.0, 0.6), (1.0, 0.0, 0.5), (1.0, 0.4, 0.3)]
    held = [(0.5, 0.1, 1.2), *discs]
    outcomes = set()
    for _ in range(60):
        circles = [
            Obstacle(circle={"center": tuple(rng.uniform(-8, 8, 2)), "radius": rng.uniform(0.2, 2)})
            for _ in range(6)
        ]
        world = World(circles)
        bend = rng.uniform(-0.25, 0.25)
        segments = np.array([[0, bend, 1.0], [bend, bend, 5.0], [bend, 0, 1.0], [0, 0, 2.0]])
        x, y, heading = chained(segments)
        c, s = np.cos(heading), np.sin(heading)
        slack = min(
            (world.distance(np.column_stack((x + c * a - s * b, y + s * a + c * b))) - r).min()
            for a, b, r in discs
        )
        found = is_clear(cache(world, held), 0.0, 0.0, 0.0, segments, len(segments))
        assert not found or slack > 0.0
        assert found or slack < 0.02
        outcomes.add(found)
    assert outcomes == {False, True}


def test_distances_that_are_looked_up_are_counted_for_each_disc_of_the_body():
    world = World([Obstacle(circle={"center": (5.0, 3.0), "radius": 1.0})])
    line = np.array([[0.0, 0.0, 10.0]])
    one = cache(world, [(0.0, 0.0, 1.9)])
    many = cache(world, [(0.0, 0.0, 3.0), *((0.1 * k, 0.0, 1.9) for k in range(20))])
    for each in (one, many):
        assert is_clear(each, 0.0, 0.0, 0.0, line, 1)
    assert many.reckoned[LOOKED_UP] > 10 * one.reckoned[LOOKED_UP]


def test_what_lies_far_along_a_chain_is_seen_without_all_that_is_before_it():
    posts = [
        Obstacle(circle={"center": (x, side * 1.7), "radius": 1.0})
        for x in range(-10, 10, 2)
        for side in (-1, 1)
    ]
    wall = Obstacle(circle={"center": (14.0, 0.0), "radius": 2.0})
    line = np.array([[0.0, 0.0, 28.0]])
    free, shut = (cache(World(things), [(0.0, 0.0, 0.65)]) for things in (posts, [*posts, wall]))
    assert is_clear(free, -12.0, 0.0, 0.0, line, 1)
    assert not is_clear(shut, -12.0, 0.0, 0.0, line, 1)
    assert shut.reckoned[LOOKED_UP] < 0.15 * free.reckoned[LOOKED_UP]  # coarse looks among them
