"""Other paths, timed like all: for who couldn't be served, and for who waits long."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from viaspline.fleet.crossing_paths import CrossingPaths, crossing_paths
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.laying.kept_paths import PathAlone
from viaspline.fleet.laying.lay_round_stretch import lay_round_stretch
from viaspline.fleet.rerouted_fleet import rerouted_fleet
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import Plan
from viaspline.planning.problem.work_budget import WorkBudget

APART = 1.1  # centre to centre: twice a radius of 0.4 m, and 0.3 m between


CART = {"radius_m": 0.4, "clearance_m": 0.1, "max_speed_mps": 1.5}
LONG = {"footprint": [[-0.6, -0.3], [0.6, -0.3], [0.6, 0.3], [-0.6, 0.3]], "clearance_m": 0.1}


def loop(*ends: tuple[Any, Any], kind: dict[str, Any] = CART, **more: Any) -> Fleet:
    """A ring of two aisles, the lower one shorter, in which two robots can't pass."""
    hole = [[2, 2], [28, 2], [28, 12], [2, 12]]
    robots = [
        {"name": f"r{k}", "route": {"start": a, "goal": b}, **more} for k, (a, b) in enumerate(ends)
    ]
    return Fleet.model_validate(
        {
            "world": {"bounds": [0, 0, 30, 14], "known": [{"polygon": hole}]},
            "separation_m": 0.3,
            "robots": {"cart": kind},
            "fleet": robots,
        }
    )


def timed(fleet: Fleet) -> tuple[TimedFleet, CrossingPaths]:
    paths = crossing_paths(fleet)
    return TimedFleet.by_priority(FleetWays.of(fleet, paths)), paths


def places(plan: Plan, times: Floats) -> Floats:
    return np.asarray(plan.path.at_distance(plan.trajectory.distance_at(times)))


def least_distance(found: TimedFleet) -> float:
    """Of any two robots, every 10 ms."""
    plans = list(found.plans().values())
    times = np.arange(0.0, max(plan.trajectory.end_time for plan in plans) + 1.0, 0.01)
    tracks = [places(plan, times) for plan in plans]
    return min(float(np.hypot(*(a - b).T).min()) for k, a in enumerate(tracks) for b in tracks[:k])


SWAP = (([1, 3], [29, 3]), ([29, 3], [1, 3]))


def test_two_that_meet_head_on_take_either_side_of_the_loop() -> None:
    fleet = loop(*SWAP)
    before, paths = timed(fleet)
    assert len(before.blocked) == 1
    assert paths.laid.kept is not None
    after = rerouted_fleet(before, paths.laid.kept, fleet.separation_m, 10.0)
    assert not after.blocked
    assert certify_fleet(after.ways.courses, after.timing.laws, fleet.separation_m).holds
    assert least_distance(after) >= APART - 1e-6
    tops = [plan.path.evaluate(np.linspace(*plan.path.domain, 500)) for plan in after.ways.plans]
    assert sorted(float(line[:, 1].max()) > 12.0 for line in tops) == [False, True]
    assert all(plan.certificate.holds for plan in after.ways.plans)


def test_without_a_budget_all_stays_as_it_was() -> None:
    fleet = loop(*SWAP)
    before, paths = timed(fleet)
    assert paths.laid.kept is not None
    assert rerouted_fleet(before, paths.laid.kept, fleet.separation_m, 0.0) is before


@pytest.mark.parametrize(("kind", "needs_work"), [(LONG, True), (CART, False)])
def test_a_body_is_led_round_if_that_is_found_with_what_may_be_spent(
    kind: dict[str, Any], needs_work: bool
) -> None:
    fleet = loop(*SWAP, kind=kind)
    before, paths = timed(fleet)
    kept = paths.laid.kept
    assert kept is not None
    alone, other = kept.alone["r0"], paths.laid.plans["r1"]
    assert isinstance(alone, PathAlone)
    reach = before.ways.courses.packed.reach.tolist()
    works = [WorkBudget(limit) for limit in (0.0, 5.0)]
    without, found = (
        lay_round_stretch(alone, "r0", reach[0], kept.rests, other, reach[1], (5.0, 20.0), work)
        for work in works
    )
    assert found is not None
    assert found.certificate.holds
    assert (without is None) == needs_work
    assert (works[1].spent > 0.0) == needs_work


def test_who_waits_long_goes_round_and_never_is_anybody_later_in_the_sum() -> None:
    fleet = loop(([1, 3], [26, 1]), ([24, 1], [1, 5]), ([20, 1], [1, 8]))
    before, paths = timed(fleet)
    assert paths.laid.kept is not None
    spent: list[float] = []
    after = rerouted_fleet(
        before, paths.laid.kept, fleet.separation_m, 6.0, polish=0.02, progress=spent.append
    )
    ends = [
        sum(plan.trajectory.end_time for plan in found.plans().values())
        for found in (before, after)
    ]
    assert len(after.blocked) <= len(before.blocked)
    if len(after.blocked) == len(before.blocked):
        assert ends[1] <= ends[0] + 1e-9
    assert all(0.0 < share <= 1.0 for share in spent)
    assert least_distance(after) >= APART - 1e-6


@pytest.mark.parametrize("again", range(2))
def test_the_same_fleet_gets_the_same_paths(again: int) -> None:
    fleet = loop(*SWAP)
    found = []
    for _ in range(2):
        before, paths = timed(fleet)
        assert paths.laid.kept is not None
        found.append(rerouted_fleet(before, paths.laid.kept, fleet.separation_m, 5.0 + again))
    for one, two in zip(found[0].ways.plans, found[1].ways.plans, strict=True):
        assert one.path.spans.tobytes() == two.path.spans.tobytes()
