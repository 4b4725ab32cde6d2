"""A drive along the path exactly ends at its end, at a contact, or when it takes too long."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import pytest

from viaspline.errors import GeometryError
from viaspline.mission.model import Mission
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot import simulator
from viaspline.robot.navigator import Navigator
from viaspline.robot.run import Run
from viaspline.robot.simulation import exact_drive
from viaspline.robot.simulation.pace import by_clock
from viaspline.robot.simulator import simulate

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]


def kinds(run: Run) -> list[str]:
    return [event.kind for event in run.events]


def test_a_robot_without_a_sensor_touches_what_it_can_not_see(mission_of: Make) -> None:
    mission = mission_of([0, 0], [50, 0])
    blind = mission.robot.model_copy(update={"sensor": None})
    rock = Obstacle(circle=Circle(center=(25, 0), radius=3), name="rock")
    world = mission.world.model_copy(update={"unseen": (rock,)})
    mission = mission.model_copy(update={"robot": blind, "world": world})
    run = simulate(mission)
    assert not run.reached
    assert run.reason == "the robot touched 'rock'"
    assert kinds(run)[-1] == "contact"
    assert run.positions[-1][0] == pytest.approx(25 - 3 - 0.5, abs=0.02)
    assert run.certificate.clearance == pytest.approx(0.0, abs=0.02)
    assert run.visits[-1].status == "failed"


def test_a_body_that_starts_in_something_unseen_has_touched_it(
    mission_of: Make, disc_at: Shape
) -> None:
    run = simulate(mission_of([0, 0], [50, 0], unseen=[disc_at(1, 0, 1.2)]))
    assert run.reason == "the robot touched 'obstacle 1'"
    assert run.duration == 0.0


def test_a_drive_that_does_not_end_is_broken_off(
    mission_of: Make, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(simulator, "MAX_DURATION_RATIO", 0.1)
    monkeypatch.setattr(simulator, "MAX_DELAY_S", 0.0)
    monkeypatch.setattr(exact_drive, "MAX_QUIET_STEPS", 20)
    run = simulate(mission_of([0, 0], [50, 0]))
    assert not run.reached
    assert run.reason is not None
    assert "broken off" in run.reason
    assert run.visits[-1].reason == run.reason


def test_a_long_body_touches_what_its_outline_touches_and_not_its_outer_disc(
    mission_of: Make, disc_at: Shape
) -> None:
    plank = [(-0.2, -0.2), (1.5, -0.2), (1.5, 0.2), (-0.2, 0.2)]
    mission = mission_of(
        [0, 0], [10, 0], known=[disc_at(5, 1, 0.5, "post")], footprint=plank, clearance_m=0.1
    )
    run = simulate(mission)
    assert run.reached, run.reason
    assert 0.1 <= run.certificate.clearance < 0.4


def test_a_long_body_that_turns_on_the_spot_touches_what_its_corners_pass(
    mission_of: Make, disc_at: Shape
) -> None:
    plank = [(-0.2, -0.2), (1.5, -0.2), (1.5, 0.2), (-0.2, 0.2)]
    robot = {"footprint": plank, "clearance_m": 0.1, "sensor": {"range_m": 5}}
    route = {"start": [0, 0], "via": [[5, 0]], "goal": [5, 5]}
    mission = Mission.model_validate({"robot": robot, "route": route, "spline": {"tension": 1}})
    assert simulate(mission).reached
    post = Obstacle(circle=Circle(center=(5.9, 0.9), radius=0.1), name="post")
    blind = mission.robot.model_copy(update={"sensor": None})
    world = mission.world.model_copy(update={"unseen": (post,)})
    run = simulate(mission.model_copy(update={"robot": blind, "world": world}))
    assert run.reason == "the robot touched 'post'"


def test_a_robot_that_thinks_for_long_goes_on_by_its_old_path_meanwhile(mission_of: Make) -> None:
    """Two rocks: the second comes in sight while the robot still searches a way round the first."""
    rocks = [Circle(center=(x, 0.5), radius=1.5) for x in (30, 36)]
    world = {"unseen": tuple(Obstacle(circle=rock) for rock in rocks)}
    mission = mission_of([0, 0], [60, 0])
    mission = mission.model_copy(update={"world": mission.world.model_copy(update=world)})
    at_once = simulate(mission, pace=lambda nav: 0.0)
    slowly = simulate(mission, pace=lambda nav: 1.0 if nav.compute_times else 0.0)
    for run in (at_once, slowly):
        assert run.reached
        assert run.certificate.holds
    seen = [
        [event.time for event in run.events if event.kind == "detected"]
        for run in (at_once, slowly)
    ]
    assert seen[1][1] >= seen[0][1]
    assert seen[1][1] - seen[1][0] >= 1.0 - 1e-9


@pytest.mark.parametrize("drive", [None, {"differential": {"track_m": 0.5}}], ids=["none", "drive"])
@pytest.mark.parametrize(
    ("pace", "said"),
    [
        (dict, "pace is the class dict"),
        (lambda nav: "long", "is 'long'; give a number"),
        (lambda nav: -1.0, "is -1.0; give 0 s to"),
        (lambda nav: 1e9, "is 1000000000.0; give 0 s to"),
    ],
)
def test_a_pace_that_tells_no_time_is_refused(
    mission_of: Make, drive: Any, pace: Any, said: str
) -> None:
    with pytest.raises(GeometryError, match=re.escape(said)):
        simulate(mission_of([0, 0], [5, 0], drive=drive), pace=pace)


def test_by_the_clock_a_search_takes_what_it_took(mission_of: Make) -> None:
    rock = Obstacle(circle=Circle(center=(25, 0), radius=3))
    mission = mission_of([0, 0], [50, 0])
    world = mission.world.model_copy(update={"unseen": (rock,)})
    told: list[float] = []

    def pace(nav: Navigator) -> float:
        told.append(by_clock(nav))
        assert told[-1] == sum(nav.compute_times)
        return told[-1]

    run = simulate(mission.model_copy(update={"world": world}), pace=pace)
    assert run.reached
    assert sum(told) == pytest.approx(sum(run.compute_times))
    assert max(told) > 0.0
