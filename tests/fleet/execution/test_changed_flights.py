"""Fleets in space that get a robot more, or other ways for some, against gaps of the test's own."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import viaspline as vs
from viaspline.errors import GeometryError, PlanningError
from viaspline.fleet.execution.changed_plans import add_robot, remove_robot, reroute_robot
from viaspline.fleet.execution.driven_fleet import driven_fleet_of
from viaspline.fleet.execution.fleet_orders import orders_of
from viaspline.fleet.execution.ways_in_the_air import rest_of_flight
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.route_spec import Route
from viaspline.space.spatial_plan import SpatialPlan

Floats = NDArray[np.float64]
RADIUS, HALF, SEPARATION = 0.4, 0.2, 1.0
KINDS = {"drone": {"radius_m": RADIUS, "half_height_m": HALF, "clearance_m": 0.5,
                   "max_speed_mps": 4, "max_accel_mps2": 1.5, "max_climb_mps": 2,
                   "max_descent_mps": 1}}  # fmt: skip
PERIOD_S = 0.5
SLACK = 2e-6
CROSS = ({"start": [0, 0, 10], "goal": [40, 0, 10]}, {"start": [20, -20, 10], "goal": [20, 20, 10]})
ASIDE = {"start": [0, 40, 10], "goal": [40, 40, 10]}


def fleet(*routes: Any, world: Any = None) -> vs.Fleet:
    robots = [{"name": f"r{k}", "route": route} for k, route in enumerate(routes)]
    return vs.Fleet.model_validate({"separation_m": SEPARATION, "robots": KINDS,
                                    "world": world or {}, "fleet": robots})  # fmt: skip


def member(name: str, route: Any, world: Any = None) -> FleetMember:
    return FleetMember(name, fleet(route, world=world).members[0].mission)


def gap(one: Floats, other: Floats) -> Floats:
    """Free space between two of the drones at places, (n, 3) each."""
    off = one - other
    level = np.maximum(np.hypot(off[..., 0], off[..., 1]) - 2 * RADIUS, 0.0)
    return np.asarray(np.hypot(level, np.maximum(np.abs(off[..., 2]) - 2 * HALF, 0.0)))


def nearest(plan: vs.FleetPlan) -> float:
    """The least free space between any two, every 10 ms by their plans."""
    end = max(one.trajectory.end_time for one in plan.plans.values())
    times = np.arange(-1.0, end + 1.0, 0.01)
    at = [np.asarray(one.path.at_distance(one.trajectory.distance_at(times)))
          for one in plan.plans.values()]  # fmt: skip
    return min(float(gap(a, b).min()) for a, b in combinations(at, 2))


def test_a_flight_is_added_and_nothing_of_the_others_changes() -> None:
    plan = vs.plan_fleet(fleet(*CROSS, ASIDE))
    more = add_robot(plan, member("new", {"start": [30, -20, 10], "goal": [30, 20, 10]}))
    assert more.served
    assert tuple(more.plans) == ("r0", "r1", "r2", "new")
    assert all(more.plans[name] is plan.plans[name] for name in plan.plans)
    assert nearest(more) >= SEPARATION - SLACK
    assert more.certificate.separation <= nearest(more) + SLACK
    assert len(orders_of(driven_fleet_of(more)).sequence()) > 0
    less = remove_robot(more, "new")
    for kind in ("courses", "crossings", "laws"):
        one, two = getattr(less, kind).packed, getattr(plan, kind).packed
        for a, b in zip(one, two, strict=True):
            assert a.tolist() == b.tolist()
    assert less.courses.bodies is not None
    assert plan.courses.bodies is not None
    assert less.courses.bodies.tolist() == plan.courses.bodies.tolist()


def test_a_flight_that_is_added_above_a_crossing_waits_for_nobody() -> None:
    plan = vs.plan_fleet(fleet(*CROSS))
    route = {"start": [30, -20, 12], "goal": [30, 20, 12]}
    more = add_robot(plan, member("new", route))
    assert more.served
    assert all("new" not in (one.first, one.second) for one in more.precedences)
    alone = vs.plan(member("new", route).mission)
    assert more.plans["new"].trajectory.end_time == alone.trajectory.end_time


def test_a_flight_is_sent_elsewhere_and_nothing_of_the_others_changes() -> None:
    plan = vs.plan_fleet(fleet(*CROSS, ASIDE))
    other = reroute_robot(plan, member("r1", {"start": [20, -20, 10], "goal": [20, 60, 10]}))
    assert other.served
    assert all(other.plans[name] is plan.plans[name] for name in ("r0", "r2"))
    assert nearest(other) >= SEPARATION - SLACK


def test_a_robot_without_heights_cant_join_flights() -> None:
    plan = vs.plan_fleet(fleet(*CROSS))
    cart = vs.Mission.model_validate({"route": {"start": [0, 9], "goal": [9, 9]}})
    with pytest.raises(GeometryError, match="'cart' is in the plane, and the fleet isn't"):
        add_robot(plan, FleetMember("cart", cart))
    with pytest.raises(GeometryError, match="give its points heights"):
        vs.FleetNavigator(plan).with_robot(FleetMember("cart", cart))


@dataclass
class Flight:
    """Drones that do what the navigator tells them, and are looked at every half a second."""

    nav: vs.FleetNavigator
    time: float = 0.0

    def __post_init__(self) -> None:
        self.place = dict.fromkeys(self.nav.names, 0.0)
        self.speed = dict.fromkeys(self.nav.names, 0.0)
        self.number = dict.fromkeys(self.nav.names, 0)
        self.holds = dict.fromkeys(self.nav.names, 0.0)
        self.heard = -1.0
        self.at: dict[str, Floats] = {}
        self.nearest = np.inf
        self.laps = {name: one.path.length / one.mission.route.laps
                     for name, one in self.nav.paths.items()
                     if one.mission.route.closed}  # fmt: skip

    def step(self, dead: tuple[str, ...] = ()) -> None:
        paths = self.nav.paths
        reports = [
            vs.ProgressReport(
                name, self.time, self.place[name], self.speed[name],
                name not in self.laps and self.place[name] >= paths[name].path.length - 1e-6,
                self.holds[name],
                self.heard, self.number[name],
            )
            for name in self.place if name not in dead and name in self.nav.names
        ]  # fmt: skip
        commands, self.nav = self.nav.step(reports, self.time)
        assert not [one for one in self.nav.events if one.kind == "refused"]
        self.heard = self.time
        for name, command in commands.items():
            if name in dead:
                continue
            assert command.path == self.number[name]
            if command.granted >= self.holds[name] or self._stops_at(name) <= command.granted:
                self.holds[name] = command.granted
            self.place[name] = max(self.place[name], min(command.distance, self.holds[name]))
            self.speed[name] = command.speed
        self.time += PERIOD_S
        for name in self.place:
            if name in self.nav.names:
                path = self.nav.paths[name].path
                along = self.place[name] % self.laps.get(name, np.inf)
                self.at[name] = np.asarray(path.at_distance(min(along, path.length)))
        gone = [name for name in self.at if self.nav.progress.get(name, np.inf) == np.inf]
        for a, b in combinations([name for name in self.at if name not in gone], 2):
            self.nearest = min(self.nearest, float(gap(self.at[a], self.at[b])))

    def _stops_at(self, name: str) -> float:
        return self.place[name] + self.speed[name] ** 2 / 2.0

    def take(self, nav: vs.FleetNavigator) -> None:
        """A navigator of a fleet that was changed."""
        before, self.nav = self.nav.paths, nav
        for name in nav.names:
            if name not in before or nav.paths[name] is not before[name]:
                self.number[name] = self.number[name] + 1 if name in self.number else 0
                self.place[name] = self.speed[name] = self.holds[name] = 0.0
                self.laps.pop(name, None)

    def until(self, seconds: float, dead: tuple[str, ...] = ()) -> None:
        while self.time < seconds and not self.nav.reached:
            self.step(dead)


def start(*routes: Any, world: Any = None, periods: int = 2) -> Flight:
    plan = vs.plan_fleet(fleet(*routes, world=world), periods=periods)
    assert plan.served
    return Flight(vs.FleetNavigator(plan, period=PERIOD_S))


def test_a_flight_that_joins_under_way_passes_the_others() -> None:
    flight = start(*CROSS, ASIDE)
    flight.until(6.0)
    flight.take(flight.nav.with_robot(member("new", {"start": [30, -20, 10],
                                                     "goal": [30, 20, 10]})))  # fmt: skip
    assert [(one.kind, one.name) for one in flight.nav.events][-1] == ("added", "new")
    flight.until(120.0)
    assert flight.nav.reached
    assert flight.nearest >= SEPARATION - SLACK


def test_a_flight_that_is_taken_out_is_waited_for_by_nobody() -> None:
    flight = start(*CROSS)
    flight.until(2.0)
    flight.take(flight.nav.without("r0"))
    del flight.place["r0"]
    flight.until(60.0)
    assert flight.nav.reached
    assert flight.at["r1"] == pytest.approx([20, 20, 10])


def test_a_flight_is_sent_elsewhere_from_where_it_hovers() -> None:
    flight = start(*CROSS)
    flight.until(3.0)
    flight.take(flight.nav.stopping("r1"))
    with pytest.raises(GeometryError, match="ask it to stop"):
        flight.nav.rerouted("r1", Route(start=(0, 0, 0), goal=(0, 0, 12)))
    flight.until(16.0)
    at = flight.at["r1"]
    route = Route.model_validate({"start": [0, 0, 0], "via": [[20, -12, 14]], "goal": [45, 5, 12]})
    flight.take(flight.nav.rerouted("r1", route))
    begins = np.asarray(flight.nav.paths["r1"].path.at_distance(0.0))
    assert begins == pytest.approx(at)
    flight.until(120.0)
    assert flight.nav.reached
    assert flight.at["r1"] == pytest.approx([45, 5, 12])
    assert flight.nearest >= SEPARATION - SLACK


def test_who_waits_for_one_that_hovers_for_ever_goes_round_it() -> None:
    flight = start(*CROSS, ASIDE)
    while flight.place["r0"] < 20.0:
        flight.step()
    flight.take(flight.nav.dead("r0", flight.place["r0"]))
    assert flight.nav.blocked == {"r1": "r0"}
    flight.until(40.0, dead=("r0",))
    assert not flight.nav.reached
    flight.take(flight.nav.replanned())
    assert flight.nav.blocked == {}
    flight.until(100.0, dead=("r0",))
    assert flight.nav.reached
    assert flight.nearest >= SEPARATION - SLACK
    assert flight.at["r1"] == pytest.approx([20, 20, 10])


def test_a_patrol_is_sent_elsewhere_and_the_others_go_on() -> None:
    rounds = [{"start": [0, 0, z], "via": [[20, 0, z], [20, 20, z]], "closed": True}
              for z in (10, 16)]  # fmt: skip
    flight = start(*rounds, periods=4)
    flight.until(40.0)
    flight.take(flight.nav.stopping("r0"))
    flight.until(50.0)
    flight.take(flight.nav.rerouted("r0", Route(start=(0, 0, 0), goal=(30, 30, 12))))
    flight.until(150.0)
    assert flight.at["r0"] == pytest.approx([30, 30, 12])
    assert flight.place["r1"] > 200.0
    assert flight.nearest >= SEPARATION - SLACK


GROUND = {"ground": {"flat_m": 100}, "altitude": {"min_m": 5, "max_m": 40}}
UP_AND_DOWN = {"start": [0, 0], "takeoff": {"to_agl_m": 10}, "via": [[20, 0, 112], [30, 0, 112]],
               "land": [40, 0]}  # fmt: skip


def test_one_that_has_landed_takes_off_again_where_it_stands() -> None:
    flight = start(UP_AND_DOWN, world=GROUND)
    flight.until(120.0)
    assert flight.nav.reached
    assert flight.at["r0"] == pytest.approx([40, 0, 100 + HALF])
    route = Route.model_validate({"start": [0, 0], "takeoff": {"to_agl_m": 8},
                                  "goal": [40, 20, 115]})  # fmt: skip
    flight.take(flight.nav.rerouted("r0", route))
    plan = flight.nav.paths["r0"]
    assert isinstance(plan, SpatialPlan)
    assert np.asarray(plan.path.at_distance(plan.airborne[0])) == pytest.approx([40, 0, 108])
    flight.until(240.0)
    assert flight.at["r0"] == pytest.approx([40, 20, 115])


def test_one_that_is_sent_elsewhere_on_its_way_up_goes_on_up_first() -> None:
    flight = start(UP_AND_DOWN, world=GROUND)
    flight.until(1.0)
    flight.take(flight.nav.stopping("r0"))
    flight.until(6.0)
    assert 100.5 < flight.at["r0"][2] < 109.0
    flight.take(flight.nav.rerouted("r0", Route(start=(0, 0, 0), goal=(0, 20, 115))))
    plan = flight.nav.paths["r0"]
    assert isinstance(plan, SpatialPlan)
    assert np.asarray(plan.path.at_distance(plan.airborne[0])) == pytest.approx([0, 0, 110])
    assert plan.certificate.holds
    flight.until(120.0)
    assert flight.at["r0"] == pytest.approx([0, 20, 115])


def test_heights_above_home_stay_above_the_home_of_the_first_flight() -> None:
    """The hill is 30 m higher than home: from there on 40 m above home are 10 above the hill."""
    heights = np.zeros((3, 41))
    heights[:, 20:] = 30.0
    world = {"ground": {"terrain": vs.Terrain(heights, 1.0, (0.0, -1.0))},
             "altitude": {"max_m": 40, "above": "home"}}  # fmt: skip
    flight = start({"start": [5, 0, 35], "goal": [38, 0, 35]}, world=world)
    flight.until(120.0)
    assert flight.nav.reached
    flight.take(flight.nav.rerouted("r0", Route(start=(0, 0, 0), goal=(30, 0, 36))))
    with pytest.raises(PlanningError):
        flight.nav.rerouted("r0", Route(start=(0, 0, 0), goal=(30, 0, 44)))


def test_what_is_left_of_a_flights_route_keeps_its_points_as_they_are() -> None:
    route = {**UP_AND_DOWN, "via": [[10, 0, 112], {"at": [20, 0], "agl_m": 11, "dwell_s": 3},
             {"at": [30, 0, 112], "look_at": [30, 9, 100]}], "yaw": {"fixed_deg": 90}}  # fmt: skip
    plan = vs.plan(member("r0", route, GROUND).mission)
    assert isinstance(plan, SpatialPlan)
    asked = plan.mission.route
    up = plan.airborne[0]
    left = rest_of_flight(plan, 0.5 * up)
    assert (left.via, left.takeoff, left.land) == (asked.via, asked.takeoff, asked.land)
    left = rest_of_flight(plan, up + 12.0)
    assert (left.via, left.land, left.yaw) == (asked.via[1:], asked.land, asked.yaw)
    with pytest.raises(GeometryError, match="comes down to land"):
        rest_of_flight(plan, plan.path.length - 1.0)
    last = vs.plan(member("r0", {"start": [0, 0, 9], "via": [[9, 0, 9], [20, 0, 9]]}).mission)
    assert isinstance(last, SpatialPlan)
    left = rest_of_flight(last, 12.0)
    assert (left.via, left.goal is not None and left.goal.at) == ((), (20.0, 0.0, 9.0))


def test_what_is_left_of_several_laps_ends_where_they_begin() -> None:
    route = {"start": [0, 0, 9], "via": [[20, 0, 9], [20, 20, 9]], "closed": True, "laps": 3}
    plan = vs.plan(member("r0", route).mission)
    assert isinstance(plan, SpatialPlan)
    lap = plan.path.length / 3.0
    left = rest_of_flight(plan, lap + 30.0)
    assert [via.at for via in left.via] == [(20, 20, 9), (0, 0, 9), (20, 0, 9), (20, 20, 9)]
    assert left.goal is not None
    assert left.goal.at == (0, 0, 9)
    assert not left.closed


@settings(max_examples=4, deadline=None)
@given(seed=st.integers(0, 100_000))
def test_whoever_joins_or_is_sent_elsewhere_stays_apart_from_all_others(seed: int) -> None:
    rng = np.random.default_rng(seed)
    taken: list[Floats] = []

    def route() -> dict[str, Any]:
        ends = []
        for _ in range(2):
            at = rng.uniform((0, 0, 5), (25, 25, 15)).round(2)
            while any(gap(at, other) < SEPARATION + 0.5 for other in taken):
                at = rng.uniform((0, 0, 5), (25, 25, 15)).round(2)
            taken.append(at)
            ends.append(at.tolist())
        return {"start": ends[0], "goal": ends[1]}

    plan = vs.plan_fleet(fleet(*(route() for _ in range(3))))
    if not plan.served:
        return
    flight = Flight(vs.FleetNavigator(plan, period=PERIOD_S))
    flight.until(float(rng.uniform(0.0, 8.0)))
    with suppress(PlanningError):
        flight.take(flight.nav.with_robot(member("new", route())))
    flight.take(flight.nav.stopping("r1"))
    flight.until(flight.time + 6.0)
    try:
        flight.take(flight.nav.rerouted("r1", Route.model_validate(route())))
    except (PlanningError, GeometryError):
        flight.take(flight.nav.resumed("r1"))
    flight.until(flight.time + 200.0)
    assert flight.nav.reached
    assert flight.nearest >= SEPARATION - SLACK
