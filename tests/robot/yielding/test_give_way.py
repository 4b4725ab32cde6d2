"""Robots give way to what moves and isn't on the map: judged by what happens in the simulator."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.planning.problem.work_budget import LAW_AMONG_S
from viaspline.planning.replanning.swerve import Swerving
from viaspline.robot.navigation import law_past
from viaspline.robot.navigation.law_past import LAW_WORK_S
from viaspline.robot.navigator import Navigator
from viaspline.robot.yielding import give_way
from viaspline.robot.yielding.swerves import Swerves
from viaspline.robot.yielding.ways_past import WAYS_WORK_S, try_ways


def crossing(*moving: dict[str, Any], goal_x: float = 24.0, **robot: Any) -> vs.Mission:
    return vs.Mission.model_validate(
        {
            "world": {"unseen": list(moving)},
            "robot": {"radius_m": 0.25, "clearance_m": 0.1, "sensor": {"range_m": 10}, **robot},
            "route": {"start": [0, 0], "goal": [goal_x, 0]},
        }
    )


def cart(name: str, start: tuple[float, float], velocity: tuple[float, float]) -> dict[str, Any]:
    return {
        "name": name,
        "circle": {"center": [0, 0], "radius": 0.5},
        "motion": {"from": list(start), "velocity_mps": list(velocity)},
    }


def test_what_crosses_is_let_pass_or_passed_and_nothing_is_touched() -> None:
    run = vs.simulate(crossing(cart("a", (12.0, -7.5), (0.0, 1.1))), step=0.1)
    assert run.reached
    assert run.encounters is not None
    assert run.encounters.contacts == ()
    assert run.encounters.clearance > 0.0


def test_what_is_far_from_the_way_changes_nothing() -> None:
    alone = vs.simulate(crossing(), step=0.1)
    other = vs.simulate(crossing(cart("far", (12.0, 30.0), (1.0, 0.0))), step=0.1)
    assert other.duration == alone.duration
    assert other.replans == ()


def test_what_comes_head_on_is_passed_at_its_side() -> None:
    run = vs.simulate(crossing(cart("oncoming", (24.0, 0.0), (-1.0, 0.0))), step=0.1)
    assert run.reached
    assert run.replans
    assert run.encounters is not None
    assert run.encounters.contacts == ()
    for replan in run.replans:
        assert replan.position_jump < 1e-6
        assert replan.heading_jump < 1e-6
        assert replan.curvature_jump < 1e-4


def test_the_same_drive_is_the_same_to_the_bit() -> None:
    mission = crossing(cart("a", (12.0, -7.0), (0.0, 1.2)), sensor={
        "range_m": 10, "velocity_noise_mps": 0.05,
    })  # fmt: skip
    one, other = (vs.simulate(mission, step=0.1, seed=3) for _ in range(2))
    assert one.positions.tobytes() == other.positions.tobytes()


@pytest.mark.parametrize("seed", range(6))
def test_no_limit_is_broken_while_giving_way(seed: int) -> None:
    random = np.random.default_rng(seed)
    moving = [
        cart(
            f"d{i}",
            (float(random.uniform(5, 20)), float(random.choice([-1, 1]) * random.uniform(4, 9))),
            (0.0, 0.0),
        )
        for i in range(4)
    ]
    for one in moving:
        x, y = one["motion"]["from"]
        speed = float(random.uniform(0.5, 1.5))
        one["motion"]["velocity_mps"] = [float(random.uniform(-0.5, 0.5)), -np.sign(y) * speed]
        assert x > 0
    run = vs.simulate(crossing(*moving, max_speed_mps=2, max_accel_mps2=1), step=0.1)
    assert run.speeds.max() <= 2.0 + 1e-9
    accelerations = np.diff(run.speeds) / np.maximum(np.diff(run.times), 1e-9)
    assert np.abs(accelerations[np.diff(run.times) > 0.05]).max() <= 1.0 + 1e-6


def test_a_robot_at_which_something_turns_gets_out_of_its_way() -> None:
    """It crosses the robot's path ahead, as it seems, and then comes back at the robot."""
    turning = {
        "name": "turning",
        "circle": {"center": [0, 0], "radius": 0.5},
        "motion": {
            "keyframes": [[0, 12, -8], [4, 12, -4], [11, 5.5, 2.5], [40, 5.5, 30]], "after": "stay",
        },
    }  # fmt: skip
    run = vs.simulate(crossing(turning), step=0.1)
    assert run.reached
    assert run.encounters is not None
    assert run.encounters.contacts == ()


def test_a_robot_goes_on_when_all_that_it_waited_for_is_gone_from_sight() -> None:
    """It stood for ever: nothing that moved was left to look at."""
    to_and_fro = [(t, 3.0, 0.3 * (-1) ** t) for t in range(9)]
    restless = {
        "name": "restless",
        "circle": {"center": [0, 0], "radius": 0.5},
        "motion": {"keyframes": to_and_fro, "after": "vanish"},
    }
    mission = crossing(restless, goal_x=6.0, sensor={"range_m": 0.8})
    run = vs.simulate(mission, step=0.1)
    assert run.encounters is not None
    assert run.duration > 8.0
    np.testing.assert_allclose(run.positions[-1], (6.0, 0.0), atol=1e-6)


def test_a_wall_of_them_touches_no_robot_under_way_that_is_to_be_at_rest_in_time() -> None:
    boxed = [cart(f"d{i}", (12.0, y), (-1.3, 0.0)) for i, y in enumerate(np.arange(-6.0, 7.0))]
    safe = {"max_speed_mps": 1.5, "safety": "passive"}
    run = vs.simulate(crossing(*boxed, moving=safe), step=0.2)
    assert run.encounters is not None
    assert all(contact.robot_speed == 0.0 for contact in run.encounters.contacts)


def test_no_path_to_swerve_by_is_laid_before_it_is_asked_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    laid: list[int] = []
    through = Swerving.through

    def counted(self: Swerving, place: Any) -> Any:
        laid.append(1)
        return through(self, place)

    monkeypatch.setattr(Swerving, "through", counted)
    asked: list[Swerves] = []

    def seen(context: Any) -> Swerves:
        asked.append(Swerves(context))
        return asked[-1]

    monkeypatch.setattr(give_way, "Swerves", seen)
    vs.simulate(crossing(cart("oncoming", (24.0, 0.0), (-1.0, 0.0))), step=0.1)
    places = sum(len(paths.places) for paths in asked)
    assert 0 < len(laid) < places
    assert len(list(asked[0])) <= len(asked[0].places)


def test_ways_are_tried_one_after_the_other_and_the_rest_in_the_steps_to_come() -> None:
    tried: list[int] = []

    def way(number: int) -> Any:
        def lay(budget: Any) -> None:
            tried.append(number)
            budget.spent += LAW_AMONG_S

        return lay

    ways, at, steps = [way(number) for number in range(7)], 0, []
    for _ in range(4):
        done = try_ways(ways, at, lambda *_: True)
        assert done.best is None
        steps.append(list(tried))
        tried.clear()
        at = done.next_way
    most = 1 + int(WAYS_WORK_S / LAW_AMONG_S)
    assert all(1 <= len(step) <= most for step in steps)
    assert [number for step in steps for number in step] == [*range(7), 0][: sum(map(len, steps))]


def test_no_step_searches_more_than_a_few_laws_however_much_comes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Up to eight paths with two searches each were laid in a step: it took 6.5 s once."""
    found, step = law_past.law_among, Navigator.step
    searched: list[int] = []

    def counted(*args: Any, **keys: Any) -> Any:
        outcome = found(*args, **keys)
        assert keys["budget"].spent <= LAW_WORK_S
        searched[-1] += 1
        return outcome

    def stepped(*args: Any) -> Any:
        searched.append(0)
        return step(*args)

    monkeypatch.setattr(law_past, "law_among", counted)
    monkeypatch.setattr(Navigator, "step", stepped)
    wall = [cart(f"d{i}", (12.0, y), (-1.3, 0.0)) for i, y in enumerate(np.arange(-6.0, 7.0))]
    vs.simulate(crossing(*wall, min_turn_radius_m=0.5), step=0.1)
    assert max(searched) <= 6
    assert sum(searched) > 20
