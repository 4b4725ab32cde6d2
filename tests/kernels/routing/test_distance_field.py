import math

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from viaspline.kernels.routing.distance_field import OCTILE_EXCESS, distance_field


def test_lengths_spread_as_dijkstra_finds_them_on_the_graph_of_neighbours():
    cells = (np.random.default_rng(2).random((12, 17)) < 0.35).astype(np.uint8)
    cells[3, 4] = 0
    lengths = distance_field(cells, np.array([[3, 4]]))
    rows, columns, weights = [], [], []
    for r, c in np.argwhere(cells == 0):
        for dr in (-1, 0, 1):
            for dc in (-1, 0, 1):
                to = (r + dr, c + dc)
                if (dr or dc) and 0 <= to[0] < 12 and 0 <= to[1] < 17 and not cells[to]:
                    rows.append(r * 17 + c)
                    columns.append(to[0] * 17 + to[1])
                    weights.append(math.hypot(dr, dc) / OCTILE_EXCESS)
    graph = coo_array((weights, (rows, columns)), shape=(cells.size, cells.size)).tocsr()
    assert lengths.ravel() == pytest.approx(dijkstra(graph, indices=3 * 17 + 4))
