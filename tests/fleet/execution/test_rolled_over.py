"""Patrols that a navigator drives on and on, longer than their plans."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.fleet.execution.fleet_messages import ProgressReport
from viaspline.fleet.execution.fleet_navigator import FleetNavigator
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.plan_fleet import plan_fleet
from viaspline.mission.fleet.fleet import Fleet

STEP_S = 0.2
FASTEST_MPS = 1.9


def patrol(*points: list[float]) -> dict[str, Any]:
    return {"route": {"start": points[0], "via": list(points[1:]), "closed": True}}


def plan_of(*robots: dict[str, Any]) -> FleetPlan:
    named = [{"name": f"r{k}", **one} for k, one in enumerate(robots)]
    return plan_fleet(Fleet.model_validate({"fleet": named}))


@cache
def patrols() -> FleetPlan:
    return plan_of(patrol([0, 0], [20, 0]), patrol([10, 9], [10, -14]))


@cache
def slanted() -> FleetPlan:
    return plan_of(patrol([0, 0], [20, 5]), patrol([10, 9], [10, -14]))


@cache
def mixed_ones() -> FleetPlan:
    return plan_of(
        patrol([0, 0], [12, 0]),
        patrol([6, 9], [6, -60]),
        {"route": {"start": [3, 12], "goal": [3, -30]}, "rest": "leave"},
    )


def driven(plan: FleetPlan, periods: float, seed: int, lost: float, halting: float) -> Any:
    """Drive robots as far as they were let go, but they halt, and aren't always heard.

    Returns:
        How far each came [m], how near any two were [m], and the navigator at the end.
    """
    assert plan.patrols is not None
    random = np.random.default_rng(seed)
    nav = FleetNavigator(plan, period=STEP_S)
    come = dict.fromkeys(plan.plans, 0.0)
    speed = dict.fromkeys(plan.plans, 0.0)
    halted = dict.fromkeys(plan.plans, 0.0)
    granted = dict.fromkeys(plan.plans, 0.0)
    heard = dict.fromkeys(plan.plans, -1.0)
    least = np.inf
    for time in np.arange(0.0, periods * plan.patrols.period, STEP_S):
        reports = [
            ProgressReport(
                name, time, come[name], speed[name],
                arrived=name not in plan.patrols.begins
                and come[name] >= plan.plans[name].path.length - 1e-9,
                holds=granted[name], heard=heard[name],
            )
            for name in come
            if random.random() >= lost
        ]  # fmt: skip
        commands, nav = nav.step(reports, float(time))
        for name, command in commands.items():
            if random.random() < halting:
                halted[name] = time + random.uniform(1.0, 20.0)
            if random.random() >= lost:
                granted[name] = max(granted[name], command.granted)  # none is given back
                heard[name] = command.time
            room = max(granted[name] - come[name], 0.0)
            quick = min(speed[name] + STEP_S, FASTEST_MPS, np.sqrt(2.0 * room))
            speed[name] = quick if time >= halted[name] else 0.0
            come[name] += min(speed[name] * STEP_S, room)
        least = min(least, _nearest(plan, come))
    return come, least, nav


def _nearest(plan: FleetPlan, come: dict[str, float]) -> float:
    assert plan.patrols is not None
    places = {}
    for name, distance in come.items():
        one = plan.plans[name]
        if name not in plan.patrols.begins and distance >= one.path.length:
            continue  # it has left
        lap = one.path.length / one.mission.route.laps
        there = distance % lap if name in plan.patrols.begins else distance
        places[name] = np.asarray(one.path.at_distance(there))[:2]
    return min(
        float(np.hypot(*(places[one] - places[two])))
        - plan.plans[one].mission.robot.outer_radius
        - plan.plans[two].mission.robot.outer_radius
        for one, two in combinations(places, 2)
    )


@pytest.mark.slow
@pytest.mark.parametrize("made", [patrols, mixed_ones])
def test_patrols_go_on_longer_than_their_plans(made: Callable[[], FleetPlan]) -> None:
    plan = made()
    assert plan.patrols is not None
    come, least, nav = driven(plan, 9.0, 0, lost=0.0, halting=0.0)
    assert least >= plan.fleet.separation_m - 1e-6
    for name, laps in plan.patrols.laps.items():
        lap = plan.plans[name].path.length / plan.plans[name].mission.route.laps
        assert come[name] > plan.plans[name].path.length
        assert come[name] > 7.0 * laps * lap
        assert nav.progress[name] == pytest.approx(come[name], abs=5.0)
        assert nav.expected()[name] == np.inf
    assert not nav.reached


@settings(max_examples=5, deadline=None)
@given(st.integers(0, 10_000), st.booleans())
def test_patrols_that_halt_and_are_not_heard_stay_apart_and_go_on(seed: int, mixed: bool) -> None:
    plan = mixed_ones() if mixed else patrols()
    assert plan.patrols is not None
    come, least, _ = driven(plan, 8.0, seed, lost=0.2, halting=0.002)
    assert least >= plan.fleet.separation_m - 1e-6
    for name in plan.patrols.begins:
        assert come[name] > plan.plans[name].path.length


@pytest.mark.parametrize(
    ("made", "gone"), [(patrols, "r1"), (slanted, "r1"), (slanted, "r0")],
    ids=["square", "slanted", "slanted, the other"],
)  # fmt: skip
def test_a_patrol_that_is_taken_out_does_not_hold_the_others_up(
    made: Callable[[], FleetPlan], gone: str
) -> None:
    plan = made()
    assert plan.patrols is not None
    nav = FleetNavigator(plan, period=STEP_S).without(gone)
    (left,) = set(plan.plans) - {gone}
    come, speed = 0.0, 0.0
    for time in np.arange(0.0, 6.0 * plan.patrols.period, STEP_S):
        commands, nav = nav.step([ProgressReport(left, time, come, speed)], float(time))
        speed = commands[left].speed
        come = max(come, commands[left].distance)
    assert come > plan.plans[left].path.length


def test_a_period_begins_anew_where_laps_are_cut_into_cells_in_two_ways() -> None:
    """The crossings of two laps then end some centimetres beside each other."""
    slow = {"radius_m": 0.6, "clearance_m": 0.1, "max_speed_mps": 0.6, "max_accel_mps2": 0.3}
    swift = {"radius_m": 0.25, "clearance_m": 0.05, "max_speed_mps": 3.0}
    way = {"start": [22.14, 3.36], "via": [[15.18, 10.79], [11.15, 13.71]], "goal": [9.22, 9.56]}
    round_way = patrol([21.32, 0.92], [9.8, 6.16], [18.1, 22.69], [13.95, 8.64])
    members = [{"name": "a", "robot": "slow", "route": way}, {"name": "p", "robot": "swift"}]
    plan = plan_fleet(
        Fleet.model_validate(
            {
                "separation_m": 0.2,
                "robots": {"slow": slow, "swift": swift},
                "fleet": [members[0], {**members[1], **round_way}],
            }
        )
    )
    assert plan.patrols is not None
    nav, come, held = FleetNavigator(plan, warm=False), {"a": 0.0, "p": 0.0}, dict[str, float]()
    length = plan.plans["a"].path.length
    for time in np.arange(0.0, plan.patrols.repeats_from + 4.0 * plan.patrols.period, 0.5):
        reports = [
            ProgressReport(
                name, time, at, 0.0, arrived=name == "a" and at >= length - 1e-9,
                holds=held.get(name), heard=time - 0.5 if held else None,
            )
            for name, at in come.items()
        ]  # fmt: skip
        commands, nav = nav.step(reports, time)
        for name, command in commands.items():
            held[name] = command.granted
            gone = 0.5 * {"a": 0.4, "p": 1.5}[name] if time > 2.0 else 0.0
            come[name] = min(command.granted, come[name] + gone)
    assert come["a"] == length
    assert come["p"] > plan.plans["p"].path.length / plan.plans["p"].mission.route.laps * 2.5
