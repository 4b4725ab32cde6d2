"""How far beside its path a robot is, by which place on the path, and when that is told."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.mission.drives.drive import Drive
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.navigator import Navigator
from viaspline.robot.state import RobotState
from viaspline.robot.watching.true_place import true_place
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime

BODY = {"radius_m": None, "footprint": [[0.5, 0.3], [-0.5, 0.3], [-0.5, -0.3], [0.5, -0.3]]}


def schedule_of(nav: Navigator) -> Schedule:
    return Schedule(nav.path, nav.trajectory, laid_in=nav.world)


def test_it_is_the_distance_to_the_nearest_place_nearby(slalom_of: Any) -> None:
    nav = Navigator(slalom_of())
    on_path = nav.reference(5.0)
    x, y = on_path.position
    aside = replace(on_path, position=(x, y + 0.2))
    place = true_place(nav.mission.robot, schedule_of(nav), aside, 8.0, 8.0)
    assert 0.1 < place.off <= 0.2
    assert place.off == place.aside


def test_a_body_that_looks_another_way_is_off_by_its_corners(slalom_of: Any) -> None:
    robot = slalom_of().robot.model_copy(update={"footprint": BODY["footprint"]})
    nav = Navigator(slalom_of())
    on_path = nav.reference(5.0)
    turned = replace(on_path, position=(on_path.position[0], on_path.position[1] + 1e-4))
    turned = replace(turned, heading=turned.heading + 0.2)
    should = float(nav.trajectory.distance_at(5.0))
    place = true_place(robot, schedule_of(nav), turned, should, should)
    assert place.off == pytest.approx(2.0 * 0.5831 * 0.0998, abs=2e-3)


@given(st.floats(0.02, 1.0), st.floats(0.02, 0.4), st.floats(0.5, 3.14), st.floats(0.02, 0.1))
@example(1.0, 0.1, 3.14, 0.05)
@settings(deadline=None, max_examples=25)
def test_a_body_that_follows_late_is_off_by_no_more_where_it_turns(
    slalom_of: Any, accel: float, late: float, angle: float, period: float
) -> None:
    """It was taken for being far beside its path: on what it came by, and looking back."""
    robot = slalom_of().robot.model_copy(update={"footprint": BODY["footprint"]})
    there = [(float(k), 0.0) for k in range(4)]
    onward = [(3.0 + k * math.cos(angle), k * math.sin(angle)) for k in range(4)]
    path = Path([there, onward], [])
    stand = 1.0 + late  # it has turned when its law goes on
    law = retime(path, Limits(max_speed=1.0, max_accel=accel), [Station(3.0, stand)])
    nav = Navigator(slalom_of())
    schedule = Schedule(path, law, laid_in=nav.world, turns=(3.0,))
    last = 0.0
    for time in np.arange(0.0, law.end_time, period).tolist():
        at, speed, _ = (float(x) for x in law.state_at(max(time - late, 0.0)))
        x, y = np.asarray(path.at_distance(at)).tolist()
        heading = float(path.heading(float(path.parameter(at))))
        measured = RobotState((x, y + 1e-4), heading, speed)
        should = float(law.distance_at(time))
        place = true_place(robot, schedule, measured, should, last)
        last = place.distance
        assert place.off < 2e-3, (time, at, should)


HELD = {"max_speed_along_mps": 1.0, "max_speed_across_mps": 1.0, "hold_heading_deg": 20.0}


@given(
    st.floats(-0.3, 0.3), st.floats(-3.0, 3.0), st.floats(0.0, 0.1), st.floats(-0.02, 0.02),
    st.booleans(),
)  # fmt: skip
@example(0.0752, 2.5, 0.0752, 1e-3, False)  # taken to be before a turn that it stood 8 cm beyond
@example(0.08, 1.5, 0.09, 0.0, True)  # and so was one that looks the same way all the time
@settings(deadline=None, max_examples=50)
def test_one_near_a_turn_is_off_by_what_it_is_beside_one_of_the_two_ways(
    slalom_of: Any, along: float, angle: float, beyond: float, aside: float, holds: bool
) -> None:
    nav = Navigator(slalom_of())
    kept = {"footprint": BODY["footprint"]}
    if holds:
        kept = {"drive": Drive.model_validate({"omnidirectional": HELD})}
    robot = nav.mission.robot.model_copy(update=kept)
    there = [(float(k), 0.0) for k in range(4)]
    onward = [(3.0 + k * math.cos(angle), k * math.sin(angle)) for k in range(4)]
    path = Path([there, onward], [])
    law = retime(path, Limits(max_speed=1.0, max_accel=1.0))
    schedule = Schedule(path, law, laid_in=nav.world, turns=(3.0,))
    u = path.parameter(3.0 + along)
    (x, y), way = np.asarray(path.evaluate(u)).tolist(), float(path.heading(u))
    beside = (x - aside * math.sin(way), y + aside * math.cos(way))
    looks = way if robot.held_heading is None else robot.held_heading
    measured = RobotState(beside, looks, 1.0 if holds else 0.0)
    for last in (3.0 + along, 3.0):
        found = true_place(robot, schedule, measured, 3.0 + beyond, last)
        assert found.off <= abs(aside) + 1e-6


def test_a_body_beyond_a_turn_that_does_not_look_on_is_off_by_its_corners(slalom_of: Any) -> None:
    nav = Navigator(slalom_of())
    robot = nav.mission.robot.model_copy(update={"footprint": BODY["footprint"]})
    path = Path([[(k, 0.0) for k in range(4)], [(3.0, k) for k in range(4)]], [])
    law = retime(path, Limits(max_speed=1.0, max_accel=1.0))
    schedule = Schedule(path, law, laid_in=nav.world, turns=(3.0,))
    measured = RobotState((3.0, 0.08), 0.5 * math.pi - 0.1, 0.0)
    place = true_place(robot, schedule, measured, 3.09, 3.08)
    assert place.distance == pytest.approx(3.08)
    assert place.off == pytest.approx(2.0 * 0.5831 * math.sin(0.05), abs=1e-4)
    turning = replace(measured, heading=0.3)
    assert true_place(robot, schedule, turning, 3.09, 3.08).off == pytest.approx(0.08)


@pytest.mark.slow
@pytest.mark.parametrize("drive", [{"differential": {"track_m": 0.5}}, None], ids=["drive", "none"])
def test_a_robot_that_is_set_off_beside_its_start_comes_to_its_path(
    slalom_of: Any, cart_of: Any, loop: Any, drive: Any
) -> None:
    nav, one = Navigator(slalom_of(drive=drive)), cart_of()
    one.state = RobotState((0.0, 0.4), 0.0, 0.0)
    done = loop(nav, one)
    told = [event for event in done.book.events if event.kind == "deviation"]
    assert told[0].data["outcome"] == "returns"
    assert told[0].data["off_m"] == pytest.approx(0.4, abs=0.01)
    assert done.nav.reached
    assert done.nav.allowance <= nav.allowance + 0.1


@pytest.mark.slow
def test_noise_that_the_mission_tells_of_is_no_deviation(
    slalom_of: Any, cart_of: Any, loop: Any
) -> None:
    import random

    chance = random.Random(4)
    mission = slalom_of(
        drive={"differential": {"track_m": 0.5}}, localization={"position_noise_m": 0.02}
    )

    def noisy(state: RobotState, _: float) -> RobotState:
        x, y = (value + chance.gauss(0.0, 0.02) for value in state.position)
        return replace(state, position=(x, y))

    done = loop(Navigator(mission), cart_of(), measure=noisy)
    assert done.nav.reached
    assert not {"deviation", "pose_jump", "slip"} & set(done.kinds)
