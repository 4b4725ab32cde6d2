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

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.motion.passive_threats import (
    Threats,
    first_charted,
    gap_to,
    jumps_at,
    rate_of,
    sources,
)

LEAST_GAP: Final = 1e-3
"""A gap beyond what is to be kept that is taken for none: checks would go on in ever smaller steps
[m]."""

LEAST_STEP_S: Final = 1e-6
"""By so much a check goes on at least where a motion jumps: in that time nothing goes as far as the
least gap [s]."""

HALVINGS: Final = 12
"""How often the interval of speeds is halved in which the largest one is looked for,"""

STEP_HALVINGS: Final = 7
"""and that of what one step may change."""


@inner
def _place(places: Floats, step: float, s: float) -> tuple[float, float]:
    """The place at a distance along the path, on the chord between two places of the table."""
    last = places.shape[0] - 2
    j = min(max(math.floor(s / step), 0), last)
    w = min(max(s / step - j, 0.0), 1.0)
    return (
        places[j, 0] + w * (places[j + 1, 0] - places[j, 0]),
        places[j, 1] + w * (places[j + 1, 1] - places[j, 1]),
    )


@inner
def _first_contact(
    threats: Threats, first_source: int, places: Floats, step: float, keep: float,
    s: float, v: float, accel: float, t: float, duration: float,
) -> float:  # fmt: skip
    """From when on a piece of a law isn't proven [s]; infinite if all of it is."""
    first = np.inf
    charted = first_charted(threats)
    for k in range(first_source, sources(threats)):
        if k >= charted and t + duration <= threats.free_until[k - charted]:
            continue
        rate = rate_of(threats, k)
        late = 0.0
        while late < duration and t + late < first:
            now = v + accel * late
            fastest = max(now, v + accel * duration)
            x, y = _place(places, step, s + (v + 0.5 * accel * late) * late)
            gap = gap_to(threats, k, t + late, x, y) - keep
            if not gap > LEAST_GAP:
                first = t + late
                break
            later = min(late + gap / (fastest + rate), duration)
            jump = jumps_at(threats, k, t + late, t + later)
            late = later if jump > t + later else max(jump - t, late + LEAST_STEP_S)
    return first


@inner
def _stops(
    threats: Threats, places: Floats, step: float, keep: float, brake: float, stay: float,
    settle: float, s: float, v: float, t: float,
) -> bool:  # fmt: skip
    """Whether a robot that brakes from here and now on is at rest before any contact.

    And before any in the time that it takes to settle [s], and whether what is on the map stays
    away from it while it stays there for so long [s].
    """
    lasts = v / brake
    if _first_contact(threats, 0, places, step, keep, s, v, -brake, t, lasts) < np.inf:
        return False
    rest = s + 0.5 * v * lasts
    if settle > 0.0:
        found = _first_contact(threats, 0, places, step, keep, rest, 0.0, 0.0, t + lasts, settle)
        if found < np.inf:
            return False
    if stay <= 0.0:
        return True
    charted = first_charted(threats)
    found = _first_contact(threats, charted, places, step, keep, rest, 0.0, 0.0, t + lasts, stay)
    return math.isinf(found)


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
        found = _first_contact(threats, 0, places, step, keep, s, v, accel, t, duration)
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
    return _first_contact(threats, first, places, step, keep, s, 0.0, 0.0, t, stay)


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
    for j in range(distances.size):
        s, t = distances[j], times[j]
        if _stops(threats, places, step, keep, brake, 0.0, 0.0, s, caps[j], t):
            speeds[j] = caps[j]
            continue
        low, high = 0.0, caps[j]
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            if _stops(threats, places, step, keep, brake, 0.0, 0.0, s, middle, t):
                low = middle
            else:
                high = middle
        speeds[j] = low
    return speeds


@inner
def _goes_on(
    threats: Threats, places: Floats, step: float, keep: float, brake: float, stay: float,
    settle: float, s: float, v: float, t: float, width: float, square: float,
) -> bool:  # fmt: skip
    """Whether a robot may drive to the next place, have a v² there, and still stops in time."""
    after = math.sqrt(square)
    if v + after <= 0.0:
        return False
    duration = 2.0 * width / (v + after)
    accel = (square - v * v) / (2.0 * width)
    found = _first_contact(threats, 0, places, step, keep, s, v, accel, t, duration)
    if found < np.inf:
        return False
    return _stops(threats, places, step, keep, brake, stay, settle, s + width, after, t + duration)


@inner
def _largest_square(
    threats: Threats, places: Floats, step: float, keep: float, brake: float, stay: float,
    settle: float, s: float, v: float, t: float, width: float, high: float,
) -> float:  # fmt: skip
    """The largest v² at the next place that is proven; that of braking on, below 0 if it rests."""
    best = v * v - 2.0 * brake * width
    if high < best:
        return best
    if _goes_on(threats, places, step, keep, brake, stay, settle, s, v, t, width, high):
        return high
    low = max(best, 0.0)
    for _ in range(STEP_HALVINGS):
        middle = 0.5 * (low + high)
        if _goes_on(threats, places, step, keep, brake, stay, settle, s, v, t, width, middle):
            low = best = middle
        else:
            high = middle
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
    proven = _stops(threats, places, step, keep, brake, stay, settles, s, v, t)
    n = 1
    for j in range(1, line.size):
        width = line[j] - line[j - 1]
        square = v * v - 2.0 * brake * width
        if proven and t < time + lasting:
            high = min(v * v + 2.0 * accel * width, caps[j])
            square = _largest_square(
                threats, places, step, keep, brake, stay, settle, s, v, t, width, high
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
        t += 2.0 * width / (v + after)
        s, v = line[j], after
    return distances[:n].copy(), squares[:n].copy(), proven
