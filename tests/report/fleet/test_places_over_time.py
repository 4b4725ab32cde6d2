from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.report.fleet.places_over_time import FleetMotion, instants, least_gap, span_of


@given(seed=st.integers(0, 10_000), count=st.integers(0, 30), same=st.booleans())
def test_the_least_gap_is_that_of_all_pairs(seed: int, count: int, same: bool) -> None:
    random = np.random.default_rng(seed)
    places = random.uniform(0, 20, (count, 2))
    bodies = np.full(count, 0.5) if same else random.uniform(0, 6, count)
    gaps = [
        float(np.hypot(*(places[i] - places[j]))) - bodies[i] - bodies[j]
        for i in range(count)
        for j in range(i)
    ]
    assert least_gap(places, bodies) == pytest.approx(min(gaps, default=np.inf))


def test_robots_are_where_their_plans_have_them(fleet_plan: FleetPlan) -> None:
    begin, end = span_of(fleet_plan)
    times = np.linspace(begin, end, 23)
    motion = FleetMotion.of_plan(fleet_plan, times)
    assert motion.names == ("east", "north", "tug")
    assert motion.places.shape == (3, 23, 2)
    assert motion.places[0, 0] == pytest.approx([0, 0])
    assert motion.places[0, -1] == pytest.approx([40, 0])
    along = np.asarray(fleet_plan.plans["tug"].trajectory.distance_at(times))
    assert motion.places[2, :, 1] == pytest.approx(15 - along, abs=0.2)


def test_a_robot_that_leaves_is_gone_after_its_arrival(fleet_plan: FleetPlan) -> None:
    over = fleet_plan.plans["north"].trajectory.end_time
    motion = FleetMotion.of_plan(fleet_plan, np.array([over - 0.1, over + 0.1]))
    assert np.isfinite(motion.places[1, 0]).all()
    assert np.isnan(motion.places[1, 1]).all()


def test_the_nearest_two_are_as_far_apart_as_is_proven(
    fleet_plan: FleetPlan, fleet_run: FleetRun
) -> None:
    proven = fleet_plan.certificate
    times = instants(*span_of(fleet_plan), 3, proven.at_s)
    near = FleetMotion.of_plan(fleet_plan, times).nearest_two()
    assert near.gaps.min() >= proven.separation - 1e-6
    assert near.gaps.min() <= proven.separation + 0.05
    times = instants(0.0, fleet_run.end_s, 3)
    driven = FleetMotion.of_run(fleet_plan, fleet_run, times).nearest_two()
    assert driven.gaps.min() >= 1.0 - 1e-6


def test_many_robots_are_looked_at_less_often() -> None:
    few, many = instants(0.0, 60.0, 2, 33.3), instants(0.0, 60.0, 10_000)
    assert 33.3 in few
    assert len(many) < len(few)
    assert (np.diff(few) > 0).all()
