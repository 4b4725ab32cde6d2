"""The time law of a path in space that lets what moves pass, or passes before it.

The robot flies as it would alone, and slower or hovering where that would bring it too near: with a
running start, so that no more is lost than has to be (`kernels.fleet.yielding_ride`). Where limits
couple speed and acceleration it waits where it stands anyway.

Tested through ``space/among/test_plan_past_moving``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.passing_order import passing_gaps
from viaspline.kernels.fleet.yielding_ride import CLEAR, timed_in_order
from viaspline.space.among.courses_among import ROBOT, courses_among, laws_among
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.meeting.gap_of_bodies import SpatialCourses
from viaspline.space.meeting.spatial_crossings import spatial_crossings
from viaspline.space.meeting.spatial_separation import nearest_in_space
from viaspline.space.timing.retime_in_space import along_limits
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.trajectory.coupled import is_coupled
from viaspline.trajectory.law_at_nodes import law_through_nodes
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.waits import TrafficWait

MAX_BOXES: Final = 20_000_000
SAME_S: Final = 1e-12
"""Waits that are no longer are rounding [s]."""
WORTH_S: Final = 0.05
"""Less than that isn't told [s]."""


@dataclass(frozen=True, eq=False)
class LawPast:
    """A law past what moves.

    Attributes:
        trajectory: It.
        waits: Where it loses time, and for what.
    """

    trajectory: Trajectory
    waits: tuple[TrafficWait, ...]


def law_past_moving(
    path: Path, static: Trajectory, hold: float, limits: SpatialLimits,
    body: tuple[float, float, float], moving: Sequence[MovingSolid],
) -> LawPast | str:  # fmt: skip
    """The law of a path past what moves.

    Args:
        path: In space.
        static: The fastest law along it if nothing moved.
        hold: How long the goal stays free after that [s].
        limits: Of the drive.
        body: Radius and half height of the robot's cylinder, and what is kept about it [m].
        moving: What moves, from the law's beginning on.

    Returns:
        The law; or the name of what it can't let pass.

    Raises:
        GaveUpError: The path and the ways of what moves come near each other in too many places.
    """
    courses = courses_among(path, static, body, moving)
    crossings = spatial_crossings(courses, np.array([ROBOT], np.int64), MAX_BOXES)
    laws = laws_among(courses, static, hold, moving, is_timed=False)
    rides = _rides(courses, laws, limits, path.dimension)
    passages = passages_of(courses.packed, crossings)
    (box,) = timed_in_order(
        courses.packed, crossings, passages, rides, laws, np.array([ROBOT], np.int64)
    ).tolist()
    if box != CLEAR:
        return courses.names[int(crossings.other[box])]
    law = _taken(static, courses, laws, rides)
    return LawPast(law, tuple(_waits(static, courses, crossings, laws)))


def _rides(
    courses: SpatialCourses, laws: PackedLaws, limits: SpatialLimits, dimension: int
) -> PackedRides:
    """How the robot flies alone, and that what moves keeps to the clock."""
    first, count = courses.packed.first, len(courses.names)
    ends = first[1:] - 1
    stays = laws.leave - laws.arrive
    stays[ends[ROBOT + 1 :]] = 0.0
    lasts = np.append(laws.arrive[1:] - laws.leave[:-1], 0.0)
    lasts[ends] = 0.0
    along = along_limits(limits)
    keeps = np.ones(count, np.bool_)
    keeps[ROBOT] = along.max_jerk is not None or is_coupled(along, dimension)
    return PackedRides(
        square=laws.speed**2,
        lasts=lasts,
        stays=stays,
        accel=np.full(count, along.max_accel),
        brake=np.full(count, along.brake),
        depart=laws.arrive[first[:-1]],
        keeps_pace=keeps,
        vanishes=np.ones(count, np.bool_),
    )


def _taken(
    static: Trajectory, courses: SpatialCourses, laws: PackedLaws, rides: PackedRides
) -> Trajectory:
    """The law that was found; to the bit the fastest one with waits where only these are new."""
    nodes = slice(0, int(courses.packed.first[1]))
    arrive, leave, speed = laws.arrive[nodes], laws.leave[nodes], laws.speed[nodes]
    along = courses.packed.distance[nodes]
    waits = leave[:-1] - arrive[:-1] - rides.stays[nodes][:-1]
    if (speed == np.sqrt(rides.square[nodes])).all():
        law = static
        for k in np.flatnonzero(waits > SAME_S):
            law = law.waiting(float(along[k]), float(waits[k]))
        return law
    law = law_through_nodes(along, speed, arrive, leave, static)
    stays = float(static.times[-1] - static.times[static.distances == static.distances[-1]][0])
    return law.waiting(float(along[-1]), stays) if stays > SAME_S else law


def _waits(
    static: Trajectory, courses: SpatialCourses, crossings: PackedCrossings, laws: PackedLaws
) -> Iterator[TrafficWait]:
    """Where time is lost, from where it begins until the place that had to become free."""
    count = int(courses.packed.first[1])
    along = courses.packed.distance[:count]
    late = laws.arrive[:count] - np.asarray(static.time_at(along))
    gaps = passing_gaps(courses.packed, crossings, laws)
    before = 0.0
    boxes = np.arange(int(crossings.box_first[0]), int(crossings.box_first[1]))
    for box in boxes[(gaps[boxes] >= 0.0) & (gaps[boxes] < WORTH_S)].tolist():
        k = int(crossings.cell[box])
        now = float(late[k])
        if now <= before + WORTH_S:
            continue
        begins = int(np.flatnonzero(late[: k + 1] <= before + 1e-9)[-1])
        stood = float(np.maximum(laws.leave[begins:k] - laws.arrive[begins:k], 0.0).sum())
        name = courses.names[int(crossings.other[box])]
        yield TrafficWait(
            float(along[begins]), float(along[k]), float(laws.arrive[begins]), now - before,
            min(stood, now - before), name,
        )  # fmt: skip
        before = now


def proven_past_moving(
    path: Path, law: Trajectory, hold: float, body: tuple[float, float, float], clearance: float,
    moving: Sequence[MovingSolid],
) -> MovingCertificate:  # fmt: skip
    """Prove how far a robot stays from what moves, over continuous time.

    Args:
        path: In space.
        law: The time law along it.
        hold: How long the robot stays at its goal after that [s].
        body: Radius and half height of its cylinder, and the margin about it without any clearance
            [m].
        clearance: That is asked for [m].
        moving: What moves, until the end of that at least.
    """
    kept = (body[0], body[1], body[2] + clearance)
    courses = courses_among(path, law, kept, moving)
    laws = laws_among(courses, law, hold, moving, is_timed=True)
    found = nearest_in_space(courses, laws, only=ROBOT)
    if found.pair[0] < 0:
        start = tuple(path.evaluate(0.0).tolist())
        return MovingCertificate(math.inf, clearance, law.start_time, start, 0.0, None)
    place: Floats = found.places[0]
    return MovingCertificate(
        clearance=found.bound + clearance,
        required=clearance,
        tightest_at_s=found.when,
        tightest_at=tuple(place.tolist()),
        tightest_distance=float(law.distance_at(found.when)),
        obstacle=courses.names[found.pair[1]],
    )
