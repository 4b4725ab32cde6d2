"""What was driven as laws on courses: exact, and proven by what proves plans."""

from __future__ import annotations

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.fleet_ticks import FleetTicks
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws

SAME_M = 1e-7
"""Rests that are nearer to each other are one; nodes of a course so near to a row are left out."""


def stretches_of(ticks: FleetTicks, departs: Floats) -> list[Floats]:
    """For each robot when, where and how fast it was where its acceleration changed, (m, 3).

    Args:
        ticks: What was driven.
        departs: When each robot may set out [s], (n,).
    """
    rows = ticks.stretches[np.argsort(ticks.stretches[:, 0], kind="stable")]
    cuts = np.searchsorted(rows[:, 0], np.arange(len(departs) + 1))
    found = []
    for robot, depart in enumerate(departs.tolist()):
        own = rows[cuts[robot] : cuts[robot + 1], 1:4]
        last = min(float(ticks.arrived[robot]), ticks.end)
        end = [[last, float(ticks.place[robot]), 0.0]]
        found.append(np.concatenate(([[depart, 0.0, 0.0]], own, end)))
    return found


def driven_laws(
    courses: FleetCourses, stretches: list[Floats], ends: Floats, leaves: Floats
) -> tuple[FleetCourses, FleetLaws]:
    """The courses as far as they were driven, with a node wherever an acceleration changed.

    Args:
        courses: That were driven.
        stretches: For each robot time [s], place [m] and square of the speed [m²/s²] where its
            stretches of even acceleration begin, the last row where it was at last, (m, 3).
        ends: How far each robot came [m], (n,).
        leaves: When each robot left the world [s]; infinite: it didn't, (n,).
    """
    packed = courses.packed
    first, parts = [0], []
    for robot, rows in enumerate(stretches):
        nodes = slice(int(packed.first[robot]), int(packed.first[robot + 1]))
        law = _standing_beside(_law(rows, packed.distance[nodes], ends[robot]), packed, nodes)
        law[-1, 2] = leaves[robot]
        parts.append(np.column_stack((law, _on_chords(packed, nodes, law[:, 0]))))
        first.append(first[-1] + len(law))
    table = np.concatenate(parts)
    refined = PackedCourses(
        first=np.array(first, np.int64),
        distance=table[:, 0].copy(),
        place=table[:, 4:-1].copy(),
        bow=table[:, -1].copy(),
        reach=packed.reach,
    )
    laws = PackedLaws(
        arrive=table[:, 1].copy(),
        leave=table[:, 2].copy(),
        speed=table[:, 3].copy(),
        is_timed=np.ones(len(stretches), np.bool_),
    )
    return FleetCourses(courses.names, refined, courses.bodies), FleetLaws(laws)


def _law(rows: Floats, nodes: Floats, end: float) -> Floats:
    """Place, arrival, departure and speed at all nodes and wherever the acceleration changes.

    Rows at one place are joined, and rests. Others that are nanometres apart are not: who goes on
    has another speed there already, with which all of the way to the next row would be off.
    """
    along = np.maximum.accumulate(rows[:, 1])  # rounding goes back
    rests = rows[:, 2] == 0.0
    same = np.where(rests[1:] & rests[:-1], SAME_M, 0.0)
    begins = np.flatnonzero(np.append(True, np.diff(along) > same))
    lasts = np.append(begins[1:], len(rows)) - 1
    slowest = _slowest(rows[:, 2], begins)
    arrive, square = rows[slowest, 0], rows[slowest, 2]
    leave, places = rows[lasts, 0], along[lasts]
    between = nodes[(nodes < end) & (nodes > places[0])]
    near = np.searchsorted(places, between - SAME_M)
    between = between[places[np.minimum(near, len(places) - 1)] > between + SAME_M]
    i = np.searchsorted(places, between) - 1
    gone, width = between - places[i], places[i + 1] - places[i]
    square_there = square[i] + (square[i + 1] - square[i]) * gone / width
    both = np.sqrt(square[i]) + np.sqrt(square_there)
    time = leave[i] + np.divide(2.0 * gone, both, out=np.zeros_like(gone), where=both > 0.0)
    law = np.column_stack(
        (
            np.concatenate((places, between)),
            np.concatenate((arrive, time)),
            np.concatenate((leave, time)),
            np.sqrt(np.concatenate((square, square_there))),
        )
    )
    law = law[np.argsort(law[:, 0], kind="stable")]
    if len(law) > 1:
        return law
    return np.repeat(law, 2, axis=0)  # a robot that never set out has two nodes at its start


def _standing_beside(law: Floats, packed: PackedCourses, nodes: slice) -> Floats:
    """A law in which stays between nodes of the course are cells of no length.

    Who stands at a node is at its place. Between nodes the course is known by its chords alone, and
    a cell is what says how far the robot may be from there.
    """
    stays = (law[:, 2] > law[:, 1]) & ~np.isin(law[:, 0], packed.distance[nodes])
    if not stays.any():
        return law
    rows = np.arange(len(law))
    begins = np.repeat(rows, 1 + stays)
    found = law[begins]
    second = np.append(False, begins[1:] == begins[:-1])
    first = np.append(second[1:], False)
    found[first, 2], found[second, 1] = found[first, 1], found[second, 2]
    return found


def _slowest(square: Floats, begins: Ints) -> Ints:
    """The first of the slowest rows of each group: who comes to rest is there when it does."""
    ends = np.append(begins[1:], len(square))
    slowest = begins.copy()
    for k in np.flatnonzero(ends - begins > 1).tolist():
        slowest[k] += int(square[begins[k] : ends[k]].argmin())
    return slowest


def _on_chords(packed: PackedCourses, nodes: slice, along: Floats) -> Floats:
    """Places on the chords of a course, and how far the curve is from them at most, (m, d + 1)."""
    distance, place, bow = packed.distance[nodes], packed.place[nodes], packed.bow[nodes]
    cell = np.clip(np.searchsorted(distance, along, side="right") - 1, 0, len(distance) - 2)
    columns = [np.interp(along, distance, place[:, k]) for k in range(place.shape[1])]
    bows = bow[cell]
    bows[-1] = 0.0
    return np.column_stack((*columns, bows))
