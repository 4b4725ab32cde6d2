"""The ledger speaks of the curve that is driven."""

from dataclasses import replace

import numpy as np
import pytest

from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.planning.plan_drive import find_drive
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.world.world import World


def test_the_chosen_curve_of_every_entry_is_the_one_that_is_driven() -> None:
    mission = Mission.model_validate(
        {
            "world": {
                "known": [
                    {"circle": {"center": [25, 1], "radius": 5}},
                    {"circle": {"center": [75, -1], "radius": 5}},
                    {"circle": {"center": [75, 52], "radius": 6}},
                ]
            },
            "route": {"start": [0, 0], "via": [[50, 0], [100, 0], [100, 50]], "goal": [50, 54]},
        }
    )
    result = plan(mission)
    assert len(result.ledger) >= 3
    for entry in result.ledger:
        assert entry.chosen is not None
        spans = entry.chosen.spans
        starts = [k for k in range(len(result.path.spans)) if np.array_equal(
            result.path.spans[k : k + len(spans)], spans)]  # fmt: skip
        assert len(starts) == 1


BOX = [[-0.8, -0.4], [0.8, -0.4], [0.8, 0.4], [-0.8, 0.4]]


@pytest.mark.parametrize(
    "robot", [{"footprint": BOX}, {"min_turn_radius_m": 2}, {"tracking_error_m": 0.1}]
)
def test_the_ledger_is_told_of_when_the_search_has_spent_all_that_it_might(
    robot: dict[str, object],
) -> None:
    mission = Mission.model_validate({
        "world": {"known": [{"circle": {"center": [9, 0.3], "radius": 1}}]},
        "robot": {"clearance_m": 0.2, **robot}, "route": {"start": [0, 0], "goal": [18, 0]},
    })  # fmt: skip
    world, requirements = World.known(mission), Requirements.of(mission)
    budget = WorkBudget(60.0)
    found = find_drive(mission, world, replace(requirements, budget=budget))
    budget.limit = before = budget.spent
    assert found.ledger == find_drive(mission, world, requirements).ledger
    assert found.ledger
    assert (budget.limit, budget.spent) == (before, before)
