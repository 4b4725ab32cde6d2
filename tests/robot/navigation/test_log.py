"""What is noted of a drive."""

from __future__ import annotations

import pytest

from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigation.log import Log
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.run import Event

MISSION = Mission.model_validate(
    {"route": {"start": [0, 0], "via": [[20, 5], [30, 0]], "goal": [40, 0]}}
)
SEEN = Event("detected", 1.0, (0.0, 0.0), "sees 'rock'")


@pytest.fixture(scope="module")
def schedule() -> Schedule:
    made = plan(MISSION)
    return Schedule(made.path, made.trajectory, laid_in=made.world)


def test_only_a_search_has_a_compute_time(schedule: Schedule) -> None:
    log = Log().with_decision(Decision(schedule, events=(SEEN,)), 0.5)
    assert log == Log(events=(SEEN,))
    log = log.with_decision(Decision(schedule, searched=True, skipped=((1, "lost"),)), 0.25)
    assert log == Log(events=(SEEN,), skipped=((1, "lost"),), compute_times=(0.25,))


def test_a_log_is_never_changed() -> None:
    log = Log()
    assert log.with_events(SEEN, SEEN).events == (SEEN, SEEN)
    assert log == Log()
