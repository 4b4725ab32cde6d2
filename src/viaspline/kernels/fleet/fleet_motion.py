"""Where a robot of a fleet is when, on the chords of its course.

Its drive is a row of *stages*: stage 2k is its stay at node k, and stage 2k + 1 its way to the next
one.

Tested through ``fleet/test_fleet_certificate``.
"""

from __future__ import annotations

from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.jit import inlined


@inlined
def stage_end(laws: PackedLaws, stage: int) -> float:
    """When a stage ends [s]."""
    node = stage >> 1
    return laws.arrive[node + 1] if stage & 1 else laws.leave[node]


@inlined
def stage_place(
    courses: PackedCourses, laws: PackedLaws, stage: int, instant: float
) -> tuple[float, float]:
    """The point on the chord at an instant of a stage [m]."""
    k = stage >> 1
    x, y = courses.place[k, 0], courses.place[k, 1]
    if stage & 1 == 0:
        return x, y
    lasts, late = laws.arrive[k + 1] - laws.leave[k], instant - laws.leave[k]
    length = courses.distance[k + 1] - courses.distance[k]
    part = 1.0
    if late < lasts and length > 0.0:
        rise = (laws.speed[k + 1] - laws.speed[k]) / lasts
        part = min(max((laws.speed[k] + 0.5 * rise * late) * late / length, 0.0), 1.0)
    return x + part * (courses.place[k + 1, 0] - x), y + part * (courses.place[k + 1, 1] - y)


@inlined
def stage_acceleration(courses: PackedCourses, laws: PackedLaws, stage: int) -> tuple[float, float]:
    """The acceleration along the chord in a stage [m/s²]."""
    k = stage >> 1
    if stage & 1 == 0:
        return 0.0, 0.0
    lasts = laws.arrive[k + 1] - laws.leave[k]
    length = courses.distance[k + 1] - courses.distance[k]
    if not (lasts > 0.0 and length > 0.0):
        return 0.0, 0.0
    share = (laws.speed[k + 1] - laws.speed[k]) / (lasts * length)
    return (
        share * (courses.place[k + 1, 0] - courses.place[k, 0]),
        share * (courses.place[k + 1, 1] - courses.place[k, 1]),
    )


@inlined
def stage_error(courses: PackedCourses, laws: PackedLaws, stage: int) -> float:
    """How far the robot is from the point on the chord in a stage, at most [m].

    That is the bow of the curve, and how much farther the law goes than with constant acceleration.
    Where acceleration changes, speed is convex or concave in time, and what that adds only grows.
    """
    k = stage >> 1
    if stage & 1 == 0:
        return 0.0
    length = courses.distance[k + 1] - courses.distance[k]
    lasts = laws.arrive[k + 1] - laws.leave[k]
    return courses.bow[k] + abs(length - 0.5 * (laws.speed[k] + laws.speed[k + 1]) * lasts)
