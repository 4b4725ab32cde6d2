"""How near a polygonal body comes to an obstacle: bounds over a piece of time in which both move.

The body is taken as it is in the middle of that time. Until its ends no point of it gets farther,
as seen from the obstacle, than its reference point and the turns of both allow.

Where the path has a corner the body turns on the spot, the short way, at any time while it is
there; at a cusp it may turn either way, and counts as the disc that it turns in. Where it turns far
within a short way, at what is nearly a cusp, it counts in all headings that it has there.

Tested through ``trajectory/test_moving_certificate``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.footprint_pose import outer_radius
from viaspline.kernels.jit import inner
from viaspline.kernels.motion.body_turns import has_cusp, is_at_cusp, turns_between, with_turns_at
from viaspline.kernels.motion.motion_pairs import OBSTACLE, PIECE, SHIFT, UPPER
from viaspline.kernels.motion.moving_distance import uncertainty
from viaspline.kernels.motion.moving_gap import relative_line
from viaspline.kernels.motion.packed_motion import (
    HEADING,
    KNOWN,
    PRESENT,
    TURNING,
    PackedMotion,
)
from viaspline.kernels.motion.path_bends import CORNER, bend_bounds, towards
from viaspline.kernels.motion.strides import BEGIN, END, SAG, U0, U1, X0, X1, Y0, Y1
from viaspline.kernels.motion.timed_path import TimedPath, law_bounds, place_at
from viaspline.kernels.world.shape import obstacle_enclosed, obstacle_segment

AT_JOINT = 1e-9  # of a span, within which a place is at its end
LEAST_CORNER = 1e-9  # differences of directions below this are none
SWEEP_STEP_M = 2e-4  # what a turn on the spot may miss [m],
SWEEP_SHARE = 0.125  # or so much of how far all moves meanwhile


@inner
def _pose_gap(
    motion: PackedMotion, i: int, body: Floats, x: float, y: float, heading: float, limit: float
) -> float:
    """Distance between obstacle i and a body in its frame [m]; 0 where they overlap."""
    c, s = math.cos(heading), math.sin(heading)
    best = limit
    before = body.shape[0] - 1
    for k in range(body.shape[0]):
        gap = obstacle_segment(
            motion.shapes, i, x + c * body[before, 0] - s * body[before, 1],
            y + s * body[before, 0] + c * body[before, 1], x + c * body[k, 0] - s * body[k, 1],
            y + s * body[k, 0] + c * body[k, 1], best,
        )  # fmt: skip
        best = min(best, gap)
        before = k
        if best <= 0.0:
            return 0.0
    outer = outer_radius(body)
    inside, _, _ = obstacle_enclosed(motion.shapes, i, body, outer, x, y, c, s)
    return 0.0 if inside else best


@inner
def _sweep_gap(
    motion: PackedMotion, i: int, body: Floats, x: float, y: float, first: float, turn: float,
    limit: float, missed: float,
) -> tuple[float, float]:  # fmt: skip
    """The least distance in a turn on the spot [m], at most the limit, and the heading then [rad].

    It may be less by what is missed [m].
    """
    outer = outer_radius(body)
    best = limit
    at = first
    turned = 0.0
    while True:
        gap = _pose_gap(motion, i, body, x, y, first + math.copysign(turned, turn), np.inf)
        if gap < best:
            best = gap
            at = first + math.copysign(turned, turn)
        if turned >= abs(turn) or best == 0.0:
            return best, at
        turned = min(abs(turn), turned + (gap - best + missed) / outer)


@inner
def _corner_between(bends: Floats, start: float, end: float) -> tuple[int, int]:
    """How many corners there are from one parameter to another, and the last one's parameter."""
    count = bends.shape[0]
    corners = 0
    joint = -1
    for k in range(math.ceil(start - AT_JOINT), math.floor(end + AT_JOINT) + 1):
        if bends[k % count, CORNER] > LEAST_CORNER:
            corners += 1
            joint = k
    return corners, joint


@inner
def _heading_of(rows: Floats, u: float) -> float:
    """Heading of the tangent at a parameter [rad]; lap after lap."""
    spans = rows.shape[0] - 1
    k = min(math.floor(u), math.ceil(u) - 1) if u == math.floor(u) and u > 0.0 else math.floor(u)
    w = u - k
    row = rows[k % spans]
    dx = row[1, 0] + w * (2.0 * row[2, 0] + 3.0 * w * row[3, 0])
    dy = row[1, 1] + w * (2.0 * row[2, 1] + 3.0 * w * row[3, 1])
    if dx == 0.0 and dy == 0.0:
        out = np.zeros(rows.shape[2])
        towards(rows, k % spans, w > 0.5, out)
        dx, dy = out[0], out[1]
    return math.atan2(dy, dx)


@inner
def _turn_at(rows: Floats, joint: int) -> tuple[float, float]:
    """The heading before a joint [rad] and the turn to the one after it, the short way [rad]."""
    spans = rows.shape[0] - 1
    out = np.zeros(rows.shape[2])
    towards(rows, joint - 1 if joint > 0 else spans - 1, True, out)
    before = math.atan2(out[1], out[0])
    towards(rows, joint, False, out)
    turn = math.atan2(out[1], out[0]) - before
    return before, turn - 2.0 * math.pi * math.floor(turn / (2.0 * math.pi) + 0.5)


@inner
def body_bounds(
    path: TimedPath, motion: PackedMotion, bends: Floats, body: Floats, held: float, pair: Floats,
    enough: float,
) -> tuple[float, float, float, float]:  # fmt: skip
    """Bounds of the least distance between a body and an obstacle over the time of a pair.

    Args:
        path: TimedPath.
        motion: PackedMotion.
        bends: See ``bends_of``.
        body: The outline (k, 2) [m].
        held: The heading that the body keeps [rad]; nan: it looks the way it goes.
        pair: With places at its ends that are exact; see ``motion_pairs``.
        enough: What is farther away need not be known [m].

    Returns:
        (lower, upper, heading, instant): the bounds [m], less how far off the obstacle may be, the
        lower one minus infinite where nothing is known; and the heading [rad] and the instant [s]
        with which the upper one is reached.
    """
    i, row, shift = int(pair[OBSTACLE]), int(pair[PIECE]), pair[SHIFT]
    begin, end = pair[BEGIN], pair[END]
    piece = motion.pieces[row]
    if piece[PRESENT] == 0.0:
        return np.inf, np.inf, 0.0, begin
    outer = outer_radius(body)
    swing = 0.0
    corners = 0
    joint = -1
    if math.isnan(held):
        speed, _, _ = law_bounds(path.law, begin, end)
        if speed > 0.0:
            curvature, _ = bend_bounds(path.rows, bends, pair[U0], pair[U1])
            swing = curvature * speed * (end - begin)
        corners, joint = _corner_between(bends, pair[U0], pair[U1])
    if corners > 1:
        return -np.inf, np.inf, 0.0, begin
    instant = 0.5 * (begin + end)
    cusp = math.isnan(held) and has_cusp(bends, pair[U0], pair[U1])
    if cusp and corners == 0 and is_at_cusp(bends, pair[U0], pair[U1]):
        u, _, _ = place_at(path, instant)
        most = uncertainty(motion, i, begin)
        return -np.inf, max(pair[UPPER] - outer, -most), _heading_of(path.rows, u), instant
    if corners == 1 and abs(pair[U0] - joint) <= AT_JOINT:
        instant = begin
    elif corners == 1 and abs(pair[U1] - joint) <= AT_JOINT:
        instant = end
    u, x, y = place_at(path, instant)
    ax, ay, bx, by = relative_line(
        motion, row, shift, begin, end, pair[X0], pair[Y0], pair[X1], pair[Y1]
    )
    apart = math.sqrt((bx - ax) ** 2 + (by - ay) ** 2)
    turn = abs(piece[TURNING]) * (end - begin)
    share = 0.5 if corners == 0 else 1.0
    turns = cusp
    from_u, to_u = pair[U0], pair[U1]
    if math.isnan(held):
        from_u, to_u = with_turns_at(bends, from_u, to_u)
        turns |= from_u < pair[U0] or to_u > pair[U1]
    shifts = share * (apart + turn * motion.reaches[i]) + 2.0 * pair[SAG]
    moves = np.inf if turns else shifts + swing * outer
    most = uncertainty(motion, i, end)
    then = uncertainty(motion, i, instant)
    # the pose, in the obstacle's frame
    ax, ay, bx, by = relative_line(motion, row, shift, instant, instant, x, y, x, y)
    frame = piece[HEADING] + piece[TURNING] * (instant - shift - piece[KNOWN])
    c, s = math.cos(frame), math.sin(frame)
    x, y = c * ax + s * ay, c * ay - s * ax
    if corners == 1:
        missed = max(SWEEP_STEP_M, SWEEP_SHARE * moves)
        limit = max(enough + moves + most, 0.0) + 2.0 * missed
        before, swept = _turn_at(path.rows, joint % bends.shape[0])
        gap, heading = _sweep_gap(motion, i, body, x, y, before - frame, swept, limit, missed)
        lower = max(gap - missed - moves, 0.0) - most
        if abs(u - joint) <= AT_JOINT:
            return lower, gap - then if gap < limit else np.inf, heading + frame, instant
        heading = _heading_of(path.rows, u)
        return (
            lower,
            _pose_gap(motion, i, body, x, y, heading - frame, np.inf) - then,
            heading,
            instant,
        )
    if shifts <= SWEEP_STEP_M and (turns or swing * outer > SWEEP_STEP_M) and not cusp:
        right, left = turns_between(path.rows, from_u, to_u)
        if not math.isnan(right):
            first = _heading_of(path.rows, from_u) + right
            limit = max(enough + shifts + most, 0.0) + 2.0 * SWEEP_STEP_M
            gap, heading = _sweep_gap(
                motion, i, body, x, y, first - frame, left - right, limit, SWEEP_STEP_M
            )  # fmt: skip
            lower = max(gap - SWEEP_STEP_M - shifts, 0.0) - most
            upper = gap + shifts - uncertainty(motion, i, begin)
            return lower, upper if gap < limit else np.inf, heading + frame, instant
    heading = held if not math.isnan(held) else _heading_of(path.rows, u)
    limit = enough + moves + most
    gap = _pose_gap(motion, i, body, x, y, heading - frame, max(limit, 0.0))
    if gap >= limit:
        return enough, np.inf, heading, instant
    return max(gap - moves, 0.0) - most, gap - then, heading, instant
