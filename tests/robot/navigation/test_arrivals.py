"""Via points that are passed, stays that end, and the end of the drive."""

from __future__ import annotations

from dataclasses import replace

import pytest

from viaspline.machine.machine_limits import limits_of
from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.robot.navigation.arrivals import note_arrivals
from viaspline.robot.navigation.drive_task import DriveTask, requirements_under_way
from viaspline.robot.navigation.log import Log
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule

MISSION = Mission.model_validate(
    {
        "route": {
            "start": [0, 0],
            "via": [[20, 5], {"at": [40, 0], "dwell_s": 7, "name": "pump"}],
            "goal": [60, 0],
        }
    }
)
TASK = DriveTask(
    MISSION, requirements_under_way(MISSION, 0.0), limits_of(MISSION.robot), reaction=0.1
)


@pytest.fixture(scope="module")
def schedule() -> Schedule:
    made = plan(MISSION)
    return Schedule(made.path, made.trajectory, laid_in=made.world)


def at(schedule: Schedule, time: float) -> Progress:
    return Progress(time, float(schedule.trajectory.distance_at(time)), last_via=0)


def test_nothing_happens_between_two_points(schedule: Schedule) -> None:
    progress = at(schedule, 3.0)
    assert note_arrivals(TASK, progress, schedule, Log()) == (progress, Log())


def test_points_that_were_passed_together_are_noted_at_their_own_times(schedule: Schedule) -> None:
    time = schedule.trajectory.end_time - 2.0  # long after the stay
    progress, log = note_arrivals(TASK, at(schedule, time), schedule, Log())
    assert [event.kind for event in log.events] == ["via", "arrived", "dwell"]
    first, arrived, leaves = log.events
    assert first.time == pytest.approx(
        float(schedule.trajectory.time_at(schedule.path.via_distances[1]))
    )
    assert leaves.time == arrived.time + 7.0
    assert progress.last_via == 2
    assert [index for index, _ in log.served] == [1, 2]


def test_a_stay_lasts_until_it_is_over(schedule: Schedule) -> None:
    arrival = float(schedule.trajectory.time_at(schedule.path.via_distances[2]))
    progress, log = note_arrivals(TASK, at(schedule, arrival + 1.0), schedule, Log())
    assert progress.dwell is not None
    assert progress.dwell.until == pytest.approx(arrival + 7.0)
    later = replace(progress, time=arrival + 8.0)
    progress, log = note_arrivals(TASK, later, schedule, log)
    assert progress.dwell is None
    assert log.events[-1].message == "the stay at 'pump' is over"


def test_a_robot_that_gives_up_does_not_end_its_stay(schedule: Schedule) -> None:
    arrival = float(schedule.trajectory.time_at(schedule.path.via_distances[2]))
    progress, log = note_arrivals(TASK, at(schedule, arrival + 1.0), schedule, Log())
    stopped = replace(schedule, giving_up="no way")
    progress, after = note_arrivals(TASK, progress, stopped, log)
    assert progress.dwell is None
    assert "dwell" not in [event.kind for event in after.events]


def test_the_drive_ends_where_and_when_its_trajectory_does(schedule: Schedule) -> None:
    over = at(schedule, schedule.trajectory.end_time + 3.0)
    progress, log = note_arrivals(TASK, replace(over, last_via=2), schedule, Log())
    assert progress.finished
    assert log.events[-1].kind == "reached"
    assert log.events[-1].time == schedule.trajectory.end_time
    again = note_arrivals(TASK, progress, schedule, log)
    assert again == (progress, log)


def test_a_robot_that_only_sees_too_little_has_not_ended_its_drive(schedule: Schedule) -> None:
    short = replace(schedule, trajectory=schedule.trajectory.until(10.0))
    progress, log = note_arrivals(TASK, at(short, 60.0), short, Log())
    assert not progress.finished
    stopped = replace(short, giving_up="sees no way to 'goal'")
    progress, log = note_arrivals(TASK, at(short, 60.0), stopped, Log())
    assert progress.finished
    assert log.events[-1].message == "stands: sees no way to 'goal'"
