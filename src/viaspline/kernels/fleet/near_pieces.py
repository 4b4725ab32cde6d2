"""Which pieces of courses come near each other: a grid of them, and all pairs of neighbours in it.

The grid is hashed, so that it has no bounds: a bucket holds the pieces of all squares that fall
into it, in their order, and what isn't near is told by its box.

Tested through ``fleet/test_crossings``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet import packed_pieces as columns
from viaspline.kernels.fleet.packed_pieces import PackedPieces
from viaspline.kernels.growable import new_floats, new_ints, sized_ints
from viaspline.kernels.jit import inlined, inner, kernel

TOUCHING = 5e-7  # robots that are so much too near aren't [m]: half of PROOF_SLACK_M
MOST_SQUARES = 12  # of a piece in the mean
PRIME_X: Final = 73856093
PRIME_Y: Final = 19349663


class PieceGrid(NamedTuple):
    """Pieces by the squares that their boxes touch.

    Attributes:
        side: Of a square [m].
        start: Where the pieces of a bucket begin, (buckets + 1,); the buckets are a power of two.
        piece: In each bucket not decreasing, (entries,).
        robot: Whose piece it is, (entries,).
        box: Its box, (entries, 4).
    """

    side: float
    start: Ints
    piece: Ints
    robot: Ints
    box: Floats


@inlined
def _bucket(x: int, y: int, mask: int) -> int:
    return ((x * PRIME_X) ^ (y * PRIME_Y)) & mask


@inlined
def _square(value: float, side: float) -> int:
    return math.floor(value / side)


@inner
def _entries(box: Floats, side: float) -> int:
    """How many squares all boxes touch together."""
    count = 0
    for p in range(box.shape[0]):
        wide = _square(box[p, 2], side) - _square(box[p, 0], side) + 1
        high = _square(box[p, 3], side) - _square(box[p, 1], side) + 1
        count += wide * high
    return count


@inner
def _side(box: Floats) -> float:
    """A side for the squares: the mean extent of boxes, or so much more that they touch few."""
    total = 0.0
    for p in range(box.shape[0]):
        total += max(box[p, 2] - box[p, 0], box[p, 3] - box[p, 1])
    side = max(total / max(box.shape[0], 1), 1e-3)
    while _entries(box, side) > MOST_SQUARES * box.shape[0]:
        side *= 2.0
    return side


@kernel
def grid_of(pieces: PackedPieces) -> PieceGrid:
    """Put the boxes of pieces into a grid."""
    box = pieces.box
    side = _side(box)
    entries = _entries(box, side)
    buckets = 16
    while buckets < entries:
        buckets *= 2
    start = new_ints(buckets + 1, 1)
    piece, robot, boxes = new_ints(entries, 1), new_ints(entries, 1), new_floats(entries, 4)
    for bucket in range(buckets + 1):
        start[bucket, 0] = 0
    for p in range(box.shape[0]):
        for x in range(_square(box[p, 0], side), _square(box[p, 2], side) + 1):
            for y in range(_square(box[p, 1], side), _square(box[p, 3], side) + 1):
                start[_bucket(x, y, buckets - 1), 0] += 1
    total = 0
    for bucket in range(buckets + 1):
        total += start[bucket, 0]
        start[bucket, 0] = total
    for p in range(box.shape[0] - 1, -1, -1):  # backwards, so that each bucket is in order
        for x in range(_square(box[p, 0], side), _square(box[p, 2], side) + 1):
            for y in range(_square(box[p, 1], side), _square(box[p, 3], side) + 1):
                bucket = _bucket(x, y, buckets - 1)
                start[bucket, 0] -= 1
                entry = start[bucket, 0]
                piece[entry, 0], robot[entry, 0] = p, pieces.whole[p, columns.ROBOT]
                for side_of_box in range(4):
                    boxes[entry, side_of_box] = box[p, side_of_box]
    return PieceGrid(side, start[:, 0], piece[:, 0], robot[:, 0], boxes)


@inlined
def _is_near(pieces: PackedPieces, p: int, q: int) -> bool:
    """Whether two pieces may come too near each other, seen along the chord of each."""
    real = pieces.real
    near = real[p, columns.REACH] + real[q, columns.REACH] - TOUCHING
    near += real[p, columns.OFF] + real[q, columns.OFF]
    for _ in range(2):
        x, y = real[q, columns.X] - real[p, columns.X], real[q, columns.Y] - real[p, columns.Y]
        ex, ey = real[p, columns.ALONG_X], real[p, columns.ALONG_Y]
        chord = real[q, columns.CHORD]
        x1, y1 = x + chord * real[q, columns.ALONG_X], y + chord * real[q, columns.ALONG_Y]
        across, across1 = y * ex - x * ey, y1 * ex - x1 * ey
        if min(across, across1) > near or max(across, across1) < -near:
            return False
        along, along1 = x * ex + y * ey, x1 * ex + y1 * ey
        if min(along, along1) > real[p, columns.CHORD] + near or max(along, along1) < -near:
            return False
        p, q = q, p
    return True


@kernel
def near_pieces(
    pieces: PackedPieces, grid: PieceGrid, is_asked: Flags, limit: int
) -> tuple[Ints, Ints]:
    """All pairs of pieces of two robots that may come too near each other.

    Args:
        pieces: PackedPieces.
        grid: Of their boxes.
        is_asked: Robots of which one has to be in each pair, (n,).
        limit: The search ends when there are more pairs than that.

    Returns:
        (first (p + 1,), near): the pieces near piece p are those from first[p] to before
        first[p + 1] in ``near``, increasing; it is longer than twice ``limit`` where it isn't all.
    """
    count = pieces.box.shape[0]
    pairs = new_ints(4 * count + 16, 2)
    found = 0
    first = new_ints(count + 1, 1)
    for p in range(count + 1):
        first[p, 0] = 0
    side, mask = grid.side, grid.start.shape[0] - 2
    for p in range(count):
        robot = pieces.whole[p, columns.ROBOT]
        low_x, low_y, high_x, high_y = (
            pieces.box[p, 0], pieces.box[p, 1], pieces.box[p, 2], pieces.box[p, 3],
        )  # fmt: skip
        for x in range(_square(low_x, side), _square(high_x, side) + 1):
            for y in range(_square(low_y, side), _square(high_y, side) + 1):
                bucket = _bucket(x, y, mask)
                for entry in range(grid.start[bucket + 1] - 1, grid.start[bucket] - 1, -1):
                    q, other = grid.piece[entry], grid.robot[entry]
                    if q <= p:
                        break
                    if other == robot or not (is_asked[robot] or is_asked[other]):
                        continue
                    other_x, other_y = grid.box[entry, 0], grid.box[entry, 1]
                    if other_x > high_x or grid.box[entry, 2] < low_x:
                        continue
                    if other_y > high_y or grid.box[entry, 3] < low_y:
                        continue
                    if _square(max(low_x, other_x), side) != x:
                        continue  # the first square that both touch has the pair
                    if _square(max(low_y, other_y), side) != y or not _is_near(pieces, p, q):
                        continue
                    if found == pairs.shape[0]:
                        pairs = sized_ints(pairs, found, 2 * found)
                    pairs[found, 0], pairs[found, 1] = p, q
                    first[p + 1, 0] += 1
                    first[q + 1, 0] += 1
                    found += 1
        if found > limit:
            return first[:, 0], new_ints(2 * found, 1)[:, 0]
    return _both_ways(first, pairs, found)


@inner
def _both_ways(first: Ints, pairs: Ints, count: int) -> tuple[Ints, Ints]:
    """Pairs as a list for either piece, increasing, from how many each has."""
    pieces = first.shape[0] - 1
    near = new_ints(2 * count, 1)
    filled = new_ints(pieces, 1)
    for p in range(pieces):
        first[p + 1, 0] += first[p, 0]
        filled[p, 0] = first[p, 0]
    for k in range(count):  # in the order of the first: the lists of the second are increasing
        near[filled[pairs[k, 1], 0], 0] = pairs[k, 0]
        filled[pairs[k, 1], 0] += 1
    begin = 0
    while begin < count:
        p, end = pairs[begin, 0], begin
        while end < count and pairs[end, 0] == p:
            q, at = pairs[end, 1], filled[p, 0]
            while at > filled[p, 0] - (end - begin) and near[at - 1, 0] > q:
                near[at, 0] = near[at - 1, 0]
                at -= 1
            near[at, 0] = q
            filled[p, 0] += 1
            end += 1
        begin = end
    return first[:, 0], near[:, 0]
