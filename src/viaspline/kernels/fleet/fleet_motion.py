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
"""Of how much farther a law goes than with constant acceleration: by more it is nowhere off that,
if it has an even share of it at every instant; see ``error_in``."""


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
        bow: How far the curve is from the chord, at most [m].
        swing: How much farther the law goes than with constant acceleration [m]: every instant has
            an even share of it in these numbers; see ``error_in``.
        swung: The same, in chords.
    """

    x: float
    y: float
    across: float
    up: float
    begin: float
    end: float
    speed: float
    rise: float
    bow: float
    swing: float
    swung: float


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
        return DriveStage(x, y, 0.0, 0.0, laws.leave[k], laws.leave[k], 0.0, 0.0, 0.0, 0.0, 0.0)
    begin, end = laws.leave[k], laws.arrive[k + 1]
    lasts, length = end - begin, courses.distance[k + 1] - courses.distance[k]
    farther = length - 0.5 * (laws.speed[k] + laws.speed[k + 1]) * lasts
    speed, rise, bow, swing, swung = 0.0, 0.0, courses.bow[k] + abs(farther), 0.0, 0.0
    if lasts > 0.0 and length > 0.0:
        speed = (laws.speed[k] + farther / lasts) / length
        rise = 0.5 * (laws.speed[k + 1] - laws.speed[k]) / (lasts * length)
        bow, swing, swung = courses.bow[k], abs(farther), abs(farther) / length
    across, up = courses.place[k + 1, 0] - x, courses.place[k + 1, 1] - y
    return DriveStage(x, y, across, up, begin, end, speed, rise, bow, swing, swung)


@inlined
def place_in(stage: DriveStage, instant: float) -> tuple[float, float]:
    """The point on the chord at an instant of a stage [m]."""
    part = 1.0  # of nothing for one that stays
    if stage.begin <= instant < stage.end:
        late = instant - stage.begin
        part = (stage.speed + stage.rise * late) * late
    return stage.x + part * stage.across, stage.y + part * stage.up


@inlined
def _unsure(stage: DriveStage, begin: float, end: float) -> float:
    """How far a law is off its even share between two instants, of how much farther it goes.

    Where acceleration changes, speed is convex or concave in time: what is between it and the
    straight line is a mean of triangles. After a part u of the time one of area F, whose tip is at
    c, has F u²/c of it behind it up to its tip, and what is behind that mirrored: neither is
    farther from the even share F u than F u (1 - u).
    """
    lasts = stage.end - stage.begin
    part = min(max(0.5, (begin - stage.begin) / lasts), (end - stage.begin) / lasts)
    part = min(max(part, 0.0), 1.0)
    return part * (1.0 - part)


@inlined
def error_in(stage: DriveStage, begin: float, end: float) -> float:
    """How far the robot is from the point on the chord, at most, between two instants [m].

    Args:
        stage: A stage.
        begin: In it, or at its end [s].
        end: The same, not before that [s].
    """
    if stage.swing == 0.0:
        return stage.bow
    return stage.bow + stage.swing * _unsure(stage, begin, end)


@inlined
def parts_in(stage: DriveStage, begin: float, end: float) -> tuple[float, float]:
    """From where to where on its chord a robot may be between two instants, in chords.

    It goes on from node to node: it is neither before the one nor behind the other, whatever its
    motion with an even share comes to there.

    Args:
        stage: A stage.
        begin: In it, or at its end [s].
        end: The same, not before that [s].
    """
    if not stage.begin < stage.end:
        return 0.0, 1.0
    first, last = max(begin - stage.begin, 0.0), min(end, stage.end) - stage.begin
    one, other = (
        (stage.speed + stage.rise * first) * first,
        (stage.speed + stage.rise * last) * last,
    )
    low, high = min(one, other), max(one, other)
    if stage.rise != 0.0:
        tip = -0.5 * stage.speed / stage.rise
        if first < tip < last:
            low, high = min(low, 0.5 * stage.speed * tip), max(high, 0.5 * stage.speed * tip)
    off = stage.swung * _unsure(stage, begin, end)
    low, high = min(max(low - off, 0.0), 1.0), min(max(high + off, 0.0), 1.0)
    return low, high
