"""What robots do when, beside what their laws say."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import viaspline as vs
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.lost_times import lost_times
from viaspline.fleet.timelines import timelines_of


@pytest.fixture(scope="module")
def planned() -> FleetPlan:
    """Two that let a first one pass, one of them after a stop; a fourth that meets nobody."""
    return vs.plan_fleet(
        vs.Fleet.model_validate(
            {
                "separation_m": 1,
                "robots": {"cart": {"radius_m": 0.5}},
                "fleet": [
                    {"name": "east", "priority": 1, "route": {"start": [0, 0], "goal": [60, 0]}},
                    {"name": "north", "route": {"start": [20, -20], "goal": [20, 20]}},
                    {
                        "name": "south",
                        "depart_s": 3,
                        "route": {
                            "start": [40, 30],
                            "via": [{"at": [40, 12], "dwell_s": 4}],
                            "goal": [40, -20],
                        },
                    },
                    {"name": "far", "route": {"start": [0, 90], "goal": [60, 90]}},
                ],
            }
        )
    )


def test_stretches_follow_each_other_from_departure_to_arrival(planned: FleetPlan) -> None:
    for one in timelines_of(planned):
        law = planned.plans[one.name].trajectory
        assert one.stretches[0].begin == pytest.approx(law.start_time)
        assert one.stretches[-1].end == pytest.approx(law.end_time)
        assert all(a.end == pytest.approx(b.begin) for a, b in pairwise(one.stretches))


def test_late_is_what_is_lost_on_the_way(planned: FleetPlan) -> None:
    lost = lost_times(planned)
    first = planned.courses.packed.first
    for robot, one in enumerate(timelines_of(planned)):
        nodes = slice(int(first[robot]), int(first[robot + 1]))
        total = float((lost.standing[nodes] + lost.driving[nodes]).sum())
        assert one.late == pytest.approx(total, abs=1e-6)
        assert sum(wait.lost for wait in one.waits) <= one.late + 1e-6
        assert sum(wait.lost for wait in one.waits) >= 0.8 * one.late - 1e-6


def test_robots_wait_for_those_that_pass_before_them(planned: FleetPlan) -> None:
    found = {one.name: one for one in timelines_of(planned)}
    told = {(one.second, one.first) for one in planned.precedences if one.waits_s > 0.0}
    assert {(name, wait.other) for name, one in found.items() for wait in one.waits} == told
    assert not found["far"].waits
    assert not found["east"].waits


def test_a_robot_that_waits_is_slower_than_alone(planned: FleetPlan) -> None:
    for one in timelines_of(planned):
        law = planned.plans[one.name].trajectory
        top = float(law.speeds.max())
        for wait in one.waits:
            assert one.waits_for(0.5 * (wait.begin + wait.end)) == wait.other
            times = np.linspace(wait.begin, wait.end, 50)
            assert float(np.ptp(np.asarray(law.distance_at(times)))) < top * (wait.end - wait.begin)


def test_a_stop_at_a_station_is_no_wait(planned: FleetPlan) -> None:
    south = next(one for one in timelines_of(planned) if one.name == "south")
    stands = [one for one in south.stretches if one.kind == "stands"]
    assert sum(one.end - one.begin for one in stands) == pytest.approx(4.0)
