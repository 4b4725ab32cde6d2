"""A search stops where what it may spend is spent, at the same place every time."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest

from viaspline.errors import GaveUpError
from viaspline.mission.model import Mission
from viaspline.planning.plan_drive import find_drive
from viaspline.planning.problem.method import Found, GaveUp, Outcome, first_settled
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError, WorkBudget
from viaspline.world.world import World


def cramped() -> Mission:
    """Via points too near to each other for the turning circle, which takes many headings."""
    return Mission.model_validate({
        "world": {"known": [{"circle": {"center": [6, 1], "radius": 1}}]},
        "robot": {"radius_m": 0.3, "clearance_m": 0.2, "min_turn_radius_m": 2},
        "route": {"start": [0, 0], "via": [[9, 0], [9, 1], [8, 3]], "goal": [0, 4]},
    })  # fmt: skip


def spent_by(limit: float) -> tuple[float, bool]:
    mission, budget = cramped(), WorkBudget(limit)
    requirements = replace(Requirements.of(mission), budget=budget)
    try:
        find_drive(mission, World.known(mission), requirements)
    except SpentBudgetError:
        return budget.spent, False
    return budget.spent, True


def test_a_step_that_costs_more_than_is_left_is_not_begun() -> None:
    budget = WorkBudget(1.0)
    budget.spend(0.75)
    with pytest.raises(SpentBudgetError, match="plan anew"):
        budget.spend(0.5)
    budget.spend(0.25)
    assert budget.spent == 1.0


def test_who_has_spent_his_budget_gave_up_and_has_refused_nothing() -> None:
    with pytest.raises(GaveUpError):
        WorkBudget(0.0).spend(1e-6)


def test_no_search_spends_more_than_it_may_and_with_enough_it_finds_a_path() -> None:
    whole, found = spent_by(float("inf"))
    assert found
    for part in (0.0, 0.01, 0.1, 0.5, 0.99):
        spent, _ = spent_by(part * whole)
        assert spent <= part * whole
    assert spent_by(whole) == (whole, True)


def test_the_same_search_spends_the_same_every_time() -> None:
    for limit in (0.003, 0.02, float("inf")):
        assert len({spent_by(limit) for _ in range(2)}) == 1


class Growth:
    """A part of a search that is stopped and goes on."""

    def __init__(self, size: int = 0) -> None:
        self.size = size

    def copy(self) -> Growth:
        return Growth(self.size)


def test_what_was_taken_up_for_a_part_goes_on_until_that_is_over_and_then_is_let_go() -> None:
    def grown(budget: WorkBudget) -> int:
        growth = budget.taken_up("growth", Growth)
        while growth.size < 5:
            budget.spend_on_part(1.0)
            growth.size += 1
        return growth.size

    first = WorkBudget(3.0)
    with pytest.raises(SpentBudgetError):
        first.once("outer", lambda: first.once("part", lambda: grown(first)))
    assert first.finished["growth"].size == 3
    then = WorkBudget(3.0, finished=dict(first.finished))
    assert then.once("outer", lambda: then.once("part", lambda: grown(then))) == 5
    assert then.spent == 2.0
    assert then.finished == {"part": 5, "outer": 5}
    assert first.finished["growth"].size == 3


def test_what_was_found_before_the_budget_was_spent_is_kept() -> None:
    class Long:
        def lay(self, problem: WorkBudget, bound: float = 0.0) -> Outcome[str]:
            problem.spend(0.5)
            return Found("long", 2.0, is_settled=False)

    for many in (1, 2, 3):
        found = first_settled(list(itertools.repeat(Long(), many)), WorkBudget(0.6))
        assert not isinstance(found, GaveUp)
        assert found.value == "long"
    with pytest.raises(SpentBudgetError):
        first_settled([Long()], WorkBudget(0.1))


@pytest.mark.parametrize("part", [0.5, 0.2, 0.05])
def test_a_search_that_goes_on_finds_what_it_would_have_found_at_once(part: float) -> None:
    mission = cramped()
    world, requirements = World.known(mission), Requirements.of(mission)
    whole = WorkBudget(float("inf"))
    at_once = find_drive(mission, world, replace(requirements, budget=whole)).path
    limit, finished, steps = part * whole.spent, {}, 0
    while True:
        budget, steps = WorkBudget(limit, finished=finished), steps + 1
        try:
            found = find_drive(mission, world, replace(requirements, budget=budget)).path
        except SpentBudgetError:
            limit, finished = limit * (1.0 if budget.has_gained else 2.0), budget.finished
            continue
        break
    np.testing.assert_array_equal(found.spans, at_once.spans)
    assert steps > 1
    assert budget.spent < whole.spent


def test_a_part_that_is_over_is_not_done_again_and_one_that_was_stopped_is() -> None:
    budget, done = WorkBudget(1.0), []

    def part(cost: float) -> str:
        budget.spend(cost)
        done.append(cost)
        return f"{cost}"

    assert [budget.once("a", lambda: part(0.5)) for _ in range(3)] == ["0.5"] * 3
    with pytest.raises(SpentBudgetError):
        budget.once("b", lambda: part(0.75))
    assert done == [0.5]
    budget = WorkBudget(1.0, finished=dict(budget.finished))
    assert budget.once("a", lambda: part(0.5)) == "0.5"
    assert not budget.has_gained
    assert budget.once("b", lambda: part(0.75)) == "0.75"
    assert budget.has_gained
    assert done == [0.5, 0.75]


def test_tries_that_share_a_budget_spend_no_more_than_it_has() -> None:
    whole = WorkBudget(1.0)
    with whole.share(0.75) as one:
        one.spend(0.5)
    with pytest.raises(SpentBudgetError), whole.share(0.25) as two:
        two.spend(0.5)
    assert whole.spent == 0.5
    assert not whole.is_spent
    with whole.share(0.75) as three:
        three.spend(0.25)
    with pytest.raises(SpentBudgetError), whole.share(0.75) as four:
        four.spend(0.375)
    assert whole.is_spent
    assert whole.left == 0.0
