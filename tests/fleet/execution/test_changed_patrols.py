"""Fleets with patrols that never end, changed under way and in their plans."""

from __future__ import annotations

from contextlib import suppress
from functools import cache
from itertools import combinations
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.errors import GaveUpError, GeometryError, PlanningError
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.route_spec import Route

STEP_S = 0.2


def fleet(*robots: dict[str, Any], world: Any = None) -> vs.Fleet:
    named = [{"name": f"r{k}", **one} for k, one in enumerate(robots)]
    return vs.Fleet.model_validate({"world": world or {}, "fleet": named})


def patrol(*points: Any) -> dict[str, Any]:
    return {"route": {"start": points[0], "via": list(points[1:]), "closed": True}}


def member(name: str, route: Any) -> FleetMember:
    return FleetMember(name, fleet({"route": route}).members[0].mission)


PATROLS = patrol([0, 0], [20, 0]), patrol([10, 9], [10, -14])
CROSSES = {"start": [4, 9], "goal": [4, -9]}


@cache
def planned() -> vs.FleetPlan:
    return vs.plan_fleet(fleet(*PATROLS))


class PatrolDrive:
    """Robots that do what the navigator tells them, and count what they drove along their paths."""

    def __init__(self, plan: vs.FleetPlan) -> None:
        self.nav, self.time, self.least = vs.FleetNavigator(plan, period=STEP_S), 0.0, np.inf
        self.separation = plan.fleet.separation_m
        self.come: dict[str, float] = {}
        self.speed: dict[str, float] = {}
        self.path: dict[str, int] = {}
        self.holds: dict[str, float] = {}
        self.heard = -1.0
        self.lap = {
            name: plan.plans[name].path.length / plan.plans[name].mission.route.laps
            for name in plan.patrols.laps
        } if plan.patrols else {}  # fmt: skip

    def until(self, time: float) -> None:
        while self.time < time:
            commands, self.nav = self.nav.step([self._report(n) for n in self.come], self.time)
            assert not [one for one in self.nav.events if one.kind == "refused"]
            for name, told in commands.items():
                if told.path != self.path.get(name, 0):
                    self.come[name], self.speed[name] = 0.0, 0.0
                    self.lap.pop(name, None)
                self.path[name], self.holds[name] = told.path, told.granted
                come = self.come.get(name, 0.0)
                self.come[name] = max(come, told.distance)
                self.speed[name] = told.speed if told.distance > come else 0.0
            self.heard = self.time
            self.time += STEP_S
            for one, two in combinations(self.come, 2):
                apart = float(np.hypot(*(self._at(one) - self._at(two))))
                reach = sum(self.nav.paths[n].mission.robot.outer_radius for n in (one, two))
                self.least = min(self.least, apart - reach)

    def _report(self, name: str) -> vs.ProgressReport:
        ends = name not in self.lap and self.come[name] >= self.nav.paths[name].path.length - 1e-6
        return vs.ProgressReport(
            name, self.time, self.come[name], self.speed[name], arrived=ends, path=self.path[name],
            holds=self.holds[name], heard=self.heard,
        )  # fmt: skip

    def _at(self, name: str) -> Any:
        come = self.come[name] % self.lap[name] if name in self.lap else self.come[name]
        path = self.nav.paths[name].path
        return np.asarray(path.at_distance(min(come, path.length)))[:2]


def goes_on(drive: PatrolDrive, names: tuple[str, ...] = ("r0", "r1")) -> bool:
    """Whether patrols drive several laps more, clear of all others."""
    before = {name: drive.come.get(name, 0.0) for name in names}
    drive.until(drive.time + 5.0 * planned().patrols.period)  # type: ignore[union-attr]
    laps = [(drive.come[name] - before[name]) / drive.lap[name] for name in names]
    return min(laps) > 3.0 and drive.least >= drive.separation - 1e-6


@pytest.mark.parametrize("since", [3.0, 150.0, 230.0])
def test_a_robot_that_asks_for_a_period_joins_patrols_and_they_go_on(since: float) -> None:
    drive = PatrolDrive(planned())
    for later in np.arange(0.0, planned().patrols.period, 2.0):  # type: ignore[union-attr]
        drive.until(since + later)
        with suppress(GaveUpError):
            drive.nav = drive.nav.with_robot(member("new", CROSSES))
            break
    assert goes_on(drive)
    assert drive.come["new"] == pytest.approx(drive.nav.paths["new"].path.length)


@pytest.mark.parametrize("since", [1.0, 10.0])
def test_a_robot_joins_patrols_on_curves_and_they_go_on(since: float) -> None:
    """Their speeds change all along, and boxes of crossings are a little larger in some laps."""
    curved = {"spline": {"tension": 0.0}}
    rounds = patrol([0, 0], [10, 3], [20, 0], [10, -3]), patrol([10, 9], [14, 0], [10, -14], [6, 0])
    drive = PatrolDrive(vs.plan_fleet(fleet(*({**one, **curved} for one in rounds))))
    drive.until(since)
    drive.nav = drive.nav.with_robot(member("new", {"start": [3, 9], "goal": [3, -9]}))
    assert goes_on(drive)
    assert drive.come["new"] == pytest.approx(drive.nav.paths["new"].path.length)


def test_a_robot_that_would_rest_in_a_patrols_way_does_not_join() -> None:
    drive = PatrolDrive(planned())
    drive.until(3.0)
    there = np.asarray(planned().plans["r0"].path.at_distance(5.0))[:2].tolist()
    with pytest.raises(PlanningError):
        drive.nav.with_robot(member("new", {"start": [5, 9], "goal": there}))
    with pytest.raises(GeometryError, match="a patrol that never ends"):
        drive.nav.with_robot(member("new", patrol([40, 0], [50, 0])["route"]))


@pytest.mark.parametrize("time", [132.0, 150.0, 160.0])  # the other waits for it in two
def test_a_patrol_is_sent_elsewhere_after_some_laps_and_the_other_goes_on(time: float) -> None:
    drive = PatrolDrive(planned())
    drive.until(time)
    assert drive.come["r0"] > 2.0 * drive.lap["r0"]
    drive.nav = drive.nav.stopping("r0")
    stops = drive.nav.events[-1].at_m
    drive.until(time + 20.0)
    assert drive.speed["r0"] == 0.0
    assert drive.come["r0"] == pytest.approx(stops, abs=0.1)
    stood = drive._at("r0")
    elsewhere = Route.model_validate({"start": [0, 0], "goal": [-10, 5]})
    for later in np.arange(20.0, 20.0 + planned().patrols.period, 5.0):  # type: ignore[union-attr]
        drive.until(time + later)
        with suppress(GaveUpError):  # it is told to ask again when the other has passed
            drive.nav = drive.nav.rerouted("r0", elsewhere)
            break
    assert np.asarray(drive.nav.paths["r0"].path.at_distance(0.0))[:2] == pytest.approx(stood)
    assert goes_on(drive, ("r1",))
    assert drive.come["r0"] == pytest.approx(drive.nav.paths["r0"].path.length)


def test_patrols_stand_at_their_stations_in_every_lap() -> None:
    there = {"at": [20, 0], "dwell_s": 4.0}
    plan = vs.plan_fleet(fleet(patrol([0, 0], there), PATROLS[1]))
    drive = PatrolDrive(plan)
    stood: dict[int, float] = {}
    lap, half = drive.lap["r0"], 0.5 * drive.lap["r0"]
    while drive.time < 8.0 * plan.patrols.period:  # type: ignore[union-attr]
        drive.until(drive.time + 0.5 * STEP_S)
        number = int(drive.come["r0"] // lap)
        if drive.speed["r0"] == 0.0 and abs(drive.come["r0"] % lap - half) < 0.5:
            stood[number] = stood.get(number, 0.0) + STEP_S
    laps = range(int(drive.come["r0"] // lap))
    assert len(laps) > plan.plans["r0"].mission.route.laps
    assert min(stood.get(number, 0.0) for number in laps) >= 4.0 - STEP_S


def test_who_waits_for_a_dead_robot_goes_round_it_but_patrols() -> None:
    drive = PatrolDrive(vs.plan_fleet(fleet(*PATROLS, {"route": {**CROSSES, "start": [5, 20]}})))
    drive.until(7.0)
    drive.nav = drive.nav.dead("r1")
    drive.until(120.0)
    drive.nav = drive.nav.replanned()
    found = [one for one in drive.nav.events if one.kind == "has no way"]
    assert all("a patrol that never ends" in one.message for one in found if one.name == "r0")
    assert drive.least >= drive.separation - 1e-6


def test_a_plan_with_patrols_gets_a_robot_more_and_one_less() -> None:
    more = vs.add_robot(planned(), member("new", CROSSES))
    assert more.served
    assert planned().patrols is not None
    assert more.patrols is not None
    assert more.patrols.laps == planned().patrols.laps
    assert more.patrols.repeats_from >= more.plans["new"].trajectory.end_time
    assert more.certificate.repeats == (more.patrols.repeats_from, planned().patrols.period)
    assert more.alone["r0"] == planned().alone["r0"]
    drive = PatrolDrive(more)
    assert goes_on(drive)
    assert drive.come["new"] == pytest.approx(more.plans["new"].path.length)
    one = vs.remove_robot(more, "r1")
    assert one.patrols is not None
    assert set(one.patrols.laps) == {"r0"}
    assert goes_on(PatrolDrive(one), ("r0",))
    assert vs.remove_robot(one, "r0").patrols is None
    assert vs.reroute_robot(one, member("r0", {"start": [0, 30], "goal": [9, 30]})).patrols is None


def test_a_plan_among_things_that_move_is_not_changed() -> None:
    motion = {"from": [40, 40], "velocity_mps": [0.0, 1.0]}
    tram = {"name": "tram", "circle": {"center": [0, 0], "radius": 1.0}, "motion": motion}
    robots = fleet({"route": CROSSES}, {"route": {"start": [9, 9], "goal": [9, -9]}})
    asked = robots.model_dump(exclude_unset=True, by_alias=True)
    plan = vs.plan_fleet(vs.Fleet.model_validate({**asked, "world": {"known": [tram]}}))
    with pytest.raises(GeometryError, match="'tram' waits for nobody"):
        vs.add_robot(plan, member("new", {"start": [0, 30], "goal": [9, 30]}))
    with pytest.raises(GeometryError, match="'tram' waits for nobody"):
        vs.remove_robot(plan, "r1")
