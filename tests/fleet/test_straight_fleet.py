"""Robots on the paths that they would take alone, in place of long ways round others."""

from __future__ import annotations

from typing import Any

import numpy as np

import viaspline as vs
from viaspline.fleet.crossing_paths import crossing_paths
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.plan_fleet import is_settled_by_priority, plan_by_priority
from viaspline.fleet.straight_fleet import straight_fleet
from viaspline.fleet.timed_fleet import TimedFleet

APART = 1.1  # centre to centre: twice a radius of 0.4 m, and 0.3 m between


def ring(*ends: tuple[Any, Any]) -> vs.Fleet:
    """A ring of aisles in which two robots can't pass; all leave the world at their goals."""
    hole = [[2, 2], [28, 2], [28, 12], [2, 12]]
    robots = [
        {"name": f"r{k}", "rest": "leave", "route": {"start": a, "goal": b}}
        for k, (a, b) in enumerate(ends)
    ]
    return vs.Fleet.model_validate(
        {
            "world": {"bounds": [0, 0, 30, 14], "known": [{"polygon": hole}]},
            "separation_m": 0.3,
            "robots": {"cart": {"radius_m": 0.4, "clearance_m": 0.1, "max_speed_mps": 1.5}},
            "fleet": robots,
        }
    )


OFF_ITS_START = ((1, 1), (29, 1)), ((15, 1), (29, 13))


def test_who_sets_out_soon_is_followed_not_gone_round() -> None:
    fleet = ring(*OFF_ITS_START)
    paths = crossing_paths(fleet)
    assert paths.laid.plans["r0"].path.length > 45.0  # round the start of the other one
    plan = vs.plan_fleet(fleet)
    assert plan.served
    assert plan.plans["r0"].path.length < 30.0
    assert plan.plans["r0"].trajectory.end_time < 1.2 * plan.alone["r0"]
    assert plan.certificate.separation >= 0.3 - 1e-9
    times = np.arange(0.0, min(one.trajectory.end_time for one in plan.plans.values()), 0.01)
    a, b = (
        np.asarray(one.path.at_distance(one.trajectory.distance_at(times)))
        for one in plan.plans.values()
    )
    assert np.hypot(*(a - b).T).min() >= APART - 1e-6


def test_what_priority_has_alone_is_not_the_last_word_where_a_way_is_long() -> None:
    fleet = ring(*OFF_ITS_START)
    paths = crossing_paths(fleet)
    assert not is_settled_by_priority(plan_by_priority(fleet, paths), paths)


def test_no_fleet_is_served_later_for_it() -> None:
    spots = [(1, 1), (8, 1), (15, 1), (22, 1), (29, 1), (29, 13), (15, 13), (1, 13)]
    looked_at = sooner = 0
    for seed in range(8):
        order = np.random.default_rng(seed).permutation(len(spots))
        fleet = ring(*((spots[order[k]], spots[order[k + 1]]) for k in range(0, 6, 2)))
        paths = crossing_paths(fleet)
        before = TimedFleet.by_priority(FleetWays.of(fleet, paths))
        if before.blocked:
            continue
        found = straight_fleet(before, paths.laid.kept, fleet.separation_m)
        looked_at += 1
        sooner += found.rank < before.rank
        assert found is before or found.rank < before.rank
        assert not found.blocked
    assert looked_at > 3
    assert sooner > 0
