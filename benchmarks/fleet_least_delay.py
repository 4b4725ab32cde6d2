"""How late robots are at least that drive along given paths: a bound that no order gets below.

    python benchmarks/fleet_least_delay.py [--robots 1000] [--seed 1] [--improve 10]

Rounds as in ``fleet_growth.py``. Where two would meet if each drove as if it were alone, one of
them waits until the other has left, however fast it goes on: a pair is late by the lesser of the
two waits at least. The least sum of delays of all robots in which every pair has as much is a
linear program. Delays that pass from one to the next aren't in it.
"""

from __future__ import annotations

import argparse

import numpy as np
from fleet_growth import SEPARATION_M, fleet_of, sooner
from scipy.optimize import linprog
from scipy.sparse import csr_matrix

from viaspline.fleet.courses import FleetCourses, courses_of
from viaspline.fleet.crossings import FleetCrossings, box_owners, crossings_of
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.late_share import arrivals_of
from viaspline.fleet.laying.lay_paths import lay_paths
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.timing.rides import rides_of
from viaspline.fleet.timing.time_paths import time_paths
from viaspline.kernels.arrays import Floats, Ints


def least_waits(
    courses: FleetCourses, crossings: FleetCrossings, alone: FleetLaws
) -> tuple[Ints, Floats]:
    """The pairs that would meet, (k, 2), and how long one of each waits at least [s], (k,).

    Args:
        courses: The paths.
        crossings: Where they come near each other.
        alone: When each robot would be where if it were alone, as fast as it can.
    """
    packed, first = crossings.packed, courses.packed.first
    owner, gone = box_owners(packed), np.empty(len(packed.cell))
    by_other = np.argsort(packed.other, kind="stable")
    begins = np.searchsorted(packed.other[by_other], np.arange(len(first)))
    for robot in range(len(first) - 1):  # when it has come to the node before a box's end
        boxes, nodes = by_other[begins[robot] : begins[robot + 1]], slice(*first[robot : robot + 2])
        along, arrive = courses.packed.distance[nodes], alone.packed.arrive[nodes]
        at = np.searchsorted(along, packed.high[boxes], side="right") - 1
        gone[boxes] = arrive[np.clip(at, 0, len(along) - 1)]
    waits = np.zeros((len(packed.robots), 2))
    side = (owner == packed.robots[packed.crossing, 1]).astype(int)
    late = np.nan_to_num(gone - alone.packed.arrive[packed.cell], posinf=0.0, neginf=0.0)
    np.maximum.at(waits, (packed.crossing, side), late)
    lesser = waits.min(axis=1)
    pairs, which = np.unique(packed.robots[lesser > 0.0], axis=0, return_inverse=True)
    least = np.zeros(len(pairs))
    np.maximum.at(least, which.ravel(), lesser[lesser > 0.0])
    return pairs, least


def least_delay(pairs: Ints, waits: Floats, robots: int) -> float:
    """The least sum of the delays of all robots in which every pair has its wait [s]."""
    rows = np.repeat(np.arange(len(pairs)), 2)
    both = csr_matrix((-np.ones(rows.size), (rows, pairs.ravel())), shape=(len(pairs), robots))
    return float(linprog(np.ones(robots), A_ub=both, b_ub=-waits).fun)


def told(what: str, timed: TimedFleet, asked: Floats) -> None:
    """Print how late robots are beside what they ask for alone, and at least."""
    ways = timed.ways
    drives = timed.arrivals() - ways.rides.packed.depart
    there = np.isfinite(drives)  # others aren't served
    pairs, waits = least_waits(ways.courses, ways.crossings, ways.rides.laws)
    both = there[pairs].all(axis=1)
    least = least_delay(pairs[both], waits[both], len(asked))
    total, late = float(asked[there].sum()), float((drives - asked)[there].sum())
    alone = arrivals_of(ways.courses, ways.rides.laws) - ways.rides.packed.depart
    detours = float((alone - asked)[there].sum())
    print(
        f"{what}, {there.sum()} robots: {late:.0f} s later, {100 * late / total:.2f} %; at least "
        f"{100 * (least + detours) / total:.2f} % along these paths, {detours:.0f} s of it detours;"
        f" lesser waits of {both.sum()} pairs: {waits[both].sum():.0f} s"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--improve", type=float, default=10.0)
    asked = parser.parse_args()
    fleet = fleet_of(asked.robots, asked.seed)
    laid = lay_paths(fleet)
    members = [one for one in fleet.members if one.name in laid.plans]
    courses = courses_of(laid.plans, SEPARATION_M)
    crossings = crossings_of(courses)
    plans = tuple(laid.plans.values())
    rides = rides_of(members, plans, courses)
    timing = time_paths(courses, crossings, rides, [0.0] * len(members))
    ways = FleetWays(tuple(members), plans, courses, crossings, rides)
    timed = TimedFleet(ways, timing)
    told("as laid", timed, rides.alone)
    told("after search", sooner(timed, laid, asked.improve), rides.alone)


if __name__ == "__main__":
    main()
