"""A step is bounded: what it hasn't time for goes on in later steps, while the robot brakes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from viaspline.machine.machine_limits import limits_of
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import plan
from viaspline.robot.navigation.drive_task import DriveTask, requirements_under_way
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.pending_search import NO_STAGE
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.navigator import Navigator
from viaspline.robot.replanning import deadline
from viaspline.robot.replanning.deadline import (
    MAX_STANDING_WORK_S,
    STEP_WORK_S,
    with_time_to_search,
)
from viaspline.robot.replanning.replan_context import Obstruction, ReplanContext
from viaspline.robot.simulator import simulate
from viaspline.world.world import World

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]
STEP = 0.05


def steps_of(mission: Mission, until: float = 60.0) -> list[Navigator]:
    """The navigator after every step of a drive that is followed exactly."""
    seen = mission.world.unseen
    assert mission.robot.sensor is not None
    nav, navs = Navigator(mission), []
    for time in np.arange(0.0, until, STEP):
        state = nav.reference(time)
        near = [
            rock
            for rock in seen
            if rock.circle is not None
            and np.hypot(*(np.array(rock.circle.center) - state.position))
            <= rock.circle.radius + mission.robot.sensor.reach
        ]
        _, nav = nav.step(state, near, float(time))
        navs.append(nav)
        if nav.finished:
            break
    return navs


def cramped(mission_of: Make, disc_at: Shape, **robot: Any) -> Mission:
    """Turns that have to be looked for long, and something new in the way of them."""
    return mission_of(
        [0, 0], [20, 0], [22, 1], [22, 4], [0, 8],
        unseen=[disc_at(11, 0.0, 1.5, "rock")], min_turn_radius_m=2.5, sensor={"range_m": 6},
        **robot,
    )  # fmt: skip


def test_no_step_under_way_spends_more_than_it_may(mission_of: Make, disc_at: Shape) -> None:
    navs = steps_of(cramped(mission_of, disc_at))
    assert navs[-1].reached
    assert 0.0 < max(nav.work for nav in navs) <= MAX_STANDING_WORK_S
    for k, (before, nav) in enumerate(pairwise(navs)):
        if before.trajectory.state_at((k + 1) * STEP)[1] > 0.0:
            assert nav.work <= STEP_WORK_S


def test_the_robot_goes_on_as_it_meant_to_while_a_new_path_is_sought(
    mission_of: Make, disc_at: Shape
) -> None:
    mission = mission_of([0, 0], [50, 0], unseen=[disc_at(25, 0.3, 2, "rock")])
    navs = steps_of(mission)
    for before, nav in pairwise(navs):
        if nav.replans and not before.replans:
            begin = nav.replans[0].time
            times = begin + np.linspace(0.0, nav.work, 9)
            old, new = before.trajectory.state_at(times), nav.trajectory.state_at(times)
            np.testing.assert_allclose(new[0], old[0], atol=1e-9)
            np.testing.assert_allclose(new[1], old[1], atol=1e-9)
            assert nav.replans[0].changed_from >= old[0][-1]
            assert nav.replans[0].work == nav.work > 0.0
            return
    pytest.fail("no new path was laid")


def test_a_search_without_time_stops_the_robot_where_it_is_clear_and_then_finds_a_path(
    mission_of: Make, disc_at: Shape, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(deadline, "STEP_WORK_S", 1e-3)
    mission = mission_of([0, 0], [50, 0], unseen=[disc_at(25, 0.3, 2, "rock")])
    run = simulate(mission)
    assert run.reached, run.reason
    assert run.certificate.holds
    assert "braked" in [event.kind for event in run.events]
    assert run.speeds[(run.times > 5.0) & (run.times < run.times[-1] - 5.0)].min() == 0.0


def test_a_robot_that_has_searched_at_rest_for_all_it_may_says_what_helps(
    mission_of: Make, disc_at: Shape, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("STEP_WORK_S", "STANDING_WORK_S", "MAX_STANDING_WORK_S"):
        monkeypatch.setattr(deadline, name, 1e-4)
    run = simulate(mission_of([0, 0], [50, 0], unseen=[disc_at(25, 0.3, 2, "rock")]))
    assert not run.reached
    assert run.reason is not None
    assert "plan anew from where it stands" in run.reason
    assert "max_replan_s" not in run.reason  # that is how long it searches under way


def test_a_robot_brakes_when_its_time_to_search_is_up(
    mission_of: Make, disc_at: Shape, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(deadline, "STEP_WORK_S", 1e-3)
    places = []
    for longest in (None, 0.3):
        mission = mission_of(
            [0, 0], [20, 0], [50, 0], unseen=[disc_at(35, 0.3, 2, "rock")],
            sensor={"range_m": 25}, max_replan_s=longest,
        )  # fmt: skip
        run = simulate(mission)
        assert run.reached, run.reason
        stood = run.positions[(run.speeds < 1e-6) & (run.times > 3.0)]
        places.append(float(stood[0, 0]))
    late, early = places
    assert early < late


@pytest.mark.parametrize("limit", [{}, {"max_jerk_mps3": 2.0}])
def test_a_robot_whose_time_is_up_goes_on_searching_while_it_brakes(
    mission_of: Make, disc_at: Shape, monkeypatch: pytest.MonkeyPatch, limit: dict[str, float]
) -> None:
    """It had looked for nothing from then on until it stood."""
    monkeypatch.setattr(deadline, "STEP_WORK_S", 1e-3)
    mission = mission_of(
        [0, 0], [20, 0], [50, 0], unseen=[disc_at(35, 0.3, 2, "rock")],
        sensor={"range_m": 25}, max_replan_s=0.3, **limit,
    )  # fmt: skip
    navs = steps_of(mission)
    begun = next(k for k, nav in enumerate(navs) if nav.searches)
    end = begun + next(k for k, nav in enumerate(navs[begun:]) if not nav.searches)
    braking = [
        (nav, nav.reference((k + 1) * STEP).speed)
        for k, nav in enumerate(navs[:end])
        if k * STEP > begun * STEP + 0.3 + STEP
    ]
    speeds = [speed for _, speed in braking if speed > 0.0]
    assert len(speeds) > 3
    assert (np.diff(speeds) < 0.0).all()
    assert any(nav.work > 0.0 for nav, speed in braking if speed > 0.0)
    stop = navs[begun + 8].trajectory.distances[-1]
    assert stop < 35.0 - 2.0 - mission.robot.clearance_m
    assert navs[-1].reached


def test_the_world_goes_on_while_a_robot_thinks(mission_of: Make, disc_at: Shape) -> None:
    mission = cramped(mission_of, disc_at)
    first, second = simulate(mission), simulate(mission)
    assert first.reached
    assert first.certificate.holds
    assert [replan.work for replan in first.replans] == [replan.work for replan in second.replans]
    assert first.positions.tobytes() == second.positions.tobytes()


def test_who_has_tried_all_that_he_has_time_for_goes_on_for_a_while_before_he_tries_again(
    mission_of: Make, disc_at: Shape, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(deadline, "STEP_WORK_S", 1e-4)
    rock = disc_at(60, 0.3, 2, "rock")
    navs = steps_of(mission_of([0, 0], [90, 0], unseen=[rock], sensor={"range_m": 40}))
    far = [bool(nav.compute_times) for nav in navs if nav.searches and nav.distance < 45.0]
    assert 0 < far.count(True) < 0.4 * len(far)
    assert navs[-1].reached


def test_one_that_has_just_set_off_tries_again_as_soon_as_one_that_will_be_as_fast() -> None:
    """It paused for 6 s: by the speed at which it set off it would have taken minutes."""
    mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [100, 0]}})
    made = plan(mission)
    task = DriveTask(
        mission, requirements_under_way(mission, 0.0), limits_of(mission.robot), reaction=0.1
    )
    schedule = Schedule(made.path, made.trajectory, laid_in=made.world)
    law, knowledge = made.trajectory, Knowledge(made.world, frozenset())
    for time in (0.05, 1.0, 10.0):
        progress = Progress(time, float(law.distance_at(time)), last_via=0)
        context = ReplanContext.of(task, progress, knowledge, schedule).searching(STEP_WORK_S)
        pending = deadline.gone_on(context, NO_STAGE, 90.0, None)
        assert pending is not None
        arrives = float(law.time_at(90.0))
        assert pending.again - time == pytest.approx(deadline.PAUSE_RATIO * (arrives - time))


def test_a_robot_that_is_held_where_it_was_keeps_its_time_law_while_it_searches(
    mission_of: Make, disc_at: Shape, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A law with a limit of the jerk took as long as all the rest of such a step."""
    monkeypatch.setattr(deadline, "STEP_WORK_S", 1e-3)
    rock = disc_at(40, 0.3, 2, "rock")
    navs = steps_of(mission_of([0, 0], [60, 0], unseen=[rock], sensor={"range_m": 30}))
    pairs = [(one, two) for one, two in pairwise(navs) if one.searches and two.searches]
    assert sum(bool(two.compute_times) for _, two in pairs) > 3
    for one, two in pairs:
        assert two.trajectory is one.trajectory
    assert navs[-1].reached


def test_a_robot_that_needs_more_room_than_its_path_has_left_is_held_on_it(
    mission_of: Make, disc_at: Shape
) -> None:
    """What it needs beyond where it was held was looked for beyond the end of its path."""
    mission, rock = mission_of([0, 0], [50, 0]), disc_at(50, 0.3, 2, "rock")
    made, world = plan(mission), World([Obstacle.model_validate(rock)])
    task = DriveTask(
        mission, requirements_under_way(mission, 0.0), limits_of(mission.robot), reaction=0.1
    )
    schedule = Schedule(made.path, made.trajectory, laid_in=made.world, held_at=40.0)
    progress = Progress(5.0, float(made.trajectory.distance_at(5.0)), last_via=0)
    for kept in (0.0, 20.0):
        needs = requirements_under_way(mission, kept)
        context = ReplanContext.of(
            replace(task, requirements=needs), progress, Knowledge(world, frozenset()), schedule
        )
        blocked = replace(context, obstruction=Obstruction(world, ("rock",), context.stop))
        assert deadline.last_place(blocked) <= 40.0


def test_a_robot_with_a_drive_searches_no_longer_than_until_its_next_command(
    mission_of: Make,
) -> None:
    """What it was told in a bend led it off its path while it went on by that for longer."""
    wheels = {"differential": {"track_m": 0.5}, "delay_s": 0.1, "lag_s": 0.1}
    limits = []

    def pace(nav: Navigator) -> float:
        state = nav._state
        context = ReplanContext.of(nav._task, state.progress, state.knowledge, state.schedule)
        if context.speed > 0.0:
            budget = with_time_to_search(context).requirements.budget
            assert budget is not None
            limits.append(budget.limit)
        return nav.work

    for step in (STEP, 0.02):
        limits.clear()
        simulate(mission_of([0, 0], [9, 0], drive=wheels), pace=pace, step=step)
        assert max(limits) == pytest.approx(min(step, STEP_WORK_S))


def rounds(seed: int) -> Mission:
    """Three laps of a boxy robot with wheels and a short sight, and three things not on its map."""
    random = np.random.default_rng(seed)
    angles = np.linspace(0.0, 2.0 * np.pi, 6)[:-1] + random.uniform(-0.2, 0.2, 5)
    corners = random.uniform(9.0, 14.0, (5, 1)) * np.stack((np.cos(angles), np.sin(angles)), 1)
    legs = random.choice(5, 3, replace=False)
    middles = corners[legs] + random.uniform(0.4, 0.6, (3, 1)) * (
        corners[(legs + 1) % 5] - corners[legs]
    )
    rocks = zip(middles.tolist(), random.uniform(0.3, 0.9, 3).tolist(), strict=True)
    return Mission.model_validate(
        {
            "world": {"unseen": [{"circle": {"center": at, "radius": r}} for at, r in rocks]},
            "robot": {
                "footprint": [[-0.35, -0.25], [0.35, -0.25], [0.35, 0.25], [-0.35, 0.25]],
                "clearance_m": 0.1, "max_lateral_accel_mps2": 0.6, "sensor": {"range_m": 2.0},
                "drive": {"differential": {"track_m": 0.4, "max_wheel_speed_mps": 2},
                          "delay_s": 0.1, "lag_s": 0.1},
                "max_speed_mps": float(random.uniform(0.8, 2.0)),
            },
            "route": {
                "start": corners[0].tolist(), "via": corners[1:].tolist(),
                "closed": True, "laps": 3,
            },
        }
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_three_laps_past_what_a_short_sight_finds_are_driven_to_their_end(seed: int) -> None:
    """Once 8 of 12 such robots stood for ever: askew, or short of time for all the laps to come."""
    run = simulate(rounds(seed))
    assert run.reached, run.reason
    assert run.replans


def test_a_robot_that_never_turns_on_the_spot_searches_from_one_place_until_it_has_passed_it(
    mission_of: Make, disc_at: Shape, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each step began anew, and what it had found by then was for a place that was passed."""
    monkeypatch.setattr(deadline, "STEP_WORK_S", 4e-3)
    rock = disc_at(25, 0.3, 3, "rock")
    mission = mission_of(
        [0, 0], [50, 0], unseen=[rock], min_turn_radius_m=2.5, turn_on_spot="never",
        sensor={"range_m": 9},
    )  # fmt: skip
    settled = []
    for nav in steps_of(mission):
        pending = nav._state.schedule.pending
        if pending is not None and pending.leave is not None:
            assert pending.leave > nav.distance
            settled.append(pending.leave)
    assert len(settled) > 2 * len(set(settled))
    assert nav.reached
