"""How near a drive came to what moves, against sums by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.report.run_picture import how_near
from viaspline.robot.simulation.appearance import Appearance
from viaspline.robot.simulation.driven_motion import DrivenMotion
from viaspline.studio.simulated_drive import driven
from viaspline.tracks.encounters import DrivenStates, encounters, touched_by
from viaspline.world.moving_obstacles import MovingObstacles

ROBOT = RobotSpec(radius_m=0.5)


def cart(velocity: tuple[float, float], start: tuple[float, float]) -> MovingObstacles:
    motion = {"from": start, "velocity_mps": velocity}
    data = {"circle": {"center": (0, 0), "radius": 1.0}, "name": "cart", "motion": motion}
    return MovingObstacles([Obstacle.model_validate(data)])


def straight(speed: float, seconds: float) -> DrivenStates:
    def state_at(times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        places = np.column_stack((speed * times, np.zeros_like(times)))
        return places, np.full(times.shape, speed)

    return DrivenStates(0.0, seconds, state_at)


def never(index: int, time: float) -> bool:
    return False


def test_the_clearance_is_proven_and_near_the_true_one() -> None:
    met = encounters(straight(2.0, 10.0), ROBOT, 0.5, cart((0.0, 1.0), (10.0, -8.0)), never)
    times = np.linspace(0.0, 10.0, 1_000_001)
    truth = np.hypot(2.0 * times - 10.0, 8.0 - times).min() - 1.5
    assert truth - 3e-3 < met.clearance <= truth
    assert met.obstacle == "cart"
    assert met.contacts == ()
    assert touched_by(met) is None


def test_a_touch_under_way_ends_a_drive_in_words_and_one_at_rest_does_not() -> None:
    moving = encounters(straight(2.0, 10.0), ROBOT, 0.5, cart((0.0, 1.0), (10.0, -5.0)), never)
    [contact] = moving.contacts
    assert contact.robot_speed == 2.0
    reason = touched_by(moving)
    assert reason is not None
    assert "the robot touched 'cart'" in reason
    standing = encounters(straight(0.0, 10.0), ROBOT, 0.5, cart((1.0, 0.0), (-5.0, 0.0)), never)
    [contact] = standing.contacts
    assert contact.time == pytest.approx(3.5, abs=2e-3)
    assert contact.robot_speed == 0.0
    assert touched_by(standing) is None


def test_where_nothing_moves_nothing_is_met() -> None:
    nothing = MovingObstacles()
    assert encounters(straight(1.0, 1.0), ROBOT, 0.5, nothing, never).clearance == math.inf


def test_a_run_past_what_is_known_to_move_keeps_what_its_plan_proves() -> None:
    mission = vs.Mission.model_validate(
        {
            "world": {
                "known": [
                    {
                        "name": "cart",
                        "circle": {"center": [0, 0], "radius": 1},
                        "motion": {"keyframes": [[0, 10, -9], [9, 10, 9]], "after": "stay"},
                    }
                ]
            },
            "route": {"start": [0, 0], "goal": [20, 0], "depart_s": 1.0},
        }
    )
    run = vs.simulate(mission)
    certificate = run.plan.moving_certificate
    assert run.reached
    assert run.encounters is not None
    assert certificate is not None
    assert run.encounters.clearance == pytest.approx(certificate.clearance, abs=5e-3)
    assert run.encounters.clearance >= 0.5 - 5e-3
    assert run.encounters.contacts == ()


def test_what_came_near_and_touched_nothing_is_told_with_what_was_left() -> None:
    far = cart((0.0, 1.0), (10.0, -30.0))
    near = cart((0.0, 1.0), (10.0, -8.0))
    met = encounters(straight(2.0, 10.0), ROBOT, 0.5, near.and_those(far), never)
    [passed] = met.passes
    times = np.linspace(0.0, 10.0, 1_000_001)
    truth = np.hypot(2.0 * times - 10.0, 8.0 - times).min() - 1.5
    assert truth - 0.03 < passed.clearance <= truth
    assert passed.robot_speed == 2.0
    touching = encounters(straight(2.0, 10.0), ROBOT, 0.5, cart((0.0, 1.0), (10.0, -5.0)), never)
    assert touching.passes == ()


def test_nothing_passed_nearer_than_is_proven_of_all() -> None:
    one, other = cart((0.0, 1.0), (10.0, -8.0)), cart((0.0, -2.0), (10.0, 14.0))
    met = encounters(straight(2.0, 10.0), ROBOT, 0.5, one.and_those(other), never)
    assert len(met.passes) == 2
    assert min(passed.clearance for passed in met.passes) >= met.clearance


def onto(x: float, **sensor: Any) -> vs.Mission:
    """A robot on its way to the east, and a thing that jumps on to its way after 8 s."""
    motion = {"keyframes": [[0, x, 20], [8, x, 20.5], [8.001, x, 0], [60, x, 0.1]], "after": "stay"}
    thing = {"name": "thing", "circle": {"center": [0, 0], "radius": 0.5}, "motion": motion}
    return vs.Mission.model_validate(
        {
            "world": {"unseen": [thing]},
            "robot": {"radius_m": 0.5, "max_speed_mps": 2, "max_accel_mps2": 1, "sensor": sensor},
            "route": {"start": [0, 0], "goal": [60, 0]},
        }
    )


def late(mission: vs.Mission, contact: float) -> bool:
    """Whether what a robot runs into at 2 m/s was there too late to be seen in time."""
    times = np.linspace(0.0, 20.0, 2001)
    places, still = np.column_stack((2.0 * times, 0.0 * times)), np.zeros_like(times)
    motion = DrivenMotion(times, places, still, still + 2.0, 2.0 * times, step=0.1)
    world, moving = vs.World.everything(mission), MovingObstacles.everything(mission)
    return Appearance(mission, world, moving, motion).was_late(0, contact)


@pytest.mark.parametrize("sensor", [{"range_m": 12}, {"lidar": {"range_m": 12}}])
@pytest.mark.parametrize(("x", "is_late"), [(20.0, True), (20.9, True), (21.4, False)])
def test_what_is_there_when_the_robot_can_not_stop_any_more_was_late(
    sensor: dict[str, Any], x: float, is_late: bool
) -> None:
    """It stands 2.1 s after the look at 8.1 s, the first that can show it: that is 10.2 s."""
    assert late(onto(x, **sensor), contact=(x - 1.0) / 2.0) is is_late


def test_what_was_seen_and_jumps_then_was_late_wherever_it_jumps_to() -> None:
    data = onto(20.0, range_m=30).model_dump(by_alias=True, exclude_defaults=True)
    motion = {"keyframes": [[0, 22, 0], [8, 22.1, 0]], "after": "loop"}
    data["world"]["unseen"][0]["motion"] = motion
    with pytest.warns(vs.MissionWarning, match="jumps by 0.1 m"):
        looped = vs.Mission.model_validate(data)
    assert late(looped, contact=8.5)
    assert not late(looped, contact=12.0)


def test_what_is_behind_the_reach_of_the_sensor_is_late_and_what_is_on_the_map_never() -> None:
    hidden = onto(21.4, range_m=3)
    assert late(hidden, contact=10.2)
    data = hidden.model_dump(by_alias=True, exclude_defaults=True)
    data["world"] = {"known": data["world"]["unseen"]}
    assert not late(vs.Mission.model_validate(data), contact=10.2)


def test_a_touch_at_rest_is_told_wherever_a_run_is() -> None:
    """A drive whose robot is touched while it dwells reaches its goal; nobody calls it clear."""
    dog = {
        "name": "dog", "circle": {"center": [0, 0], "radius": 0.5},
        "motion": {"keyframes": [[0, 20, 6], [8, 4.9, 0], [9, 4.9, 0], [20, 20, 20]],
                   "after": "stay"},
    }  # fmt: skip
    mission = vs.Mission.model_validate(
        {
            "world": {"unseen": [dog]},
            "robot": {"sensor": {"range_m": 3}, "moving": {"max_speed_mps": 3}},
            "route": {"start": [0, 0], "via": [{"at": [5, 0], "dwell_s": 20}], "goal": [10, 0]},
        }
    )
    run = vs.simulate(mission)
    assert run.reached
    assert run.encounters is not None
    [contact] = run.encounters.contacts
    assert contact.robot_speed == 0.0
    assert run.least_clearance == run.encounters.clearance < 0.0
    said = "touched by 'dog', which moves, while it stood"
    assert f"{run.least_clearance:.2f} m clear, 0 re-plans, reached, {said}, at" in repr(run)
    [event] = [one for one in run.events if one.kind == "contact"]
    assert (event.time, event.message) == (contact.time, said)
    assert [one.time for one in run.events] == sorted(one.time for one in run.events)
    assert event.at == pytest.approx(run.place_at(contact.time), abs=1e-6)
    assert how_near(run) == run.encounters.touched
    assert driven(run)["touched"] == run.encounters.touched
    assert driven(run)["clearance"] == run.least_clearance
    for words in (run.summary(), run._repr_html_()):
        assert "CONTACT" in words
