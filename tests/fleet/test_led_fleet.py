from itertools import combinations

import numpy as np

import viaspline as vs
from viaspline.fleet.crossing_paths import crossing_paths
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.laying.alone_paths import alone_paths
from viaspline.fleet.led_fleet import is_dense, led_fleet
from viaspline.fleet.plan_fleet import is_settled_by_priority, plan_by_priority
from viaspline.fleet.timed_fleet import TimedFleet

ROBOT = {"radius_m": 0.35, "clearance_m": 0.0, "max_speed_mps": 1.0, "max_accel_mps2": 1.0}
RING = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]


def fleet_in(side, posts, drives):
    """Discs on cells of 1 m, some of which are walled up."""
    walls = [{"polygon": [(x + dx, y + dy) for dx, dy in RING]} for x, y in posts]
    members = [
        {"name": f"r{k}", "robot": "disc", "route": {"start": start, "goal": goal}}
        for k, (start, goal) in enumerate(drives)
    ]
    world = {"bounds": [-0.5, -0.5, side - 0.5, side - 0.5], "known": walls}
    data = {"separation_m": 0.0, "world": world, "robots": {"disc": ROBOT}, "fleet": members}
    return vs.Fleet.model_validate(data)


def random_fleet(seed, side=9, robots=14, posts=12):
    random = np.random.default_rng(seed)
    cells = [(int(k % side), int(k // side)) for k in random.permutation(side * side)]
    free = cells[posts:]
    starts, goals = free[:robots], [free[k] for k in random.permutation(len(free))]
    pairs = [(s, g) for s, g in zip(starts, goals, strict=False) if s != g]
    return fleet_in(side, cells[:posts], pairs)


def nearest(plan):
    """The least distance of two centres, looked for every twentieth of a second [m]."""
    end = max(one.trajectory.end_time for one in plan.plans.values())
    times = np.arange(0.0, end, 0.05)
    places = {
        name: one.path.at_distance(one.trajectory.state_at(times)[0])
        for name, one in plan.plans.items()
    }
    return min(
        float(np.hypot(*(one - other).T).min()) for one, other in combinations(places.values(), 2)
    )


def test_of_random_dense_fleets_whoever_has_a_law_on_a_lattice_is_proven_apart() -> None:
    led = 0
    for seed in range(2, 6):
        fleet = random_fleet(seed)
        alone = alone_paths(fleet)
        if len(alone.plans) < len(fleet.members):
            continue
        found = led_fleet(fleet.members, alone.plans, 0.0)
        if isinstance(found, TimedFleet) and not found.blocked:
            led += 1
            assert certify_fleet(found.ways.courses, found.timing.laws, 0.0).holds
    assert led > 1


def test_robots_that_rest_densely_are_led_at_once_however_they_are_asked_for() -> None:
    fleet = random_fleet(3, side=10, robots=26, posts=4)
    paths = crossing_paths(fleet)
    assert is_dense(fleet, alone_paths(fleet))
    assert not is_settled_by_priority(plan_by_priority(fleet, paths), paths)
    plan = vs.plan_fleet(fleet)
    assert plan.served
    assert nearest(plan) >= 0.7 - 1e-6
    assert plan == vs.plan_fleet(fleet, paths=paths)


def test_robots_that_priority_makes_late_are_led_if_that_is_sooner() -> None:
    crossing = [((0, k), (8, k)) for k in range(1, 8)] + [((k, 0), (k, 8)) for k in range(1, 8)]
    fleet = fleet_in(9, [], crossing)
    paths = crossing_paths(fleet)
    by_priority, whole = plan_by_priority(fleet, paths), vs.plan_fleet(fleet)
    ends = [
        sum(one.trajectory.end_time for one in plan.plans.values()) for plan in (by_priority, whole)
    ]
    assert whole.served
    assert len(by_priority.plans) < len(whole.plans) or ends[1] <= ends[0]
