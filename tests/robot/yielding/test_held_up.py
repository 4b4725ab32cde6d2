"""What stands in the way and doesn't go: the robot says what it is, and doesn't wait for ever."""

from __future__ import annotations

from typing import Any

import pytest

import viaspline as vs
from viaspline.robot.navigation import law_past
from viaspline.robot.yielding import held_up

PATIENCE_S = 20.0
GOAL = (15.0, 0.0)
YARD = (-1.0, -19.0, 20.0, 19.0)
PASSIVE = {"max_speed_mps": 2, "safety": "passive"}


def coming(name: str, *frames: tuple[float, float, float]) -> dict[str, Any]:
    """A disc that goes somewhere and stays there."""
    motion = {"keyframes": frames, "after": "stay"}
    return {"name": name, "circle": {"center": (0, 0), "radius": 0.4}, "motion": motion}


def wall(name: str, low: float, high: float) -> dict[str, Any]:
    corners = [(11.5, low), (12.5, low), (12.5, high), (11.5, high)]
    return {"name": name, "polygon": corners}


def mission(
    *unseen: dict[str, Any],
    known: tuple[dict[str, Any], ...] = (),
    range_m: float = 10,
    bounds: tuple[float, ...] | None = None,
    **more: Any,
) -> vs.Mission:
    robot = {"radius_m": 0.25, "max_accel_mps2": 1, "sensor": {"range_m": range_m}, **more}
    return vs.Mission.model_validate(
        {
            "world": {"known": known, "unseen": unseen, "bounds": bounds},
            "robot": robot,
            "route": {"start": (0, 0), "goal": GOAL},
        }
    )


@pytest.fixture(autouse=True)
def less_patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """A minute of standing is simulated as any other."""
    monkeypatch.setattr(held_up, "MAX_HELD_UP_S", PATIENCE_S)


@pytest.fixture
def searches(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """When it was looked for a law past what moves [s]."""
    asked: list[float] = []
    law_among = law_past.law_among

    def counted(*args: Any, **more: Any) -> Any:
        asked.append(more["start_time"])
        return law_among(*args, **more)

    monkeypatch.setattr(law_past, "law_among", counted)
    return asked


@pytest.mark.parametrize("robot", [{"moving": PASSIVE}, {}], ids=["passive", "unsaid"])
def test_one_whose_goal_is_taken_says_by_what_and_ends(
    robot: dict[str, Any], searches: list[float]
) -> None:
    """It searched in every step for ten minutes, then said nothing but that its time was up."""
    run = vs.simulate(mission(coming("cart", (0, 15, 6), (3, 15, 0)), **robot), step=0.2)
    assert not run.reached
    assert run.reason is not None
    assert "'cart', which has stood at (15.00, 0.00), on 'goal', for" in run.reason
    assert PATIENCE_S < run.duration < PATIENCE_S + 20.0
    assert run.events[-1].kind == "stopped"
    assert run.encounters is not None
    assert run.encounters.contacts == ()
    looks = {time for time in searches if time > run.duration - PATIENCE_S}
    assert len(looks) < 40  # one in each of 100 steps before


def test_a_gap_that_has_closed_is_told_of_with_what_stands_in_it() -> None:
    pair = coming("a", (0, 12, 3), (9, 12, 0.7)), coming("b", (0, 12, -3), (9, 12, -0.7))
    walls = wall("w1", 0.8, 20), wall("w2", -20, -0.8)
    asked = mission(*pair, known=walls, range_m=6, bounds=YARD, moving=PASSIVE)
    run = vs.simulate(asked, step=0.2)
    assert run.reason is not None
    assert "'a', which has stood at (12.00, 0.70)" in run.reason
    assert "'b', which has stood at (12.00, -0.70)" in run.reason
    assert "0.56 m wide, at (12.00, 0.00)" in run.reason
    assert "robot.clearance_m has to be less than 0.029 to fit through" in run.reason
    assert run.duration < PATIENCE_S + 20.0
    assert run.encounters is not None
    assert [one for one in run.encounters.contacts if one.robot_speed > 0.0] == []


@pytest.mark.parametrize(
    ("beside", "helps"),
    [
        (0.6, "is 0.36 m wide, at (12.00, 0.00), and the robot 0.50 m: move it away"),
        (0.4, "no way round it is left: move it away"),
    ],
    ids=["too narrow", "shut"],
)
def test_of_a_gap_that_the_body_does_not_fit_through_no_clearance_is_advised(
    beside: float, helps: str
) -> None:
    """The discs are told of with an error of some centimetres, and that is taken off the gap."""
    pair = coming("a", (0, 12, 3), (9, 12, beside)), coming("b", (0, 12, -3), (9, 12, -beside))
    walls = wall("w1", 0.8, 20), wall("w2", -20, -0.8)
    run = vs.simulate(mission(*pair, known=walls, range_m=6, bounds=YARD), step=0.5)
    assert run.reason is not None
    assert run.reason.endswith(helps)
    assert "clearance" not in run.reason


@pytest.mark.parametrize("safety", ["passive", "none"])
def test_one_that_cannot_stop_in_what_it_sees_says_so(safety: str) -> None:
    cart = coming("cart", (0, 12, 0), (9, 1.5, 0))
    things = {"max_speed_mps": 2, "safety": safety}
    run = vs.simulate(mission(cart, range_m=0.5, moving=things), step=0.1)
    assert run.reason is not None
    assert "'cart', which has stood at (1.50, 0.00)" in run.reason
    assert "it can't stop in what it sees" in run.reason
    assert run.duration < PATIENCE_S + 60.0  # it creeps, as it sees so little


def test_one_that_what_stands_gives_way_to_again_drives_on() -> None:
    """It looks more seldom while nothing changes, and at once when something does."""
    stays = coming("cart", (0, 15, 6), (3, 15, 0), (20, 15, 0), (23, 15, 6))
    run = vs.simulate(mission(stays, moving=PASSIVE), step=0.2)
    assert run.reached
    assert 22.0 < run.duration < 35.0


def test_what_stands_a_while_is_gone_round_and_not_waited_for() -> None:
    stays = coming("cart", (0, 8, 3), (2, 8, 0))
    run = vs.simulate(mission(stays, moving=PASSIVE), step=0.2)
    assert run.reached
    assert run.duration < 20.0
    assert run.encounters is not None
    assert run.encounters.contacts == ()
