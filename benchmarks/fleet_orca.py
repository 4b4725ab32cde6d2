"""ORCA on the paths of a fleet, beside the laws of ours on the same paths.

    pip install ".[bench]" && python benchmarks/fleet_orca.py [--robots 1000] [--improve 0]

Rounds as in ``fleet_worlds.py``, laid among each other's resting places. ORCA's robots (pyrvo,
discs of 1 m, so that centres stay 2 m apart; horizon 2 s, steps of 0.1 s) head for the place 2 m
ahead on their paths, as fast as they would be alone there. It has no limit of acceleration and
knows of no path.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
import pyrvo
from fleet_growth import fleet_of, lateness
from fleet_worlds import ROBOT, SEPARATION_M
from scipy.spatial import cKDTree
from timing import clock

from viaspline.fleet.courses import courses_of
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.laying.lay_paths import lay_paths
from viaspline.fleet.timing.improve_laws import improve_laws
from viaspline.fleet.timing.rides import rides_of
from viaspline.fleet.timing.time_paths import time_paths

STEP_S = 0.1
HORIZON_S = 2.0
AHEAD_M = 2.0
HOME_M = 0.5  # so near its end a robot has arrived
LONGEST_S = 600.0
SLOWEST_MPS = 0.3  # that is asked for, so that robots set out
LEAST_CELL_M = 1e-3  # over less than that an acceleration is rounding
WINDOW = 40  # nodes of the path in which the nearest one is looked for


def orca(courses, rides) -> None:
    """Drive with ORCA and say what came of it."""
    packed = courses.packed
    robots = packed.reach.size
    sizes = np.diff(packed.first)
    places = np.full((robots, sizes.max() + WINDOW, 2), np.inf)
    along = np.full(places.shape[:2], np.inf)
    speed = np.zeros(places.shape[:2])
    for k in range(robots):
        nodes = slice(packed.first[k], packed.first[k + 1])
        places[k, : sizes[k]], along[k, : sizes[k]] = packed.place[nodes], packed.distance[nodes]
        speed[k, : sizes[k]] = np.sqrt(rides.packed.square[nodes])
    length = along[np.arange(robots), sizes - 1]
    radius, most = ROBOT["radius_m"] + 0.5 * SEPARATION_M, ROBOT["max_speed_mps"]
    world = pyrvo.RVOSimulator(STEP_S, 15.0, 15, HORIZON_S, HORIZON_S, radius, most)
    for start in places[:, 0].tolist():
        world.add_agent(start)
    every, at = np.arange(robots), np.zeros(robots, np.int64)
    velocity, arrival = np.zeros((robots, 2)), np.full(robots, np.inf)
    hardest, off, least, spent, now = np.zeros(robots), np.zeros(robots), np.inf, [], 0.0
    while now < LONGEST_S and np.isinf(arrival).any():
        found = [world.get_agent_position(k) for k in range(robots)]
        here = np.array([(one.x, one.y) for one in found])
        window = at[:, None] + np.arange(WINDOW)
        window = np.minimum(window, (sizes - 1)[:, None])
        apart = np.hypot(*(places[every[:, None], window] - here[:, None]).transpose(2, 0, 1))
        at = window[every, apart.argmin(axis=1)]
        off = np.maximum(off, apart.min(axis=1))
        has_come = (along[every, at] > length - HOME_M) & np.isinf(arrival)
        arrival[has_come] = now
        target = np.minimum((along < (along[every, at] + AHEAD_M)[:, None]).sum(axis=1), sizes - 1)
        way = places[every, target] - here
        pace = np.maximum(speed[every, np.minimum(at + 1, sizes - 1)], SLOWEST_MPS)
        wish = way * (pace / np.maximum(np.hypot(*way.T), 1e-9))[:, None]
        wish[np.isfinite(arrival)] = 0.0
        for k, one in enumerate(wish.tolist()):
            world.set_agent_pref_velocity(k, one)
        before = time.thread_time()
        world.do_step()
        spent.append(time.thread_time() - before)
        found = [world.get_agent_velocity(k) for k in range(robots)]
        new = np.array([(one.x, one.y) for one in found])
        hardest = np.maximum(hardest, np.hypot(*(new - velocity).T) / STEP_S)
        velocity, now = new, now + STEP_S
        least = min(least, float(cKDTree(here).query(here, 2)[0][:, 1].min()))
    come = np.isfinite(arrival)
    late = (arrival - rides.alone)[come].sum() / rides.alone[come].sum()
    too_hard = (hardest > 1.05 * ROBOT["max_accel_mps2"]).sum()
    print(f"ORCA: {come.sum()} of {robots} arrive, {100 * late:.1f} % later than alone; "
          f"{too_hard} exceed 1 m/s², up to {hardest.max():.1f} m/s²; up to {off.max():.1f} m off "
          f"the path; {least:.2f} m between centres; "
          f"{1e3 * np.median(spent):.2f} ms a step, {sum(spent):.1f} s in all")  # fmt: skip


def ours(plans, courses, rides, improve: float) -> None:
    """Time the same paths and say what came of it."""
    equal = [0.0] * len(plans)
    met, crossings = clock(lambda: crossings_of(courses))
    took, timing = clock(lambda: time_paths(courses, crossings, rides, equal))
    if improve > 0.0:
        better, timing = clock(
            lambda: improve_laws(courses, crossings, rides, timing, equal, improve)
        )
        took += better
    proved, proof = clock(lambda: certify_fleet(courses, timing.laws, SEPARATION_M))
    laws = timing.laws.packed
    inside = np.delete(np.arange(laws.speed.size - 1), courses.packed.first[1:-1] - 1)
    wide = np.diff(courses.packed.distance)
    inside = inside[wide[inside] > LEAST_CELL_M]
    rise = np.diff(laws.speed**2)[inside] / (2.0 * wide[inside])
    apart = proof.separation + 2.0 * ROBOT["radius_m"]
    print(f"ours: {len(plans) - len(timing.blocked)} of {len(plans)} served, "
          f"{100 * lateness(rides, courses, timing):.1f} % later than alone; at most "
          f"{np.abs(rise).max():.3f} m/s² along the path; on it; {apart:.4f} m between centres, "
          f"proven; {met + took + proved:.2f} s")  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--improve", type=float, default=0.0)
    asked = parser.parse_args()
    for count in (100, asked.robots):  # the first time kernels are loaded
        fleet = fleet_of(count, asked.seed)
        plans = lay_paths(fleet).plans
        courses = courses_of(plans, SEPARATION_M)
        rides = rides_of(fleet.members, list(plans.values()), courses)
        if count != asked.robots:
            time_paths(courses, crossings_of(courses), rides, [0.0] * count)
    ours(plans, courses, rides, asked.improve)
    orca(courses, rides)


if __name__ == "__main__":
    main()
