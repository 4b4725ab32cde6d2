"""The proof that the robots of a fleet in space stay apart, over continuous time.

All pairs of robots are looked at, from stage to stage of either: there both go along chords with
constant acceleration. So between two instants h apart the offset p of their places bows out from
the straight line by h²/8 |p''| at most, and along that line the gap of their bodies is convex: the
tangents at both ends bound it from below. What may be least is halved.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import Final, NamedTuple

import numpy as np

from viaspline.errors import GaveUpError
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.fleet_motion import EVEN_SHARE
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.space.meeting.gap_of_bodies import (
    BodyPair,
    SpatialCourses,
    gap_slopes,
    gaps_of,
)

DEEPEST: Final = 48
"""How often an interval is halved."""
TOLERANCE_M: Final = 1e-3
"""How near the least has to be known [m],"""
HALF_SLACK_M: Final = 5e-7
"""and where it takes more than that to tell whether it is enough, half of PROOF_SLACK_M."""
MAX_INTERVALS: Final = 20_000_000


class Nearest(NamedTuple):
    """The two bodies that come nearest to each other.

    Attributes:
        bound: Proven: no two are nearer than what they keep, and this more [m].
        met: The least that was met [m].
        when: When that was [s].
        pair: Their numbers; -1 where there are no two.
        places: Where they were [m], (2, 3).
    """

    bound: float
    met: float
    when: float
    pair: tuple[int, int]
    places: Floats


@dataclass(frozen=True, eq=False)
class _FlownStages:
    """What one robot does: one row for each stay and each way from a node to the next.

    Attributes:
        ends: When each ends [s], not decreasing, (m,); the last one is infinite, or when it leaves.
        begins: When each begins [s], (m,).
        place: Where it begins [m], (m, 3).
        way: To where it ends [m], (m, 3).
        speed: As a share of the way, when it begins [1/s], (m,); see ``DriveStage``.
        rise: By how much that grows [1/s²], (m,).
        error: How far the robot is from there, at most [m], (m,).
        there: Whether it is there at all, (m,).
    """

    ends: Floats
    begins: Floats
    place: Floats
    way: Floats
    speed: Floats
    rise: Floats
    error: Floats
    there: Flags

    def at(self, stages: Ints, times: Floats) -> Floats:
        """Where on the chords of stages it is at times [s], (k,): [m], (k, 3)."""
        late = np.maximum(times - self.begins[stages], 0.0)
        late = np.where(np.isfinite(late), late, 0.0)
        share = (self.speed[stages] + 0.5 * self.rise[stages] * late) * late
        share = np.where(times >= self.ends[stages], 1.0, share)
        return np.asarray(self.place[stages] + share[:, None] * self.way[stages])

    def bends(self, stages: Ints) -> Floats:
        """Accelerations [m/s²], (k, 3)."""
        return np.asarray(self.rise[stages][:, None] * self.way[stages])


def nearest_in_space(courses: SpatialCourses, laws: PackedLaws, only: int | None = None) -> Nearest:
    """The two bodies that come nearest to each other, proven.

    Args:
        courses: Of what moves; their bodies hold half of the separation each.
        laws: When each is where. Those that have none play no part.
        only: One that has to be in each pair; None: any.

    Raises:
        GaveUpError: It takes too many halvings.
    """
    timed = np.flatnonzero(laws.is_timed).tolist()
    stages = {robot: _stages_of(courses, laws, robot) for robot in timed}
    best = Nearest(np.inf, np.inf, 0.0, (-1, -1), np.zeros((2, 3)))
    lower = np.inf
    for one, other in combinations(timed, 2):
        if only is not None and only not in (one, other):
            continue
        pair = BodyPair.of(courses.bodies, one, other)
        found = _nearest_of_two(stages[one], stages[other], pair, best.met, (one, other))
        lower = min(lower, found.bound)
        if found.met < best.met:
            best = found
    return best._replace(bound=min(lower, best.met))


def _stages_of(courses: SpatialCourses, laws: PackedLaws, robot: int) -> _FlownStages:
    """The stays and ways of a robot; before it departs it stands at its start."""
    packed = courses.packed
    nodes = slice(int(packed.first[robot]), int(packed.first[robot + 1]))
    arrive, leave = laws.arrive[nodes], laws.leave[nodes]
    speed, place = laws.speed[nodes], packed.place[nodes]
    length = np.diff(packed.distance[nodes])
    with np.errstate(invalid="ignore"):  # who never departs takes no time to be known
        lasts = arrive[1:] - leave[:-1]
    goes = (lasts > 0.0) & (length > 0.0) & np.isfinite(lasts)
    within = np.where(goes, lasts, 1.0)
    long = np.where(goes, length, 1.0)
    farther = length - 0.5 * (speed[1:] + speed[:-1]) * within
    rise = np.where(goes, np.diff(speed) / within / long, 0.0)
    start = np.where(goes, (speed[:-1] + farther / within) / long, 0.0)
    error = packed.bow[nodes][:-1] + np.where(goes, EVEN_SHARE * np.abs(farther), 0.0)
    count = len(place)

    def woven(stays: Floats, ways: Floats) -> Floats:
        rows: Floats = np.zeros((2 * count - 1, *stays.shape[1:]))
        rows[::2], rows[1::2] = stays, ways
        return rows

    still = np.zeros(count)
    ways = courses.there[nodes]
    there = np.ones(2 * count - 1, np.bool_)
    there[1::2] = ways[:-1]
    there[2:-1:2] = ways[:-2] | ways[1:-1]  # at a node it is there if it is before it or after it
    there[0], there[-1] = ways[0], ways[-2]
    ends = np.maximum.accumulate(woven(leave, arrive[1:]))
    begins = np.append(-np.inf, ends[:-1])
    return _FlownStages(
        ends, begins, woven(place, place[:-1]), woven(0.0 * place, np.diff(place, axis=0)),
        woven(still, start), woven(still, rise), woven(still, error), there,
    )  # fmt: skip


def _nearest_of_two(
    one: _FlownStages, other: _FlownStages, pair: BodyPair, known: float, who: tuple[int, int]
) -> Nearest:
    """The least gap of two robots; what is surely more than is known isn't looked at closely."""
    begin, end = _span(one, other)
    cuts = np.unique(np.concatenate((one.ends, other.ends)))
    cuts = cuts[(cuts > begin) & (cuts < end)]
    t0, t1 = np.append(begin, cuts), np.append(cuts, end)
    i = np.minimum(np.searchsorted(one.ends, t0, side="right"), len(one.ends) - 1)
    j = np.minimum(np.searchsorted(other.ends, t0, side="right"), len(other.ends) - 1)
    there = one.there[i] & other.there[j]
    i, j, t0, t1 = i[there], j[there], t0[there], t1[there]
    if not len(i):
        return Nearest(np.inf, np.inf, begin, (-1, -1), np.zeros((2, 3)))
    off = one.error[i] + other.error[j]
    bend = 0.125 * np.linalg.norm(one.bends(i) - other.bends(j), axis=1)
    p0, p1 = (other.at(j, t) - one.at(i, t) for t in (t0, t1))
    lower, least, when, where = np.inf, np.inf, begin, np.zeros((2, 3))
    looked = 0
    for depth in range(DEEPEST + 1):
        gaps = np.column_stack((gaps_of(pair, p0), gaps_of(pair, p1)))
        k, side = np.unravel_index(int(gaps.argmin()), gaps.shape)
        if gaps[k, side] - off[k] < least:
            time = (t0 if side == 0 else t1)[[k]]
            least, when = float(gaps[k, side] - off[k]), float(time[0])
            where = np.concatenate((one.at(i[[k]], time), other.at(j[[k]], time)))
        bound = _bound(pair, p0, p1, gaps) - bend * (t1 - t0) ** 2 - off
        top = min(least, known)
        middle = 0.5 * (t0 + t1)
        near = (bound >= top - TOLERANCE_M) & ((bound >= -HALF_SLACK_M) | (top < -2 * HALF_SLACK_M))
        done = (bound >= top) | near | (middle <= t0) | (middle >= t1) | (depth == DEEPEST)
        lower = min(lower, float(bound[done].min(initial=np.inf)))
        left = np.flatnonzero(~done)
        looked += len(left)
        if not len(left):
            break
        if looked > MAX_INTERVALS:
            raise GaveUpError(
                "the robots are near each other for too long to prove how far apart they are",
                where=where[0].tolist(), remedy="ask for less separation",
                tried=("the proof of the separation",),
            )  # fmt: skip
        i, j, off, bend = (np.repeat(each[left], 2) for each in (i, j, off, bend))
        t0, t1, middle = t0[left], t1[left], middle[left]
        mid = other.at(j[::2], middle) - one.at(i[::2], middle)
        p0, p1 = _between(p0[left], mid), _between(mid, p1[left])
        t0, t1 = _between(t0, middle), _between(middle, t1)
    return Nearest(lower, least, when, who, where)


def _between(first: Floats, second: Floats) -> Floats:
    """Rows of one and of another table in turn."""
    woven: Floats = np.stack((first, second), axis=1)
    rows: Floats = woven.reshape(-1, *first.shape[1:])
    return rows


def _span(one: _FlownStages, other: _FlownStages) -> tuple[float, float]:
    """From when to when the offset of two robots may change, or both are there at all [s]."""
    finite = np.concatenate((one.ends, other.ends))
    finite = finite[np.isfinite(finite)]
    gone = min(float(one.ends[-1]), float(other.ends[-1]))
    begin = float(finite.min(initial=0.0))
    end = float(finite.max(initial=begin))
    return min(begin, gone), min(end, gone) if np.isfinite(gone) else end


def _bound(pair: BodyPair, p0: Floats, p1: Floats, gaps: Floats) -> Floats:
    """What the gap isn't less than along straight lines from offsets to offsets.

    The tangents at both ends bound it from below; so does the larger of both where they cross.
    """
    way = p1 - p0
    rise0 = (gap_slopes(pair, p0) * way).sum(axis=1)
    rise1 = (gap_slopes(pair, p1) * way).sum(axis=1)
    # along t from 0 to 1: gaps0 + rise0 t, and gaps1 - rise1 (1 - t)
    apart = rise1 - rise0
    crossing = np.divide(
        gaps[:, 0] - gaps[:, 1] + rise1, apart, out=np.zeros(len(way)), where=apart > 0.0
    )
    crossing = np.clip(crossing, 0.0, 1.0)
    tangents = np.maximum(gaps[:, 0] + rise0 * crossing, gaps[:, 1] - rise1 * (1.0 - crossing))
    falls = (rise0 < 0.0) & (rise1 > 0.0)
    ends = gaps.min(axis=1)
    return np.asarray(np.where(falls, np.minimum(tangents, ends), ends))
