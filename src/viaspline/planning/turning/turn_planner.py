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
from viaspline.planning.alternatives.lay_clear import lay_clear
from viaspline.planning.alternatives.lead_round import Task
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.alternatives.record import Account
from viaspline.planning.checking.conflicts import is_clear
from viaspline.planning.problem.heights import with_heights
from viaspline.planning.problem.requirements import Brief
from viaspline.planning.problem.spline_path import Laid
from viaspline.planning.problem.via_sequence import Course
from viaspline.planning.routing.router import Way, on_the_line
from viaspline.planning.turning.bend_row import DETOUR, Bends, bends_along
from viaspline.planning.turning.driven_alternatives import DrivenSides
from viaspline.planning.turning.headings import Leg, Poses, legs_of, posed
from viaspline.planning.turning.hybrid_astar.pose_search import NotFound, Reason
from viaspline.planning.turning.hybrid_astar.via_route import tight_chains
from viaspline.planning.turning.next_shortest import swing_on_byways
from viaspline.planning.turning.repair import Stuck, clear_swing, clear_swing_or_why, swing_if_clear
from viaspline.planning.turning.turn_path import OVERSHOOT, RAMP, Swing
from viaspline.planning.turning.turn_refusals import refuse_body, refuse_circle
from viaspline.world.world import World

Floats = NDArray[np.float64]
PUSHED = 40  # rows of headings for which legs are pushed clear
PATIENCE = 16  # pairs of headings of a leg, until one of them can be
WIDE = (6.0, 3.0, 1.5)  # radii of turns for a long body without a turning circle, and the last,
ENOUGH = 1.01  # of the shortest ways' length: a longer byway is compared with what a search finds
NARROW = 0.5  # in distances that its path keeps


@dataclass(frozen=True)
class _Drive:
    """What is to be driven, where, and by what."""

    course: Course
    world: World
    brief: Brief

    @property
    def radius(self) -> float:
        """The turning circle [m]."""
        if self.brief.turn_radius is not None:
            return self.brief.turn_radius
        return NARROW * max(self.brief.required, 1e-3)

    @property
    def rho(self) -> float:
        """The least radius of turns that are laid [m]."""
        return OVERSHOOT * self.radius

    @property
    def radii(self) -> tuple[float, ...]:
        """The least radii that are tried for turns [m]; wide ones first if none is given."""
        if self.brief.turn_radius is not None:
            return (self.rho,)
        return (*(part * self.brief.required for part in WIDE), self.rho)

    @property
    def careful(self) -> tuple[float, ...]:
        """Those that are worth a longer search [m]."""
        return self.radii[-1:] if len(self.radii) == 1 else (self.radii[1], self.radii[-1])

    @cached_property
    def legs(self) -> tuple[LegSearch, ...]:
        """The legs of the course."""
        router = Task.of(self.course, self.world, self.brief).router
        count = len(self.course.legs)
        return tuple(
            LegSearch(self.course, k, self.world, self.brief, router) for k in range(count)
        )

    @cached_property
    def ways(self) -> tuple[Way, ...]:
        """The shortest way of every leg."""
        return tuple(_way_of(leg) for leg in self.legs)

    def is_clear(self, spans: Floats) -> bool:
        """Whether the body keeps clear on planar spans."""
        return is_clear(self.world, spans, self.brief)

    def is_drivable(self, spans: Floats) -> bool:
        """Whether the body keeps clear, and no turn is sharper than the turning circle."""
        limit = self.brief.turn_radius
        if limit is not None:
            flat = np.ascontiguousarray(spans[:, :, :2])
            is_round = self.course.closed and np.array_equal(flat[0, 0], flat[-1, 3])
            ground = PiecewiseCubic(flat, closed=is_round)  # with the seam: no turn there either
            if not curvature_bound(ground)[0] * limit <= 1.0:
                return False
        return self.is_clear(spans)


def lay_drivable(course: Course, world: World, brief: Brief) -> tuple[Laid, Account]:
    """Lay a course for a robot with a turning circle or a long body.

    Raises:
        NoPathError: When there is no such curve, with the via point that can't be reached and
            what would allow it.
    """
    smooth = replace(course, tangents="continuous")
    laid, account = lay_clear(smooth, world, brief)
    drive = _Drive(smooth, world, brief)
    sides = DrivenSides(smooth, world, brief, partial(_along, drive), drive.is_drivable)
    if not drive.is_drivable(laid.spans):
        laid = sides.shortest(_swung(drive), account.passed)
    return laid, replace(account, laid=laid, driven=sides)


def _along(drive: _Drive, given: Mapping[int, Way]) -> Laid | None:
    """Lines and turns with some legs along given ways, the others along their shortest."""
    ways = [given.get(k, way) for k, way in enumerate(drive.ways)]
    bends = bends_along(drive.course, ways)
    for rho in drive.radii:
        swing = clear_swing(bends, rho, drive.world, drive.brief)
        if swing is not None:
            return _laid(drive, [swing])
    return None


def _swung(drive: _Drive) -> Laid:
    """Lines and turns through the via points of a course.

    Raises:
        NoPathError: When there are none.
    """
    bends = bends_along(drive.course, drive.ways)
    for rho in drive.radii:
        swing = clear_swing(bends, rho, drive.world, drive.brief)
        if swing is not None:
            return _laid(drive, [swing])
    failed: NotFound | None = None
    for rho in drive.careful:
        byway = _on_byways(drive, rho)
        if byway is not None and byway.length <= ENOUGH * sum(way.length for way in drive.ways):
            return _laid(drive, [byway])
        found = _searched(drive, bends, rho, math.inf if byway is None else byway.length)
        if byway is not None and (isinstance(found, NotFound) or found.length > byway.length):
            return _laid(drive, [byway])
        if isinstance(found, Laid):
            return found
        failed = found
    assert failed is not None  # there is at least one radius
    raise _refusal(drive, bends, failed)


def _searched(drive: _Drive, bends: Bends, rho: float, bound: float) -> Laid | NotFound:
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
        return _laid(drive, poses.swings)
    chains = tight_chains(drive.course, drive.world, drive.brief, rho, RAMP * rho, spots)
    if isinstance(chains, NotFound):
        return chains
    spans = np.concatenate([chain.spans for chain in chains])
    if not drive.is_clear(spans):  # the search knows the body by the discs that cover it
        return NotFound(Reason.BUDGET)
    joints = np.cumsum([0, *(len(chain.spans) for chain in chains)])
    return _through(drive, spans, joints, ())


def _way_of(leg: LegSearch) -> Way:
    way, _ = leg.shortest_allowed(on_the_line(leg.world, *leg.ends, leg.brief.required))
    assert way is not None  # the spline found one
    return way


def _on_byways(drive: _Drive, rho: float) -> Swing | None:
    """The shortest swing along the shortest ways and those that are a little longer."""

    def lay(along: Sequence[Way]) -> Swing | Stuck:
        bends = bends_along(drive.course, along)
        return clear_swing_or_why(bends, rho, drive.world, drive.brief)

    return swing_on_byways(drive.legs, drive.ways, lay)


def _posed(
    drive: _Drive, legs: Sequence[Leg], rho: float, closed: bool, bound: float
) -> Poses | None:
    """The headings at all via points together: legs as they are, else pushed clear."""
    world, brief = drive.world, drive.brief
    as_it_is = partial(swing_if_clear, rho=rho, world=world, brief=brief)
    poses = posed(legs, rho, closed, as_it_is, bound=bound)
    if poses is None:
        pushed = partial(clear_swing, rho=rho, world=world, brief=brief)
        poses = posed(legs, rho, closed, pushed, most=PUSHED, patience=PATIENCE, bound=bound)
    return poses


def _spots(drive: _Drive) -> set[int]:
    """The via points at which the robot may turn on the spot."""
    where = drive.brief.turns_on_spot
    return {
        k
        for k, via in enumerate(drive.course.vias)
        if where == "vias" or (where == "stations" and via.dwell > 0.0)
    }


def _refusal(drive: _Drive, bends: Bends, failed: NotFound) -> NoPathError:
    if drive.brief.turn_radius is None:
        return refuse_body(drive.course, failed, partial(_has_room, drive, bends))
    legs = legs_of(bends, _spots(drive))

    def serves(radius: float) -> bool:
        rho = OVERSHOOT * radius
        lay = partial(swing_if_clear, rho=rho, world=drive.world, brief=drive.brief)
        return posed(legs, rho, drive.course.closed, lay, most=PUSHED) is not None

    return refuse_circle(drive.course, drive.radius, failed, serves)


def _has_room(drive: _Drive, bends: Bends, part: float) -> bool:
    """Whether there is a path with a part of the clearance."""
    brief = replace(drive.brief, clearance=part * drive.brief.clearance)
    return any(clear_swing(bends, rho, drive.world, brief) is not None for rho in drive.radii)


def _laid(drive: _Drive, swings: Sequence[Swing]) -> Laid:
    """The curve of swings that follow each other, with heights if the course has them."""
    joints, detours, first = [], [], 0
    for swing in swings:
        vias = swing.bends.vias
        if len(swings) > 1:
            joints.append(first)
            detours += (first + swing.begins[1:-1]).tolist()
        else:
            begins = swing.begins[: len(vias)]
            joints = begins[vias != DETOUR].tolist()
            detours = begins[vias == DETOUR].tolist()
        first += len(swing.spans)
    if len(joints) < len(drive.course.vias) + drive.course.closed:
        joints.append(first)
    spans = np.concatenate([swing.spans for swing in swings])
    return _through(drive, spans, np.array(joints), detours)


def _through(
    drive: _Drive, spans: Floats, joints: NDArray[np.int64], detours: Sequence[int]
) -> Laid:
    """Planar spans as the curve of the course: with its heights, and exactly through its places."""
    course = drive.course
    ends = [*course.vias, course.vias[0]] if course.closed else course.vias
    spans = with_heights(spans, joints, np.array([via.at[2:] for via in ends]))
    for u, via in zip(joints, ends, strict=True):
        if u < len(spans):
            spans[u, 0] = via.at
        if u > 0:
            spans[u - 1, 3] = via.at
    return Laid.through(course, spans, joints, detours)
