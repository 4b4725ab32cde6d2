"""Are all robots served where no path passes another's resting place? In many small random fleets.

    python benchmarks/fleet_completeness.py [FLEETS] [--seed 1]

Fleets of 2 to 12 discs of three speeds and two sizes in a square of 20 m to 60 m, from anywhere to
anywhere or round and back, through up to two via points, with departures and priorities of their
own; some have a limit of their jerk, so that they can wait at home alone. Timed along their paths
and proven; fleets in which a path passes a rest are counted apart.
"""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np
from timing import clock

import viaspline as vs
from viaspline.fleet.crossing_paths import crossing_paths
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.timed_fleet import TimedFleet

SEPARATION_M = 0.5
JERKY = 0.1
"""The share of robots that have a limit of their jerk."""


def random_fleet(random: np.random.Generator) -> vs.Fleet:
    """Robots whose rests are apart from each other."""
    count, side = int(random.integers(2, 13)), float(random.uniform(20.0, 60.0))
    rests = np.empty((0, 2))
    kinds: dict[str, Any] = {}
    members: list[dict[str, Any]] = []
    for k in range(count):
        points = random.uniform(0.0, side, (2 + int(random.integers(0, 3)), 2))
        closed = len(points) > 2 and random.random() < 0.4
        own = points[:1] if closed else points[[0, -1]]
        if len(rests) and np.hypot(*(own[:, None] - rests[None]).T).min() < 2.5:
            continue
        rests = np.vstack([rests, own])
        kind: dict[str, Any] = {
            "radius_m": float(random.choice([0.2, 0.5])),
            "max_speed_mps": float(random.choice([0.7, 1.5, 3.0])),
            "clearance_m": 0.1,
        }
        if random.random() < JERKY:
            kind["max_jerk_mps3"] = 1.0
        kinds[f"k{k}"] = kind
        start, *via, goal = points.tolist()
        route: dict[str, Any] = {"start": start, "via": via, "goal": goal}
        if closed:
            route = {"start": start, "via": [*via, goal], "closed": True}
        members.append(
            {
                "name": f"r{k}",
                "robot": f"k{k}",
                "route": route,
                "priority": float(random.integers(0, 3)),
                "depart_s": float(random.choice([0.0, 0.0, 5.0])),
            }
        )
    return vs.Fleet.model_validate(
        {"separation_m": SEPARATION_M, "robots": kinds, "fleet": members}
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("fleets", nargs="?", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    fleets, robots, apart, served_fleets, with_rests = 0, 0, np.inf, 0, [0, 0]
    late, alone, took = 0.0, 0.0, 0.0
    seed = 0
    while fleets < asked.fleets:
        seed += 1
        fleet = random_fleet(np.random.default_rng([asked.seed, seed]))
        paths = crossing_paths(fleet)
        if paths.laid.not_served:
            continue
        ways = FleetWays.of(fleet, paths)
        seconds, timed = clock(lambda ways=ways: TimedFleet.by_priority(ways))
        took += seconds
        if paths.laid.passed:
            with_rests[0] += 1
            with_rests[1] += not timed.blocked
            continue
        fleets += 1
        robots += len(ways.members)
        if timed.blocked:
            print(f"seed {asked.seed} {seed}: {timed.blocked} not served", flush=True)
            continue
        served_fleets += 1
        proof = certify_fleet(ways.courses, timed.timing.laws, SEPARATION_M)
        if not proof.holds:
            print(f"seed {asked.seed} {seed}: {proof.separation} m", flush=True)
        apart = min(apart, proof.separation)
        laws = timed.timing.laws.packed
        arrives = laws.arrive[ways.courses.packed.first[1:] - 1]
        late += float((arrives - ways.rides.packed.depart - ways.rides.alone).sum())
        alone += float(ways.rides.alone.sum())
        if fleets % 500 == 0:
            print(f"{fleets} fleets, {served_fleets} served", flush=True)
    print(
        f"{fleets} fleets of {robots} robots, no path past a rest: {served_fleets} served, "
        f"{apart:.6f} m apart at least, {100 * late / alone:.2f} % later than alone, "
        f"{1e3 * took / (fleets + with_rests[0]):.2f} ms to time one; "
        f"with rests in the way {with_rests[1]} of {with_rests[0]}"
    )


if __name__ == "__main__":
    main()
