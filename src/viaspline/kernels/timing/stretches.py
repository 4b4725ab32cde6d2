"""A path cut into stretches, each with one largest speed: by its bends, stops and slow parts.

Tested through ``trajectory/test_retime``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.jit import kernel


@kernel
def cut_in_stretches(
    arcs: Floats, arc_caps: Floats, corners: Flags, places: Floats, stops: Floats, slow: Floats
) -> tuple[Floats, Floats, Flags]:
    """Cut arcs at places as well.

    Args:
        arcs: Ends of arcs as distances [m], increasing; those up to the first place don't count,
            (k + 1,).
        arc_caps: The largest v² on each [m²/s²], (k,).
        corners: Whether the robot rests at an end, (k + 1,).
        places: From the first one on there are stretches [m], increasing, (p,).
        stops: Those of the places at which it rests, increasing, (s,).
        slow: Where it is slow, from and to [m], and v² there [m²/s²], (z, 3).

    Returns:
        Ends of stretches (n + 1,), the largest v² on each (n,), and whether it rests at an end
        (n + 1,).
    """
    line = np.empty(arcs.size + places.size)
    rests = np.zeros(line.size, np.bool_)
    count, i, j, k = 0, 0, 0, 0
    while i < arcs.size and arcs[i] <= places[0]:
        i += 1
    while i < arcs.size or j < places.size:
        arc = arcs[i] if i < arcs.size else np.inf
        place = places[j] if j < places.size else np.inf
        at = min(arc, place)
        if arc == at:
            rests[count] = corners[i]
            i += 1
        if place == at:
            j += 1
        while k < stops.size and stops[k] < at:
            k += 1
        rests[count] |= k < stops.size and stops[k] == at
        line[count] = at
        count += 1
    caps = np.empty(count - 1)
    arc = 0
    for n in range(count - 1):
        middle = 0.5 * (line[n] + line[n + 1])
        while arc < arc_caps.size - 1 and arcs[arc + 1] < middle:
            arc += 1
        caps[n] = arc_caps[arc]
        for part in range(slow.shape[0]):
            if slow[part, 0] < middle < slow[part, 1]:
                caps[n] = min(caps[n], slow[part, 2])
    return line[:count].copy(), caps, rests[:count].copy()
