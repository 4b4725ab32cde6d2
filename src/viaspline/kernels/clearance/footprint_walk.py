"""The certificate of a polygonal body that moves along a curve, its heading along the tangent.

Nothing can get into a body that moves continuously without crossing its outline. So the body is
free when nothing is inside of it at the start and the outline keeps clear all the way: a branch
and bound over the place on the curve and the place on the outline. Pieces are dropped by the
reference point's distance and the body's outer radius where that is enough; elsewhere the cells of
``body_piece``, each the hull of four points but for a little, are bounded by a ball about a body
point and by a capsule along their long side.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.clearance.footprint_bounds import (
    AT,
    CELLS,
    COS,
    LOWER,
    SIN,
    STATE_SIZE,
    UPPER,
    X,
    Y,
    cell_bound,
)
from viaspline.kernels.clearance.footprint_motion import (
    EDGE,
    FROM,
    HIGH,
    LOW,
    MOTION_COLUMNS,
    PATH,
    SAG,
    SPEED,
    TURN,
    end_heading,
    halve_edge,
    halve_motion,
    load_path,
    load_turn,
    path_reach,
    settle,
)
from viaspline.kernels.clearance.footprint_pose import enclosed, outer_radius, outline_gap
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.segment import nearest_to_segment

MAX_STACK = 200
MAX_CELLS = 1_000_000  # cells that a bound may take
CUSP_PIECE_M = 1e-9  # a piece so small that still turns without bound is a turn on the spot [m]
FIRST_TOLERANCE_M = 1.0  # the tolerance of the first look [m]; every other one is so much finer:
TOLERANCE_RATIO = 32.0
MAX_REACH_RADII = 4.0  # pieces are halved until they reach no farther than so many outer radii
SAME_HEADING_RAD = 1e-9  # headings nearer to each other than this are one [rad]


@inner
def _turn(heading: float, other: float) -> float:
    """From one heading to another the short way [rad], in [-pi, pi]."""
    turn = other - heading
    return turn - 2.0 * math.pi * math.floor(turn / (2.0 * math.pi) + 0.5)


@inner
def _halve(stack: Floats, top: int) -> int:
    """Halve the piece at ``top``, at a cusp in the very middle with a turn on the spot. New top."""
    halve_motion(stack, top)
    late = stack[top]
    early = stack[top + 1]
    if late[TURN] == 1.0 or late[SPEED] != 0.0 or late[SPEED + 1] != 0.0:
        return top + 1
    turn = _turn(end_heading(early, True), end_heading(late, False))
    if abs(turn) <= SAME_HEADING_RAD:
        return top + 1
    load_turn(stack, late[PATH], late[PATH + 1], late[FROM], 0.0, 2.0 * math.pi, top + 2)
    return top + 2


@inner
def _open(
    world: PackedWorld,
    body: Floats,
    outer: float,
    stack: Floats,
    top: int,
    state: Floats,
    accept: float,
) -> int:
    """Take the piece at ``top``: drop it, halve it, or put its cells there. The new top."""
    row = stack[top]
    x = 0.125 * (row[PATH] + 3.0 * (row[PATH + 2] + row[PATH + 4]) + row[PATH + 6])
    y = 0.125 * (row[PATH + 1] + 3.0 * (row[PATH + 3] + row[PATH + 5]) + row[PATH + 7])
    reach = path_reach(row, x, y)
    distance, _ = nearest(world, x, y, state[UPPER] + reach + outer)
    bound = distance - reach - outer
    if bound >= accept or top + body.shape[0] + 2 > stack.shape[0]:
        state[LOWER] = min(state[LOWER], bound)
        return top - 1
    if not settle(row):
        if row[TURN] == 0.0 and reach < CUSP_PIECE_M:
            load_turn(stack, row[PATH], row[PATH + 1], row[FROM], 0.0, 2.0 * math.pi, top)
            return top
        return _halve(stack, top)
    width = row[SAG] + outer
    if distance - width >= accept:
        chord, _ = nearest_to_segment(
            world, row[PATH], row[PATH + 1], row[PATH + 6], row[PATH + 7], state[UPPER] + width
        )
        if chord > 0.0 and chord - width >= accept:
            state[LOWER] = min(state[LOWER], chord - width)
            return top - 1
    if reach > MAX_REACH_RADII * outer:
        return _halve(stack, top)
    row[LOW] = 0.0
    row[HIGH] = 1.0
    for edge in range(body.shape[0]):
        if edge > 0:
            for column in range(MOTION_COLUMNS):
                stack[top + edge, column] = row[column]
        stack[top + edge, EDGE] = edge
    return top + body.shape[0] - 1


@inner
def _walk(
    world: PackedWorld,
    body: Floats,
    outer: float,
    stack: Floats,
    top: int,
    at: Floats,
    state: Floats,
    tolerance: float,
    enough: float,
) -> int:
    """Bound the body's distance over all pieces on the stack, in ``state``.

    Stops as soon as some distance is less than ``enough``. Returns the index of what is nearest
    where the upper bound is now reached, or -1 when it is where it was.
    """
    found = -1
    while top >= 0:
        state[CELLS] += 1.0
        if state[CELLS] > MAX_CELLS:
            state[LOWER] = -np.inf
            return found
        accept = state[UPPER] - max(tolerance, -0.25 * state[UPPER])
        row = stack[top]
        if row[EDGE] < 0.0:
            top = _open(world, body, outer, stack, top, state, accept)
            continue
        bound, how, index = cell_bound(world, body, row, state, accept, at)
        if index != -1:
            found = index
            if state[UPPER] < enough:
                return found
        accept = state[UPPER] - max(tolerance, -0.25 * state[UPPER])
        full = top + 2 > stack.shape[0]
        if bound >= accept or full or how == 0:
            state[LOWER] = min(state[LOWER], bound)
            top -= 1
        elif how == 1:
            halve_motion(stack, top)
            settle(stack[top])
            settle(stack[top + 1])
            top += 1
        else:
            halve_edge(stack, top)
            top += 1
    return found


@kernel
def end_direction(spans: Floats, last: bool) -> float:
    """Heading at the start or the end of a curve [rad]; nan when it is a single point."""
    stack = np.empty((1, MOTION_COLUMNS))
    count = spans.shape[0]
    for k in range(count):
        span = count - 1 - k if last else k
        if load_path(stack, spans, span, 0):
            return end_heading(stack[0], last)
    return math.nan


@inner
def _load_span(stack: Floats, spans: Floats, span: int, heading: float) -> tuple[int, float]:
    """Put a span on the stack, above it the turn from the heading before.

    Returns:
        (top, heading at the end): -1 with the same heading where there is neither.
    """
    if not load_path(stack, spans, span, 0):
        return -1, heading
    start = end_heading(stack[0], False)
    end = end_heading(stack[0], True)
    turn = _turn(heading, start)
    if not abs(turn) > SAME_HEADING_RAD:
        return 0, end
    if abs(turn) > math.pi - 1e-6:  # either way round
        turn = 2.0 * math.pi
    load_turn(stack, spans[span, 0, 0], spans[span, 0, 1], 0.0, heading, heading + turn, 1)
    return 1, end


@inner
def _stand(stack: Floats, x: float, y: float, heading: float) -> None:
    """Put the body standing still on the stack; without a heading, turning all round."""
    if math.isnan(heading):
        load_turn(stack, x, y, 0.0, 0.0, 2.0 * math.pi, 0)
    else:
        load_turn(stack, x, y, 0.0, heading, heading, 0)


@kernel
def body_tightest(
    world: PackedWorld, spans: Floats, body: Floats, arrival: float, tolerance: float
) -> tuple[float, float, int, float, int, tuple[float, float, float]]:
    """The smallest distance between a moving body and a world, from both sides.

    Args:
        world: PackedWorld.
        spans: Bézier control polygons, (m, 4, d); the first two coordinates count.
        body: The outline (k, 2) [m]; the reference point lies inside.
        arrival: Heading before the first span [rad], from which the body turns on the spot; nan
            where there is none.
        tolerance: How far apart the two bounds may be [m]; a quarter of the depth where the body
            overlaps something.

    Returns:
        (lower, upper, span, w, index, (x, y, heading)): the bounds [m], where on the curve the
        upper one is reached, what is nearest there, and the outline's point that is nearest [m]
        with the heading that the body has then [rad]. Both bounds are
        infinite in an empty world; the lower one is minus infinity where so small a tolerance
        takes too many cells.
    """
    outer = outer_radius(body)
    heading = end_direction(spans, False) if math.isnan(arrival) else arrival
    x, y = spans[0, 0, 0], spans[0, 0, 1]
    c, s = math.cos(heading), math.sin(heading)
    if not math.isnan(heading):
        index, px, py = enclosed(world, body, outer, x, y, c, s)
        if index != -1:
            dx, dy = px - x, py - y
            depth = -outline_gap(body, c * dx + s * dy, c * dy - s * dx)
            return depth, depth, 0, 0.0, index, (px, py, heading)
    state = np.zeros(STATE_SIZE)
    state[UPPER] = np.inf
    stack = np.empty((MAX_STACK + body.shape[0], MOTION_COLUMNS))
    at = np.empty((6, 2))
    index = -1
    span_at = 0
    start = heading
    within = max(FIRST_TOLERANCE_M, tolerance)
    while True:  # from coarse to fine, so that the fine look knows where to look
        state[LOWER] = np.inf
        state[CELLS] = 0.0
        heading = start
        for span in range(-1, spans.shape[0]):
            top = 0
            if span < 0:
                _stand(stack, x, y, heading)
            else:
                top, heading = _load_span(stack, spans, span, heading)
            found = _walk(world, body, outer, stack, top, at, state, within, -np.inf)
            if found != -1:
                index = found
                span_at = max(span, 0)
        if within <= tolerance:
            break
        within = max(tolerance, within / TOLERANCE_RATIO)
    lower = min(state[LOWER], state[UPPER])
    heading = math.atan2(state[SIN], state[COS])
    place = (state[X], state[Y], heading)
    return lower, state[UPPER], span_at, state[AT], index, place


@kernel
def body_conflicts(
    world: PackedWorld, spans: Floats, body: Floats, arrival: float, required: float
) -> Ints:
    """What a moving body comes too close to on each span.

    Args:
        world: PackedWorld.
        spans: Bézier control polygons, (m, 4, d).
        body: The outline (k, 2) [m]; the reference point lies inside.
        arrival: Heading before the first span [rad], or nan.
        required: Distance that is to be kept [m]; a tenth of a micrometre more is asked for.

    Returns:
        (m,): -1 where a span is proven clear, the turn on the spot before it included; elsewhere
        the index of what the body is too close to (see ``nearest``). Something that the body
        encloses as it starts counts to the first span.
    """
    count = spans.shape[0]
    outer = outer_radius(body)
    index = np.full(count, -1, np.int64)
    stack = np.empty((MAX_STACK + body.shape[0], MOTION_COLUMNS))
    at = np.empty((6, 2))
    state = np.zeros(STATE_SIZE)
    spare = 1e-7
    heading = arrival
    for span in range(count):
        x, y = spans[span, 0, 0], spans[span, 0, 1]
        state[LOWER] = np.inf
        state[UPPER] = required + spare
        state[CELLS] = 0.0
        if span == 0:
            if math.isnan(heading):
                heading = end_direction(spans, False)
            index[0], _, _ = enclosed(
                world, body, outer, x, y, math.cos(heading), math.sin(heading)
            )
            _stand(stack, x, y, heading)
            if index[0] == -1:
                index[0] = _walk(world, body, outer, stack, 0, at, state, spare, required + spare)
        top, heading = _load_span(stack, spans, span, heading)
        if index[span] == -1:
            index[span] = _walk(world, body, outer, stack, top, at, state, spare, required + spare)
        if index[span] == -1 and state[LOWER] < required - 0.01 * spare:
            _, index[span] = nearest(world, x, y, np.inf)
    return index
