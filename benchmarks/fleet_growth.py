"""What a fleet costs as it grows: laying, crossings, timing, proof, and memory.

    python benchmarks/fleet_growth.py [ROBOTS ...] [--improve SECONDS] [--out PICTURE]

Rounds as in ``fleet_worlds.py``, laid among each other's resting places in 500 m x 500 m, or, of
more than 1,000, in a square that has as many to a km². Seconds of the processor, of one process;
the memory is the most that was held so far, with all plans in it.
"""

from __future__ import annotations

import argparse
import resource
from pathlib import Path

import numpy as np
from fleet_worlds import SEPARATION_M, round_missions
from timing import clock

import viaspline as vs
from viaspline.fleet.courses import courses_of
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.late_share import arrivals_of, late_share
from viaspline.fleet.laying.lay_paths import LaidPaths, lay_paths
from viaspline.fleet.plan_fleet import SWERVING_SHARE
from viaspline.fleet.swerved_fleet import swerved_fleet
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.timing.rides import rides_of
from viaspline.fleet.timing.time_paths import time_paths
from viaspline.mission.fleet.fleet import FleetMember

ROBOTS = (10, 30, 100, 300, 1000, 3000, 10_000)
SIDE_M = 500.0  # of the square of 1,000 robots
STEPS = ("laid", "cells", "crossings", "timed", "proven")


def memory() -> float:
    """The most memory that was held so far [MB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def fleet_of(count: int, seed: int) -> vs.Fleet:
    side = SIDE_M * max(count / 1000.0, 1.0) ** 0.5
    missions = round_missions(count, seed, side)
    return vs.Fleet.of([FleetMember(name, one) for name, one in missions.items()], SEPARATION_M)


def lateness(rides, courses, timing) -> float:
    """Of all that are served, over what they would take alone."""
    return late_share(rides, arrivals_of(courses, timing.laws))


def sooner(timed: TimedFleet, laid: LaidPaths, seconds: float) -> TimedFleet:
    """As ``vs.plan_fleet`` spends its time on so many robots: on other paths, then on orders."""
    swerving = SWERVING_SHARE * seconds
    timed, left = swerved_fleet(timed, laid.kept.rests, SEPARATION_M, swerving)
    return timed.improved(seconds - swerving + left)


def measured(count: int, seed: int, improve: float) -> tuple[list[float], str]:
    """The seconds of each step, and all that is told of them."""
    fleet = fleet_of(count, seed)
    laying, laid = clock(lambda: lay_paths(fleet))
    held = memory()
    plans = laid.plans
    cutting, courses = clock(lambda: courses_of(plans, SEPARATION_M))
    meeting, found = clock(lambda: crossings_of(courses))
    members = [one for one in fleet.members if one.name in plans]
    rides = rides_of(members, list(plans.values()), courses)
    equal = [0.0] * len(members)
    timing_s, timing = clock(lambda: time_paths(courses, found, rides, equal))
    proving, proof = clock(lambda: certify_fleet(courses, timing.laws, SEPARATION_M))
    late, late_took = [lateness(rides, courses, timing)], ""
    if improve > 0.0:
        ways = FleetWays(tuple(members), tuple(plans.values()), courses, found, rides)
        seeking, better = clock(lambda: sooner(TimedFleet(ways, timing), laid, improve))
        late.append(late_share(rides, better.arrivals()))
        late_took = f" in {seeking:.1f} s"
    took = [laying, cutting, meeting, timing_s, proving]
    return took, (
        f"{count:6d} {count - len(timing.blocked):6d} "
        + " ".join(f"{1e3 * one:9.1f}" for one in took)
        + f" {len(found.packed.robots):9d} {len(found.packed.low):9d} "
        + "  ".join(f"{100 * one:.2f} %" for one in late)
        + late_took
        + f"  {proof.separation:.4f} m  {held:.0f}, {memory():.0f} MB"
    )


def picture(counts: list[int], took: list[list[float]], file: Path) -> None:
    """Each step's seconds against the number of robots, both as logarithms."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.0, 4.5), layout="constrained")
    axes = figure.subplots()
    for step, seconds in zip(STEPS, np.array(took).T, strict=True):
        axes.loglog(counts, seconds, marker="o", label=step)
    axes.set(xlabel="robots", ylabel="seconds of one core", title="What a fleet costs as it grows")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(file, dpi=120)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("robots", nargs="*", type=int, default=list(ROBOTS))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--improve", type=float, default=0.0)
    parser.add_argument("--out", type=Path)
    asked = parser.parse_args()
    for count in (10, 100):  # so that kernels are loaded
        measured(count, 0, asked.improve and 0.1)
    print("robots served " + " ".join(f"{step:>6s} ms" for step in STEPS)
          + " crossings     boxes  late  apart  memory after laying, at the end")  # fmt: skip
    counts = sorted(asked.robots)
    took = []
    for count in counts:
        seconds, row = measured(count, asked.seed, asked.improve)
        took.append(seconds)
        print(row, flush=True)
    if asked.out is not None:
        picture(counts, took, asked.out)


if __name__ == "__main__":
    main()
