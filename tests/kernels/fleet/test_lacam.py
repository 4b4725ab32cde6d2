import numpy as np
from hypothesis import given, settings
from lattice_oracles import is_a_way, lattice_of, problems, there_is_a_way

from viaspline.kernels.fleet.lacam import FOUND, GAVE_UP, NONE, lacam
from viaspline.kernels.fleet.lattice_distances import lattice_distances


def solved(neighbours, starts, goals, work=1_000_000):
    distances = lattice_distances(neighbours, goals)
    return lacam(neighbours, starts, goals, distances, work, 1)


@given(problems())
@settings(max_examples=150, deadline=None)
def test_a_way_is_found_where_there_is_one_and_else_it_is_proven_that_there_is_none(problem):
    neighbours, starts, goals = problem
    state, places, _ = solved(*problem)
    if there_is_a_way(*problem):
        assert state == FOUND
        assert is_a_way(neighbours, starts, goals, places)
    else:
        assert state == NONE
        assert places.size == 0


def test_two_robots_pass_each_other_at_a_bay():
    free = np.array([[1, 1, 1, 1, 1], [0, 0, 1, 0, 0]], bool)
    neighbours, ends = lattice_of(free), np.array([0, 4], np.int32)
    state, places, _ = solved(neighbours, ends, ends[::-1].copy())
    assert state == FOUND
    assert is_a_way(neighbours, ends, ends[::-1], places)


def test_robots_that_fill_the_lattice_dont_go_round_in_a_ring():
    neighbours = lattice_of(np.ones((2, 2), bool))
    starts = np.arange(4, dtype=np.int32)
    assert solved(neighbours, starts, np.array([1, 3, 0, 2], np.int32))[0] == NONE


def test_a_crowd_changes_places():
    neighbours = lattice_of(np.ones((9, 9), bool))
    starts = np.arange(0, 81, 2, dtype=np.int32)
    goals = starts[np.random.default_rng(1).permutation(starts.size)]
    state, places, _ = solved(neighbours, starts, goals)
    assert state == FOUND
    assert is_a_way(neighbours, starts, goals, places)


def test_it_gives_up_when_its_work_is_used_up():
    neighbours = lattice_of(np.ones((5, 5), bool))
    ends = np.arange(20, dtype=np.int32)
    state, _, used = solved(neighbours, ends, ends[::-1].copy(), work=40)
    assert (state, used) == (GAVE_UP, 40)
