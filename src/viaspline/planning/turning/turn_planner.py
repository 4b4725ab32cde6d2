"""A curve that the robot's body and its turning circle allow.

First the spline with continuous curvature, if it is round enough as it is. Where it is not,
straight lines and turns with ramps: along the taut ways between the via points, pushed away from
what the turns come too close to; then with the headings at all via points chosen together; at
last by a search among poses.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.bending import curvature_bound
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.lay_clear import lay_clear
from viaspline.planning.alternatives.lead_round import DetourProblem
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.alternatives.record import Account
from viaspline.planning.checking.conflicts import is_clear
from viaspline.planning.problem.heights import with_heights
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.routing.router import TautPath, on_the_line
from viaspline.planning.turning.bend_row import DETOUR, Bends, bends_along
from viaspline.planning.turning.driven_alternatives import DrivenSides
from viaspline.planning.turning.headings import HeadingLeg, Poses, legs_of, posed
from viaspline.planning.turning.hybrid_astar.pose_search import NotFound, Reason
from viaspline.planning.turning.hybrid_astar.via_route import via_route_chains
from viaspline.planning.turning.next_shortest import turn_path_on_next_shortest
from viaspline.planning.turning.repair import (
    Stuck,
    clear_turn_path,
    clear_turn_path_or_why,
    turn_path_if_clear,
)
from viaspline.planning.turning.turn_path import OVERSHOOT, RAMP, TurnPath
from viaspline.planning.turning.turn_refusals import refuse_body, refuse_circle
from viaspline.world.world import World

PUSHED = 40  # rows of headings for which legs are pushed clear
PATIENCE = 16  # pairs of headings of a leg, until one of them can be
WIDE = (6.0, 3.0, 1.5)  # radii of turns for a long body without a turning circle, and the last,
ENOUGH = 1.01  # of the shortest ways' length: a longer byway is compared with what a search finds
NARROW = 0.5  # in distances that its path keeps


@dataclass(frozen=True)
class _TurnProblem:
    """What is to be driven, where, and by what."""

    sequence: ViaSequence
    world: World
    requirements: Requirements

    @property
    def radius(self) -> float:
        """The turning circle [m]."""
        if self.requirements.turn_radius is not None:
            return self.requirements.turn_radius
        return NARROW * max(self.requirements.required, 1e-3)

    @property
    def rho(self) -> float:
        """The least radius of turns that are laid [m]."""
        return OVERSHOOT * self.radius

    @property
    def radii(self) -> tuple[float, ...]:
        """The least radii that are tried for turns [m]; wide ones first if none is given."""
        if self.requirements.turn_radius is not None:
            return (self.rho,)
        return (*(part * self.requirements.required for part in WIDE), self.rho)

    @property
    def careful(self) -> tuple[float, ...]:
        """Those that are worth a longer search [m]."""
        return self.radii[-1:] if len(self.radii) == 1 else (self.radii[1], self.radii[-1])

    @cached_property
    def legs(self) -> tuple[LegSearch, ...]:
        """The legs of the course."""
        router = DetourProblem.of(self.sequence, self.world, self.requirements).router
        count = len(self.sequence.legs)
        return tuple(
            LegSearch(self.sequence, k, self.world, self.requirements, router) for k in range(count)
        )

    @cached_property
    def taut_paths(self) -> tuple[TautPath, ...]:
        """The shortest way of every leg."""
        return tuple(_way_of(leg) for leg in self.legs)

    def is_clear(self, spans: Floats) -> bool:
        """Whether the body keeps clear on planar spans."""
        return is_clear(self.world, spans, self.requirements)

    def is_drivable(self, spans: Floats) -> bool:
        """Whether the body keeps clear, and no turn is sharper than the turning circle."""
        limit = self.requirements.turn_radius
        if limit is not None:
            flat = np.ascontiguousarray(spans[:, :, :2])
            is_round = self.sequence.closed and np.array_equal(flat[0, 0], flat[-1, 3])
            ground = PiecewiseCubic(flat, closed=is_round)  # with the seam: no turn there either
            if not curvature_bound(ground)[0] * limit <= 1.0:
                return False
        return self.is_clear(spans)


def lay_drivable(
    sequence: ViaSequence, world: World, requirements: Requirements
) -> tuple[SplinePath, Account]:
    """Lay a course for a robot with a turning circle or a long body.

    Raises:
        NoPathError: When there is no such curve, with the via point that can't be reached and
            what would allow it.
    """
    smooth = replace(sequence, tangents="continuous")
    spline_path, account = lay_clear(smooth, world, requirements)
    drive = _TurnProblem(smooth, world, requirements)
    sides = DrivenSides(smooth, world, requirements, partial(_along, drive), drive.is_drivable)
    if not drive.is_drivable(spline_path.spans):
        spline_path = sides.shortest(_turned_path(drive), account.passed)
    return spline_path, replace(account, spline_path=spline_path, driven=sides)


def _along(drive: _TurnProblem, given: Mapping[int, TautPath]) -> SplinePath | None:
    """Lines and turns with some legs along given ways, the others along their shortest."""
    taut_paths = [given.get(k, taut_path) for k, taut_path in enumerate(drive.taut_paths)]
    bends = bends_along(drive.sequence, taut_paths)
    for rho in drive.radii:
        turn_path = clear_turn_path(bends, rho, drive.world, drive.requirements)
        if turn_path is not None:
            return _spline_path(drive, [turn_path])
    return None


def _turned_path(drive: _TurnProblem) -> SplinePath:
    """Lines and turns through the via points of a course.

    Raises:
        NoPathError: When there are none.
    """
    bends = bends_along(drive.sequence, drive.taut_paths)
    for rho in drive.radii:
        turn_path = clear_turn_path(bends, rho, drive.world, drive.requirements)
        if turn_path is not None:
            return _spline_path(drive, [turn_path])
    failed: NotFound | None = None
    for rho in drive.careful:
        longer = _on_byways(drive, rho)
        if longer is not None and longer.length <= ENOUGH * sum(
            taut_path.length for taut_path in drive.taut_paths
        ):
            return _spline_path(drive, [longer])
        found = _searched(drive, bends, rho, math.inf if longer is None else longer.length)
        if longer is not None and (isinstance(found, NotFound) or found.length > longer.length):
            return _spline_path(drive, [longer])
        if isinstance(found, SplinePath):
            return found
        failed = found
    assert failed is not None  # there is at least one radius
    raise _refusal(drive, bends, failed)


def _searched(drive: _TurnProblem, bends: Bends, rho: float, bound: float) -> SplinePath | NotFound:
    """The headings at all via points chosen together, or else a search among poses.

    Args:
        drive: What is to be driven.
        bends: Along the shortest ways.
        rho: The least radius [m].
        bound: Only shorter rows of headings are of use [m].
    """
    spots = _spots(drive)
    poses = _posed(drive, legs_of(bends, spots), rho, bends.closed, bound)
    if poses is not None:
        return _spline_path(drive, poses.turn_paths)
    chains = via_route_chains(
        drive.sequence, drive.world, drive.requirements, rho, RAMP * rho, spots
    )
    if isinstance(chains, NotFound):
        return chains
    spans = np.concatenate([chain.spans for chain in chains])
    if not drive.is_clear(spans):  # the search knows the body by the discs that cover it
        return NotFound(Reason.BUDGET)
    joints = np.cumsum([0, *(len(chain.spans) for chain in chains)])
    return _through(drive, spans, joints, ())


def _way_of(leg: LegSearch) -> TautPath:
    taut_path, _ = leg.shortest_allowed(
        on_the_line(leg.world, *leg.ends, leg.requirements.required)
    )
    assert taut_path is not None  # the spline found one
    return taut_path


def _on_byways(drive: _TurnProblem, rho: float) -> TurnPath | None:
    """The shortest swing along the shortest ways and those that are a little longer."""

    def lay(along: Sequence[TautPath]) -> TurnPath | Stuck:
        bends = bends_along(drive.sequence, along)
        return clear_turn_path_or_why(bends, rho, drive.world, drive.requirements)

    return turn_path_on_next_shortest(drive.legs, drive.taut_paths, lay)


def _posed(
    drive: _TurnProblem, legs: Sequence[HeadingLeg], rho: float, closed: bool, bound: float
) -> Poses | None:
    """The headings at all via points together: legs as they are, else pushed clear."""
    world, requirements = drive.world, drive.requirements
    as_it_is = partial(turn_path_if_clear, rho=rho, world=world, requirements=requirements)
    poses = posed(legs, rho, closed, as_it_is, bound=bound)
    if poses is None:
        pushed = partial(clear_turn_path, rho=rho, world=world, requirements=requirements)
        poses = posed(legs, rho, closed, pushed, most=PUSHED, patience=PATIENCE, bound=bound)
    return poses


def _spots(drive: _TurnProblem) -> set[int]:
    """The via points at which the robot may turn on the spot."""
    where = drive.requirements.turns_on_spot
    return {
        k
        for k, via in enumerate(drive.sequence.vias)
        if where == "vias" or (where == "stations" and via.dwell > 0.0)
    }


def _refusal(drive: _TurnProblem, bends: Bends, failed: NotFound) -> NoPathError:
    if drive.requirements.turn_radius is None:
        return refuse_body(drive.sequence, failed, partial(_has_room, drive, bends))
    legs = legs_of(bends, _spots(drive))

    def serves(radius: float) -> bool:
        rho = OVERSHOOT * radius
        lay = partial(
            turn_path_if_clear, rho=rho, world=drive.world, requirements=drive.requirements
        )
        return posed(legs, rho, drive.sequence.closed, lay, most=PUSHED) is not None

    return refuse_circle(drive.sequence, drive.radius, failed, serves)


def _has_room(drive: _TurnProblem, bends: Bends, part: float) -> bool:
    """Whether there is a path with a part of the clearance."""
    requirements = replace(drive.requirements, clearance=part * drive.requirements.clearance)
    return any(
        clear_turn_path(bends, rho, drive.world, requirements) is not None for rho in drive.radii
    )


def _spline_path(drive: _TurnProblem, turn_paths: Sequence[TurnPath]) -> SplinePath:
    """The curve of swings that follow each other, with heights if the course has them."""
    joints, detours, first = [], [], 0
    for turn_path in turn_paths:
        vias = turn_path.bends.vias
        if len(turn_paths) > 1:
            joints.append(first)
            detours += (first + turn_path.begins[1:-1]).tolist()
        else:
            begins = turn_path.begins[: len(vias)]
            joints = begins[vias != DETOUR].tolist()
            detours = begins[vias == DETOUR].tolist()
        first += len(turn_path.spans)
    if len(joints) < len(drive.sequence.vias) + drive.sequence.closed:
        joints.append(first)
    spans = np.concatenate([turn_path.spans for turn_path in turn_paths])
    return _through(drive, spans, np.array(joints), detours)


def _through(
    drive: _TurnProblem, spans: Floats, joints: NDArray[np.int64], detours: Sequence[int]
) -> SplinePath:
    """Planar spans as the curve of the course: with its heights, and exactly through its places."""
    sequence = drive.sequence
    ends = [*sequence.vias, sequence.vias[0]] if sequence.closed else sequence.vias
    spans = with_heights(spans, joints, np.array([via.at[2:] for via in ends]))
    for u, via in zip(joints, ends, strict=True):
        if u < len(spans):
            spans[u, 0] = via.at
        if u > 0:
            spans[u - 1, 3] = via.at
    return SplinePath.through(sequence, spans, joints, detours)
