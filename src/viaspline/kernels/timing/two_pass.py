"""The fastest profile of the speed along a line of stretches, each with a largest speed.

Everything is done in v², which is linear in distance where the acceleration is constant; so a
profile given at its break points is exact between them.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.jit import inner, kernel

APART: Final = 1e-12
"""Break points within a stretch that are nearer to another point, as a share of the farthest
distance, are left out: what lies between is little more than rounding, and so would be its slope.
"""


@inner
def _backward(distances: Floats, caps: Floats, rests: Flags, brake: float, last: float) -> Floats:
    """The largest v² at every end of a stretch from which all that follows can be kept."""
    n = distances.shape[0]
    back = np.empty(n)
    back[n - 1] = 0.0 if rests[n - 1] else min(last, caps[n - 2])
    for i in range(n - 2, -1, -1):
        limit = caps[i] if i == 0 else min(caps[i], caps[i - 1])
        reach = back[i + 1] + 2.0 * brake * (distances[i + 1] - distances[i])
        back[i] = 0.0 if rests[i] else min(limit, reach)
    return back


@inner
def _exceeds(square: float, limit: float, slip: float) -> bool:
    return square > limit * (1.0 + 1e-9) + slip


@inner
def _peak(
    left: float,
    right: float,
    low: float,
    high: float,
    cap: float,
    accel: float,
    brake: float,
    apart: float,
    s: Floats,
    e: Floats,
    count: int,
) -> int:
    """Break points inside a stretch whose ends have the v² ``low`` and ``high``.

    Without one of them v² is less steep, and nowhere higher.
    """
    up, down, width = 2.0 * accel, 2.0 * brake, right - left
    rise, fall = (cap - low) / up, width - (cap - high) / down
    if rise < fall:
        for x in (rise, fall):
            if s[count - 1] + apart < left + x < right - apart:
                s[count], e[count] = left + x, cap
                count += 1
        return count
    x = (high - low + down * width) / (up + down)
    if s[count - 1] + apart < left + x < right - apart:
        s[count], e[count] = left + x, low + up * x
        count += 1
    return count


@kernel
def two_pass_profile(
    distances: Floats,
    caps: Floats,
    rests: Flags,
    accel: float,
    brake: float,
    first: float,
    last: float,
) -> tuple[Floats, Floats, float, float]:
    """The fastest v² along a line of stretches, by a backward and a forward pass.

    Args:
        distances: Ends of the stretches [m], increasing, shape (n,).
        caps: Largest v² on every stretch [m²/s²], shape (n - 1,).
        rests: Where v is 0, shape (n,).
        accel: Largest acceleration [m/s²].
        brake: Largest deceleration [m/s²].
        first: v² at the start. If it is more than the caps allow, the profile brakes with
            ``brake`` until it is below them.
        last: v² at the end.

    Returns:
        Break points (k,) and v² there (k,), between which v² is linear; the distance up to which
        the profile is above the caps (the start if it never is); the first place where it can't
        come to rest as it should (nan if there is none).
    """
    n = distances.shape[0]
    up, down = 2.0 * accel, 2.0 * brake
    slip = 1e-12 + 1e-14 * brake * abs(distances[n - 1])
    apart = APART * max(abs(distances[0]), abs(distances[n - 1]))
    back = _backward(distances, caps, rests, brake, last)
    s, e = np.empty(4 * n), np.empty(4 * n)
    count, over, missed = 1, distances[0], np.nan
    is_over = _exceeds(first, back[0], slip + 4e-6 * brake)  # what 2 µm of braking take off
    s[0], e[0] = distances[0], first if is_over else min(first, back[0])
    if is_over and rests[0]:
        missed = distances[0]
    for i in range(n - 1):
        left, right, cap, low = distances[i], distances[i + 1], caps[i], e[count - 1]
        if is_over:
            braked = low - down * (right - left)
            if _exceeds(braked, back[i + 1], slip):
                if np.isnan(missed) and (rests[i + 1] or i == n - 2):
                    missed = right
                over = right
                s[count], e[count] = right, braked
                count += 1
                continue
            is_over = False
            if low > cap:
                left = over = min(left + (low - cap) / down, right)
                low = cap
                s[count], e[count] = left, low
                count += 1
        high = min(back[i + 1], max(low, 0.0) + up * (right - left))
        count = _peak(left, right, low, high, cap, accel, brake, apart, s, e, count)
        if right > s[count - 1]:
            s[count], e[count] = right, high
            count += 1
    return s[:count], np.maximum(e[:count], 0.0), over, missed
