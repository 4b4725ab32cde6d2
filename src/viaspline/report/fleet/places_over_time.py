"""Where all robots of a fleet are at any time, and how far apart the nearest two."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.kernels.arrays import Flags, Floats
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.planner import Plan
from viaspline.space.spatial_plan import SpatialPlan

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
        bodies: Radii of the circles about their reference points that hold their bodies, seen from
            above [m], (n,).
        heights: Of the reference points of robots that fly [m], (n, t); None in the plane.
        sizes: Their cylinders, radius and half height, and the margin about them [m], (n, 3).
    """

    names: tuple[str, ...]
    times: Floats
    places: Floats
    bodies: Floats
    heights: Floats | None = None
    sizes: Floats | None = None

    @classmethod
    def of_plan(cls, plan: FleetPlan, times: Floats) -> FleetMotion:
        """What a fleet's plan has its robots do; a body includes what it may be beside its path."""
        rests = {one.name: one.rest for one in plan.fleet.members}
        places = [_places(one, rests[name], times) for name, one in plan.plans.items()]
        return cls._of(plan, times, places)

    @classmethod
    def of_run(cls, plan: FleetPlan, run: FleetRun, times: Floats) -> FleetMotion:
        """What the robots of a plan drove, those that it serves."""
        rests = {one.name: one.rest for one in plan.fleet.members}
        driven = set(run.names)
        places = []
        for name, one in plan.plans.items():
            along = run.distance_at(name, times) if name in driven else np.zeros(len(times))
            leaves = run.arrivals.get(name, np.inf) if rests[name] == "leave" else np.inf
            places.append(_along(one, along, times > leaves))
        return cls._of(plan, times, places)

    @classmethod
    def _of(cls, plan: FleetPlan, times: Floats, places: list[Floats]) -> FleetMotion:
        """From the places of all robots, (t, d) each."""
        names, plans = tuple(plan.plans), plan.plans.values()
        bodies = [one.mission.robot.outer_radius + one.tracking_error for one in plans]
        held = np.array(bodies, float)
        if not plan.is_spatial:
            return cls(names, times, np.array(places).reshape(-1, len(times), 2), held)
        ways = np.array(places).reshape(-1, len(times), 3)
        flying = [FlyingBody.of(one.mission.robot) for one in plans]
        sizes = np.array([(one.radius, one.half_height, one.margin) for one in flying], float)
        return cls(names, times, ways[:, :, :2], held, ways[:, :, 2], sizes.reshape(-1, 3))

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
        if self.heights is not None and self.sizes is not None:
            places = np.column_stack((self.places[there, k], self.heights[there, k]))
            return least_gap_in_space(places, self.sizes[there])
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


def least_gap_in_space(places: Floats, sizes: Floats) -> float:
    """The least free space between any two bodies in space [m]; infinite without two.

    Args:
        places: Of their reference points [m], (n, 3).
        sizes: Their cylinders, radius and half height, and the margin about them [m], (n, 3).

    Example:
        >>> least_gap_in_space(np.array([[0.0, 0, 0], [0, 0, 5]]), np.array([[1.0, 0.5, 0]] * 2))
        4.0
    """
    one, other = np.triu_indices(len(places), 1)
    if not len(one):
        return np.inf
    both, off = sizes[one] + sizes[other], places[one] - places[other]
    level = np.maximum(np.hypot(off[:, 0], off[:, 1]) - both[:, 0], 0.0)
    upright = np.maximum(np.abs(off[:, 2]) - both[:, 1], 0.0)
    return float((np.hypot(level, upright) - both[:, 2]).min())


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


def _places(plan: Plan | SpatialPlan, rest: str, times: Floats) -> Floats:
    """Where a robot is at some times [m], (t, 2), or (t, 3) if it flies."""
    law = plan.trajectory
    is_gone = (times > law.end_time) & (rest == "leave")
    return _along(plan, np.asarray(law.distance_at(times)), is_gone)


def _along(plan: Plan | SpatialPlan, distances: Floats, is_gone: Flags) -> Floats:
    """Places along a path [m], (t, 2) or in space (t, 3); not a number where a robot is gone."""
    places = np.asarray(plan.path.at_distance(np.minimum(distances, plan.path.length)))
    seen = places if isinstance(plan, SpatialPlan) else places[:, :2]
    return np.where(is_gone[:, None], np.nan, seen)
