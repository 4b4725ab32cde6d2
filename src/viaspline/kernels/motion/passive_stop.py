"""Is a robot at rest before anything can touch it, whatever comes from where it doesn't see?

What may come, how far that is from a place p at an instant t at least, and by what rate L that
distance falls at most, say ``passive_threats``. With t fixed it falls by no more than a metre a
metre. So if the distance d(t) of a robot that drives no faster than v from t on is more than
``keep``,

    d(t') >= d(t) - (v + L) (t' - t) > keep   for t <= t' < t + (d(t) - keep) / (v + L),

and that is how far a check goes on: it proves a law for all instants of it, not for samples. It
looks anew where a motion jumps.

What moves as the map says can be asked for more: whether it stays away from a robot that has come
to rest, too. Of what else there may be nobody can say that, but for the moment that a drive needs
to settle once its law rests.

Tested through ``trajectory/test_passive_safety`` and ``trajectory/test_charted_safety``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.motion.passive_contacts import contact, go_on, is_untouched, note_far
from viaspline.kernels.motion.passive_threats import Threats, first_charted, sources

HALVINGS: Final = 12
"""How often the interval of speeds is halved in which the largest one is looked for,"""

STEP_HALVINGS: Final = 7
"""and that of what one step may change."""


@inner
def _stops(
    threats: Threats, far: Flags, places: Floats, step: float, keep: float, brake: float,
    stay: float, settle: float, s: float, v: float, t: float,
) -> bool:  # fmt: skip
    """Whether a robot that brakes from here and now on is at rest before any contact.

    And before any in the time that it takes to settle [s], and whether what is on the map stays
    away from it while it stays there for so long [s]. What is far off isn't looked at.
    """
    lasts = v / brake
    if not is_untouched(threats, far, 0, places, step, keep, s, v, -brake, t, lasts):
        return False
    rest, rests = s + 0.5 * v * lasts, t + lasts
    if settle > 0.0 and not is_untouched(
        threats, far, 0, places, step, keep, rest, 0.0, 0.0, rests, settle
    ):
        return False
    charted = first_charted(threats)
    return stay <= 0.0 or is_untouched(
        threats, far, charted, places, step, keep, rest, 0.0, 0.0, rests, stay
    )


@kernel
def first_contact(threats: Threats, places: Floats, step: float, keep: float, law: Floats) -> float:
    """From when on it isn't proven any more that a law under way is touched by nothing [s].

    Args:
        threats: What may come.
        places: Along the path from distance 0 on, (n, 2) with n >= 2 [m].
        step: From each of them to the next along the path [m].
        keep: The body's radius, and what else is to be kept: also by how much the path leaves the
            chords between the places [m].
        law: Pieces of constant acceleration: distance [m], speed [m/s], acceleration [m/s²], time
            [s], duration [s], (p, 5). Those in which the robot stands are passed over.

    Returns:
        Infinite if all of it is proven.
    """
    for piece in range(law.shape[0]):
        s, v, accel = law[piece, 0], law[piece, 1], law[piece, 2]
        t, duration = law[piece, 3], law[piece, 4]
        if v <= 0.0 and accel <= 0.0:
            continue
        found = contact(threats, 0, places, step, keep, s, v, accel, t, duration)
        if found < np.inf:
            return found
    return np.inf


@kernel
def touched_at_rest(
    threats: Threats, first: int, places: Floats, step: float, keep: float, s: float, t: float,
    stay: float,
) -> float:  # fmt: skip
    """From when on it isn't proven that a robot which stands is touched by nothing [s].

    Args:
        threats: What may come.
        first: The first source that counts: 0 for all, ``first_charted`` for those on the map.
        places: See ``first_contact``.
        step: See ``first_contact``.
        keep: See ``first_contact``.
        s: Where it stands [m].
        t: From when on [s].
        stay: For how long [s].

    Returns:
        Infinite if it is for as long as it stays.
    """
    return contact(threats, first, places, step, keep, s, 0.0, 0.0, t, stay)


@kernel
def stoppable_speeds(
    threats: Threats, places: Floats, step: float, keep: float, brake: float,
    distances: Floats, times: Floats, caps: Floats,
) -> Floats:  # fmt: skip
    """The largest speed at each of some places and times from which the robot stops in time.

    Found by halving, and each proven. Who is slower is not always safer: it is longer in the way.

    Args:
        threats: What may come.
        places: See ``first_contact``.
        step: See ``first_contact``.
        keep: See ``first_contact``.
        brake: Deceleration [m/s²].
        distances: Along the path [m], (m,).
        times: When the robot is there [s], (m,).
        caps: No larger speed is looked for [m/s], (m,).

    Returns:
        (m,) [m/s]; 0 where none is proven.
    """
    speeds = np.zeros(distances.size)
    far = np.zeros(sources(threats), np.bool_)
    for j in range(distances.size):
        s, t = distances[j], times[j]
        if _stops(threats, far, places, step, keep, brake, 0.0, 0.0, s, caps[j], t):
            speeds[j] = caps[j]
            continue
        low, high = 0.0, caps[j]
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if _stops(threats, far, places, step, keep, brake, 0.0, 0.0, s, middle, t):
                low = middle
            else:
                high = middle
        speeds[j] = low
    return speeds


@inner
def _goes_on(
    threats: Threats, far: Flags, room: Floats, fresh: Flags, places: Floats, step: float,
    keep: float, brake: float, stay: float, settle: float, s: float, v: float, t: float,
    width: float, square: float,
) -> bool:  # fmt: skip
    """Whether a robot may drive to the next place, have a v² there, and still stops in time."""
    after = math.sqrt(square)
    if v + after <= 0.0:
        return False
    duration = 2.0 * width / (v + after)
    accel = (square - v * v) / (2.0 * width)
    way, lasts = width + 0.5 * square / brake, duration + after / brake + settle
    note_far(threats, far, room, fresh, places, step, keep, s, t, way, lasts)
    if not is_untouched(threats, far, 0, places, step, keep, s, v, accel, t, duration):
        return False
    return _stops(
        threats, far, places, step, keep, brake, stay, settle, s + width, after, t + duration
    )


@inner
def _largest_square(
    threats: Threats, far: Flags, room: Floats, fresh: Flags, places: Floats, step: float,
    keep: float, brake: float, stay: float, settle: float, s: float, v: float, t: float,
    width: float, high: float,
) -> float:  # fmt: skip
    """The largest v² at the next place that is proven; that of braking on, below 0 if it rests."""
    best = v * v - 2.0 * brake * width
    if high < best:
        return best
    low = max(best, 0.0)
    square = high
    for _ in range(1 + STEP_HALVINGS):
        if _goes_on(
            threats, far, room, fresh, places, step, keep, brake, stay, settle, s, v, t, width,
            square,
        ):  # fmt: skip
            low = best = square
        else:
            high = square
        if best == high:
            break
        square = 0.5 * (low + high)
    return best


@kernel
def passive_profile(
    threats: Threats, places: Floats, step: float, keep: float, accel: float, brake: float,
    line: Floats, caps: Floats, speed: float, time: float, lasting: float, stay: float,
    settle: float,
) -> tuple[Floats, Floats, bool]:  # fmt: skip
    """A fast law from here and now on, from all of which the robot stops in time.

    From each place of the line to the next it takes the largest speed, found by halving, with which
    it arrives untouched and from which braking is proven. There is always one: to brake on, which
    was proven at the place before. Between two places the law is proven too, but braking begins at
    one.

    Args:
        threats: What may come.
        places: See ``first_contact``.
        step: See ``first_contact``.
        keep: See ``first_contact``.
        accel: Largest acceleration [m/s²].
        brake: Largest deceleration [m/s²].
        line: Distances along the path, from where the robot is [m], increasing, (m,).
        caps: Largest v² there [m²/s²], which ``brake`` can follow, (m,).
        speed: The robot's own, no larger than the first cap allows [m/s].
        time: When it is there [s].
        lasting: From so long after that on it brakes [s].
        stay: Where it stops, what is on the map has to stay away for so long [s].
        settle: For so long after its law rests a robot that was under way may still move [s].

    Returns:
        (distances [m] (k,), v² there (k,), whether it is proven): to the end of the line or to a
        rest before. Not proven: it isn't even if the robot brakes at once, which is the law then.
    """
    distances, squares = np.empty(line.size + 1), np.empty(line.size + 1)
    s, v, t = line[0], speed, time
    distances[0], squares[0] = s, v * v
    settles = settle if v > 0.0 else 0.0
    far, fresh = np.zeros(sources(threats), np.bool_), np.zeros(sources(threats), np.bool_)
    room = np.full(sources(threats), -np.inf)
    proven = _stops(threats, far, places, step, keep, brake, stay, settles, s, v, t)
    n = 1
    for j in range(1, line.size):
        width = line[j] - line[j - 1]
        square = v * v - 2.0 * brake * width
        if proven and t < time + lasting:
            high = min(v * v + 2.0 * accel * width, caps[j])
            square = _largest_square(
                threats, far, room, fresh, places, step, keep, brake, stay, settle, s, v, t, width,
                high,
            )  # fmt: skip
        square = min(square, caps[j])  # it isn't more, but for rounding
        if square < 0.0:
            if v > 0.0:
                distances[n], squares[n] = s + v * v / (2.0 * brake), 0.0
                n += 1
            break
        after = math.sqrt(square)
        distances[n], squares[n] = line[j], square
        n += 1
        if after <= 0.0:
            break
        lasts = 2.0 * width / (v + after)
        go_on(threats, room, fresh, width, lasts)
        t += lasts
        s, v = line[j], after
    return distances[:n].copy(), squares[:n].copy(), proven
