import math

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from viaspline.kernels.ground import Ground, is_clear
from viaspline.kernels.moves import LEVELS, WAYS, moves_of
from viaspline.kernels.spread import OVER, spread
from viaspline.mission.parts import Obstacle
from viaspline.world.world import World

RHO, RAMP, STEP = 4.0, 1.0, 0.8


def ground(world, discs, pace=0.02):
    rows = np.array(discs, float)
    frame = np.array([-20.0, -20.0, 0.1, pace])
    speeds = np.hypot(1.0 + np.abs(rows[:, 1]) / RHO, rows[:, 0] / RHO)
    rows = np.ascontiguousarray(np.column_stack((rows, speeds)))
    return Ground(world.packed, frame, np.full((400, 400), np.nan), rows)


def chained(segments, count=2000):
    """Places and headings along a chain, by summing up small steps."""
    at = np.concatenate([np.full(count, k) for k in range(len(segments))])
    w = np.tile((np.arange(count) + 0.5) / count, len(segments))
    first, last, length = segments[at].T
    step = length / count
    heading = np.cumsum((first + w * (last - first)) * step)
    middle = heading - 0.5 * (first + w * (last - first)) * step
    return np.cumsum(step * np.cos(middle)), np.cumsum(step * np.sin(middle)), heading


@pytest.mark.parametrize("ramp", [0.3, 1.0, 1.6])
def test_every_move_follows_its_segments_from_level_to_level(ramp):
    moves = moves_of(RHO, ramp, np.array([STEP, 2.5 * STEP]), 0.02)
    for row in range(2 * LEVELS * WAYS):
        scale, level, way = np.unravel_index(row, (2, LEVELS, WAYS))
        step, pace, count = moves.scales[scale]
        last = moves.places[row, int(count) - 1]
        segments = moves.segments[row]
        assert step == pytest.approx(STEP * (1.0, 2.5)[scale])
        assert (pace <= 0.02, pace * count) == (True, pytest.approx(step))
        assert segments[:, 2].sum() == pytest.approx(step)
        assert segments[0, 0] * RHO == pytest.approx((level - 2) / 2)
        assert segments[1, 1] * RHO == pytest.approx((level + way - 3) / 2)
        x, y, heading = chained(segments)
        assert last[:2] == pytest.approx((x[-1], y[-1]), abs=1e-6)
        assert moves.turns[row] == pytest.approx(heading[-1])
        assert math.atan2(last[3], last[2]) == pytest.approx(heading[-1])


def test_a_clear_chain_is_clear_by_brute_force_and_a_chain_with_room_to_spare_is_clear():
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
        found = is_clear(ground(world, held), 0.0, 0.0, 0.0, segments, len(segments))
        assert not found or slack > 0.0
        assert found or slack < 0.02
        outcomes.add(found)
    assert outcomes == {False, True}


def test_lengths_spread_as_dijkstra_finds_them_on_the_graph_of_neighbours():
    cells = (np.random.default_rng(2).random((12, 17)) < 0.35).astype(np.uint8)
    cells[3, 4] = 0
    lengths = spread(cells, np.array([[3, 4]]))
    rows, columns, weights = [], [], []
    for r, c in np.argwhere(cells == 0):
        for dr in (-1, 0, 1):
            for dc in (-1, 0, 1):
                to = (r + dr, c + dc)
                if (dr or dc) and 0 <= to[0] < 12 and 0 <= to[1] < 17 and not cells[to]:
                    rows.append(r * 17 + c)
                    columns.append(to[0] * 17 + to[1])
                    weights.append(math.hypot(dr, dc) / OVER)
    graph = coo_array((weights, (rows, columns)), shape=(cells.size, cells.size)).tocsr()
    assert lengths.ravel() == pytest.approx(dijkstra(graph, indices=3 * 17 + 4))
