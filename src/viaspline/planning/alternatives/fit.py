"""Fitting the spline of one leg to a taut path until it is proven clear.

As the slack goes to 0 a cardinal spline tends to its polyline. The detour via points stand so that
their polyline is clear; so there is always a slack at which the spline is clear as well. It is
lowered only on the spans that need it, and only as far as they need it.

Tested through ``planning/methods/test_clear_spline`` and ``test_planner_bad_days``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.bending import self_loops
from viaspline.kernels.arrays import Floats, Ints
from viaspline.planning.checking.barrier_crossings import crossings
from viaspline.planning.checking.conflicts import CLEAR, too_close
from viaspline.planning.problem.via_sequence import Leg, ViaSequence, lay
from viaspline.planning.routing.taut_path import TautPath
from viaspline.world.world import World

# Largest turn from via point to via point [rad], and what part of the length may be spent on
# roundness: rounder first, closer at those bends where it is tight.
EFFORTS = np.array(((0.2, 1e-4), (0.2, 2e-5), (0.2, 0.0), (0.1, 0.0)))
MAX_EFFORT_ROUNDS = 8  # in which bends are taken more closely, before the slack is lowered
STRAIGHT_SLACKS = (0.7, 0.5)  # parts of a straight leg's slack that are tried before helpers
MAX_HALVINGS = 24  # of slack, after which the spline is its polyline to a ten-millionth
LEAST_LOOP_SLACK = 1e-3  # below which a loop is too small to matter
HELPER_AT = 0.1  # of a straight leg's length, where the spline would swing out into something


@dataclass(frozen=True)
class Fitted:
    """A via sequence in which one leg is clear, and that leg's curve.

    Attributes:
        sequence: With the leg in it.
        spans: The leg's curve [m], shape (m, 4, d).
    """

    sequence: ViaSequence
    spans: Floats


def fit(
    sequence: ViaSequence,
    index: int,
    taut_path: TautPath,
    world: World,
    required: float,
    closed: Floats,
) -> Fitted | None:
    """Lay the leg's spline along a taut path, across none of the ``closed`` barriers (b, 4).

    Returns:
        The fitted leg, or None if no slack makes it clear (the two via points themselves have
        then less room than the proof needs).
    """
    if taut_path.is_direct:
        return _fit_straight(sequence, index, world, required, closed)
    return _fit_round(sequence, index, taut_path, world, required, closed)


def _fit_straight(
    sequence: ViaSequence, index: int, world: World, required: float, closed: Floats
) -> Fitted | None:
    """Lay the leg straight; with helpers if less slack alone doesn't do."""
    for leg in _straight_legs(sequence, index):
        candidate = sequence.with_leg(index, leg)
        spans = leg_spans(candidate, index)
        if not _is_blocked(world, spans, required, closed).any():
            return Fitted(candidate, spans)
    return tighten(candidate, index, world, required, closed)


def _fit_round(
    sequence: ViaSequence, index: int, taut_path: TautPath, world: World, required: float,
    closed: Floats,
) -> Fitted | None:  # fmt: skip
    """Lay the leg along bends, those that are tight more closely than the others.

    So a robot that is a little slimmer gets no longer path because it got a rounder one.
    """
    start, goal = (via.at for via in sequence.ends(index))
    base = _base_slack(sequence, index)
    efforts = np.zeros(len(taut_path.bends), np.int64)
    for _ in range(MAX_EFFORT_ROUNDS if len(efforts) else 0):
        planar, of = taut_path.points(EFFORTS[efforts])
        points = lifted(planar, start, goal)
        candidate = sequence.with_leg(index, Leg(points, np.full(len(points) + 1, base)))
        spans = leg_spans(candidate, index)
        close = _is_blocked(world, spans, required, closed).reshape(-1, sequence.pieces)
        if not close.any():
            return Fitted(candidate, spans)
        raised = _raised(efforts, of, np.flatnonzero(close.any(axis=1)))
        if (raised == efforts).all():
            break
        efforts = raised
    if len(efforts):
        tightened = tighten(candidate, index, world, required, closed)
        if tightened is not None:
            return tightened
    # Arcs that run into each other leave no clear polyline along them; the corners always have one.
    points = lifted(taut_path.turns, start, goal)
    leg = Leg(points, np.full(len(points) + 1, base))
    return tighten(sequence.with_leg(index, leg), index, world, required, closed)


def _raised(efforts: Ints, of: Ints, close: Ints) -> Ints:
    """The efforts of bends, one more where the curve from via point to via point is too close.

    Args:
        efforts: Rows of ``EFFORTS``, (m,).
        of: The bend that each detour via point is of, (n,).
        close: Those of the n + 1 spans between start, detour via points and goal that are, (k,).
    """
    raised = efforts.copy()
    if len(of):
        met = of[np.clip(np.append(close - 1, close), 0, len(of) - 1)]
        raised[met] = np.minimum(efforts[met] + 1, len(EFFORTS) - 1)
    return raised


def tighten(
    sequence: ViaSequence, index: int, world: World, required: float, closed: Floats
) -> Fitted | None:
    """Halve the slack of a leg's spans that come too close or cross a barrier, until none does."""
    for _ in range(MAX_HALVINGS):
        spans = leg_spans(sequence, index)
        close = _is_blocked(world, spans, required, closed)
        if not close.any():
            return Fitted(sequence, spans)
        sequence = _halved(sequence, index, close)
    return None


def _is_blocked(world: World, spans: Floats, required: float, closed: Floats) -> NDArray[np.bool_]:
    """Which spans come too close to something or cross a barrier, (m,)."""
    close = too_close(world, spans, required) != CLEAR
    found: NDArray[np.bool_] = close | crossings(spans, closed).any(axis=1)
    return found


def untied(sequence: ViaSequence, spans: Floats) -> ViaSequence:
    """The sequence with less slack where a span loops back on itself; itself if none does.

    Where a heading is given the curve may have to come round.
    """
    legs = spans[:, 1:, :2] - spans[:, :-1, :2]
    ahead, after = legs[:, :-1], legs[:, 1:]
    cross = ahead[..., 0] * after[..., 1] - ahead[..., 1] * after[..., 0]
    turns = np.abs(np.arctan2(cross, (ahead * after).sum(axis=2))).sum(axis=1)
    if turns.max() <= np.pi:  # a curve turns no more than its control polygon
        return sequence
    loops = self_loops(spans)
    if sequence.start_tangent is not None:
        loops[: sequence.pieces] = False
    if sequence.end_tangent is not None:
        loops[-sequence.pieces :] = False
    first = sequence.first_spans()
    for index, leg in enumerate(sequence.legs):
        tied = loops[first[index] : first[index + 1]]
        tied &= np.repeat(leg.slack > LEAST_LOOP_SLACK, sequence.pieces)
        if tied.any():
            sequence = _halved(sequence, index, tied)
    return sequence


def _halved(sequence: ViaSequence, index: int, close: NDArray[np.bool_]) -> ViaSequence:
    """Half the slack between those via points of a leg between which a span is too close."""
    leg = sequence.legs[index]
    near = close.reshape(-1, sequence.pieces).any(axis=1)
    return sequence.with_leg(index, Leg(leg.points, np.where(near, leg.slack / 2, leg.slack)))


def leg_spans(sequence: ViaSequence, index: int) -> Floats:
    """The curve of one leg, laid with all others around it."""
    first = sequence.first_spans()
    return lay(sequence)[first[index] : first[index + 1]]


def _base_slack(sequence: ViaSequence, index: int) -> float:
    return float(sequence.legs[index].slack.max())


def _straight_legs(sequence: ViaSequence, index: int) -> Iterator[Leg]:
    """Legs without detours, the roundest first."""
    start, goal = (via.at for via in sequence.ends(index))
    slack = _base_slack(sequence, index)
    helpers = np.array([start + w * (goal - start) for w in (HELPER_AT, 1 - HELPER_AT)])
    for factor in STRAIGHT_SLACKS:
        yield Leg(np.empty((0, len(start))), np.array([slack * factor]))
    yield Leg(helpers, np.full(3, slack))


def lifted(points: Floats, start: Floats, goal: Floats) -> Floats:
    """Planar points between start and goal with their other coordinates in proportion."""
    if len(start) == 2:
        return points
    track = np.vstack((start[:2], points, goal[:2]))
    run = np.cumsum(np.linalg.norm(np.diff(track, axis=0), axis=1))
    share = (run[:-1] / run[-1])[:, None] if run[-1] > 0 else np.zeros((len(points), 1))
    return np.hstack((points, start[None, 2:] + share * (goal[2:] - start[2:])[None, :]))
