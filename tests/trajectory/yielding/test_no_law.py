"""Where there is no law past what moves: who is in the way, and what would help."""

from typing import Any

import pytest
from on_a_line import LIMITS, cart, line, parked

import viaspline as vs
from viaspline.errors import GaveUpError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.method import Found, GaveUp, Refusal
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.trajectory.limits import Station
from viaspline.trajectory.yielding import no_law
from viaspline.trajectory.yielding.law_among import law_among
from viaspline.world.moving_obstacles import MovingObstacles


def test_who_cannot_brake_in_time_is_refused() -> None:
    moving = MovingObstacles([parked(6.0, [[0, 0, 0]], "stay")])
    outcome = law_among(line(), LIMITS, moving=moving, required=0.5, start=3.5, start_speed=2.0)
    assert isinstance(outcome, Refusal)
    assert "'cart'" in outcome.reason


def test_who_is_run_over_at_the_start_is_told_to_depart_later() -> None:
    moving = MovingObstacles([parked(0.0, [[0, 0, -1], [1, 0, 0], [7, 0, 0], [9, 0, 9]], "stay")])
    outcome = law_among(line(), LIMITS, moving=moving, required=0.5)
    assert isinstance(outcome, Refusal)
    later = float(outcome.reason.split("depart ")[1].split(" s later")[0])
    assert 7.0 < later < 8.0
    assert isinstance(
        law_among(line(), LIMITS, moving=moving, required=0.5, start_time=later), Found
    )


def test_what_stands_at_the_start_already_is_named() -> None:
    moving = MovingObstacles([parked(0.0, [[0, 0, 0], [4, 0, 8]], "stay")])
    outcome = law_among(line(), LIMITS, moving=moving, required=0.5)
    assert isinstance(outcome, Refusal)
    assert "0.0 m along the path, 'cart'" in outcome.reason
    assert "depart" in outcome.reason


def test_an_end_that_is_run_over_is_held_for_less() -> None:
    moving = MovingObstacles([parked(30.0, [[0, 0, -9], [25, 0, -9], [35, 0, 9]], "loop")])
    outcome = law_among(line(), LIMITS, moving=moving, required=0.5, hold=60.0)
    assert not isinstance(outcome, Found)
    said = outcome.reason if isinstance(outcome, Refusal) else outcome.would_help
    least = float(said.split("hold ")[1].split(" s at most")[0])
    for hold, kind in ((least, Found), (least + 2.0, (Refusal, GaveUp))):
        assert isinstance(law_among(line(), LIMITS, moving=moving, required=0.5, hold=hold), kind)


def test_what_stands_on_the_path_for_good_is_no_law_and_says_so() -> None:
    moving = MovingObstacles([parked(20.0, [[0, 0, 3], [4, 0, 0]], "stay")])
    outcome = law_among(line(), LIMITS, moving=moving, required=0.5)
    assert isinstance(outcome, Refusal)
    assert "'cart'" in outcome.reason


def test_a_robot_that_is_at_the_end_has_no_law_past_what_runs_it_over() -> None:
    cart = Obstacle(
        circle={"center": (0, 0), "radius": 0.6}, motion={"from": (30, 8), "velocity_mps": (0, -1)}
    )
    found = law_among(
        line(), LIMITS, moving=MovingObstacles([cart]), required=0.3, start=30.0, hold=20.0
    )
    assert isinstance(found, Refusal)
    assert "at the end of its path, where 'moving obstacle 1' comes nearer" in found.reason


def test_a_spent_budget_is_no_refusal() -> None:
    moving = MovingObstacles([cart(15, -8, 1)])
    outcome = law_among(line(), LIMITS, moving=moving, required=0.5, budget=WorkBudget(1e-9))
    assert isinstance(outcome, GaveUp)
    assert "depart_s" in outcome.would_help


def test_what_cuts_a_proof_off_is_not_taken_for_one(monkeypatch: pytest.MonkeyPatch) -> None:
    moving = MovingObstacles([parked(15.0, [[0, 0, 0], [1, 0, 0]], "stay")])
    assert isinstance(law_among(line(), LIMITS, moving=moving, required=0.5), Refusal)
    monkeypatch.setattr(no_law, "PROOF_S", 1e-6)
    budget = WorkBudget(1e-6)
    outcome = law_among(line(), LIMITS, moving=moving, required=0.5, budget=budget)
    assert isinstance(outcome, GaveUp)
    assert "depart_s" in outcome.would_help


def test_what_never_comes_near_the_goal_keeps_nobody_from_saying_how_long_it_is_free() -> None:
    def goes_round(name: str, *frames: list[float]) -> dict[str, Any]:
        return {
            "name": name,
            "circle": {"center": [0, 0], "radius": 1},
            "motion": {"keyframes": list(frames), "after": "loop"},
        }

    known = [
        goes_round("far", [0, 0, 50], [4, 5, 50], [8, 0, 50]),
        goes_round("near", [0, 20, 9], [4, 20, 0], [8, 20, 9]),
    ]
    mission = {
        "world": {"known": known},
        "robot": {"radius_m": 0.3, "max_speed_mps": 2},
        "route": {"start": [0, 0], "goal": [20, 0], "hold_s": 20},
    }
    with pytest.raises(GaveUpError, match="'near' first: hold 5 s at most"):
        vs.plan(vs.Mission.model_validate(mission))


def test_who_stays_for_days_where_something_comes_by_is_given_up_on_soon() -> None:
    moving = MovingObstacles([parked(20.0, [[0, 0, 9], [5, 0, -9], [10, 0, 9]], "loop")])
    stay = [Station(20.0, dwell=1e6)]
    outcome = law_among(line(), LIMITS, stay, moving=moving, required=0.5)
    assert isinstance(outcome, GaveUp)
