import math

import numpy as np
import pytest

import viaspline as vs
from viaspline.fleet.lattice_order.lattice_paths import LatticePaths, lattice_paths
from viaspline.fleet.lattice_order.no_lattice_order import NoLatticeOrder
from viaspline.planner import plan

ROBOT = {"radius_m": 0.35, "clearance_m": 0.0, "max_speed_mps": 1.0, "max_lateral_accel_mps2": 1.0}


def alone(start, goal, world, **route):
    data = {"world": world, "robot": ROBOT, "route": {"start": start, "goal": goal, **route}}
    return plan(vs.Mission.model_validate(data))


def corridor():
    walls = [[(0, 1), (3, 1), (3, 3), (0, 3)], [(4, 1), (7, 1), (7, 3), (4, 3)]]
    return {"bounds": [0, 0, 7, 3], "known": [{"polygon": ring} for ring in walls]}


def places_over_steps(paths, steps):
    """Where robots are at steps, by what is said of who is where before whom."""
    found = []
    for name, one in paths.plans.items():
        rows = paths.steps[name]
        pairs = np.column_stack([rows.steps, rows.distances])
        assert (np.diff(pairs, axis=0) >= -1e-9).all()
        distances = np.interp(steps, rows.steps, rows.distances)
        found.append(one.path.at_distance(distances.clip(0.0, one.path.length)))
    return np.array(found)


def least_distance(paths):
    last = max(one.steps[-1] for one in paths.steps.values())
    places = places_over_steps(paths, np.arange(0.0, last + 1.0, 0.01))
    return min(
        float(np.hypot(*(places[i] - places[j]).T).min())
        for i in range(len(places))
        for j in range(i)
    )


def test_two_robots_change_places_in_a_corridor_with_a_bay():
    world = corridor()
    plans = {
        "a": alone((0.5, 0.5), (6.5, 0.5), world),
        "b": alone((6.5, 0.5), (0.5, 0.5), world),
        "c": alone((3.5, 2.5), (3.5, 1.5), world),
    }
    paths = lattice_paths(plans, 0.0, work=20_000)
    assert isinstance(paths, LatticePaths)
    for name, one in paths.plans.items():
        assert one.certificate.holds
        assert one.path.evaluate(0.0) == pytest.approx(plans[name].path.evaluate(0.0))
        assert one.path.stops[-1][0].at == plans[name].path.stops[-1][0].at
        assert one.path.stops[-1][1] == pytest.approx(one.path.length)
    assert least_distance(paths) >= 0.7 - 0.3  # corners are rounded, and timing does the rest


def test_robots_that_meet_nobody_keep_their_paths():
    world = {"bounds": [0, 0, 12, 12]}
    plans = {
        "a": alone((0.5, 0.5), (6.5, 3.5), world),
        "b": alone((8.5, 10.5), (10.5, 5.5), world),
    }
    paths = lattice_paths(plans, 0.0, work=20_000)
    assert isinstance(paths, LatticePaths)
    assert all(paths.plans[name] is plans[name] for name in plans)


def test_no_robots_have_no_paths():
    paths = lattice_paths({}, 0.0)
    assert isinstance(paths, LatticePaths)
    assert (paths.plans, paths.steps) == ({}, {})


def test_robots_with_via_points_are_not_led_over_a_lattice():
    one = alone((0.5, 0.5), (6.5, 0.5), {}, via=[(3.5, 2.5)])
    found = lattice_paths({"a": one}, 0.0)
    assert isinstance(found, NoLatticeOrder)
    assert found.reason == "'a' has via points"


@pytest.mark.parametrize("end", ["start", "goal"])
def test_robots_with_a_heading_at_an_end_are_not_led_over_a_lattice(end: str) -> None:
    headed = {"at": (6.5, 0.5) if end == "goal" else (0.5, 0.5), "heading_deg": 90}
    route = {"start": (0.5, 0.5), "goal": (6.5, 0.5), end: headed}
    mission = vs.Mission.model_validate({"robot": ROBOT, "route": route})
    found = lattice_paths({"a": plan(mission)}, 0.0)
    assert isinstance(found, NoLatticeOrder)
    assert found.reason == "'a' is to start or to arrive with a heading"


@pytest.mark.parametrize("turn", [0, 60, 120, 180, 240, 300])
def test_a_ring_keeps_the_headings_that_are_asked_for(turn: float) -> None:
    at = [(10 + 3 * math.cos(a), 10 + 3 * math.sin(a)) for a in (0.0, 2.1, 4.2)]
    robots = [
        {"name": f"r{k}", "rest": "leave" if k else "stay",
         "route": {"start": {"at": at[k], "heading_deg": turn}, "goal": at[(k + 1) % 3]}}
        for k in range(3)
    ]  # fmt: skip
    fleet = {"separation_m": 0.5, "robots": {"r": {"radius_m": 0.4}}, "fleet": robots}
    for one in vs.plan_fleet(vs.Fleet.model_validate(fleet)).plans.values():
        assert isinstance(one, vs.Plan)
        off = float(one.path.heading(0.0)) - math.radians(turn)
        assert abs(math.remainder(off, math.tau)) < 1e-6
