"""Where a robot of a fleet is when, on the chords of its course.

Its drive is a row of *stages*: stage 2k is its stay at node k, and stage 2k + 1 its way to the next
one.

Tested through ``fleet/test_fleet_certificate``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.jit import inlined

EVEN_SHARE: Final = 0.25
"""Of what a law goes farther than with constant acceleration: by more it is nowhere off that, if
it has an even share of it at every instant."""


class DriveStage(NamedTuple):
    """What is known of a stage.

    Attributes:
        x: Where it begins [m].
        y: [m].
        across: How far its chord goes in x [m].
        up: And in y [m].
        begin: When it is left for the next node [s].
        end: When it ends [s].
        speed: At its beginning, in chords [1/s], and so much more or less that it comes to its end
            with constant acceleration.
        rise: Half of its acceleration, in chords [1/s²].
        error: How far the robot is from the point on the chord, at most [m]. That is the bow of the
            curve, and a quarter of how much farther the law goes than with constant acceleration.
            Where acceleration changes, speed is convex or concave in time: what is between it and
            the straight line is a mean of triangles, of each of which no part is farther from an
            even share than that.
    """

    x: float
    y: float
    across: float
    up: float
    begin: float
    end: float
    speed: float
    rise: float
    error: float


@inlined
def stage_end(laws: PackedLaws, stage: int) -> float:
    """When a stage ends [s]."""
    node = stage >> 1
    return laws.arrive[node + 1] if stage & 1 else laws.leave[node]


@inlined
def stage_of(courses: PackedCourses, laws: PackedLaws, stage: int) -> DriveStage:
    """What is known of a stage."""
    k = stage >> 1
    x, y = courses.place[k, 0], courses.place[k, 1]
    if stage & 1 == 0:
        return DriveStage(x, y, 0.0, 0.0, laws.leave[k], laws.leave[k], 0.0, 0.0, 0.0)
    begin, end = laws.leave[k], laws.arrive[k + 1]
    lasts, length = end - begin, courses.distance[k + 1] - courses.distance[k]
    farther = length - 0.5 * (laws.speed[k] + laws.speed[k + 1]) * lasts
    speed, rise, error = 0.0, 0.0, abs(farther)
    if lasts > 0.0 and length > 0.0:
        speed = (laws.speed[k] + farther / lasts) / length
        rise = 0.5 * (laws.speed[k + 1] - laws.speed[k]) / (lasts * length)
        error *= EVEN_SHARE
    error += courses.bow[k]
    across, up = courses.place[k + 1, 0] - x, courses.place[k + 1, 1] - y
    return DriveStage(x, y, across, up, begin, end, speed, rise, error)


@inlined
def place_in(stage: DriveStage, instant: float) -> tuple[float, float]:
    """The point on the chord at an instant of a stage [m]."""
    part = 1.0  # of nothing for one that stays
    if stage.begin <= instant < stage.end:
        late = instant - stage.begin
        part = (stage.speed + stage.rise * late) * late
    return stage.x + part * stage.across, stage.y + part * stage.up
