from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.robot.navigator import Navigator
from viaspline.robot.simulator import simulate
from viaspline.robot.state import RobotState

DEPARTS_S, STEP_S = 5.0, 0.1
CART = {"name": "cart", "circle": {"center": [0, 0], "radius": 0.3}}
FAR = {**CART, "motion": {"from": [50, 50], "velocity_mps": [0, 0.1]}}
CROSSING = {**CART, "name": "other cart", "motion": {"from": [4, -7], "velocity_mps": [0, 1]}}
BESIDE = {"name": "post", "circle": {"center": [3, 0.2], "radius": 0.4}}
RANGE, LIDAR = {"range_m": 9}, {"lidar": {"range_m": 9}}
PASSIVE = {"max_speed_mps": 1.5, "safety": "passive"}


def mission(world: dict[str, Any], **robot: Any) -> Mission:
    limits = {"radius_m": 0.25, "max_speed_mps": 1.0, "max_accel_mps2": 1.0}
    route = {"start": [0, 0], "goal": [8, 0], "depart_s": DEPARTS_S}
    return Mission.model_validate({"world": world, "robot": limits | robot, "route": route})


@pytest.mark.parametrize(
    ("world", "robot"),
    [
        ({"known": [FAR], "unseen": [BESIDE]}, {"sensor": RANGE}),
        ({"known": [FAR], "unseen": [BESIDE]}, {"sensor": LIDAR}),
        ({"known": [FAR], "unseen": [CROSSING]}, {"sensor": RANGE, "moving": PASSIVE}),
        ({"unseen": [CROSSING]}, {"sensor": RANGE}),
        ({"unseen": [CROSSING, BESIDE]}, {"sensor": RANGE, "max_jerk_mps3": 1.0}),
    ],
    ids=["goes round", "goes round by lidar", "kept safe", "only unseen", "limited jerk"],
)
def test_a_robot_sets_off_when_it_may_depart_whatever_it_sees_until_then(
    world: dict[str, Any], robot: dict[str, Any]
) -> None:
    run = simulate(mission(world, **robot), step=STEP_S)
    assert run.reached
    moves = run.times[run.speeds > 0.0]
    assert DEPARTS_S < moves[0] <= DEPARTS_S + 1.5 * STEP_S
    assert (run.positions[run.times <= DEPARTS_S] == run.positions[0]).all()


@pytest.mark.parametrize("drive", [None, {"differential": {"track_m": 0.4}}])
def test_a_plan_begins_when_its_robot_may_depart_where_only_unseen_things_move(drive: Any) -> None:
    asked = mission({"unseen": [CROSSING]}, sensor=RANGE, drive=drive)
    late = plan(asked)
    route = asked.route.model_copy(update={"depart_s": 0.0})
    early = plan(asked.model_copy(update={"route": route}))
    assert (early.trajectory.start_time, late.trajectory.start_time) == (0.0, DEPARTS_S)
    assert late.trajectory.duration == pytest.approx(early.trajectory.duration, rel=1e-12)


@pytest.mark.parametrize(
    ("unseen", "begins", "robot"),
    [
        ([CROSSING], DEPARTS_S, {"sensor": LIDAR}),
        ([CROSSING], DEPARTS_S, {"sensor": RANGE, "moving": PASSIVE}),
        ([BESIDE], 0.0, {"sensor": LIDAR}),
    ],
)
def test_its_first_law_begins_when_its_plan_does(
    unseen: list[Any], begins: float, robot: dict[str, Any]
) -> None:
    nav = Navigator(mission({"unseen": unseen}, **robot), warm=False)
    assert nav.trajectory.start_time == begins


def test_a_robot_that_was_held_still_before_it_may_depart_stays_until_then() -> None:
    nav = Navigator(mission({"known": [FAR]}), reaction=STEP_S, period=STEP_S, warm=False)
    for time, stamp in ((0.0, 0.0), (1.0, 0.0), (1.1, 1.1), (1.2, 1.2), (2.0, 0.0), (3.0, 3.0)):
        command, nav = nav.step(RobotState((0.0, 0.0), 0.0, 0.0, stamp=stamp), (), time)
        assert [event.kind for event in nav.events].count("stale") == (
            1 if time - stamp > 0.2 else 0
        )
        assert command.speed == 0.0
    assert nav.trajectory.state_at(DEPARTS_S)[1] == 0.0
    assert nav.trajectory.state_at(DEPARTS_S + 1.0)[1] > 0.0


def test_a_drive_that_departs_late_is_not_broken_off_before() -> None:
    late = mission({"known": [FAR]}).model_dump(by_alias=True, exclude_defaults=True)
    late["route"]["depart_s"] = 1000.0
    run = simulate(Mission.model_validate(late), step=1.0)
    assert run.reached
    assert run.duration == pytest.approx(1009.0, abs=0.1)


@pytest.mark.parametrize("drive", [None, {"differential": {"track_m": 0.4}}])
@pytest.mark.parametrize("late", [2.5, 4000.0])
def test_a_loop_that_begins_after_its_robot_was_to_depart_drives_from_the_start(
    late: float, drive: Any
) -> None:
    """It was taken to have been set beside its path by as much as it would have driven by then."""
    to_and_fro = {"keyframes": [[0, 4, -2], [4, 4, 2]], "after": "bounce"}
    asked = mission({"known": [{**CART, "motion": to_and_fro}]}, drive=drive)
    nav = Navigator(asked, period=STEP_S, warm=False)
    here, begin = nav.reference(0.0), DEPARTS_S + late
    kinds: list[str] = []
    for k in range(3):
        _, nav = nav.step(here, (), begin + STEP_S * k)
        kinds += [event.kind for event in nav.events if event.kind != "lag"]
    assert kinds == ["started"]
    first = nav.trajectory
    assert first.start_time >= begin
    assert (first.distances[0], first.distances[-1]) == (0.0, nav.path.length)
    moving = nav._state.knowledge.moving
    times = np.arange(first.start_time, first.end_time, 0.05)
    gaps = [
        moving.distance(nav.path.at_distance(along)[:2], time)[0]
        for time, along in zip(times.tolist(), first.distance_at(times).tolist(), strict=True)
    ]
    assert min(gaps) >= asked.robot.radius_m + asked.robot.clearance_m - 1e-6


def test_on_a_closed_route_it_drives_from_the_start_as_well() -> None:
    world = {"known": [{**CART, "motion": {"from": [50, 50], "velocity_mps": [0, 0.001]}}]}
    data = mission(world).model_dump(by_alias=True, exclude_defaults=True)
    corners = [{"at": at} for at in ((6, 0), (6, 5), (0, 5))]
    data["route"] = {"start": [0, 0], "via": corners, "closed": True, "laps": 1}
    nav = Navigator(Mission.model_validate(data), warm=False)
    _, nav = nav.step(nav.reference(0.0), (), 900.0)
    assert not nav.finished
    assert nav.trajectory.end_time > 910.0
