from collections import deque

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from lattice_oracles import is_a_way, keeps_a_step_apart, lattice_of, problems

from viaspline.kernels.fleet.lacam import FOUND, lacam
from viaspline.kernels.fleet.lattice_distances import FAR, lattice_distances
from viaspline.kernels.fleet.lattice_table import spaced_out
from viaspline.kernels.fleet.neighbourhood_search import neighbourhood_search
from viaspline.kernels.fleet.prioritised_planning import prioritised_planning

STEPS = 30


def at_once(count):
    """Robots that all depart at the first step, and stay."""
    return np.zeros(count, np.int32), np.zeros(count, np.bool_)


def planned(neighbours, starts, goals, tries=5, departs=None, leaves=None):
    distances = lattice_distances(neighbours, goals)
    assume((distances[np.arange(len(starts)), starts] < FAR).all())
    order = np.arange(len(starts), dtype=np.int32)
    none, stay = at_once(len(starts))
    found, table, _ = prioritised_planning(
        neighbours, starts, goals, distances, none if departs is None else departs,
        stay if leaves is None else leaves, order, STEPS, tries, 1_000_000,
    )  # fmt: skip
    return found, table, distances


def first_arrival(neighbours, first, start, goal, departs=0, stays=True):
    """Of a robot that keeps a step apart from one whose places are known, -1 where it isn't."""
    seen, queue = {(start, 0)}, deque([(start, 0)])
    while queue:
        cell, step = queue.popleft()
        is_over = step >= departs or start != goal
        if cell == goal and is_over and not (stays and goal in first[step:]):
            return step
        if step + 1 == STEPS:
            continue
        for to in (cell, *neighbours[cell]):
            moves = to != cell
            meets = first[step + 1] == to or (
                moves and (first[step] == to or first[step + 1] == cell)
            )
            meets = meets or (moves and step < departs)
            if to >= 0 and not meets and (to, step + 1) not in seen:
                seen.add((to, step + 1))
                queue.append((to, step + 1))
    return None


@given(problems())
@settings(max_examples=100, deadline=None)
def test_paths_lead_from_start_to_goal_and_keep_a_step_apart(problem):
    found, table, _ = planned(*problem)
    if found:
        assert is_a_way(*problem, table.places)
        assert keeps_a_step_apart(table.places)
        still = table.places == table.places[:, -1:]
        assert [int(row[::-1].argmin()) or STEPS for row in still] == [
            STEPS - arrival for arrival in table.arrivals
        ]


@pytest.mark.long_without_jit
@given(problems(most_cells=9, most_robots=2))
@settings(max_examples=100, deadline=None)
def test_the_second_robot_arrives_as_early_as_the_first_allows(problem):
    neighbours, starts, goals = problem
    assume(len(starts) == 2)
    found, table, distances = planned(*problem, tries=1)
    assert table.arrivals[0] == distances[0, starts[0]]
    first = table.places[0]
    expected = first_arrival(neighbours.tolist(), first.tolist(), int(starts[1]), int(goals[1]))
    assert found == (expected is not None)
    if found:
        assert table.arrivals[1] == expected


@pytest.mark.long_without_jit
@given(problems(most_cells=9, most_robots=2), st.data())
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
def test_robots_depart_when_they_may_and_leave_their_goals_to_others(problem, data):
    neighbours, starts, goals = problem
    assume(len(starts) == 2 and (starts != goals).all())
    departs = np.array(data.draw(st.tuples(*[st.integers(0, 6)] * 2)), np.int32)
    leaves = np.array(data.draw(st.tuples(st.booleans(), st.booleans())), np.bool_)
    found, table, distances = planned(*problem, tries=1, departs=departs, leaves=leaves)
    assert table.arrivals[0] == distances[0, starts[0]] + departs[0]
    first = table.places[0].tolist()
    if leaves[0]:
        gone = int(table.arrivals[0]) + 1
        first[gone:] = [-1] * (STEPS - gone)
    expected = first_arrival(
        neighbours.tolist(), first, int(starts[1]), int(goals[1]), int(departs[1]),
        not bool(leaves[1]),
    )  # fmt: skip
    assert found == (expected is not None)
    if found:
        assert table.arrivals[1] == expected
        for robot in range(2):
            assert (table.places[robot, : departs[robot] + 1] == starts[robot]).all()


@given(problems())
@settings(max_examples=60, deadline=None)
def test_ways_that_are_spaced_out_keep_a_step_apart(problem):
    neighbours, starts, goals = problem
    distances = lattice_distances(neighbours, goals)
    state, places, _ = lacam(neighbours, starts, goals, distances, 100_000, 1)
    assume(state == FOUND)
    spaced, count = spaced_out(places, len(neighbours))
    assert is_a_way(*problem, spaced[:, :count])
    assert keeps_a_step_apart(spaced[:, :count])


@pytest.mark.long_without_jit
def test_a_better_set_of_paths_is_still_one():
    neighbours = lattice_of(np.random.default_rng(3).random((12, 12)) > 0.1)
    rng = np.random.default_rng(4)
    starts, goals = (rng.permutation(len(neighbours))[:12].astype(np.int32) for _ in range(2))
    distances = lattice_distances(neighbours, goals)
    order = np.arange(12, dtype=np.int32)
    found, table, _ = prioritised_planning(
        neighbours, starts, goals, distances, *at_once(12), order, 60, 20, 1_000_000
    )
    assert found
    before = int(table.arrivals.sum())
    after = neighbourhood_search(neighbours, starts, goals, distances, table, 4, 100_000, 1)
    least = distances[np.arange(12), starts].sum()
    assert least <= after < before
    assert after == table.arrivals.sum()
    assert is_a_way(neighbours, starts, goals, table.places)
    assert keeps_a_step_apart(table.places)
