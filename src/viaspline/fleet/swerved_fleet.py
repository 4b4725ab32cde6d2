"""Paths of a large fleet led aside where robots wait long for each other.

Where two paths cross at a small angle, or robots meet head-on, one of them waits until the other
has passed all of the stretch that both drive along, whoever is let pass first; and where they cross
steeply, a second or two: only other paths help. So all robots are looked at by samples, each as if
it were alone among the others as they drive by their laws. Where it waits long its path swerves, so
that it crosses the other one more steeply, or passes behind it, or not near it at all. That takes
milliseconds a robot. What is chosen is then laid and proven, and all are timed along it; by these
laws all are looked at once more. What is handed back is never later than what it began with.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.laying.resting_places import RestingPlaces
from viaspline.fleet.laying.swerving import bend_of, kept_distances, swerved
from viaspline.fleet.sampled_paths import grid_of_rests, grid_of_samples, samples_of
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.sampled_meetings import BETWEEN_M
from viaspline.kernels.fleet.swerves_sought import SAVED, Swervers, X, swerves_sought
from viaspline.kernels.fleet.waits_with import KEPT_MORE_M
from viaspline.planner import Plan

PAIRS_PER_S = 80_000_000
"""Pairs of samples that are looked at in a second of the reference machine,"""
BOXES_PER_S = 2_000_000
"""and boxes of crossings that are found and timed anew."""
SPREADS_S = (2.0, 1.5, 1.0, 0.5)
"""So much sooner or later than by their laws robots come to meetings [s]: much at first, where many
paths and laws are going to change, less and less later on."""
ONCE = 2
"""With so many of these all are looked at once, with the others as long as it gets better."""
TIMED_ANEW = 2
"""So often they are timed along the new paths, each time with other orders."""
LEAST_SAVED_S = 0.15
"""What a path with all its swerves saves at least, beyond what it takes [s]."""


def swerved_fleet(
    timed: TimedFleet, rests: RestingPlaces, separation: float, budget: float
) -> tuple[TimedFleet, float]:
    """A fleet of which some robots swerve, so that all wait less.

    Args:
        timed: All of its robots have a law.
        rests: Where they rest.
        separation: Free space between any two bodies [m].
        budget: What may be spent on looking [s of the reference machine].

    Returns:
        A fleet of the same robots, all of which are served, and are no later in all; and what is
        left of the budget [s of the reference machine].
    """
    best, cost = timed, len(timed.ways.crossings.packed.cell) / BOXES_PER_S
    for k, spread in enumerate(SPREADS_S):
        is_sooner = True
        while is_sooner and budget > cost:
            work = int((budget - cost) * PAIRS_PER_S)
            found, left = _sought(best, rests, spread, work)
            budget = left / PAIRS_PER_S
            led = _swerved(best.ways, rests, found)
            anew = _timed(best.ways, led, separation) if led else best
            is_sooner = anew.rank < best.rank and k >= ONCE
            best = min(best, anew, key=lambda one: one.rank)
    return best, budget


def _timed(ways: FleetWays, led: dict[int, Plan], separation: float) -> TimedFleet:
    """The fleet timed along other paths, as few of which as need be are given up.

    Args:
        ways: As they were.
        led: The robots with other paths.
        separation: Free space between any two bodies [m].
    """
    while True:
        there = ways.with_paths(led, separation)
        timing = there.timed_ahead(TIMED_ANEW)
        if timing is not None:
            return TimedFleet(there, timing)
        anew = TimedFleet.by_priority(there)
        pairs = anew.timing.blocked.items()
        given_up = {robot for pair in pairs for robot in pair} & led.keys()
        if not given_up:
            return anew
        led = {robot: plan for robot, plan in led.items() if robot not in given_up}


def _sought(
    timed: TimedFleet, rests: RestingPlaces, spread: float, work: int
) -> tuple[Floats, int]:
    """Swerves by which less is waited, and what work is left, as ``swerves_sought``."""
    ways = timed.ways
    samples = samples_of(ways.courses, ways.rides, timed.timing.laws)
    grid = grid_of_samples(samples, BETWEEN_M)
    kept = [kept_distances(plan) for plan in ways.planar]
    swervers = Swervers(
        np.array([bend_of(plan) for plan in ways.planar]),
        np.cumsum([0, *(len(one) for one in kept)], dtype=np.int64),
        np.concatenate(kept),
    )
    ends = samples.first[1:] - 1
    order = np.argsort(samples.alone[ends, 0] - samples.comes[ends], kind="stable")
    by_place = grid_of_rests(rests, ways.courses, KEPT_MORE_M)
    return swerves_sought(samples, grid, by_place, swervers, order, spread, work)


def _swerved(ways: FleetWays, rests: RestingPlaces, swerves: Floats) -> dict[int, Plan]:
    """The plans that swerve, of those robots that save by it what they take longer, and more."""
    robots = swerves[:, 0].astype(np.int64)
    plans, changed = ways.planar, dict[int, Plan]()
    for robot in np.unique(robots).tolist():
        own, plan = swerves[robots == robot], plans[robot]
        name, reach = ways.courses.names[robot], float(ways.courses.packed.reach[robot])
        found = _worth_it(plan, own, name, reach, rests)
        if found is plan and len(own) > 1:  # some of them may be
            for k in range(len(own)):
                found = _worth_it(found, own[k : k + 1], name, reach, rests)
        if found is not plan:
            changed[robot] = found
    return changed


def _worth_it(plan: Plan, swerves: Floats, name: str, reach: float, rests: RestingPlaces) -> Plan:
    """The plan that makes swerves, or else the one that there is."""
    found = swerved(plan, swerves[:, X:SAVED].copy(), name, reach, rests)
    if found is None:
        return plan
    then, is_made = found
    longer = then.trajectory.duration - plan.trajectory.duration
    return then if swerves[is_made, SAVED].sum() - longer > LEAST_SAVED_S else plan
