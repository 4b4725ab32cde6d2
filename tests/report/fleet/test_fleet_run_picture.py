from __future__ import annotations

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.report.fleet.driven_timelines import driven_timelines
from viaspline.report.fleet.fleet_run_picture import fleet_run_picture


def test_a_driven_fleet_gives_the_same_picture_each_time(
    fleet_plan: FleetPlan, fleet_run: FleetRun
) -> None:
    picture = fleet_run_picture(fleet_plan, fleet_run, "yard")
    assert picture == fleet_run_picture(fleet_plan, fleet_run, "yard")
    assert picture.startswith(b"\x89PNG")


def test_what_robots_did_goes_on_from_departure_to_arrival(
    fleet_plan: FleetPlan, fleet_run: FleetRun
) -> None:
    for one in driven_timelines(fleet_plan, fleet_run):
        assert one.late == fleet_run.delays[one.name]
        assert abs(one.stretches[-1].end - fleet_run.arrivals[one.name]) < 1e-3
        for before, after in zip(one.stretches, one.stretches[1:], strict=False):
            assert abs(after.begin - before.end) < 2e-3
        told = {(e.name, e.other) for e in fleet_run.events if e.kind == "waits"}
        assert {(one.name, wait.other) for wait in one.waits} <= told
