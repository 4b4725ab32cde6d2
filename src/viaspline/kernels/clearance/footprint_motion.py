"""Pieces of a body's motion, and cells of them: the body in the halves of a piece, edge by edge.

A piece of the motion is a row of numbers: a Bézier piece of the reference point's path with the
control vectors of its derivative, or a turn on the spot between two headings. A cell is a piece
and a part of one edge of the outline. Body point b stands at P(w) + R(θ(w)) b. With λ how far P(w)
is along the chord, the place of b between its places at the ends of the piece is missed by

    at most   sag + |b| (Δ²/8 + max |θ(w) - θ0 - λ Δ|),   Δ = θ1 - θ0,

where sag is the path's own distance from its chord. The last term has two bounds: the heading's
range, and (max θ' - min θ')/4 + Δ max |w - λ|; both come from Bernstein coefficients, the second
is of second order. All vanish on straight pieces. So the cell lies in the hull of four places of
body points, grown by that.

Tested through ``kernels/clearance/test_footprint_walk``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner

PATH = 0  # 8 numbers: control points
SPEED = 8  # 6 numbers: control vectors of the derivative, to a factor
FROM = 14  # local parameters of the ends
TO = 15
EDGE = 16  # -1: the whole outline
LOW = 17  # part of the edge
HIGH = 18
TURN = 19  # 1: a turn on the spot
FIRST = 20  # its headings
LAST = 21
COS0 = 22  # headings at the ends
SIN0 = 23
COS1 = 24
SIN1 = 25
SAG = 26  # what the hull of four places misses: sag + |b| swing
SWING = 27
MOTION_COLUMNS = 28

MAX_CHORD_SLOPE = (
    0.35  # tangent of the widest angle to start with between a chord and the derivative
)
MAX_SPOT_TURN_RAD = 0.5  # widest turn on the spot that is taken at once [rad]


@inner
def load_path(stack: Floats, spans: Floats, span: int, top: int) -> bool:
    """Put a span on the stack. False if it is a single point, which has no heading."""
    row = stack[top]
    size = 0.0
    for k in range(4):
        for axis in range(2):
            row[PATH + 2 * k + axis] = spans[span, k, axis]
            size = max(size, abs(spans[span, k, axis]))
    largest = 0.0
    for k in range(6):
        row[SPEED + k] = row[PATH + k + 2] - row[PATH + k]
        largest = max(largest, abs(row[SPEED + k]))
    noise = max(1e-12 * largest, 1e-15 * size)  # differences that are only rounding
    for k in range(3):
        if max(abs(row[SPEED + 2 * k]), abs(row[SPEED + 2 * k + 1])) <= noise:
            row[SPEED + 2 * k] = 0.0
            row[SPEED + 2 * k + 1] = 0.0
    row[FROM] = 0.0
    row[TO] = 1.0
    row[EDGE] = -1.0
    row[TURN] = 0.0
    return largest > noise


@inner
def load_turn(
    stack: Floats, x: float, y: float, w: float, first: float, last: float, top: int
) -> None:
    """Put a turn on the spot from one heading to another [rad] on the stack."""
    row = stack[top]
    for k in range(4):
        row[PATH + 2 * k] = x
        row[PATH + 2 * k + 1] = y
    row[FROM] = w
    row[TO] = w
    row[EDGE] = -1.0
    row[TURN] = 1.0
    row[FIRST] = first
    row[LAST] = last


@inner
def end_heading(row: Floats, last: bool) -> float:
    """Heading at an end of a piece [rad]: of the first control vector that is not zero."""
    for j in range(3):
        k = SPEED + 2 * (2 - j if last else j)
        if row[k] != 0.0 or row[k + 1] != 0.0:
            return math.atan2(row[k + 1], row[k])
    return 0.0


@inner
def _copy(stack: Floats, top: int) -> None:
    for column in range(MOTION_COLUMNS):
        stack[top + 1, column] = stack[top, column]


@inner
def halve_motion(stack: Floats, top: int) -> None:
    """Replace the piece at ``top`` by its second half, its first half above it."""
    _copy(stack, top)
    late = stack[top]
    early = stack[top + 1]
    if late[TURN] == 1.0:
        middle = 0.5 * (late[FIRST] + late[LAST])
        late[FIRST] = middle
        early[LAST] = middle
        return
    for axis in range(2):
        p0 = late[PATH + axis]
        p3 = late[PATH + 6 + axis]
        q0 = 0.5 * (p0 + late[PATH + 2 + axis])
        q1 = 0.5 * (late[PATH + 2 + axis] + late[PATH + 4 + axis])
        q2 = 0.5 * (late[PATH + 4 + axis] + p3)
        r0 = 0.5 * (q0 + q1)
        r1 = 0.5 * (q1 + q2)
        middle = 0.5 * (r0 + r1)
        early[PATH + 2 + axis] = q0
        early[PATH + 4 + axis] = r0
        early[PATH + 6 + axis] = middle
        late[PATH + axis] = middle
        late[PATH + 2 + axis] = r1
        late[PATH + 4 + axis] = q2
        v0 = 0.5 * (late[SPEED + axis] + late[SPEED + 2 + axis])
        v1 = 0.5 * (late[SPEED + 2 + axis] + late[SPEED + 4 + axis])
        early[SPEED + 2 + axis] = v0
        early[SPEED + 4 + axis] = 0.5 * (v0 + v1)
        late[SPEED + axis] = 0.5 * (v0 + v1)
        late[SPEED + 2 + axis] = v1
    middle = 0.5 * (late[FROM] + late[TO])
    early[TO] = middle
    late[FROM] = middle


@inner
def halve_edge(stack: Floats, top: int) -> None:
    """Replace the cell at ``top`` by its two halves along the edge."""
    _copy(stack, top)
    middle = 0.5 * (stack[top, LOW] + stack[top, HIGH])
    stack[top, LOW] = middle
    stack[top + 1, HIGH] = middle


@inner
def _turning_spread(row: Floats) -> float:
    """(max θ' - min θ') / 4 over a piece, for its own parameter from 0 to 1 [rad]."""
    x0, y0 = row[SPEED], row[SPEED + 1]
    x1, y1 = row[SPEED + 2], row[SPEED + 3]
    x2, y2 = row[SPEED + 4], row[SPEED + 5]
    g0 = x0 * x0 + y0 * y0
    g1 = x0 * x1 + y0 * y1
    g2 = (x0 * x2 + y0 * y2 + 2.0 * (x1 * x1 + y1 * y1)) / 3.0
    g3 = x1 * x2 + y1 * y2
    g4 = x2 * x2 + y2 * y2
    low = min(min(min(g0, g1), min(g2, g3)), g4)
    high = max(max(max(g0, g1), max(g2, g3)), g4)
    if low <= 0.0:
        return np.inf
    n0 = 2.0 * (x0 * y1 - y0 * x1)
    n1 = x0 * y2 - y0 * x2
    n2 = 2.0 * (x1 * y2 - y1 * x2)
    most = max(max(n0, n1), n2)
    least = min(min(n0, n1), n2)
    most /= low if most > 0.0 else high
    least /= high if least > 0.0 else low
    return 0.25 * (most - least)


@inner
def settle(row: Floats) -> bool:
    """Fill in the headings at a piece's ends and what the hull misses.

    False where it turns too far and should be halved first. Its halves can always be settled, but
    may turn too far for their own chords.
    """
    if row[TURN] == 1.0:
        row[COS0], row[SIN0] = math.cos(row[FIRST]), math.sin(row[FIRST])
        row[COS1], row[SIN1] = math.cos(row[LAST]), math.sin(row[LAST])
        turn = row[LAST] - row[FIRST]
        row[SAG] = 0.0
        row[SWING] = 0.125 * turn * turn
        return abs(turn) <= MAX_SPOT_TURN_RAD
    cx = row[SPEED] + row[SPEED + 2] + row[SPEED + 4]
    cy = row[SPEED + 1] + row[SPEED + 3] + row[SPEED + 5]
    squared = cx * cx + cy * cy
    left = -np.inf
    right = np.inf
    first = np.inf
    last = np.inf
    for k in range(3):
        vx = row[SPEED + 2 * k]
        vy = row[SPEED + 2 * k + 1]
        if vx == 0.0 and vy == 0.0:
            continue
        ahead = cx * vx + cy * vy
        aside = cx * vy - cy * vx
        if ahead <= 0.0:
            return False
        size = 1.0 / math.sqrt(vx * vx + vy * vy)
        last = aside / ahead
        row[COS1], row[SIN1] = vx * size, vy * size
        if first == np.inf:
            first = last
            row[COS0], row[SIN0] = row[COS1], row[SIN1]
        left = max(left, last)
        right = min(right, last)
    reach = math.sqrt(squared)
    # where the path is along its chord, beside the parameter
    lag = max(
        abs(1.0 / 3.0 - (cx * row[SPEED] + cy * row[SPEED + 1]) / squared),
        abs((cx * row[SPEED + 4] + cy * row[SPEED + 5]) / squared - 1.0 / 3.0),
    )
    # from here on in metres: control points seen from the first, across the chord
    cx /= reach
    cy /= reach
    across1 = cx * (row[PATH + 3] - row[PATH + 1]) - cy * (row[PATH + 2] - row[PATH])
    across2 = cx * (row[PATH + 5] - row[PATH + 7]) - cy * (row[PATH + 4] - row[PATH + 6])
    turn = abs(last - first)
    row[SAG] = 0.75 * max(abs(across1), abs(across2))
    spread = min(left - right, _turning_spread(row) + 0.75 * lag * turn)
    row[SWING] = 0.125 * turn * turn + spread
    return left <= MAX_CHORD_SLOPE and right >= -MAX_CHORD_SLOPE


@inner
def middle_pose(row: Floats) -> tuple[float, float, float, float]:
    """x, y, cosine and sine in the middle of a settled piece."""
    x = (row[PATH] + 3.0 * (row[PATH + 2] + row[PATH + 4]) + row[PATH + 6]) / 8.0
    y = (row[PATH + 1] + 3.0 * (row[PATH + 3] + row[PATH + 5]) + row[PATH + 7]) / 8.0
    if row[TURN] == 1.0:
        c = row[COS0] + row[COS1]
        s = row[SIN0] + row[SIN1]
    else:
        c = row[SPEED] + 2.0 * row[SPEED + 2] + row[SPEED + 4]
        s = row[SPEED + 1] + 2.0 * row[SPEED + 3] + row[SPEED + 5]
    size = 1.0 / math.sqrt(c * c + s * s)
    return x, y, c * size, s * size


@inner
def path_reach(row: Floats, x: float, y: float) -> float:
    """Distance from (x, y) to a piece's farthest control point."""
    squared = 0.0
    for k in range(4):
        dx = row[PATH + 2 * k] - x
        dy = row[PATH + 2 * k + 1] - y
        squared = max(squared, dx * dx + dy * dy)
    return math.sqrt(squared)
