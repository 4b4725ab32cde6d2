"""Turn paths that nothing pushes any further, against all rounds gone one after the other."""

from __future__ import annotations

import numpy as np
import pytest

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError, WorkBudget
from viaspline.planning.turning import repair
from viaspline.planning.turning.bend_row import Bends, bend
from viaspline.planning.turning.repair import MAX_PUSH_ROUNDS
from viaspline.planning.turning.turn_path import TurnPath
from viaspline.world.world import World

Outcome = tuple[object, float, int]


def discs(random: np.random.Generator) -> World:
    """Some of them, mostly in the way."""
    found = []
    for _ in range(int(random.integers(1, 6))):
        center = (float(random.uniform(1.0, 9.0)), float(random.uniform(-1.5, 1.5)))
        found.append(Obstacle(circle={"center": center, "radius": float(random.uniform(0.1, 0.8))}))
    return World(found)


def outcome(world: World, limit: float) -> Outcome:
    """What comes of a row of bends, what that cost, and how often it is pushed."""
    rows = [bend(0.0, 0.0), bend(5.0, 0.3, 0.5, 1.0), bend(10.0, 0.0)]
    bends = Bends.free(np.array(rows), np.array([0, -1, 1])).turning(0.8)
    budget, pushes = WorkBudget(limit), []
    asked = Requirements(radius=0.4, clearance=0.05, turn_radius=0.8).within(budget)
    push = repair._pushed
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(repair, "_pushed", lambda *given: pushes.append(1) or push(*given))
        try:
            found = repair.clear_turn_path_or_why(bends, world, asked)
        except SpentBudgetError:
            return "spent", limit, len(pushes)
    if isinstance(found, TurnPath):
        return found.spans.tobytes(), budget.spent, len(pushes)
    places = found.places(asked.unbudgeted)
    return [(leg, place.tolist()) for leg, place in places], budget.spent, len(pushes)


def test_a_path_that_is_pushed_in_place_ends_where_all_rounds_would_and_costs_as_much(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    random = np.random.default_rng(0)
    cases = [(discs(random), limit) for _ in range(300) for limit in (np.inf, 0.006)]
    found = [outcome(*case) for case in cases]
    monkeypatch.setattr(repair, "_are_one", lambda first, second: False)
    every_round = [outcome(*case) for case in cases]
    assert [each[0] for each in found] == [each[0] for each in every_round]
    assert [each[1] for each in found] == pytest.approx([each[1] for each in every_round])
    saved = [many - few for (*_, few), (*_, many) in zip(found, every_round, strict=True)]
    assert min(saved) == 0
    assert max(saved) > MAX_PUSH_ROUNDS // 2
    assert any(isinstance(kind, str) for kind, *_ in found)


def test_where_a_path_got_stuck_is_found_with_what_a_later_step_may_spend() -> None:
    """It was asked of the step's budget in which it got stuck: none of the later ones came on."""
    rows = [bend(0.0, 0.0), bend(5.0, 0.3, 0.5, 1.0), bend(10.0, 0.0)]
    bends = Bends.free(np.array(rows), np.array([0, -1, 1])).turning(0.8)
    wall = World([Obstacle(polygon=[[7, -6], [8, -6], [8, 6], [7, 6]])])
    asked = Requirements(radius=0.4, clearance=0.05, turn_radius=0.8)
    first, later = WorkBudget(1.0), WorkBudget(1.0)
    stuck = repair.clear_turn_path_or_why(bends, wall, asked.within(first))
    assert isinstance(stuck, repair.Stuck)
    first.limit = first.spent
    assert stuck.places(asked.within(later))
    assert later.spent > 0.0
