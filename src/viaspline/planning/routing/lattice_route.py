"""Routes on maps and among many obstacles: guides through a lattice, pulled taut."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.routing.narrow_gaps import narrow_places
from viaspline.kernels.routing.string_pulling.pull import pulled_taut
from viaspline.kernels.routing.tangent_arcs import taut_length
from viaspline.kernels.world.segment import segment_distance
from viaspline.planning.problem.method import Found, GaveUp, Outcome, Refusal
from viaspline.planning.problem.work_budget import GUIDE_OBSTACLE_S, GUIDE_S, LATTICE_S
from viaspline.planning.routing.lattice import Lattice
from viaspline.planning.routing.pulled_guides import PulledGuide
from viaspline.planning.routing.route_problem import (
    NO_BARRIERS,
    TURN_STEPS_RAD,
    RouteProblem,
    SearchSpace,
)
from viaspline.planning.routing.taut_path import TautPath

PLACES_ACROSS_GAP = 65  # at which it is looked at whether a gap has the room


@dataclass(frozen=True)
class Followed:
    """What came of following the guides of one lattice.

    Attributes:
        taut_path: The route, if there is one.
        closed: Segments that no route crosses, (n, 4).
        is_proof: Whether all that was closed in the lattice is known to be too narrow, and blocks
            no other way: a segment blocks whole cells, and beside it there may still be a route.
    """

    taut_path: TautPath | None
    closed: Floats
    is_proof: bool


@dataclass(frozen=True)
class LatticeRoute:
    """The shortest path through the free cells of a lattice (Polyanya), pulled taut.

    Where it gets stuck in a gap, that is closed and the next shortest path is pulled; where
    nothing is left, a finer lattice is tried. The last one proves that there is no route, to
    within its cells: if every place with room lies in a free cell, and all that was closed is
    known to be too narrow.

    Attributes:
        max_gaps: Gaps of a lattice that may prove too narrow before a finer one is tried.
        lattices: Those of a space that are tried, the coarsest first.
        more_than: Obstacles met up to which it is left to the others, where there is no map.
    """

    max_gaps: int = 200
    lattices: Callable[[SearchSpace], Iterable[Lattice]] = SearchSpace.ever_finer
    more_than: int = -1

    def lay(self, problem: RouteProblem, bound: float = math.inf) -> Outcome[TautPath]:
        """See ``Method``."""
        if not problem.space.has_maps and problem.active_count <= self.more_than:
            return GaveUp(("no lattice",))
        closed, count, lattice, is_shut = problem.barriers, 0, None, False
        if not problem.space.has_lattice:
            problem.spend(LATTICE_S)
        for lattice in self.lattices(problem.space):
            count += 1
            found = self._past_known_gaps(problem, lattice, closed)
            if found.taut_path is not None:
                return _if_shorter(found.taut_path, problem, bound)
            is_shut = lattice.is_open and found.is_proof
            if is_shut and len(found.closed) == len(problem.barriers):
                return Refusal("no free cells of a lattice lead there")
            closed = found.closed
            problem.spend(LATTICE_S)
        if is_shut:
            return Refusal("every gap on the way there is too narrow")
        return self._gave_up(lattice, count)

    def _past_known_gaps(self, problem: RouteProblem, lattice: Lattice, closed: Floats) -> Followed:
        """Follow the guides of a lattice without what is known to be too narrow, if any is left.

        Else with it: only so nothing blocks more cells than it has to, and nothing found is proof.
        """
        known = problem.space.pulled.known_gaps
        if len(known):
            found = self.followed(problem, lattice, np.vstack((closed, known)))
            if found.taut_path is not None:
                return found
        return self.followed(problem, lattice, closed)

    def followed(self, problem: RouteProblem, lattice: Lattice, closed: Floats) -> Followed:
        """Follow the guides of a lattice, each but the last through a gap that is closed then.

        Args:
            problem: What is asked for.
            lattice: Of free cells.
            closed: Segments that no route crosses, (n, 4).
        """
        begun, space = len(closed), problem.space
        if begun:
            lattice = lattice.without(closed)
        for _ in range(self.max_gaps):
            problem.spend(GUIDE_S + GUIDE_OBSTACLE_S * len(space.world))
            guide = _guide(space, lattice, problem.start, problem.goal)
            if guide is None:
                return Followed(None, closed, lattice.is_fine or len(closed) == begun)
            pulled = space.pulled.once(guide, lattice.side, partial(_pulled, space, lattice, guide))
            if pulled.taut_path is not None:
                return Followed(pulled.taut_path, closed, is_proof=True)
            narrow = pulled.narrow
            if len(closed) == begun:
                narrow = np.vstack((narrow, space.narrow_disc_gaps))
            if not len(narrow):
                break
            closed = np.vstack((closed, narrow))
            before, lattice = lattice, lattice.without(narrow)
            if (before.cells == lattice.cells).all():
                break  # what is too narrow there is none of these
        return Followed(None, closed, is_proof=False)

    def _gave_up(self, finest: Lattice | None, count: int) -> GaveUp:
        if finest is None:
            return GaveUp(("no lattice",))
        cells = f"cells of {finest.side:.3g} m, the finest of {count} lattices"
        if not finest.is_open:
            return GaveUp(
                (f"{cells}, which are too wide for so small a robot",),
                "a smaller world.bounds, or more robot.clearance_m",
            )
        return GaveUp(
            (f"{cells}, where up to {self.max_gaps} gaps were closed that may be wide enough",),
            "a smaller world.bounds",
        )


def _if_shorter(taut_path: TautPath, problem: RouteProblem, bound: float) -> Outcome[TautPath]:
    """A route with what it goes round marked as met; nothing where it isn't shorter."""
    if not taut_path.length < bound:
        return GaveUp((f"a route of {taut_path.length:.3f} m, which is not shorter",))
    problem.mark(taut_path)
    return Found(taut_path, taut_path.length, is_settled=False)


def _pulled(space: SearchSpace, lattice: Lattice, guide: Floats) -> PulledGuide:
    """A guide pulled taut, else the gaps on its way that are too narrow."""
    packed = space.world.packed
    bends, corners, stuck = pulled_taut(
        packed, guide, lattice.kept, space.required + np.array(space.margins),
        space.floor, lattice.side, np.array(TURN_STEPS_RAD),
    )  # fmt: skip
    if len(bends):
        length = float(taut_length(corners, bends))
        return PulledGuide(TautPath(corners, bends, length), NO_BARRIERS)
    narrow = narrow_places(packed, guide, space.floor)
    if stuck[0, 4] < 0.0 and _is_too_narrow(space, stuck[:, :4]):
        narrow = np.vstack((narrow, stuck[:, :4]))
    return PulledGuide(None, narrow)


def _is_too_narrow(space: SearchSpace, gap: Floats) -> bool:
    """Whether nothing on a segment across a gap, shape (1, 4), has the room."""
    w = np.linspace(0.0, 1.0, PLACES_ACROSS_GAP)[:, None]
    return bool(
        space.world.distance(gap[:, :2] + w * (gap[:, 2:] - gap[:, :2])).max() < space.floor
    )


def _guide(space: SearchSpace, lattice: Lattice, start: Floats, goal: Floats) -> Floats | None:
    """The guide between two places, which are led to free cells first where theirs are blocked."""
    ends = [_entry(space, lattice, place) for place in (start, goal)]
    if ends[0] is None or ends[1] is None:
        return None
    guide = lattice.guide(ends[0], ends[1])
    return None if guide is None else np.vstack((start[:2], guide, goal[:2]))


def _entry(space: SearchSpace, lattice: Lattice, place: Floats) -> Floats | None:
    """The place itself if its cell is free, else the next free one in a straight line."""
    if lattice.is_free(place):
        return np.asarray(place[:2])
    middles = lattice.free_middles_near(place)
    if not len(middles):
        return None
    if np.abs(middles[0] - place[:2]).max() <= 0.5 * lattice.side * (1.0 + 1e-9):
        return np.asarray(place[:2])
    packed = space.world.packed
    for x, y in middles.tolist():
        if segment_distance(packed, place[0], place[1], x, y, np.inf)[0] >= space.floor:
            return np.array((x, y))
    return None
