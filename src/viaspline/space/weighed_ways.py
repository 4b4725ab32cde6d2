"""The ways past what stands on a leg: laid, proven, timed, and the best of them taken.

Tested through ``space/test_plan_spatial``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final, Protocol

import numpy as np

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.ledger import Candidate, PassingSide
from viaspline.space.laying.clear_route import (
    LEAST_RADIUS_M,
    StuckLegError,
    tightened_leg,
)
from viaspline.space.laying.gentle_turns import ROUND, ROUND_DEARER
from viaspline.space.laying.leg_polygon import LegPolygon
from viaspline.space.laying.sooner_corners import sooner_corners
from viaspline.space.laying.turn_ways import Away
from viaspline.space.leg_check import LegCheck
from viaspline.space.route_law import law_of, part_of_route
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.trajectory.trajectory import Trajectory

GENTLEST_M: Final = 200.0
"""Radius of corners, at most, however fast the robot is."""


WIDER: Final = 1.25
"""Than the radius at which no speed is lost: corners that are moved outward get sharper."""


HOPEFUL: Final = 0.06
"""Ways whose lines cost more than the cheapest by that, of the cheapest curve, aren't looked at for
corners to be left out: what a curve costs beyond its lines is much the same on every side then."""


SHARP: Final = "turns more sharply than the robot itself"

NO_CHEAPER: Final = "the whole path is no sooner with it"


NEAR: Final = 4.0
"""What a turn may reach lies no farther beyond what is required, of the least radius."""

STEP: Final = 0.01
"""How far off a distance is compared, of the least radius."""

LEAST_STEP_M: Final = 1e-5


@dataclass(frozen=True, eq=False)
class TautWay:
    """A way past what stands on a leg.

    Attributes:
        side: On which side it passes.
        inner: Its corners without its ends [m], shape (k, 3).
        cost: Of its lines, flown as fast as their slopes allow [m or s].
    """

    side: PassingSide
    inner: Floats
    cost: float


class WaysPast(Protocol):
    """Finds the ways past what stands between two places."""

    def gates(self, leg: int) -> Floats:
        """What a leg has to pass on which sides, (g, 8); see ``routing/pass_gates``."""

    def ways(self, leg: int, proof: Certificate) -> Sequence[TautWay]:
        """All of them that were found, at least one, for a leg whose curve isn't as it should be.

        ``proof`` says what is nearest to that curve.

        Raises:
            NoPathError: There is none, proven.
            GaveUpError: None was found.
        """

    def defers(self, proof: Certificate) -> bool:
        """Whether ways on other sides are looked for only to be told of: they are no shorter."""

    def others(self, leg: int, proof: Certificate) -> Sequence[TautWay]:
        """These, where they weren't among ``ways``."""

    def pulled(self, leg: int, way: Floats) -> Floats | None:
        """The corners of a way (n, 3) [m] of a leg pulled taut, (k, 3); None: it isn't free."""


def least_radius(problem: SpatialProblem) -> float:
    """The radius of a turn that is round enough for a body: its own [m]."""
    return max(problem.radius, float(problem.world.packed.core[0]))


def away_from_things(problem: SpatialProblem) -> Away:
    """The direction away from what is so near to a place that a turn may reach it."""
    near = problem.required + NEAR * least_radius(problem)
    step = max(STEP * least_radius(problem), LEAST_STEP_M)

    def away(place: Floats) -> Floats:
        around = place + step * np.concatenate((np.zeros((1, 3)), np.eye(3), -np.eye(3)))
        free = problem.world.distance(around)
        if free[0] >= near:
            return np.full(3, np.nan)
        slope = free[1:4] - free[4:7]
        size = float(np.linalg.norm(slope))
        return np.asarray(slope / size) if size > 0.0 else np.full(3, np.nan)

    return away


def corner_radius(problem: SpatialProblem) -> float:
    """How gently to turn at corners if there is room [m]: so that no speed is lost by it.

    Where the length counts, as tightly as the body is large.
    """
    along = problem.limits.along
    if problem.objective == "length":
        return WIDER * max(least_radius(problem), 0.1)
    across = along.max_lateral_accel or along.max_accel
    return min(WIDER * along.max_speed**2 / across, GENTLEST_M)


@dataclass(frozen=True, eq=False)
class WeighedWay:
    """A way with what it would cost.

    Attributes:
        way: The way.
        candidate: What the ledger says of it.
        cost: By what it is chosen: length, or time, which counts for more where it turns more
            sharply than the robot itself, for then turns are laid anew; infinite if it can't be
            taken.
    """

    way: TautWay
    candidate: Candidate
    cost: float


def by_cost(found: Sequence[WeighedWay]) -> Sequence[WeighedWay]:
    """Those of some ways that can be taken, the cheapest first."""
    return sorted((one for one in found if math.isfinite(one.cost)), key=lambda one: one.cost)


def told(found: Sequence[WeighedWay], taken: WeighedWay) -> tuple[Candidate, ...]:
    """Some ways for the ledger, one of which is taken."""
    most = taken.candidate.duration or 0.0
    candidates = []
    for one in found:
        words = None
        if one is not taken and (one.candidate.duration or math.inf) < most:
            words = SHARP if one.cost > taken.cost else NO_CHEAPER
        candidates.append(replace(one.candidate, chosen=one is taken, passed_over=words))
    return tuple(candidates)


def _impossible(way: TautWay, stuck: StuckLegError) -> WeighedWay:
    x, y, z = stuck.place.tolist()
    why = f"it comes too near at ({x:.2f}, {y:.2f}, {z:.2f}) however tightly it turns"
    nothing = Candidate(way.side, way.inner, np.empty((0, 4, 3)), impossible=why)
    return WeighedWay(way, nothing, math.inf)


@dataclass(frozen=True, eq=False)
class LegScale:
    """What ways of a leg cost: each laid alone, from rest to rest.

    Attributes:
        problem: What is asked.
        check: What the curve has to pass.
        leg: Which leg it is.
    """

    problem: SpatialProblem
    check: LegCheck
    leg: int

    def weighed(self, ways: Sequence[TautWay]) -> Sequence[WeighedWay]:
        """Ways with what they cost.

        Raises:
            StuckLegError: When none of them can be laid.
        """
        return self._some([self._weighed(way) for way in ways])

    def untimed(self, ways: Sequence[TautWay]) -> Sequence[WeighedWay]:
        """Ways with their lengths, which they cost; how long they take is told by ``timed``.

        Raises:
            StuckLegError: When none of them can be laid.
        """
        return self._some([self._measured(way) for way in ways])

    def _some(self, found: Sequence[WeighedWay]) -> Sequence[WeighedWay]:
        if all(math.isinf(one.cost) for one in found):
            raise StuckLegError(self.leg, self.problem.places[self.leg])
        return found

    def timed(self, candidate: Candidate) -> Candidate:
        """One of a ledger with how long it takes; itself, where that is known or it can't be."""
        if candidate.length is None or candidate.duration is not None:
            return candidate
        path = self._path(candidate.spans)
        return replace(candidate, duration=law_of(self.problem, path).duration)

    def sooner(self, found: Sequence[WeighedWay]) -> Sequence[WeighedWay]:
        """Ways with those of their corners alone with which they are the fastest.

        Where the length counts corners cost nothing.
        """
        if self.problem.objective == "length":
            return found
        laid = [one for one in found if math.isfinite(one.cost)]
        lines, best = min(one.way.cost for one in laid), min(one.cost for one in laid)
        worth = lines + HOPEFUL * best
        return [
            self._sooner(one) if one.way.cost <= worth and math.isfinite(one.cost) else one
            for one in found
        ]

    def _sooner(self, plain: WeighedWay) -> WeighedWay:
        points = self._points(plain.way)
        taken = sooner_corners(points, corner_radius(self.problem), self._time)
        if len(taken) == len(points):
            return plain
        return self._weighed(replace(plain.way, inner=taken[1:-1]))

    def _points(self, way: TautWay) -> Floats:
        """From via point to via point [m], (n, 3)."""
        vias = self.problem.vias[self.leg : self.leg + 2]
        return np.concatenate((vias[0].at[None], way.inner, vias[1].at[None]))

    def _weighed(self, way: TautWay) -> WeighedWay:
        """A way with what it costs, and how long it takes."""
        try:
            path = self._laid(self._points(way))
        except StuckLegError as stuck:
            return _impossible(way, stuck)
        law = law_of(self.problem, path)
        candidate = self._candidate(way, path, law.duration)
        return WeighedWay(way, candidate, self._cost(path, law))

    def _measured(self, way: TautWay) -> WeighedWay:
        """A way with how long it is."""
        try:
            path = self._laid(self._points(way))
        except StuckLegError as stuck:
            return _impossible(way, stuck)
        return WeighedWay(way, self._candidate(way, path, None), path.length)

    def _candidate(self, way: TautWay, path: Path, duration: float | None) -> Candidate:
        return Candidate(
            way.side, way.inner, np.asarray(path.spans), path.length, duration,
            self.check.proof(path.spans).clearance, float(path.max_curvature()[0]),
        )  # fmt: skip

    def _cost(self, path: Path, law: Trajectory) -> float:
        """By what a curve with its law is chosen."""
        if self.problem.objective == "length":
            return path.length
        sharp = float(path.max_curvature()[0]) * ROUND * least_radius(self.problem) > 1.0
        return law.duration * (ROUND_DEARER if sharp else 1.0)

    def _time(self, points: Floats) -> float:
        """What a way costs; infinite where its lines themselves don't pass."""
        lines = self._polygon(points, LEAST_RADIUS_M)
        if self.check(self.leg, lines.curve()) is not None:
            return math.inf
        try:
            path = self._laid(points)
            return self._cost(path, law_of(self.problem, path))
        except StuckLegError:
            return math.inf

    def _laid(self, points: Floats) -> Path:
        """The curve through corners, as gentle as it can be.

        Raises:
            StuckLegError: When it isn't clear, however tight it is.
        """
        polygon = self._polygon(points, corner_radius(self.problem))
        return self._path(tightened_leg(polygon, self.leg, self.check).curve())

    def _path(self, spans: Floats) -> Path:
        return part_of_route(self.problem, spans, self.leg, [0, len(spans)])

    def _polygon(self, points: Floats, radius: float) -> LegPolygon:
        """Free in direction where no direction is asked for."""
        free = np.full(3, np.nan)
        vias = self.problem.vias[self.leg : self.leg + 2]
        directions = np.array([free if via.direction is None else via.direction for via in vias])
        return LegPolygon(points, directions, np.full(len(points), radius))
