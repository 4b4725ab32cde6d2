import numpy as np

import viaspline as vs
from viaspline.fleet.courses import courses_of
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.lattice_order.lattice_paths import LatticePaths, lattice_paths
from viaspline.fleet.lattice_order.time_in_order import time_in_order
from viaspline.fleet.timing.rides import rides_of
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.planner import plan


def timed(ends, world, departs=None, leaving=()):
    """Robots on a lattice, in its order."""
    robot = {"radius_m": 0.3, "clearance_m": 0.0, "max_speed_mps": 1.0}
    members = [
        FleetMember(
            f"r{k}",
            vs.Mission.model_validate(
                {
                    "world": world,
                    "robot": robot,
                    "route": {
                        "start": start,
                        "goal": goal,
                        "depart_s": 0.0 if departs is None else departs[k],
                    },
                }
            ),
            rest="leave" if f"r{k}" in leaving else "stay",
        )
        for k, (start, goal) in enumerate(ends)
    ]
    plans = {one.name: plan(one.mission) for one in members}
    paths = lattice_paths(plans, 0.0, work=50_000, leaving=leaving)
    assert isinstance(paths, LatticePaths)
    courses = courses_of(paths.plans, 0.0)
    crossings = crossings_of(courses)
    rides = rides_of(members, list(paths.plans.values()), courses)
    return courses, time_in_order(courses, crossings, rides, list(paths.steps.values()))


def test_robots_that_change_places_are_proven_apart():
    walls = [[(0, 1), (3, 1), (3, 3), (0, 3)], [(4, 1), (7, 1), (7, 3), (4, 3)]]
    world = {"bounds": [0, 0, 7, 3], "known": [{"polygon": ring} for ring in walls]}
    courses, timing = timed([((0.5, 0.5), (6.5, 0.5)), ((6.5, 0.5), (0.5, 0.5))], world)
    assert not timing.blocked
    assert certify_fleet(courses, timing.laws, 0.0).holds


def test_a_crowd_that_is_permuted_is_proven_apart():
    places = [(x + 0.5, y + 0.5) for x in range(0, 8, 2) for y in range(0, 8, 2)]
    order = (5 * np.arange(len(places)) + 3) % len(places)
    ends = [(place, places[k]) for place, k in zip(places, order, strict=True)]
    courses, timing = timed(ends, {"bounds": [0, 0, 8, 8]})
    assert not timing.blocked
    assert certify_fleet(courses, timing.laws, 0.0).holds
    assert np.isfinite(timing.laws.packed.arrive[courses.packed.first[1:] - 1]).all()


def test_nobody_waits_for_a_robot_that_departs_long_after():
    ends = [((0.5, 4.5), (7.5, 4.5)), ((4.5, 0.5), (4.5, 7.5)), ((2.5, 7.5), (2.5, 0.5))]
    world = {"bounds": [0, 0, 8, 8]}
    for late in range(3):
        departs = [100.0 if k == late else 0.0 for k in range(3)]
        courses, timing = timed(ends, world, departs)
        assert not timing.blocked
        assert certify_fleet(courses, timing.laws, 0.0).holds
        first = courses.packed.first
        leave, arrive = (
            timing.laws.packed.leave[first[:-1]],
            timing.laws.packed.arrive[first[1:] - 1],
        )
        for k in range(3):
            assert leave[k] >= departs[k]
            assert (arrive[k] > 100.0) == (k == late)


def test_a_robot_that_leaves_is_passed_where_it_would_have_stood():
    world = {"bounds": [0, 0, 7, 1]}
    ends = [((1.5, 0.5), (3.5, 0.5)), ((0.5, 0.5), (6.5, 0.5))]
    courses, timing = timed(ends, world, leaving=("r0",))
    assert not timing.blocked
    assert certify_fleet(courses, timing.laws, 0.0).holds
    last = courses.packed.first[1] - 1
    assert timing.laws.packed.leave[last] == timing.laws.packed.arrive[last]
