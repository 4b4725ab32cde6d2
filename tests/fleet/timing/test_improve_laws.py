"""Sooner laws are still clear of each other, and the same each time."""

from __future__ import annotations

import numpy as np
import pytest

import viaspline as vs
from viaspline.fleet.crossing_paths import crossing_paths
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.kernels.fleet.passing_order import passing_gaps


@pytest.fixture(scope="module")
def timed() -> TimedFleet:
    return lanes_across(8)


def lanes_across(count: int) -> TimedFleet:
    """Lanes across lanes, each with its rests outside of all others."""
    far = 6 * count + 22
    lanes = [[[0, 6 * k + 10], [far, 6 * k + 10]] for k in range(count)]
    lanes += [[[6 * k + 10, 0], [6 * k + 10, far]] for k in range(count)]
    data = [
        {"name": f"r{k}", "priority": k % 2, "route": {"start": start, "goal": goal}}
        for k, (start, goal) in enumerate(lanes)
    ]
    fleet = vs.Fleet.model_validate({"separation_m": 1, "fleet": data})
    return TimedFleet.by_priority(FleetWays.of(fleet, crossing_paths(fleet)))


def lateness(timed: TimedFleet) -> float:
    """Of all robots together, each weighed by its priority [s]."""
    ways, laws = timed.ways, timed.timing.laws.packed
    late = laws.arrive[ways.courses.packed.first[1:] - 1] - ways.rides.alone
    weight = 2.0 ** np.array([one.priority for one in ways.members])
    return float((weight * late).sum())


def beside_each_other(*ends: int) -> TimedFleet:
    """From one row of places to another one, each other robot the other way; all leave there."""
    lanes = [([0, 1.5 * k], [40, 1.5 * to])[:: (-1) ** k] for k, to in enumerate(ends)]
    data = [
        {"name": f"r{k}", "rest": "leave", "route": {"start": start, "goal": goal}}
        for k, (start, goal) in enumerate(lanes)
    ]
    robots = {"cart": {"radius_m": 0.3, "clearance_m": 0.1}}
    fleet = vs.Fleet.model_validate({"separation_m": 0.3, "robots": robots, "fleet": data})
    return TimedFleet.by_priority(FleetWays.of(fleet, crossing_paths(fleet)))


def test_more_work_gives_no_later_laws_and_they_stay_proven() -> None:
    timed = beside_each_other(4, 2, 1, 3, 0)
    better = timed.improved(0.2)
    assert lateness(better) < lateness(timed) - 1e-4
    ways, laws = better.ways, better.timing.laws
    assert certify_fleet(ways.courses, laws, 0.3).holds
    gaps = passing_gaps(ways.courses.packed, ways.crossings.packed, laws.packed)
    assert np.isfinite(gaps).any()


def test_what_was_timed_before_is_left_alone(timed: TimedFleet) -> None:
    before = lateness(timed)
    timed.improved(0.05)
    assert lateness(timed) == before


def test_the_same_work_gives_the_same_laws(timed: TimedFleet) -> None:
    one, other = timed.improved(0.1), timed.improved(0.1)
    for field in ("arrive", "leave", "speed"):
        first, second = (getattr(x.timing.laws.packed, field) for x in (one, other))
        assert first.tobytes() == second.tobytes()


def test_progress_goes_up_to_all_of_it(timed: TimedFleet) -> None:
    shares: list[float] = []
    timed.improved(0.6, shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0


def test_many_are_timed_anew_with_what_lies_ahead_and_stay_proven() -> None:
    many = lanes_across(26)
    better, other = many.improved(1.0), many.improved(1.0)
    assert better.rank < many.rank
    ways, laws = better.ways, better.timing.laws
    assert certify_fleet(ways.courses, laws, 1.0).holds
    assert laws.packed.arrive.tobytes() == other.timing.laws.packed.arrive.tobytes()


def test_there_is_no_timing_ahead_where_two_come_towards_each_other_in_a_lane() -> None:
    walls = [{"polygon": [[-2, y], [26, y], [26, y + 4], [-2, y + 4]]} for y in (-5.0, 1.0)]
    ends = ([0, 0], [24, 0])
    data = [
        {"name": f"r{k}", "rest": "leave", "route": {"start": ends[k], "goal": ends[1 - k]}}
        for k in range(2)
    ]
    fleet = vs.Fleet.model_validate({"world": {"known": walls}, "separation_m": 1, "fleet": data})
    assert FleetWays.of(fleet, crossing_paths(fleet)).timed_ahead(3) is None
