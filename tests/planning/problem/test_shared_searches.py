"""Searches that plans have in common are done once, and every plan is what it is alone."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.problem.shared_searches import SharedSearches
from viaspline.planning.problem.work_budget import SpentBudgetError, WorkBudget
from viaspline.planning.turning.hybrid_astar import pose_sequence

costs = st.lists(st.sampled_from((0.1, 0.25, 0.3)), max_size=6)
asked = st.lists(st.tuples(costs, st.sampled_from((0.5, 1.0)), st.sampled_from((0.0, 0.2))))


@given(asked)
def test_a_search_that_is_done_spends_and_ends_as_if_it_were_done_anew(
    searches: list[tuple[list[float], float, float]],
) -> None:
    shared = SharedSearches()
    for steps, limit, spent in searches:
        alone, other = WorkBudget(limit, spent), WorkBudget(limit, spent)
        expected = _outcome(partial(_spent, alone, steps))
        search = partial(_spent, other, steps)
        found = _outcome(partial(shared.once, tuple(steps), [other], search))
        assert (found, other.spent) == (expected, alone.spent)
    assert len(shared.done) == len({(tuple(steps), *left) for steps, *left in searches})


def _spent(budget: WorkBudget, steps: list[float]) -> int:
    for cost in steps:
        budget.spend(cost)
    return len(steps)


def _outcome(search: Callable[[], int]) -> int | str:
    try:
        return search()
    except SpentBudgetError as error:
        return str(error)


def between_posts(seed: int, tension: float | str) -> vs.Mission:
    """A robot that sets off the wrong way among posts, with a turning circle."""
    random, known = np.random.default_rng(seed), []
    for _ in range(14):
        place, radius = random.uniform(0, 12, 2), float(random.uniform(0.4, 1.0))
        if min(np.hypot(*(place - at)) for at in ((0, 0), (12, 12), (6, 6))) > radius + 0.9:
            circle = {"center": place.round(2).tolist(), "radius": round(radius, 2)}
            known.append({"circle": circle})
    return vs.Mission.model_validate(
        {
            "world": {"known": known, "bounds": [-3, -3, 15, 15]},
            "robot": {"radius_m": 0.4, "clearance_m": 0.1, "min_turn_radius_m": 2.0},
            "route": {
                "start": {"at": [0, 0], "heading_deg": 180},
                "via": [[6, 6]],
                "goal": {"at": [12, 12], "heading_deg": -90},
            },
            "spline": {"tension": tension},
        }
    )


@pytest.mark.parametrize("seed", [12, 20])
def test_with_auto_poses_are_searched_once_for_all_tensions(
    monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    """They were searched for each of three tensions, and found the same."""
    count, through = 0, pose_sequence.through

    def counted(*args: Any) -> Any:
        nonlocal count
        count += 1
        return through(*args)

    monkeypatch.setattr(pose_sequence, "through", counted)
    plans, searched = [], []
    for tension in ("auto", 0.0, -0.5, 0.5):
        count = 0
        plans.append(vs.plan(between_posts(seed, tension)))
        searched.append(count)
    assert searched[0] == searched[1] > 0
    assert any(np.array_equal(plans[0].path.spans, other.path.spans) for other in plans[1:])
