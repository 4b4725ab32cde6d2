"""What the geometry of a fleet takes: courses, crossings, and the proof of laws on them.

    python benchmarks/fleet_geometry.py [--robots 1000] [--seed 1] [--kind rounds] [--runs 5]
    python benchmarks/fleet_geometry.py --through-one-place 10000

Times of the processor, the least of some runs. The laws are those of robots that heed nobody, one
departing after the other.
"""

from __future__ import annotations

import argparse
import resource
import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np
from fleet_worlds import SEPARATION_M, crossings_508, rounds

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GaveUpError
from viaspline.fleet.courses import FleetPath, courses_along, courses_of
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_laws import static_laws
from viaspline.fleet.renewed_crossings import renewed_crossings

Result = TypeVar("Result")
GAP_S = 0.5  # from one departure to the next


def best(job: Callable[[], Result], runs: int) -> tuple[Result, float]:
    """The result of a job, and the least time that it took after a first run [ms]."""
    result, least = job(), np.inf
    for _ in range(runs):
        before = time.process_time()
        result = job()
        least = min(least, time.process_time() - before)
    return result, 1e3 * least


def measure(count: int, seed: int, kind: str, runs: int) -> None:
    make = rounds if kind == "rounds" else crossings_508
    plans = make(count, seed, 500.0 * max(1.0, (count / 1000) ** 0.5))
    length = np.mean([one.path.length for one in plans.values()])
    print(f"{count} {kind}, {length:.1f} m in the mean")
    courses, took = best(lambda: courses_of(plans, SEPARATION_M), runs)
    print(f"courses     {took:8.1f} ms   {len(courses.packed.distance)} nodes")
    found, took = best(lambda: crossings_of(courses), runs)
    print(f"crossings   {took:8.1f} ms   {len(found.packed.robots)}, {len(found.packed.low)} boxes")
    some = np.array([0])
    _, took = best(lambda: crossings_of(courses, some), runs)
    print(f"  of one    {took:8.1f} ms")
    _, took = best(lambda: renewed_crossings(found, courses, courses, some), runs)
    print(f"  put among {took:8.1f} ms")
    laws = static_laws(
        courses,
        [one.trajectory.delayed(GAP_S * k) for k, one in enumerate(plans.values())],
    )
    proof, took = best(lambda: certify_fleet(courses, laws, SEPARATION_M), runs)
    print(f"proof       {took:8.1f} ms   {proof.separation:.3f} m")


def through_one_place(count: int) -> None:
    """All on straight lines through one point: refused, with the place."""
    ways = np.linspace(0.0, np.pi, count, endpoint=False)
    paths = []
    for way in ways:
        end = 100.0 * np.array([np.cos(way), np.sin(way)])
        path = PiecewiseCubic([[-end, -end / 3, end / 3, end]])
        paths.append(FleetPath(path, np.array([0.0, path.length]), 1.0))
    courses = courses_along([f"r{k}" for k in range(count)], paths)
    before = time.process_time()
    try:
        found = crossings_of(courses)
        print(f"{len(found.packed.robots)} crossings, {len(found.packed.low)} boxes")
    except GaveUpError as error:
        print(f"given up: {error}")
    print(f"{time.process_time() - before:.2f} s")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", choices=("rounds", "crossings"), default="rounds")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--through-one-place", type=int, default=0)
    asked = parser.parse_args()
    if asked.through_one_place:
        through_one_place(asked.through_one_place)
    else:
        measure(asked.robots, asked.seed, asked.kind, asked.runs)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak of the memory: {peak:.0f} MB")


if __name__ == "__main__":
    main()
