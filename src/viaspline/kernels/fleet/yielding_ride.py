"""The earliest ride of one robot among others that have their laws: whom does it let pass?

At first it drives as if it were alone. Where it would be in a crossing while another is there, it
lets that one pass: it is slowed down so that it comes to the crossing when the other has left it,
if it can with a running start, so that no more is lost than has to be. Where it would be in another
one's way while it waits, it waits elsewhere, or lets that one pass as well. Each crossing is given
way to at most once, so this comes to an end. If it has to be given way to once more, a robot that
is patient waits at home until nobody is in its way, at most until all have arrived: where neither a
start nor a resting place of a robot lies in a crossing, that is always left.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Ints
from viaspline.kernels.fleet.blocked_times import Blocks, blocks_of, know_passage
from viaspline.kernels.fleet.notches import can_slow_at, cut_notch, slow_down
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.fleet.ride_law import Ride, copy_ride, new_ride, ride_alone, take_law
from viaspline.kernels.jit import inner, kernel

CLEAR: Final = -1
"""No box is in the way."""
TIME_SLACK_S = 1e-9
"""So much later than needed a robot comes to a crossing: for rounding."""
STEPS_BACK = 8
"""Places farther back at which it is tried to wait: so many, up to the start."""
STEPS_AHEAD = 4
"""Places nearer to the crossing than a running start takes."""


class RideScene(NamedTuple):
    """What a robot rides among.

    Attributes:
        courses: PackedCourses.
        crossings: PackedCrossings.
        passages: PackedPassages.
        rides: PackedRides.
        laws: Of the robots; those that have none yet play no part.
    """

    courses: PackedCourses
    crossings: PackedCrossings
    passages: PackedPassages
    rides: PackedRides
    laws: PackedLaws


@inner
def _first_blocked(scene: RideScene, ride: Ride, blocks: Blocks, i: int, before: int) -> int:
    """The first box of passage i in which a ride is while the other one is there, or CLEAR."""
    at = know_passage(scene.courses, scene.passages, scene.laws, blocks, i)
    p, end = blocks.begin + i, ride.square.size - 1
    begin = scene.passages.box_first[p]
    for j in range(scene.passages.box_first[p + 1] - begin):
        k = scene.passages.cell[begin + j] - ride.first
        if k >= before:
            break
        comes = ride.arrive[k] if k > 0 else -np.inf
        goes = ride.arrive[k + 1] if k + 1 < end else ride.leave[end]
        if comes < blocks.times[at + j, 1] and goes > blocks.times[at + j, 0]:
            return scene.passages.box[begin + j]
    return CLEAR


@inner
def _blocking(scene: RideScene, ride: Ride, blocks: Blocks, before: int) -> tuple[int, int]:
    """The first box in which a ride is while another robot is there, in cells before a node.

    Returns:
        (box, which passage of the robot it is in), or CLEAR twice.
    """
    end = ride.square.size - 1
    box, passage = CLEAR, CLEAR
    for i in range(blocks.since.size):
        p = blocks.begin + i
        k, last = scene.passages.entry[p] - ride.first, scene.passages.exit[p] - ride.first
        if k >= before:
            break
        comes = ride.arrive[k] if k > 0 else -np.inf
        goes = ride.arrive[last + 1] if last + 1 < end else ride.leave[end]
        if comes < blocks.until[i] and goes > blocks.since[i]:
            found = _first_blocked(scene, ride, blocks, i, before)
            if found != CLEAR and (box == CLEAR or found < box):
                box, passage = found, i
                before = min(before, scene.crossings.cell[found] - ride.first + 1)
    return box, passage


@inner
def _lateness(scene: RideScene, ride: Ride, blocks: Blocks, i: int) -> tuple[int, float]:
    """The first node of passage i, and how much too early a ride is for letting the other pass."""
    at = know_passage(scene.courses, scene.passages, scene.laws, blocks, i)
    p = blocks.begin + i
    begin, late = scene.passages.box_first[p], 0.0
    for j in range(scene.passages.box_first[p + 1] - begin):
        k = scene.passages.cell[begin + j] - ride.first
        late = max(late, blocks.times[at + j, 1] - ride.arrive[k])
    return scene.passages.entry[p] - ride.first, late


@inner
def _running_start(ride: Ride, courses: PackedCourses, rides: PackedRides, entry: int) -> int:
    """Where a robot can stand so that it comes to a node as fast as it does now."""
    room = ride.square[entry] / (2.0 * rides.accel[ride.robot])
    place = courses.distance[ride.first + entry] - room
    k = entry
    while k > 0 and courses.distance[ride.first + k] > place:
        k -= 1
    return k


@inner
def waits_at(ride: Ride, courses: PackedCourses, rides: PackedRides, entry: int) -> Ints:
    """Nodes at which it can be slowed down for a crossing, the best first.

    None where it neither rests nor can come to rest before that: it is under way.
    """
    best = _running_start(ride, courses, rides, entry)
    places = np.empty(STEPS_BACK + STEPS_AHEAD + 2, np.int64)
    places[0] = best
    count = 1
    for i in range(1, STEPS_BACK + 1):  # ever farther back: so near the start as i² has it
        places[count] = best - (best * i * i) // (STEPS_BACK * STEPS_BACK)
        count += 1
    for i in range(1, STEPS_AHEAD + 1):
        places[count] = best + ((entry - best) * i) // STEPS_AHEAD
        count += 1
    kept = 0
    for i in range(count):
        k = places[i]
        for near in (k, k - 1, k + 1):  # beside a rest it stands at the rest
            if 0 <= near <= entry and can_slow_at(ride, courses, rides, near):
                if kept == 0 or places[kept - 1] != near:
                    places[kept] = near
                    kept += 1
                break
    if kept == 0:  # it waits at its last rest
        k = entry
        while k >= 0 and ride.square[k] > 0.0:
            k -= 1
        if k >= 0:
            places[0], kept = k, 1
    return places[:kept]


@inner
def _give_way(
    scene: RideScene, ride: Ride, before: Ride, blocks: Blocks, entry: int, late: float
) -> bool:
    """Slow a ride down so that it comes later to a crossing, clear of all before it if it can.

    Args:
        scene: What it rides among.
        ride: It is written to.
        before: Room for the ride as it was.
        blocks: When it is blocked.
        entry: The node at which the crossing begins.
        late: How much later it has to come there [s].

    Returns:
        Whether it can be slowed down before that.
    """
    courses, rides = scene.courses, scene.rides
    places = waits_at(ride, courses, rides, entry)
    if places.size == 0:
        return False
    copy_ride(ride, before, 0)
    for i in range(places.size + 1):  # after the last one, the first again
        place = places[i % places.size]
        begin = slow_down(ride, courses, rides, place, entry, late + TIME_SLACK_S)
        if i == places.size or _blocking(scene, ride, blocks, entry)[0] == CLEAR:
            break
        copy_ride(before, ride, begin)
    return True


@inner
def _ridden(scene: RideScene, robot: int) -> tuple[Ride, int, bool]:
    """See ``yielding_ride``; and whether it would have to let the same one pass once more."""
    ride = new_ride(scene.courses, scene.rides, robot)
    before = new_ride(scene.courses, scene.rides, robot)
    blocks = blocks_of(scene.courses, scene.passages, scene.laws, robot)
    yields = np.empty(blocks.since.size, np.int64)  # passages, in the order of their first cells
    count = 0
    while True:
        box, passage = _blocking(scene, ride, blocks, ride.square.size)
        if box == CLEAR:
            return ride, CLEAR, False
        entry, late = _lateness(scene, ride, blocks, passage)
        if entry == 0 or math.isinf(late):
            return ride, box, False
        if (yields[:count] == passage).any():
            return ride, box, True
        yields[count] = passage
        count += 1
        k = count - 1
        while k > 0 and _lateness(scene, ride, blocks, yields[k - 1])[0] > entry:
            yields[k - 1], yields[k] = yields[k], yields[k - 1]
            k -= 1
        if k < count - 1:  # it gives way anew to all, one after the other
            ride_alone(ride, scene.rides)
            k = 0
        for i in range(k, count):
            entry, late = _lateness(scene, ride, blocks, yields[i])
            if late > 0.0 and not _give_way(scene, ride, before, blocks, entry, late):
                return ride, box, False


@inner
def yielding_ride(scene: RideScene, robot: int) -> tuple[Ride, int]:
    """The ride of a robot among those that have their law.

    Args:
        scene: What it rides among.
        robot: Which has none.

    Returns:
        The ride, and -1; or a ride that isn't clear, and the number of a box in which it can't let
        the other one pass.
    """
    ride, box, _ = _ridden(scene, robot)
    return ride, box


@inner
def patient_ride(scene: RideScene, robot: int) -> tuple[Ride, int]:
    """As ``yielding_ride``, but where it would have to let one pass twice, it waits at home.

    Until nobody is in its way as it drives alone; at most until all that ever arrive have arrived.
    """
    ride, box, again = _ridden(scene, robot)
    if not again:
        return ride, box
    courses, laws = scene.courses, scene.laws
    over = -np.inf
    for other in range(laws.is_timed.size):
        arrives = laws.arrive[courses.first[other + 1] - 1]
        if laws.is_timed[other] and arrives < np.inf:
            over = max(over, arrives)
    ride_alone(ride, scene.rides)
    if ride.square[0] > 0.0:
        return ride, box  # it is under way
    blocks = blocks_of(courses, scene.passages, laws, robot)
    waits, most = 0.0, max(0.0, over + TIME_SLACK_S - ride.leave[0])
    for _ in range(blocks.since.size + 1):  # whom it has let pass once, it has let pass
        met, passage = _blocking(scene, ride, blocks, ride.square.size)
        if met == CLEAR:
            return ride, CLEAR
        waits += _lateness(scene, ride, blocks, passage)[1] + TIME_SLACK_S
        if not waits < most:
            break
        ride_alone(ride, scene.rides)
        cut_notch(ride, courses, scene.rides, 0, 0.0, waits)
    ride_alone(ride, scene.rides)
    cut_notch(ride, courses, scene.rides, 0, 0.0, most)
    met, _ = _blocking(scene, ride, blocks, ride.square.size)
    return ride, CLEAR if met == CLEAR else box


@kernel
def timed_in_order(
    courses: PackedCourses, crossings: PackedCrossings, passages: PackedPassages,
    rides: PackedRides, laws: PackedLaws, order: Ints,
) -> Ints:  # fmt: skip
    """Give robots their laws, one after the other, each among those that have theirs by then.

    Args:
        courses: PackedCourses.
        crossings: PackedCrossings.
        passages: Of these.
        rides: PackedRides.
        laws: They are written to.
        order: The robots, none of which has a law, (m,).

    Returns:
        For each of these -1, or the box in which it can't let another robot pass: then it has no
        law, (m,).
    """
    scene = RideScene(courses, crossings, passages, rides, laws)
    found = np.empty(order.size, np.int64)
    for i in range(order.size):
        ride, found[i] = patient_ride(scene, order[i])
        if found[i] == CLEAR:
            take_law(ride, laws)
    return found
