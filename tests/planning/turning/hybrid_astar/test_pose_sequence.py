"""Ways through rows of places: their headings fit, and what is told where there is none."""

import dataclasses
import math

import numpy as np
import pytest
from searched_poses import DISC, RAMP, RHO, box, find_poses, is_sound, walls

from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError, WorkBudget
from viaspline.planning.turning.hybrid_astar.pose_sequence import find_row
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Goal,
    NotFound,
    Pose,
    Reason,
)
from viaspline.world.world import World


def test_a_row_of_places_joins_with_headings_that_fit():
    start = Pose(-10, 0, 0)
    goals = [Goal(5.5, 3.8), Goal(14.5, -3.2), Goal(22, 5, (1.0,))]
    chains = find_row(walls(), DISC, RHO, RAMP, [start], goals, WorkBudget(9.0))
    assert not isinstance(chains, NotFound)
    for chain, goal in zip(chains, goals, strict=True):
        is_sound(chain, walls(), DISC, start, goal)
        start = chain.end


def test_a_row_says_which_place_cannot_be_come_to():
    goals = [Goal(0, 5), Goal(5.5, 0), Goal(22, 5)]
    found = find_row(walls(), DISC, RHO, RAMP, [Pose(-10, 0, 0)], goals, WorkBudget(9.0))
    assert isinstance(found, NotFound)
    assert (found.reason, found.goal) == (Reason.GOAL_TAKEN, 1)


def test_a_row_says_that_a_place_cannot_be_come_to_from_anywhere():
    """A dead end is left by its open side, but only come to backwards; all around is open."""
    pocket = [box(-1.2, -1, 8, -0.8), box(-1.2, 0.8, 8, 1), box(-1.2, -0.8, -1, 0.8)]
    world = World(pocket)
    start, goals = Pose(0, 0, 0.0), [Goal(20, 9), Goal(0, 0, (0.0,))]
    found = find_row(world, DISC, RHO, RAMP, [start], goals, WorkBudget(9.0))
    assert isinstance(found, NotFound)
    assert (found.reason, found.goal) == (Reason.GOAL_SHUT_IN, 1)
    one = find_row(world, DISC, RHO, RAMP, [start], goals[:1], WorkBudget(9.0))
    assert isinstance(one, tuple)


def test_headings_at_a_place_in_a_corner_are_told_from_what_comes_after_it():
    # by the shortest arrivals there the robot can't leave it again
    room, needs = World(bounds=(0, 0, 12, 12)), Requirements(radius=0.3, clearance=0.0)
    start, goals = Pose(5.82, 1.04, -2.49), [Goal(11.06, 11.57), Goal(7.8, 5.05, (1.31,))]
    chains = find_row(room, needs, 1.0, 1.0, [start], goals, WorkBudget(12.0))
    for chain, goal in zip(chains, goals, strict=True):
        is_sound(chain, room, needs, start, goal, 1.0)
        start = chain.end


def test_a_proof_is_none_where_a_little_sharper_turns_come_through():
    far = DISC.required + RHO - 0.03
    world = World([box(-60, far, 60, far + 1)], bounds=(-70, -70, 70, 70))
    found = find_poses(world, DISC, RHO, RHO, Pose(0, 0, math.pi / 2), Goal(20, -12))
    assert isinstance(found, NotFound)
    assert found.reason is Reason.CLOSE


def row_in_steps(limit, finished):
    """What a row of places comes to in steps that may spend so much, and how many those were."""
    start, goals = Pose(-10, 0, 0), [Goal(5.5, 3.8), Goal(14.5, -3.2), Goal(22, 5, (1.0,))]
    for step in range(1, 500):
        needs = dataclasses.replace(DISC, budget=WorkBudget(limit, finished=dict(finished)))
        try:
            return find_row(walls(), needs, RHO, RAMP, [start], goals, WorkBudget(9.0)), step
        except SpentBudgetError:
            assert needs.budget.spent <= limit
            assert needs.budget.has_gained
            finished = needs.budget.finished
    raise AssertionError("it doesn't end")


def test_a_search_that_is_stopped_and_taken_up_comes_to_what_it_comes_to_at_once():
    at_once, one = row_in_steps(math.inf, {})
    in_steps, several = row_in_steps(0.05, {})
    assert one == 1
    assert several > 2
    for chain, other in zip(at_once, in_steps, strict=True):
        assert other.length == pytest.approx(chain.length, rel=1e-3)


def test_a_step_leaves_what_the_step_before_had_of_a_search_as_it_was():
    needs = dataclasses.replace(DISC, budget=WorkBudget(0.05))
    start, goals = Pose(-10, 0, 0), [Goal(5.5, 3.8), Goal(14.5, -3.2), Goal(22, 5, (1.0,))]
    with pytest.raises(SpentBudgetError):
        find_row(walls(), needs, RHO, RAMP, [start], goals, WorkBudget(9.0))
    before = needs.budget.finished
    rows = [row_in_steps(0.05, before) for _ in range(2)]
    (first, steps), (second, again) = rows
    assert steps == again
    for chain, other in zip(first, second, strict=True):
        np.testing.assert_array_equal(chain.spans, other.spans)
