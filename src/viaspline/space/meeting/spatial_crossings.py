"""Where the paths of a fleet in space come nearer each other than two robots may be.

Cells are cut into pieces. How far a body on one piece is from a body on another one is a convex
function of both places, so its tangent in the middle of both bounds it from below on all of them;
the curves are as near to their chords as their bows say. Pairs of pieces that may be too near block
each other: all of them are found, and nothing else but what is a few millimetres farther apart.
"""

from __future__ import annotations

from itertools import combinations
from typing import Final, NamedTuple

import numpy as np

from viaspline.errors import GaveUpError
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.joined_boxes import joined_boxes
from viaspline.kernels.fleet.near_boxes import ONE_GAP, RawBoxes
from viaspline.kernels.fleet.near_pieces import TOUCHING
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.space.meeting.gap_of_bodies import (
    BodyPair,
    SpatialCourses,
    gap_slopes,
    gaps_of,
)

PIECE_M: Final = 0.125
"""Longest piece of a cell [m]."""

LEAST_M: Final = 1e-9

MAX_PAIRS: Final = 20_000_000
"""Pairs of pieces of two paths that are looked at, at most."""


class _Pieces(NamedTuple):
    """The pieces of one robot's course, in order.

    Attributes:
        cell: The node where the cell of each begins, (p,).
        middle: Of its chord [m], (p, 3).
        half: From there to its end [m], (p, 3).
        reach: Half of its length, and how far the curve is from it [m], (p,).
        bow: How far the curve is from it [m], (p,).
        low: Where it begins along the path [m], (p,).
        high: Where it ends [m], (p,).
    """

    cell: Ints
    middle: Floats
    half: Floats
    reach: Floats
    bow: Floats
    low: Floats
    high: Floats


def spatial_crossings(
    courses: SpatialCourses, only: Ints | None, max_boxes: int
) -> PackedCrossings:
    """Every pair of places on two courses at which their robots would be too near each other.

    Args:
        courses: Of what moves.
        only: The robots of which one has to be in each pair, (k,); None: any.
        max_boxes: So many boxes may be found.

    Raises:
        GaveUpError: There are more, or too many pieces are near each other.
    """
    packed = courses.packed
    robots = len(courses.names)
    asked = range(robots) if only is None else set(only.tolist())
    pieces = [_pieces_of(courses, robot) for robot in range(robots)]
    rows: list[list[tuple[int, Ints, Floats, Floats]]] = [[] for _ in range(robots)]
    boxes = 0
    for one, other in combinations(range(robots), 2):
        if one not in asked and other not in asked:
            continue
        pair = BodyPair.of(courses.bodies, one, other)
        i, j = _near(pieces[one], pieces[other], pair, courses, (one, other))
        for robot, against, mine, its in ((one, other, i, j), (other, one, j, i)):
            found = _boxes(pieces[robot], pieces[against], mine, its)
            rows[robot].append((against, *found))
            boxes += len(found[0])
        if boxes > max_boxes:
            raise _too_many(courses, (one, other))
    raw = _in_order(rows)
    pairs, span, first, crossing, count = joined_boxes(packed, raw)
    return PackedCrossings(
        pairs, span, first, raw.cell[:count], crossing[:count], raw.other[:count],
        raw.low[:count], raw.high[:count],
    )  # fmt: skip


def _pieces_of(courses: SpatialCourses, robot: int) -> _Pieces:
    """The pieces of one robot's course on which it is there.

    Where it stays, as what moves does by its clock, all of a cell is one: no part of it is nearer.
    """
    packed = courses.packed
    begin, end = int(packed.first[robot]), int(packed.first[robot + 1])
    length = np.diff(packed.distance[begin:end])
    stays = (packed.place[begin + 1 : end] == packed.place[begin : end - 1]).all(axis=1)
    counts = np.where(stays, 1.0, np.maximum(np.ceil(length / PIECE_M), 1.0)).astype(np.int64)
    cell = np.repeat(np.arange(begin, end - 1), counts)
    number = np.arange(len(cell)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = np.repeat(1.0 / counts, counts)
    start, way = packed.place[cell], packed.place[cell + 1] - packed.place[cell]
    low, high = number * share, (number + 1) * share
    along, long = packed.distance[cell], packed.distance[cell + 1] - packed.distance[cell]
    half = way * (0.5 * share)[:, None]
    bow = packed.bow[cell]
    there = courses.there[cell]
    return _Pieces(
        cell=cell[there],
        middle=(start + way * (0.5 * (low + high))[:, None])[there],
        half=half[there],
        reach=(np.linalg.norm(half, axis=1) + bow)[there],
        bow=bow[there],
        low=(along + low * long)[there],
        high=(along + high * long)[there],
    )


def _near(
    one: _Pieces, other: _Pieces, pair: BodyPair, courses: SpatialCourses, who: tuple[int, int]
) -> tuple[Ints, Ints]:
    """Pairs of pieces on which two bodies may be too near each other."""
    if not len(one.cell) or not len(other.cell):
        return np.empty(0, np.int64), np.empty(0, np.int64)
    room = float(one.reach.max()) + float(other.reach.max())
    level, upright = pair.radius + pair.margin + room, pair.half_height + pair.margin + room
    scale = 1.0 / np.maximum(np.array([level, level, upright]), LEAST_M)
    mine, its = (
        _within(one.middle * scale, other.middle * scale),
        _within(other.middle * scale, one.middle * scale),
    )
    i, j = _pairs_within(one.middle[mine] * scale, other.middle[its] * scale, courses, who)
    i, j = np.flatnonzero(mine)[i], np.flatnonzero(its)[j]
    offsets = other.middle[j] - one.middle[i]
    slopes = gap_slopes(pair, offsets)
    least = gaps_of(pair, offsets) - one.bow[i] - other.bow[j]
    least -= np.abs((slopes * one.half[i]).sum(axis=1))
    least -= np.abs((slopes * other.half[j]).sum(axis=1))
    near = least < -TOUCHING
    return i[near], j[near]


def _within(places: Floats, others: Floats) -> Flags:
    """Which places are no farther than 1 from the box about others along every axis."""
    low, high = others.min(axis=0) - 1.0, others.max(axis=0) + 1.0
    return np.asarray(((places >= low) & (places <= high)).all(axis=1))


def _pairs_within(
    places: Floats, others: Floats, courses: SpatialCourses, who: tuple[int, int]
) -> tuple[Ints, Ints]:
    """Indices of places that are no farther apart than 1 along every axis."""
    from scipy.spatial import cKDTree

    none = np.empty(0, np.int64)
    if not len(places) or not len(others):
        return none, none
    tree, there = cKDTree(places), cKDTree(others)
    if tree.count_neighbors(there, 1.0, p=np.inf) > MAX_PAIRS:
        raise _too_many(courses, who)
    found = tree.sparse_distance_matrix(there, 1.0, p=np.inf, output_type="ndarray")
    keys = np.sort(found["i"] * len(others) + found["j"])
    i, j = np.divmod(keys, len(others))
    return i, j


def _boxes(mine: _Pieces, its: _Pieces, i: Ints, j: Ints) -> tuple[Ints, Floats, Floats]:
    """Cells of one robot and what of the other's path is blocked meanwhile, in order.

    Args:
        mine: Pieces of the one.
        its: Pieces of the other.
        i: Of the one, those that are too near, (k,).
        j: The other's pieces that they are too near to, (k,).

    Returns:
        (cells, from where, to where along the other's path [m]), (b,) each.
    """
    none = np.empty(0)
    if not len(i):
        return np.empty(0, np.int64), none, none
    count = len(its.cell)
    keys = np.sort(mine.cell[i] * count + j)  # np.unique hashes them, which takes far longer
    cell, piece = np.divmod(keys[np.append(True, keys[1:] != keys[:-1])], count)
    apart = its.low[piece[1:]] - its.high[piece[:-1]]
    begins = np.append(True, (np.diff(cell) > 0) | (apart > ONE_GAP))
    ends = np.append(begins[1:], True)
    return cell[begins], its.low[piece[begins]], its.high[piece[ends]]


def _in_order(rows: list[list[tuple[int, Ints, Floats, Floats]]]) -> RawBoxes:
    """The boxes of all robots, by cell, then by the other robot, then along its path."""
    parts, first = [], [0]
    for against in rows:
        table = [np.empty((0, 4))]
        for other, cell, low, high in against:
            table.append(np.column_stack((cell, np.full(len(cell), other), low, high)))
        own = np.concatenate(table)
        parts.append(own[np.lexsort((own[:, 2], own[:, 1], own[:, 0]))])
        first.append(first[-1] + len(own))
    every = np.concatenate(parts)
    return RawBoxes(
        np.array(first, np.int64),
        every[:, 0].astype(np.int32),
        every[:, 1].astype(np.int32),
        every[:, 2].copy(),
        every[:, 3].copy(),
    )


def _too_many(courses: SpatialCourses, who: tuple[int, int]) -> GaveUpError:
    names = " and ".join(f"'{courses.names[k]}'" for k in who)
    return GaveUpError(
        f"the paths of {names} come near each other in too many places",
        where=courses.packed.place[int(courses.packed.first[who[0]])].tolist(),
        remedy="send fewer robots through one place",
        tried=("crossings in space",),
    )
