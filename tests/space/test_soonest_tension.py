"""A flight whose tension is left to the planner is no later than with any that is tried."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import viaspline as vs
from viaspline.mission.stated_tension import SPARE_SHARE
from viaspline.space.plan_spatial import plan_spatial
from viaspline.space.soonest_tension import TRIED_TENSIONS


def flight(tension: Any, **route: Any) -> vs.Mission:
    return vs.Mission.model_validate({
        "world": {
            "ground": {"flat_m": 0},
            "known": [{"circle": {"center": [60, 12], "radius": 4}, "height_m": [0, 30]}],
        },
        "robot": {"max_speed_mps": 5},
        "route": {"start": [0, 0, 5], "via": [[20, 10, 8], [45, -5, 9]], "goal": [75, 20, 5]}
        | route,
        "spline": {"tension": tension},
    })  # fmt: skip


@pytest.mark.parametrize("optimise", ["time", "length"])
def test_it_is_no_later_than_with_any_tension_by_hand_or_none(optimise: str) -> None:
    def cost(plan: vs.SpatialPlan) -> float:
        return plan.path.length if optimise == "length" else plan.trajectory.duration

    taken = plan_spatial(flight("auto", optimise=optimise))
    others = [plan_spatial(flight(tension, optimise=optimise)) for tension in TRIED_TENSIONS]
    assert cost(taken) <= min(cost(other) for other in others) * (1.0 + SPARE_SHARE)
    by_hand = [plan_spatial(flight(t, optimise=optimise)) for t in (None, -0.5, 0.0, 0.5)]
    assert cost(taken) <= min(cost(other) for other in by_hand) * (1.0 + 1e-6)
    assert cost(taken) < max(cost(other) for other in others)  # it makes a difference
    assert taken.mission.spline.tension in TRIED_TENSIONS
    assert taken in others


def test_what_it_took_is_written_and_read_again(tmp_path: Path) -> None:
    plan = vs.plan(flight("auto"))
    plan.save(tmp_path)
    again = vs.load_plan(tmp_path)
    assert again.mission.spline.tension == plan.mission.spline.tension
    assert again == plan


def test_where_no_tension_helps_it_says_what_is_in_the_way() -> None:
    with pytest.raises(vs.NoPathError, match="'start' is shut in"):
        plan_spatial(
            vs.Mission.model_validate(
                {
                    "world": {
                        "bounds": [0, 0, 20, 20],
                        "altitude": {"min_m": 1, "max_m": 10},
                        "ground": {"flat_m": 0},
                        "known": [{"polygon": [[9, 0], [11, 0], [11, 20], [9, 20]]}],
                    },
                    "route": {"start": [3, 10, 5], "goal": [17, 10, 5]},
                    "spline": {"tension": "auto"},
                }
            )
        )
