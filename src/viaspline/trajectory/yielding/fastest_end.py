"""The end of a law, as fast as where nothing moves from when on that is clear.

A lattice knows whole steps alone, so it loses a part of one. From the last thing that the robot had
to wait for, the rest of the way is the fastest there is.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing.integrate import ride
from viaspline.kernels.timing.two_pass import two_pass_profile
from viaspline.trajectory.yielding.law_knots import LawKnots
from viaspline.trajectory.yielding.leg_arrivals import LatticeSearch

NO_STOPS = np.empty(0)


def with_fastest_end(search: LatticeSearch, knots: LawKnots) -> LawKnots:
    """The law that goes over to the fastest one at the first of its last knots where that is clear.

    Args:
        search: What its legs have in common.
        knots: The law, to rest at its end.
    """
    best = knots
    rests = np.flatnonzero(knots.speeds[:-1] == 0.0)
    first = int(rests[-1]) if rests.size else 0
    for i in range(len(knots.times) - 2, first - 1, -1):
        end = _fastest(search, knots, i)
        if end.times[-1] > best.times[-1] + 1e-9 or not search.traffic.is_clear(search.road, end):
            break
        if end.times[-1] < best.times[-1]:
            best = LawKnots(*(values[:i] for values in knots.fields)).followed_by(end)
    return best


def _fastest(search: LatticeSearch, knots: LawKnots, i: int) -> LawKnots:
    """The fastest law from a knot to the end."""
    place, speed = float(knots.places[i]), float(knots.speeds[i])
    first = int(search.line.searchsorted(place, side="right")) - 1
    line: Floats = np.concatenate(([place], search.line[first + 1 :]))
    squares = search.caps[first:] ** 2
    dynamics = search.dynamics
    points, squares, _, _ = two_pass_profile(
        line, squares, np.zeros(line.size, np.bool_), dynamics.accel, dynamics.brake, speed**2, 0.0
    )
    places, speeds, times, _ = ride(
        points, squares, NO_STOPS, NO_STOPS, dynamics.accel, float(knots.times[i])
    )
    return LawKnots(times, places, speeds)
