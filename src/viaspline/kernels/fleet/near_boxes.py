"""Where a robot must not be while another one is in a cell of its course: boxes, in order.

While the one is in a cell, the other is nearer than allowed on what of its path lies in the
capsule round the chord of the cell, grown by how far either curve is from its chord. A piece of the
other's path has a chord that is driven evenly, so its part in the capsule is an interval.

Tested through ``fleet/test_crossings``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints, Steps
from viaspline.kernels.fleet import packed_pieces as columns
from viaspline.kernels.fleet.near_pieces import TOUCHING
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_pieces import MOST_CELLS, PackedPieces
from viaspline.kernels.growable import (
    new_floats,
    new_ints,
    new_steps,
    sized_floats,
    sized_steps,
)
from viaspline.kernels.jit import inlined, kernel

LOW: Final = 0
HIGH: Final = 1

AT_X: Final = 0
AT_Y: Final = 1
TO_X: Final = 2
TO_Y: Final = 3
LENGTH: Final = 4
ALONG: Final = 5  # where it begins along the evenly driven chord of its piece [m]
CELL_COLUMNS: Final = 6

ONE_GAP = 0.1  # intervals of one robot with no more between them are one [m]


class RawBoxes(NamedTuple):
    """Boxes as ``PackedCrossings`` has them, ordered alike, before they are joined.

    Attributes:
        first: (n + 1,).
        cell: (b,).
        other: (b,).
        low: [m], (b,).
        high: [m], (b,).
    """

    first: Ints
    cell: Steps
    other: Steps
    low: Floats
    high: Floats


@inlined
def chord_in_capsule(
    x: float, y: float, cos: float, sin: float, length: float, near: float
) -> tuple[float, float]:
    """Between where the x axis is nearer to a segment than ``near``; (inf, -inf) if nowhere [m].

    Half of the axis's part in the disc round a point (x, y) is √(near² - y²) long. Along the
    segment its end x + √(near² - y²) is concave, and largest at an end or where y = ± near cos.

    Args:
        x: Where the segment begins [m].
        y: [m].
        cos: The segment's direction.
        sin: [.].
        length: Its length [m].
        near: The radius of the capsule [m].
    """
    low, high = np.inf, -np.inf
    x1, y1 = x + length * cos, y + length * sin
    if abs(y) <= near:
        root = math.sqrt(near * near - y * y)
        low, high = x - root, x + root
    if abs(y1) <= near:
        root = math.sqrt(near * near - y1 * y1)
        low, high = min(low, x1 - root), max(high, x1 + root)
    turn = near * abs(cos)
    if sin != 0.0 and min(y, y1) < turn and max(y, y1) > -turn:
        at = near * cos if sin > 0.0 else -near * cos
        last = (at - y) / sin
        if 0.0 < last < length:
            high = max(high, x + last * cos + near * abs(sin))
        first = (-at - y) / sin
        if 0.0 < first < length:
            low = min(low, x + first * cos - near * abs(sin))
    return low, high


@inlined
def _look_at(courses: PackedCourses, pieces: PackedPieces, p: int, cells: Floats) -> None:
    """Write down the cells of a piece: where each begins, its direction and its length."""
    begin, end = pieces.whole[p, columns.BEGIN], pieces.whole[p, columns.END]
    start, whole = pieces.real[p, columns.FROM], pieces.real[p, columns.UNTIL]
    ratio = pieces.real[p, columns.CHORD] / (whole - start) if whole > start else 0.0
    for k in range(end - begin + 1):
        cells[k, AT_X], cells[k, AT_Y] = courses.place[begin + k, 0], courses.place[begin + k, 1]
        cells[k, ALONG] = (courses.distance[begin + k] - start) * ratio
    for k in range(end - begin):
        dx, dy = cells[k + 1, AT_X] - cells[k, AT_X], cells[k + 1, AT_Y] - cells[k, AT_Y]
        length = math.sqrt(dx * dx + dy * dy)
        cells[k, TO_X] = dx / length if length > 0.0 else 1.0
        cells[k, TO_Y] = dy / length if length > 0.0 else 0.0
        cells[k, LENGTH] = length


@inlined
def _part_near(real: Floats, p: int, q: int) -> tuple[float, float]:
    """The part of a piece's chord within which its curve may be too near another piece [m]."""
    near = real[p, columns.REACH] + real[q, columns.REACH] - TOUCHING
    near += real[p, columns.OFF] + real[q, columns.OFF]
    ex, ey = real[p, columns.ALONG_X], real[p, columns.ALONG_Y]
    x, y = real[q, columns.X] - real[p, columns.X], real[q, columns.Y] - real[p, columns.Y]
    to_x, to_y = real[q, columns.ALONG_X], real[q, columns.ALONG_Y]
    return chord_in_capsule(
        x * ex + y * ey, y * ex - x * ey, to_x * ex + to_y * ey, to_y * ex - to_x * ey,
        real[q, columns.CHORD], near,
    )  # fmt: skip


@inlined
def _fill(
    pieces: PackedPieces, p: int, q: int, cells: Floats, room: int, counts: Ints, others: Ints,
    intervals: Floats,
) -> None:  # fmt: skip
    """Add what one piece blocks for the cells of another one.

    Args:
        pieces: PackedPieces.
        p: The piece whose cells are meant.
        q: The other piece; in the order of all pieces.
        cells: See ``_look_at``, (MOST_CELLS + 1, CELL_COLUMNS).
        room: So many intervals each cell has room for.
        counts: How many each cell has, (MOST_CELLS, 1).
        others: Whose they are, (MOST_CELLS * room, 1).
        intervals: LOW and HIGH [m], (MOST_CELLS * room, 2).
    """
    real = pieces.real
    other = pieces.whole[q, columns.ROBOT]
    count = pieces.whole[p, columns.END] - pieces.whole[p, columns.BEGIN]
    near = real[p, columns.REACH] + real[q, columns.REACH] - TOUCHING
    near += real[p, columns.BOW] + real[q, columns.OFF]
    at_x, at_y = real[q, columns.X], real[q, columns.Y]
    ex, ey = real[q, columns.ALONG_X], real[q, columns.ALONG_Y]
    chord = real[q, columns.CHORD]
    start, until = real[q, columns.FROM], real[q, columns.UNTIL]
    ratio = (until - start) / chord if chord > 0.0 else 0.0
    first, until_here = _part_near(real, p, q)
    for k in range(count):
        if cells[k + 1, ALONG] < first:
            continue
        if cells[k, ALONG] > until_here:
            break
        x, y = cells[k, AT_X] - at_x, cells[k, AT_Y] - at_y
        to_x, to_y = cells[k, TO_X], cells[k, TO_Y]
        low, high = chord_in_capsule(
            x * ex + y * ey, y * ex - x * ey, to_x * ex + to_y * ey, to_y * ex - to_x * ey,
            cells[k, LENGTH], near,
        )  # fmt: skip
        if low > chord or high < 0.0:
            continue
        low = start if low <= 0.0 else min(start + low * ratio, until)
        high = until if high >= chord else min(start + high * ratio, until)
        last = k * room + counts[k, 0] - 1
        is_same = counts[k, 0] > 0 and others[last, 0] == other
        if is_same and low <= intervals[last, HIGH] + ONE_GAP:
            intervals[last, LOW] = min(intervals[last, LOW], low)
            intervals[last, HIGH] = max(intervals[last, HIGH], high)
            continue
        others[last + 1, 0] = other
        intervals[last + 1, LOW], intervals[last + 1, HIGH] = low, high
        counts[k, 0] += 1


@kernel
def near_boxes(
    courses: PackedCourses, pieces: PackedPieces, first: Ints, near: Ints, limit: int
) -> RawBoxes:
    """The boxes of every robot, from pairs of pieces.

    Args:
        courses: PackedCourses.
        pieces: PackedPieces.
        first: See ``near_pieces``, (p + 1,).
        near: (k,).
        limit: The search ends when there are more boxes than that.

    Returns:
        The boxes; more than ``limit`` where it isn't all.
    """
    robots, room = courses.reach.shape[0], 3 * near.shape[0] + 16
    box_first = new_ints(robots + 1, 1)
    cell, other = new_steps(room, 1), new_steps(room, 1)  # what isn't written costs nothing
    low, high = new_floats(room, 1), new_floats(room, 1)
    counts, cells = new_ints(MOST_CELLS, 1), new_floats(MOST_CELLS + 1, CELL_COLUMNS)
    others, intervals = new_ints(MOST_CELLS * 64, 1), new_floats(MOST_CELLS * 64, 2)
    boxes, robot = 0, 0
    box_first[0, 0] = 0
    for p in range(pieces.whole.shape[0]):
        while robot < pieces.whole[p, columns.ROBOT]:
            robot += 1
            box_first[robot, 0] = boxes
        among = first[p + 1] - first[p]
        if among == 0 or boxes > limit:
            continue
        if among * MOST_CELLS > others.shape[0]:
            others = new_ints(2 * among * MOST_CELLS, 1)
            intervals = new_floats(2 * among * MOST_CELLS, 2)
        if boxes + among * MOST_CELLS > room:
            room = 2 * (boxes + among * MOST_CELLS)
            cell, other = sized_steps(cell, boxes, room), sized_steps(other, boxes, room)
            low, high = sized_floats(low, boxes, room), sized_floats(high, boxes, room)
        for k in range(MOST_CELLS):
            counts[k, 0] = 0
        _look_at(courses, pieces, p, cells)
        for at in range(first[p], first[p + 1]):
            _fill(pieces, p, near[at], cells, among, counts, others, intervals)
        for k in range(MOST_CELLS):
            for c in range(k * among, k * among + counts[k, 0]):
                cell[boxes, 0] = pieces.whole[p, columns.BEGIN] + k
                other[boxes, 0] = others[c, 0]
                low[boxes, 0], high[boxes, 0] = intervals[c, LOW], intervals[c, HIGH]
                boxes += 1
    while robot < robots:
        robot += 1
        box_first[robot, 0] = boxes
    return RawBoxes(
        box_first[:, 0], cell[:boxes, 0], other[:boxes, 0], low[:boxes, 0], high[:boxes, 0]
    )
