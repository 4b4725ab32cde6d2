"""Fleets on straight lines, with crossings found by sampling: small, slow and simple."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides

CELL_M = 0.5
SAMPLES = 6
"""Places that are looked at in each cell."""
MARGIN_M = 2.0 * CELL_M / (SAMPLES - 1)
"""What may lie between two samples on both courses together."""

REACH = 1.0
"""Of every robot [m]."""

Line = tuple[tuple[float, float], tuple[float, float]]


def courses_on(lines: Sequence[Line], reach: float) -> PackedCourses:
    """Straight courses from one place to another."""
    first, distance, place, bow = [0], [], [], []
    for a, b in lines:
        begin, end = np.array(a), np.array(b)
        length = float(np.hypot(*(end - begin)))
        along = np.linspace(0.0, length, max(int(np.ceil(length / CELL_M)), 1) + 1)
        distance.append(along)
        share = (along / length if length > 0 else 0 * along)[:, None]
        place.append(begin + share * (end - begin))
        bow.append(np.zeros(along.size))
        first.append(first[-1] + along.size)
    return PackedCourses(
        np.array(first), np.concatenate(distance), np.concatenate(place), np.concatenate(bow),
        np.full(len(lines), reach),
    )  # fmt: skip


def _close(courses: PackedCourses, i: int, j: int) -> Floats:
    """Which cells of two courses come too near each other, (cells of i, cells of j)."""
    places = []
    for r in (i, j):
        nodes = courses.place[courses.first[r] : courses.first[r + 1]]
        share = np.linspace(0.0, 1.0, SAMPLES)[None, :, None]
        places.append(nodes[:-1, None] + share * (nodes[1:] - nodes[:-1])[:, None])
    a, b = places
    gap = np.hypot(*np.moveaxis(a[:, :, None, None] - b[None, None], -1, 0)).min(axis=(1, 3))
    near: Floats = gap < courses.reach[i] + courses.reach[j] + MARGIN_M
    return near


def crossings_on(courses: PackedCourses) -> PackedCrossings:
    """Where they come near each other; every pair of robots has one crossing at most."""
    count = courses.first.size - 1
    robots: list[tuple[int, int]] = []
    spans: list[list[float]] = []
    boxes: list[tuple[float, ...]] = []
    for i in range(count):
        for j in range(i + 1, count):
            near = _close(courses, i, j)
            if not near.any():
                continue
            crossing = len(robots)
            robots.append((i, j))
            ends = []
            for one, other, close in ((i, j, near), (j, i, near.T)):
                along = courses.distance[courses.first[other] : courses.first[other + 1]]
                cells = np.flatnonzero(close.any(axis=1))
                own = courses.distance[courses.first[one] : courses.first[one + 1]]
                ends += [own[cells[0]], own[cells[-1] + 1]]
                for k in cells:
                    met = np.flatnonzero(close[k])
                    box = (one, courses.first[one] + k, other, along[met[0]], along[met[-1] + 1])
                    boxes.append((*box, crossing))
            spans.append(ends)
    boxes.sort()
    owner = np.array([box[0] for box in boxes], np.int64)
    return PackedCrossings(
        np.array(robots, np.int64).reshape(-1, 2),
        np.array(spans, float).reshape(-1, 4),
        np.searchsorted(owner, np.arange(count + 1)).astype(np.int64),
        np.array([box[1] for box in boxes], np.int32),
        np.array([box[5] for box in boxes], np.int32),
        np.array([box[2] for box in boxes], np.int32),
        np.array([box[3] for box in boxes], float),
        np.array([box[4] for box in boxes], float),
    )


def rides_on(
    courses: PackedCourses,
    top: float = 2.0,
    accel: float = 1.0,
    depart: float | Sequence[float] = 0.0,
) -> PackedRides:
    """From rest to rest as fast as it goes."""
    count = courses.first.size - 1
    square, lasts = np.zeros(courses.distance.size), np.zeros(courses.distance.size)
    for r in range(count):
        nodes = slice(courses.first[r], courses.first[r + 1])
        along = courses.distance[nodes]
        v2 = np.minimum(top**2, 2.0 * accel * np.minimum(along, along[-1] - along))
        square[nodes] = v2
        both = np.sqrt(v2[1:]) + np.sqrt(v2[:-1])
        widths = np.diff(along)
        lasts[nodes][:-1] = np.where(
            both > 0, 2 * widths / np.maximum(both, 1e-9), 2 * np.sqrt(widths / accel)
        )
    no = np.zeros(count, bool)
    return PackedRides(
        square, lasts, np.zeros(square.size), np.full(count, accel), np.full(count, accel),
        np.broadcast_to(depart, count).astype(float), no, no,
    )  # fmt: skip


def no_laws(courses: PackedCourses) -> PackedLaws:
    """Laws that are yet to be written."""
    nodes = courses.distance.size
    return PackedLaws(
        np.zeros(nodes), np.zeros(nodes), np.zeros(nodes),
        np.zeros(courses.first.size - 1, np.bool_),
    )  # fmt: skip


def places_at(courses: PackedCourses, laws: PackedLaws, robot: int, times: Floats) -> Floats:
    """Where a robot is at some times, by its law alone, (n, 2)."""
    nodes = slice(courses.first[robot], courses.first[robot + 1])
    arrive, leave, speed = laws.arrive[nodes], laws.leave[nodes], laws.speed[nodes]
    along = courses.distance[nodes]
    k = np.clip(np.searchsorted(arrive, times, side="right") - 1, 0, along.size - 2)
    late = np.maximum(times - leave[k], 0.0)
    lasts = arrive[k + 1] - leave[k]
    rise = (speed[k + 1] - speed[k]) / np.maximum(lasts, 1e-12)
    gone = np.minimum(speed[k] * late + 0.5 * rise * late**2, along[k + 1] - along[k])
    gone = np.where(late >= lasts, along[k + 1] - along[k], gone)
    s = along[k] + gone
    return np.column_stack([np.interp(s, along, courses.place[nodes, i]) for i in range(2)])


def nearest_two(courses: PackedCourses, laws: PackedLaws) -> float:
    """The least distance between any two robots that have a law, every 10 ms [m]."""
    timed = np.flatnonzero(laws.is_timed).tolist()
    if len(timed) < 2:
        return np.inf
    last = laws.arrive[courses.first[1:] - 1][timed].max()
    times = np.arange(-1.0, last + 1.0, 0.01)
    places = [places_at(courses, laws, r, times) for r in timed]
    return min(
        float(np.hypot(*(places[i] - places[j]).T).min())
        for i in range(len(places))
        for j in range(i)
    )


def from_line(place: Floats, line: Line) -> float:
    a, b = np.array(line[0]), np.array(line[1])
    along = np.clip(np.dot(place - a, b - a) / np.dot(b - a, b - a), 0.0, 1.0)
    return float(np.hypot(*(place - a - along * (b - a))))


def lines_without_rests_in_the_way(seed: int, count: int, side: float = 40.0) -> list[Line]:
    """Lines of which none passes where another begins or ends."""
    random = np.random.default_rng(seed)
    lines: list[Line] = []
    for _ in range(60 * count):
        a, b = random.uniform(0.0, side, (2, 2))
        line: Line = (tuple(a), tuple(b))
        far = 2.0 * REACH + 2.0
        if np.hypot(*(b - a)) > 5.0 and all(
            min(from_line(np.array(p), other) for p in line) > far
            and min(from_line(np.array(p), line) for p in other) > far
            for other in lines
        ):
            lines.append(line)
        if len(lines) == count:
            break
    return lines
