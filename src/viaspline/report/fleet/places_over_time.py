"""Where all robots of a fleet are at any time, and how far apart the nearest two."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.kernels.arrays import Flags, Floats
from viaspline.planner import Plan

INSTANTS: Final = 700  # at which a whole drive is looked at
PLACES: Final = 700_000  # of all robots at all these instants, at most


class NearestTwo(NamedTuple):
    """The least free space between any two bodies at some times.

    Attributes:
        times: [s], (t,).
        gaps: [m], (t,); infinite where there are no two robots.
    """

    times: Floats
    gaps: Floats


@dataclass(frozen=True, eq=False)
class FleetMotion:
    """Where the robots of a fleet are at some times.

    Attributes:
        names: The robots.
        times: Increasing [s], (t,).
        places: Of their reference points [m], (n, t, 2); not a number where a robot is gone.
        bodies: Radii of the circles about their reference points that hold their bodies [m], (n,).
    """

    names: tuple[str, ...]
    times: Floats
    places: Floats
    bodies: Floats

    @classmethod
    def of_plan(cls, plan: FleetPlan, times: Floats) -> FleetMotion:
        """What a fleet's plan has its robots do; a body includes what it may be beside its path."""
        rests = {one.name: one.rest for one in plan.fleet.members}
        places = [_places(one, rests[name], times) for name, one in plan.plans.items()]
        bodies = [
            one.mission.robot.outer_radius + one.tracking_error for one in plan.plans.values()
        ]
        ways = np.array(places).reshape(-1, len(times), 2)
        return cls(tuple(plan.plans), times, ways, np.array(bodies, float))

    @classmethod
    def of_run(cls, plan: FleetPlan, run: FleetRun, times: Floats) -> FleetMotion:
        """What the robots of a plan drove, those that it serves."""
        rests = {one.name: one.rest for one in plan.fleet.members}
        driven = set(run.names)
        places, bodies = [], []
        for name, one in plan.plans.items():
            along = run.distance_at(name, times) if name in driven else np.zeros(len(times))
            leaves = run.arrivals.get(name, np.inf) if rests[name] == "leave" else np.inf
            places.append(_along(one, along, times > leaves))
            bodies.append(one.mission.robot.outer_radius + one.tracking_error)
        ways = np.array(places).reshape(-1, len(times), 2)
        return cls(tuple(plan.plans), times, ways, np.array(bodies, float))

    def place_at(self, name: str, time: float) -> tuple[float, float]:
        """Where a robot is at one of the times, or about that between two of them [m]."""
        way = self.places[self.names.index(name)]
        x, y = (float(np.interp(time, self.times, way[:, axis])) for axis in (0, 1))
        return x, y

    def nearest_two(self) -> NearestTwo:
        """How far apart the two nearest bodies are at each of the times."""
        gaps = [self._least_gap(k) for k in range(len(self.times))]
        return NearestTwo(self.times, np.array(gaps))

    def _least_gap(self, k: int) -> float:
        there = np.isfinite(self.places[:, k, 0])
        return least_gap(self.places[there, k], self.bodies[there])


def least_gap(places: Floats, bodies: Floats) -> float:
    """The least free space between any two discs [m]; infinite without two.

    Args:
        places: Their centres [m], (n, 2).
        bodies: Their radii [m], (n,).

    Example:
        >>> least_gap(np.array([[0.0, 0.0], [5.0, 0.0], [9.0, 0.0]]), np.array([1.0, 0.5, 0.5]))
        3.0
    """
    if len(places) < 2:
        return np.inf
    from scipy.spatial import cKDTree

    tree = cKDTree(places)
    found = tree.query(places, k=2)
    apart, near = np.asarray(found[0])[:, 1], np.asarray(found[1])[:, 1]
    gap = float((apart - bodies - bodies[near]).min())
    if np.ptp(bodies) == 0.0:
        return gap
    # those whose centres are farther apart are no nearer, however large their bodies
    pairs = tree.query_pairs(gap + 2.0 * float(bodies.max()), output_type="ndarray")
    i, j = pairs.T
    gaps = np.hypot(*(places[i] - places[j]).T) - bodies[i] - bodies[j]
    return min(gap, float(gaps.min(initial=np.inf)))


def instants(begin: float, end: float, robots: int, *more: float) -> Floats:
    """Times at which robots are looked at: close together, fewer where there are many robots.

    Args:
        begin: From when [s].
        end: Until when [s].
        robots: How many.
        more: Times that have to be among them, if they are between the two [s].
    """
    count = int(np.clip(PLACES // max(robots, 1), 100, INSTANTS))
    between = [time for time in more if begin < time < end]
    return np.unique(np.append(np.linspace(begin, max(end, begin + 1e-3), count), between))


def span_of(plan: FleetPlan) -> tuple[float, float]:
    """From when to when a fleet's plan goes: the first departure, the last arrival [s]."""
    laws = [one.trajectory for one in plan.plans.values()]
    begin = min((law.start_time for law in laws), default=0.0)
    return min(begin, 0.0), max((law.end_time for law in laws), default=1.0)


def _places(plan: Plan, rest: str, times: Floats) -> Floats:
    """Where a robot is at some times [m], (t, 2)."""
    law = plan.trajectory
    is_gone = (times > law.end_time) & (rest == "leave")
    return _along(plan, np.asarray(law.distance_at(times)), is_gone)


def _along(plan: Plan, distances: Floats, is_gone: Flags) -> Floats:
    """Places along a path [m], (t, 2); not a number where a robot is gone."""
    places = np.asarray(plan.path.at_distance(np.minimum(distances, plan.path.length)))
    return np.where(is_gone[:, None], np.nan, places[:, :2])
