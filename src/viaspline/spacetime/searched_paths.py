"""Paths that are searched together with the time at which they are driven.

Where no path among what stands has a law, nor one that is led round what moves as if it stood, the
robot may have to go back, or across: that shows only where places and times are searched at once.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from viaspline.curve.path import Path, PathVia
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.spacetime.thrust_clear import KeptClear
from viaspline.kernels.spacetime.thrust_search import ThrustLattice, search_thrusts
from viaspline.mission.strip import has_line
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.via_sequence import RouteVia, via_sequence_of
from viaspline.spacetime.alternatives import Alternative
from viaspline.spacetime.smoothed_drive import places_along, smooth_spans
from viaspline.spacetime.timed_problem import TimedProblem

LONGEST_STEP_S = 1.0
"""A step is no longer, however slowly the robot speeds up [s]."""
MAX_LEVELS = 60
"""As many levels of speed as a search tells apart."""


@dataclass(frozen=True)
class ThrustEffort:
    """How a search looks.

    Attributes:
        spare: What it keeps beyond what is required [m].
        weight: How much more what is left counts than what is driven: above 1 it is quicker.
        states: How many it looks at, at most.
        levels: So many levels of speed it tells apart where steps aren't too long for that.
        cell: Bits of a place within which states are one.
        quanta: The largest acceleration, in quanta: so finely is its direction told.
    """

    spare: float
    weight: float
    states: int
    levels: int
    cell: int
    quanta: int = 2


EFFORTS = (
    ThrustEffort(0.05, 1.2, 8_000, 8, 2),
    ThrustEffort(0.05, 1.1, 12_000, 8, 2),
    ThrustEffort(0.05, 1.2, 30_000, 4, 0),
    ThrustEffort(0.01, 1.1, 8_000, 8, 2),
    ThrustEffort(0.01, 1.2, 9_000, 8, 2, quanta=3),
)
"""One after the other: in the open, the same more closely, out of a dead end, through a gap, and
aside in more directions."""


FOLLOWED = (2, 6)
"""Into so many parts the thrusts of a drive are cut by the places through which its path is laid:
the more there are the nearer it is to what was searched, and the sharper."""


def searched_paths(problem: TimedProblem) -> Iterator[Iterator[Alternative]]:
    """Drives from rest to rest that pass what moves, found by ever closer looks.

    None where a path has more to keep than its clearance: a turning circle, a heading, sides, a
    corridor, a round, height.

    Yields:
        For each drive the paths along it that are clear, the smoothest first.
    """
    if not is_searchable(problem):
        return
    for effort in EFFORTS:
        if not problem.affords_search(effort.states):
            continue
        drives = _drives(problem, effort)
        if drives is not None:
            yield _paths_along(problem, drives)


def _paths_along(problem: TimedProblem, drives: Sequence[Floats]) -> Iterator[Alternative]:
    for pieces in FOLLOWED:
        try:
            path = _path_along(drives, via_sequence_of(problem.mission).vias, pieces)
            free = problem.free_law(path)
        except GeometryError:
            continue
        certificate = proven(path, problem.world, problem.requirements)
        if certificate.holds:
            yield Alternative(Solution(path, certificate, None), free, is_searched=True)


def is_searchable(problem: TimedProblem) -> bool:
    """Whether any path will do that is clear and leads through the via points."""
    route, requirements = problem.mission.route, problem.requirements
    asked = any(one.pass_on or one.never_pass_on for one in problem.mission.world.known)
    return not (
        asked
        or requirements.turn_radius is not None
        or requirements.goal_heading_deg is not None
        or route.start.heading_deg is not None
        or route.closed
        or has_line(route)
        or len(route.start.at) != 2
    )


def _drives(problem: TimedProblem, effort: ThrustEffort) -> list[Floats] | None:
    """The states of the drive over each leg, as ``Thrusts``; None if one of them isn't found."""
    vias = via_sequence_of(problem.mission).vias
    around = KeptClear(
        problem.world.packed, problem.moving.packed, problem.required + effort.spare,
        problem.required + effort.spare,
    )  # fmt: skip
    begin, drives = problem.mission.route.depart_s, []
    for k, (first, last) in enumerate(pairwise(vias)):
        stay = last.dwell + (problem.mission.route.hold_s if k == len(vias) - 2 else 0.0)
        found = search_thrusts(
            around,
            _lattice(problem, effort, begin),
            first.at,
            last.at,
            stay,
            effort.weight,
            effort.states,
        )
        problem.count_search(found.expanded)
        if not len(found.states):
            return None
        drives.append(found.states)
        begin = float(found.states[-1, 0]) + last.dwell
    return drives


def _lattice(problem: TimedProblem, effort: ThrustEffort, begin: float) -> ThrustLattice:
    """Steps and speeds for a robot's limits, from a time on [s]."""
    limits = problem.limits
    hardest = min(limits.max_accel, limits.brake, limits.max_lateral_accel or math.inf)
    step = min(LONGEST_STEP_S, effort.quanta * limits.max_speed / (effort.levels * hardest))
    quantum = hardest * step / effort.quanta
    levels = min(int(limits.max_speed / quantum + 1e-9), MAX_LEVELS)
    return ThrustLattice(begin, step, quantum, max(levels, 1), effort.quanta, effort.cell)


def _path_along(drives: Sequence[Floats], vias: tuple[RouteVia, ...], pieces: int) -> Path:
    """The path along drives over the legs between via points."""
    places = places_along(drives, pieces)
    on_it = [
        PathVia("detour", tuple(place.at.tolist()), "detour", float(u))
        if place.via is None
        else _placed(vias[place.via], u)
        for u, place in enumerate(places)
        if place.via is not None or place.is_thrust
    ]
    return Path(smooth_spans(np.array([place.at for place in places])), on_it)


def _placed(via: RouteVia, span: int) -> PathVia:
    return PathVia(via.name, tuple(via.at.tolist()), "user", float(span), via.dwell, via.index)
