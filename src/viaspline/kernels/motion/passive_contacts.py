"""When what may come touches a robot on a piece of its way, and what is too far off for that.

How a check goes on says ``passive_stop``. The same bound, with how far a robot goes in all and how
long that takes, leaves out what is far: what was at a distance d from a place is from one that is r
farther along the path, and T later, still at d - r - L T at least. So what is far off is looked at
once in many places.

Tested through ``trajectory/test_passive_safety`` and ``trajectory/test_charted_safety``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.jit import inner
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

ROUNDING_M: Final = 1e-9
"""What is far off has to be so much farther than it needs: then a check finds the same [m]."""


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
def _contact_with(
    threats: Threats, k: int, places: Floats, step: float, keep: float,
    s: float, v: float, accel: float, t: float, duration: float, until: float,
) -> float:  # fmt: skip
    """From when on a piece of a law isn't proven against source k [s].

    Infinite if it is proven, as far as it lies before ``until`` [s].
    """
    charted = first_charted(threats)
    if k >= charted and t + duration <= threats.free_until[k - charted]:
        return np.inf
    rate = rate_of(threats, k)
    late = 0.0
    while late < duration and t + late < until:
        now = v + accel * late
        fastest = max(now, v + accel * duration)
        x, y = _place(places, step, s + (v + 0.5 * accel * late) * late)
        gap = gap_to(threats, k, t + late, x, y) - keep
        if not gap > LEAST_GAP:
            return t + late
        later = min(late + gap / (fastest + rate), duration)
        jump = jumps_at(threats, k, t + late, t + later)
        late = later if jump > t + later else max(jump - t, late + LEAST_STEP_S)
    return np.inf


@inner
def contact(
    threats: Threats, first_source: int, places: Floats, step: float, keep: float,
    s: float, v: float, accel: float, t: float, duration: float,
) -> float:  # fmt: skip
    """From when on a piece of a law isn't proven [s]; infinite if all of it is.

    Args:
        threats: What may come.
        first_source: The first that counts.
        places: Along the path, ``step`` apart [m], (n, 2).
        step: [m].
        keep: What is kept [m].
        s: Where the piece begins [m].
        v: Speed there [m/s].
        accel: Along it [m/s²].
        t: When it begins [s].
        duration: [s].
    """
    first = np.inf
    for k in range(first_source, sources(threats)):
        found = _contact_with(threats, k, places, step, keep, s, v, accel, t, duration, first)
        first = min(first, found)
    return first


@inner
def is_untouched(
    threats: Threats, far: Flags, first_source: int, places: Floats, step: float, keep: float,
    s: float, v: float, accel: float, t: float, duration: float,
) -> bool:  # fmt: skip
    """Whether a piece of a law is proven against all but what is far off; else as ``contact``."""
    for k in range(first_source, sources(threats)):
        if far[k]:
            continue
        found = _contact_with(threats, k, places, step, keep, s, v, accel, t, duration, np.inf)
        if found < np.inf:
            return False
    return True


@inner
def note_far(
    threats: Threats, far: Flags, room: Floats, fresh: Flags, places: Floats, step: float,
    keep: float, s: float, t: float, way: float, lasts: float,
) -> None:  # fmt: skip
    """Note what can't touch a robot that goes no farther than a way in a time, from here and now.

    What is on the map isn't among that: it may jump.

    Args:
        threats: What may come.
        far: Which of it is too far off, written, (sources,).
        room: How far each is away at least, here and now, beyond what is kept [m], (sources,).
        fresh: Whether that was looked at here and now, (sources,).
        places: As for ``contact``.
        step: The same.
        keep: The same.
        s: Where the robot is [m].
        t: When [s].
        way: [m].
        lasts: [s].
    """
    for k in range(first_charted(threats)):
        needs = way + rate_of(threats, k) * lasts + LEAST_GAP + ROUNDING_M
        if not room[k] > needs and not fresh[k]:
            x, y = _place(places, step, s)
            room[k] = gap_to(threats, k, t, x, y) - keep
            fresh[k] = True
        far[k] = room[k] > needs


@inner
def go_on(threats: Threats, room: Floats, fresh: Flags, way: float, lasts: float) -> None:
    """Note that the robot has gone on: each may be nearer now, and wasn't looked at here.

    Args:
        threats: What may come.
        room: As for ``note_far``.
        fresh: The same.
        way: How far it has gone [m].
        lasts: In which time [s].
    """
    for k in range(first_charted(threats)):
        room[k] -= way + rate_of(threats, k) * lasts
        fresh[k] = False
