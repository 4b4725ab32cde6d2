"""Shortcuts are looked for a little at a time, and come to the same."""

import dataclasses
import math

import numpy as np
from searched_poses import DISC, RAMP, RHO, walls

from viaspline.planning.turning.hybrid_astar.pose_search import (
    SEARCH_EFFORTS,
    pose_problems,
)
from viaspline.planning.turning.hybrid_astar.row_layers import SHARE_AFTER_FIRST
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Goal,
    Pose,
)
from viaspline.planning.turning.hybrid_astar.shortcut_search import FIRST_SLICE, ShortcutSearch


def shortcuts_of(problem, start, goal, segments):
    rho, ramp = problem.moves.sizes[:2].tolist()
    begin = np.array([start.x, start.y, start.heading])
    return ShortcutSearch(problem.search_window.cache, begin, goal, segments, rho, ramp)


def test_shortcuts_along_walls_are_looked_for_a_little_at_a_time():
    start, goal = Pose(-10, 0, 0), Goal(22, 5)
    places = np.array([(start.x, start.y), (goal.x, goal.y)])
    problem = next(pose_problems(walls(), DISC, RHO, RAMP, places, SEARCH_EFFORTS[0]))
    begin, to = np.array([[*dataclasses.astuple(start), 0.0]]), np.array([math.nan])
    tree = problem.forwards(begin, goal, to, SHARE_AFTER_FIRST)
    while not tree.is_over:
        tree.go_on()
    arrival, end = tree.arrivals()[0], np.array([goal.x, goal.y, math.nan])
    at_once = shortcuts_of(problem, start, end, arrival.segments)
    at_once.effort = 1 << 40
    while not at_once.is_over:
        at_once.go_on()
    search, steps = shortcuts_of(problem, start, end, arrival.segments), 0
    while not search.is_over:
        before, search, steps = search, search.copy(), steps + 1
        search.effort = FIRST_SLICE
        search.go_on()
        looked_up = search._cache.reckoned - before._cache.reckoned
        assert looked_up[0] + looked_up[1] // 5 < FIRST_SLICE + 2000  # with those of a last pair
    assert steps > 10
    assert search.length == at_once.length < arrival.cost
    np.testing.assert_array_equal(search.segments, at_once.segments)
