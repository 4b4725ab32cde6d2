"""The radii of a polyline's corners where two roundings share a side that is too short for both.

All radii grow evenly. A side that is full ends that for its two corners, and the others go on: so
the smallest radius is as large as it can be, then the second one, and so on (max-min fairness).

Source: D. Bertsekas and R. Gallager, Data Networks (2nd ed., 1992), section 6.5.2.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel

SAME = 1e-12  # share of a level by which one counts as full


@kernel
def shared_radii(sides: Floats, reaches: Floats, wanted: Floats) -> Floats:
    """The radii that the corners of a polyline can have.

    Args:
        sides: Lengths of its sides [m], (n + 1,).
        reaches: How far before and after each corner a rounding of radius 1 m begins and ends [m],
            (n,); 0 where nothing is to be rounded.
        wanted: Radii to be had if there is room [m], (n,).

    Returns:
        Radii [m], none over the one that is wanted, (n,): no rounding reaches into another one.
    """
    count = len(wanted)
    radii = wanted.copy()
    is_held = reaches <= 0.0
    for _ in range(count):
        level = math.inf
        for side in range(count + 1):
            level = min(level, _full_at(side, sides, reaches, radii, is_held))
        if level == math.inf:
            break
        for side in range(count + 1):
            if _full_at(side, sides, reaches, radii, is_held) > level * (1.0 + SAME):
                continue
            for corner in (side - 1, side):
                if 0 <= corner < count and not is_held[corner]:
                    radii[corner] = min(radii[corner], level)
                    is_held[corner] = True
    return radii


@inner
def _full_at(
    side: int, sides: Floats, reaches: Floats, radii: Floats, is_held: NDArray[np.bool_]
) -> float:
    """The radius at which a side is full if those of its corners that aren't held grow [m].

    Infinite where that is never so.
    """
    taken, slope, free = 0.0, 0.0, 0
    nearest = math.inf
    for corner in (side - 1, side):
        if not 0 <= corner < len(radii):
            continue
        if is_held[corner]:
            taken += reaches[corner] * radii[corner]
        else:
            free += 1
            slope += reaches[corner]
            nearest = min(nearest, radii[corner])
    if free == 0:
        return math.inf
    room = max(sides[side] - taken, 0.0)
    if room <= slope * nearest:
        return room / slope
    if free == 1:
        return math.inf
    other, rest = 0.0, 0.0  # the corner that wants more goes on alone
    for corner in (side - 1, side):
        if radii[corner] > nearest or rest == 0.0:
            other, rest = radii[corner], reaches[corner]
    left = room - (slope - rest) * nearest
    return left / rest if left < rest * other else math.inf
