"""Pieces of a fleet's courses: several cells behind each other that are nearly straight together.

A piece goes as far as the curve stays near the chord that is driven evenly from its beginning to
its end; so there are several times fewer of them than cells, and what is near what is asked of
them first.

Tested through ``fleet/test_crossings``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.growable import new_floats, new_ints
from viaspline.kernels.jit import inlined, kernel

ROBOT: Final = 0
BEGIN: Final = 1  # the node at which a piece begins
END: Final = 2  # the node at which it ends
WHOLE_COLUMNS: Final = 3

X: Final = 0  # where its chord begins [m]
Y: Final = 1
ALONG_X: Final = 2  # the unit vector along it; (1, 0) for a single place
ALONG_Y: Final = 3
CHORD: Final = 4  # its length [m]
FROM: Final = 5  # distance along the path where it begins [m]
UNTIL: Final = 6  # where it ends [m]
OFF: Final = 7  # how far the curve is from the evenly driven chord, at most [m]
BOW: Final = 8  # the widest bow of its cells [m]
REACH: Final = 9  # of its robot [m]
REAL_COLUMNS: Final = 10

MOST_CELLS = 16
WIDEST_OFF = 0.03  # of a piece of more than one cell [m]


class PackedPieces(NamedTuple):
    """Pieces, in the order of their robots and along their paths.

    Attributes:
        whole: Robot and nodes, (p, WHOLE_COLUMNS).
        real: Chord and bounds, (p, REAL_COLUMNS).
        box: What holds its curve, grown by its robot's reach: (x and y, from and to) [m], (p, 4).
    """

    whole: Ints
    real: Floats
    box: Floats


@inlined
def _off_chord(courses: PackedCourses, begin: int, end: int) -> float:
    """How far nodes are from the evenly driven chord between two of them, at most [m]."""
    x0, y0 = courses.place[begin, 0], courses.place[begin, 1]
    x1, y1 = courses.place[end, 0] - x0, courses.place[end, 1] - y0
    start = courses.distance[begin]
    length = courses.distance[end] - start
    squared = 0.0
    for node in range(begin + 1, end):
        part = (courses.distance[node] - start) / length
        x = courses.place[node, 0] - x0 - part * x1
        y = courses.place[node, 1] - y0 - part * y1
        squared = max(squared, x * x + y * y)
    return math.sqrt(squared)


@inlined
def _piece_end(courses: PackedCourses, begin: int, first: int, last: int, cells: int) -> int:
    """The node at which a piece ends that begins at a node and may have so many cells.

    The first cell of a course and the last one are pieces of their own: robots that rest side by
    side are told apart by the curve within these.
    """
    end = begin + 1 if begin == first else max(min(begin + cells, last - 1), begin + 1)
    while end > begin + 1 and _off_chord(courses, begin, end) > WIDEST_OFF:
        end = begin + (end - begin + 1) // 2
    return end


@kernel
def pieces_of(courses: PackedCourses, takes_part: Flags) -> PackedPieces:
    """The courses of the robots that take part, in pieces.

    Args:
        courses: PackedCourses.
        takes_part: (n,).
    """
    ends = new_ints(courses.distance.shape[0], 1)
    count = 0
    for robot in range(takes_part.shape[0]):
        if not takes_part[robot]:
            continue
        first, last, cells = courses.first[robot], courses.first[robot + 1] - 1, MOST_CELLS
        node = first
        while node < last:
            end = _piece_end(courses, node, first, last, cells)
            cells = min(2 * (end - node), MOST_CELLS)
            ends[count, 0] = end
            node = end
            count += 1
    pieces = PackedPieces(
        new_ints(count, WHOLE_COLUMNS), new_floats(count, REAL_COLUMNS), new_floats(count, 4)
    )
    piece = 0
    for robot in range(takes_part.shape[0]):
        if not takes_part[robot]:
            continue
        node = courses.first[robot]
        while node < courses.first[robot + 1] - 1:
            pieces.whole[piece, ROBOT] = robot
            pieces.whole[piece, BEGIN] = node
            pieces.whole[piece, END] = ends[piece, 0]
            _describe(courses, pieces, piece)
            node = ends[piece, 0]
            piece += 1
    return pieces


@inlined
def _describe(courses: PackedCourses, pieces: PackedPieces, piece: int) -> None:
    """Fill in the chord, the bounds and the box of a piece."""
    robot, begin = pieces.whole[piece, ROBOT], pieces.whole[piece, BEGIN]
    end = pieces.whole[piece, END]
    reach, bow = courses.reach[robot], 0.0
    low_x, low_y = courses.place[begin, 0], courses.place[begin, 1]
    high_x, high_y = low_x, low_y
    for node in range(begin, end):
        bow = max(bow, courses.bow[node])
        x, y = courses.place[node + 1, 0], courses.place[node + 1, 1]
        low_x, low_y = min(low_x, x), min(low_y, y)
        high_x, high_y = max(high_x, x), max(high_y, y)
    real, box = pieces.real, pieces.box
    x, y = courses.place[begin, 0], courses.place[begin, 1]
    across, up = courses.place[end, 0] - x, courses.place[end, 1] - y
    chord = math.sqrt(across * across + up * up)
    real[piece, X], real[piece, Y] = x, y
    real[piece, ALONG_X] = across / chord if chord > 0.0 else 1.0
    real[piece, ALONG_Y] = up / chord if chord > 0.0 else 0.0
    real[piece, CHORD] = chord
    real[piece, FROM], real[piece, UNTIL] = courses.distance[begin], courses.distance[end]
    real[piece, OFF] = bow + _off_chord(courses, begin, end)
    real[piece, BOW] = bow
    real[piece, REACH] = reach
    box[piece, 0], box[piece, 1] = low_x - bow - reach, low_y - bow - reach
    box[piece, 2], box[piece, 3] = high_x + bow + reach, high_y + bow + reach
