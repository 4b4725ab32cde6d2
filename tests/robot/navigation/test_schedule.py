"""What a path keeps on which stretch, and which via points are still to come."""

from __future__ import annotations

from dataclasses import replace

import pytest

from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.robot.navigation.schedule import ReducedClearance, Schedule, vias_after

MISSION = Mission.model_validate({"route": {"start": [0, 0], "via": [[20, 5]], "goal": [40, 0]}})


@pytest.fixture(scope="module")
def schedule() -> Schedule:
    made = plan(MISSION)
    return Schedule(made.path, made.trajectory, laid_in=made.world)


def test_a_path_keeps_what_is_required_all_along(schedule: Schedule) -> None:
    assert schedule.kept(5.0, 30.0, 1.0) == ((5.0, 30.0, 1.0),)


def test_where_it_keeps_less_the_stretches_meet(schedule: Schedule) -> None:
    close = replace(schedule, reduced=ReducedClearance(until=12.0, floor=0.4))
    assert close.kept(5.0, 30.0, 1.0) == ((5.0, 12.0, 0.4), (12.0, 30.0, 1.0))
    assert close.kept(5.0, 8.0, 1.0) == ((5.0, 8.0, 0.4), (8.0, 8.0, 1.0))
    assert close.kept(12.0, 30.0, 1.0) == ((12.0, 30.0, 1.0),)


def test_the_via_points_after_one_come_with_their_places_on_the_path(schedule: Schedule) -> None:
    every = vias_after(schedule.path, -1)
    assert [via.name for via, _ in every] == ["start", "via 1", "goal"]
    assert vias_after(schedule.path, 0) == every[1:]
    assert vias_after(schedule.path, 2) == ()
    for via, distance in every:
        assert schedule.place(distance) == pytest.approx(via.at, abs=1e-9)
