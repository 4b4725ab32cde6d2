import pytest

import viaspline as vs
from viaspline.fleet.crossing_paths import crossing_paths
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.timed_fleet import FleetWays, on_lattice

POSTS = [
    (5, 2), (8, 4), (4, 8), (2, 5), (1, 8), (4, 3), (0, 5), (7, 9), (0, 3), (1, 1), (0, 8), (8, 7),
    (6, 0), (2, 8), (6, 3),
]  # fmt: skip
"""Cells of 1 m, of 10 x 10, where nobody drives."""
DRIVES = [
    ((5, 4), (2, 6)), ((8, 9), (0, 7)), ((4, 6), (7, 2)), ((0, 4), (0, 9)), ((4, 1), (7, 8)),
    ((5, 0), (5, 4)), ((5, 8), (6, 8)), ((0, 1), (1, 5)), ((7, 0), (4, 6)), ((3, 7), (4, 2)),
    ((9, 6), (3, 8)), ((7, 2), (2, 4)), ((8, 5), (3, 4)), ((5, 6), (0, 6)), ((9, 5), (8, 0)),
    ((6, 7), (0, 1)), ((9, 2), (7, 7)), ((5, 1), (7, 4)),
]  # fmt: skip
ROBOT = {"radius_m": 0.35, "clearance_m": 0.0, "max_speed_mps": 1.0, "max_accel_mps2": 1.0}


def dense_fleet():
    ring = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
    walls = [{"polygon": [(x + dx, y + dy) for dx, dy in ring]} for x, y in POSTS]
    members = [
        {"name": f"r{k}", "robot": "disc", "route": {"start": start, "goal": goal}}
        for k, (start, goal) in enumerate(DRIVES)
    ]
    world = {"bounds": [-0.5, -0.5, 9.5, 9.5], "known": walls}
    data = {"separation_m": 0.0, "world": world, "robots": {"disc": ROBOT}, "fleet": members}
    return vs.Fleet.model_validate(data)


@pytest.mark.slow
def test_straight_lines_with_tight_corners_serve_whom_rounder_ones_leave_out() -> None:
    fleet = dense_fleet()
    ways = FleetWays.of(fleet, crossing_paths(fleet))
    led = on_lattice(ways, 0.0)
    assert not led.blocked
    assert certify_fleet(led.ways.courses, led.timing.laws, 0.0).holds
