import numpy as np
from hypothesis import given, settings
from lattice_oracles import problems
from scipy.sparse.csgraph import shortest_path

from viaspline.kernels.fleet.lattice_distances import FAR, lattice_distances


@given(problems())
@settings(max_examples=40, deadline=None)
def test_distances_are_those_of_the_graph(problem):
    neighbours, _, goals = problem
    cell, way = np.nonzero(neighbours >= 0)
    graph = np.zeros((len(neighbours), len(neighbours)))
    graph[cell, neighbours[cell, way]] = 1.0
    expected = shortest_path(graph, unweighted=True)[:, goals].T
    found = lattice_distances(neighbours, goals).astype(float)
    assert np.array_equal(np.where(found == FAR, np.inf, found), expected)
