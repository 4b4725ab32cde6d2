import numpy as np
import pytest

from viaspline.kernels.turning.collision_cache import CollisionCache, is_clear
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
        world.packed, frame, np.zeros((400, 400)), rows, barriers, np.zeros(1, np.int64)
    )


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
