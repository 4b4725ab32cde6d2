"""How high a curve is above bilinear ground, at least and at most: bounds from both sides.

A piece lies over at most nine cells of some level of the ground's pyramid. Over each the ground
keeps within two bounds of a plane, and the height over a plane is a cubic, which is nowhere lower
than its lowest Bézier coefficient. Over single patches the plane is that of the ground at the
piece's middle, and what is left of the bilinear term is bounded by the piece's size. What that
doesn't settle is halved; so where the curve goes from patch to patch, either one's ground is
continued beyond its edge. The span that may be lowest comes first: the lower a height is known, the
more of the others are settled as a whole.

Tested through ``curve/test_height_certificate``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.halving import halve_piece, load_span
from viaspline.kernels.jit import inlined, kernel
from viaspline.kernels.space.ground_pyramid import ground_height, has_terrain
from viaspline.kernels.space.packed_space import PackedSpace

MAX_DEPTH = 64  # halvings of a span
MAX_PIECES = 1_000_000  # that a bound may take
SAME_PLACE_M = 1e-6  # a piece so small that partly lies over unknown ground lies over it [m]
LEAST_M = 1e-9  # a piece so small isn't halved any more [m]
PIECE = 14  # four control points and the parameters of the ends


@inlined
def _over_plane(
    piece: Floats, base: float, along: float, across: float, x0: float, y0: float, sign: float
) -> float:
    """Bound of sign times the height of a piece over the plane through (x0, y0, base) [m]."""
    bound = np.inf
    for k in range(4):
        ground = base + along * (piece[3 * k] - x0) + across * (piece[3 * k + 1] - y0)
        bound = min(bound, sign * (piece[3 * k + 2] - ground))
    return bound


@inlined
def _over_patch(
    space: PackedSpace,
    piece: Floats,
    i: int,
    j: int,
    sign: float,
    u: float,
    v: float,
    twisted: float,
) -> float:
    """Bound of sign times the height of a piece over patch (i, j), continued beyond its edges [m].

    Args:
        space: PackedSpace.
        piece: Its control points.
        i: Column of the patch.
        j: Row of the patch.
        sign: 1 or -1.
        u: Middle of the piece along x, in patches from the patch's first corner.
        v: Its middle along y.
        twisted: Product of how far the piece gets from there along x and along y.
    """
    frame, nodes = space.ground_frame, space.heights
    corner = nodes[j, i]
    along, across = nodes[j, i + 1] - corner, nodes[j + 1, i] - corner
    twist = nodes[j + 1, i + 1] - nodes[j, i + 1] - across
    if math.isnan(corner + along + across + twist):
        return -np.inf if sign > 0.0 and frame[4] == np.inf else np.inf
    x0, y0 = frame[0] + i * frame[2], frame[1] + j * frame[2]
    slope_x, slope_y = (along + v * twist) / frame[2], (across + u * twist) / frame[2]
    bound = _over_plane(piece, corner - u * v * twist, slope_x, slope_y, x0, y0, sign)
    return bound - abs(twist) * twisted


@inlined
def _over_cell(space: PackedSpace, piece: Floats, level: int, i: int, j: int, sign: float) -> float:
    """Bound of sign times the height of a piece over a cell of the ground's pyramid [m]."""
    row = space.ground_levels[level, 2] + i + space.ground_levels[level, 0] * j
    plane, frame = space.ground_planes[row], space.ground_frame
    if sign > 0.0 and space.ground_tops[row] == np.inf:
        return -np.inf
    if plane[4] < plane[3]:  # none of it is known
        return np.inf
    size = frame[2] * (4 << (2 * level))
    x0, y0 = frame[0] + i * size, frame[1] + j * size
    bound = _over_plane(piece, plane[0], plane[1], plane[2], x0, y0, sign)
    return bound - (plane[4] if sign > 0.0 else -plane[3])


@inlined
def _piece_height(
    space: PackedSpace, piece: Floats, sign: float, needed: float
) -> tuple[float, float]:
    """Bound of sign times the height above ground of a piece, and the size of the piece in plan.

    Over ground that isn't known it is inf, or -inf where that blocks and sign is 1. Where it is
    found to be less than is needed [m], it may be less still: then the piece has to be halved. Of
    one so small that it counts as one place it is the bound.
    """
    frame = space.ground_frame
    x_low, x_high, y_low, y_high = np.inf, -np.inf, np.inf, -np.inf
    low = np.inf
    for k in range(4):
        x_low, x_high = min(x_low, piece[3 * k]), max(x_high, piece[3 * k])
        y_low, y_high = min(y_low, piece[3 * k + 1]), max(y_high, piece[3 * k + 1])
        low = min(low, sign * (piece[3 * k + 2] - frame[3]))
    size = max(x_high - x_low, y_high - y_low)
    if not has_terrain(space):
        return low, size
    columns, rows = space.heights.shape[1] - 1, space.heights.shape[0] - 1
    u_low, u_high = (x_low - frame[0]) / frame[2], (x_high - frame[0]) / frame[2]
    v_low, v_high = (y_low - frame[1]) / frame[2], (y_high - frame[1]) / frame[2]
    if u_low < 0.0 or v_low < 0.0 or u_high > columns or v_high > rows:
        if sign > 0.0 and frame[4] == np.inf:
            return -np.inf, size
        if u_high < 0.0 or v_high < 0.0 or u_low > columns or v_low > rows:
            return np.inf, size
    i0, i1 = int(max(u_low, 0.0)), int(min(u_high, columns - 1.0))
    j0, j1 = int(max(v_low, 0.0)), int(min(v_high, rows - 1.0))
    i0, j0 = min(i0, i1), min(j0, j1)
    level = -1
    while i1 - i0 > 2 or j1 - j0 > 2:
        i0, i1, j0, j1 = i0 >> 2, i1 >> 2, j0 >> 2, j1 >> 2
        level += 1
    u_mid, v_mid = 0.5 * (u_low + u_high), 0.5 * (v_low + v_high)
    twisted = 0.25 * (u_high - u_low) * (v_high - v_low)
    bound = np.inf
    for j in range(j0, j1 + 1):
        for i in range(i0, i1 + 1):
            if level < 0:
                over = _over_patch(space, piece, i, j, sign, u_mid - i, v_mid - j, twisted)
            else:
                over = _over_cell(space, piece, level, i, j, sign)
            bound = min(bound, over)
            if bound < needed and size >= SAME_PLACE_M:
                return bound, size
    return bound, size


@inlined
def _over_ground(
    space: PackedSpace, x: float, y: float, z: float, sign: float, blocked: float
) -> float:
    """Sign times the height of a place above ground [m]; ``blocked`` where that isn't known."""
    height = sign * (z - ground_height(space, x, y))
    return blocked if math.isnan(height) else height


@inlined
def _middle_height(space: PackedSpace, piece: Floats, sign: float, blocked: float) -> float:
    """As ``_over_ground``, of the middle of a piece."""
    x = 0.125 * (piece[0] + 3.0 * (piece[3] + piece[6]) + piece[9])
    y = 0.125 * (piece[1] + 3.0 * (piece[4] + piece[7]) + piece[10])
    z = 0.125 * (piece[2] + 3.0 * (piece[5] + piece[8]) + piece[11])
    return _over_ground(space, x, y, z, sign, blocked)


@kernel
def least_height(
    space: PackedSpace, spans: Floats, sign: float, tolerance: float
) -> tuple[float, float, int, float]:
    """The least of sign times the height above ground along a curve, from both sides.

    Args:
        space: PackedSpace.
        spans: Bézier control polygons, (m, 4, 3).
        sign: 1 for the least height; -1 for the greatest, whose negative is found.
        tolerance: How far apart the two bounds may be [m].

    Returns:
        (lower, upper, span, w): the bounds [m] and where the upper one is reached. With sign 1 both
        are -inf where the curve lies over ground that isn't known, or within a micrometre of it,
        if that blocks. Both are inf where it lies over no ground that is known. The lower one is
        -inf alone where so small a tolerance takes too many pieces.
    """
    blocked = -np.inf if sign > 0.0 and space.ground_frame[4] == np.inf else np.inf
    upper, lower = np.inf, np.inf
    span_at, w_at = 0, 0.0
    count = spans.shape[0]
    for joint in range(count + 1):
        span = min(joint, count - 1)
        place = spans[span, 3 * (joint - span)]
        height = _over_ground(space, place[0], place[1], place[2], sign, blocked)
        if height < upper:
            upper, span_at, w_at = height, span, float(joint - span)
    stack = np.empty((MAX_DEPTH, PIECE))
    bounds = np.empty(count)
    first = 0
    for span in range(count):
        load_span(stack, spans, span, 3)
        bounds[span] = _piece_height(space, stack[0], sign, -np.inf)[0]
        height = _middle_height(space, stack[0], sign, blocked)
        if height < upper:
            upper, span_at, w_at = height, span, 0.5
        if bounds[span] < bounds[first]:
            first = span
    pieces = 0
    for number in range(count):
        span = first if number == 0 else number - 1 if number <= first else number
        if bounds[span] >= upper - tolerance or upper == -np.inf:
            lower = min(lower, bounds[span])
            continue
        load_span(stack, spans, span, 3)
        halve_piece(stack, 0, 3)
        top = 1
        while top >= 0:
            pieces += 1
            if pieces > MAX_PIECES:
                return -np.inf, upper, span_at, w_at
            piece = stack[top]
            is_last = top + 2 > MAX_DEPTH
            needed = -np.inf if is_last else upper - tolerance
            bound, size = _piece_height(space, piece, sign, needed)
            if bound >= upper - tolerance or upper == -np.inf:
                lower = min(lower, bound)
                top -= 1
                continue
            height = _middle_height(space, piece, sign, blocked)
            if bound == -np.inf and size < SAME_PLACE_M:
                height = blocked
            if height < upper:
                upper, span_at, w_at = height, span, 0.5 * (piece[12] + piece[13])
            if is_last or size < LEAST_M:
                lower = min(lower, bound)
                top -= 1
            else:
                halve_piece(stack, top, 3)
                top += 1
    return min(lower, upper), upper, span_at, w_at
