"""A robot's path and what moves beside it as courses: how far along is a length, and a time.

What moves goes along its course by the clock: its distances are times, its speed is 1. So what of
its course is too near a cell of the robot's says when the robot must not be there.

Tested through ``space/among/test_plan_past_moving``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet import cut_courses as columns
from viaspline.kernels.fleet.cut_courses import cut_courses
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_paths import PackedPaths
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.meeting.gap_of_bodies import SpatialCourses
from viaspline.trajectory.law_at_nodes import law_at_nodes
from viaspline.trajectory.trajectory import Trajectory

ROBOT: Final = 0
"""The number of the robot's course; what moves comes after it."""


def courses_among(
    path: Path, law: Trajectory, body: tuple[float, float, float], moving: Sequence[MovingSolid]
) -> SpatialCourses:
    """The courses of a robot and of what moves.

    Args:
        path: The robot's.
        law: Along it; it changes at nodes alone.
        body: Of the robot, with the clearance in its margin [m].
        moving: What moves.
    """
    nodes, bow = _cut(path, law.distances)
    sizes = [len(nodes), *(len(one.times) for one in moving)]
    places = np.asarray(path.at_distance(np.minimum(nodes, path.length)))
    packed = PackedCourses(
        first=np.cumsum([0, *sizes], dtype=np.int64),
        distance=np.concatenate([nodes, *(one.times - one.times[0] for one in moving)]),
        place=np.concatenate([places, *(one.places for one in moving)]),
        bow=np.concatenate([bow, *(one.off for one in moving)]),
        reach=np.array([body[0] + body[2], *(one.body[0] + one.body[2] for one in moving)]),
    )
    there = [np.ones(len(nodes), np.bool_), *(one.there for one in moving)]
    bodies = np.array([body, *(one.body for one in moving)])
    names = ("the robot", *(one.name for one in moving))
    return SpatialCourses(names, packed, bodies, np.concatenate(there))


def laws_among(
    courses: SpatialCourses, law: Trajectory, hold: float, moving: Sequence[MovingSolid], *,
    is_timed: bool,
) -> PackedLaws:  # fmt: skip
    """When the robot and what moves are where on their courses.

    Args:
        courses: Of them.
        law: The robot's.
        hold: How long it stays where it arrives [s], after its dwell there.
        moving: What moves.
        is_timed: Whether the robot has this law already, or is to get one.
    """
    packed = courses.packed
    count = int(packed.first[1])
    arrive, leave, speed = law_at_nodes(law, packed.distance[:count])
    leave[-1] = law.times[-1] + hold
    clocks = np.concatenate([np.empty(0), *(one.times for one in moving)])
    timed = np.ones(len(courses.names), np.bool_)
    timed[ROBOT] = is_timed
    return PackedLaws(
        np.concatenate((arrive, clocks)), np.concatenate((leave, clocks)),
        np.concatenate((speed, np.ones(len(clocks)))), timed,
    )  # fmt: skip


def _cut(path: Path, knots: Floats) -> tuple[Floats, Floats]:
    """The nodes of a path from its first knot on [m], and how far the curve is from its chords."""
    rows, at, along = path.packed_length
    table, _ = cut_courses(
        PackedPaths(
            rows, np.array([0, len(rows)], np.int64), at, along,
            np.array([0, len(at)], np.int64), knots, np.array([0, len(knots)], np.int64),
        )
    )  # fmt: skip
    distances = table[:, columns.DISTANCE]
    first = int(distances.searchsorted(knots[0] - columns.SAME_PLACE))
    return distances[first:].copy(), table[first:, columns.BOW].copy()
