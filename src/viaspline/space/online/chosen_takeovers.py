"""Where another path may begin under way: in the air, and where no stay at a station is cut short.

Tested through ``space/online/test_fly``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.online.retimed_ahead import SAME_PLACE_M, STANDS_MPS, FlightAhead
from viaspline.space.online.takeover import (
    LATENCY_S,
    Takeover,
    braked_takeover,
    smooth_takeover,
)


def takeovers(
    leg: FlownLeg, now: float, brake: float, shares: Sequence[float], climb: float
) -> Iterator[Takeover]:
    """Where another path may begin: as fast as the robot is, and slower.

    While it climbs from the ground that is at the top, where it stops anyway: lower down the ground
    would be in the way of every other path.

    Args:
        leg: What is flown.
        now: [s].
        brake: Largest deceleration [m/s²].
        shares: Of its speed, down to which it brakes where it can't be flown into any faster.
        climb: How far the leg climbs straight up from the ground [m]; 0: it doesn't.
    """
    if climbs(leg, now, climb):
        stands = np.flatnonzero(np.abs(leg.law.distances - climb) <= SAME_PLACE_M)
        if len(stands):
            leaves = float(leg.law.times[stands[-1]])
            yield Takeover(leaves, climb, 0.0, leaves)
        return
    yield _after_stay(leg, smooth_takeover(leg, now, brake))
    for share in shares:
        yield _after_stay(leg, braked_takeover(leg, now, brake, share))


def _after_stay(leg: FlownLeg, begins: Takeover) -> Takeover:
    """A take-over; at a station it is when the robot has stood there as long as it has to."""
    if begins.speed > STANDS_MPS:
        return begins
    leaves = FlightAhead(begins.time, begins.distance, 0.0).after_dwell(leg).time
    return begins if leaves == begins.time else begins._replace(time=leaves, since=leaves)


def climbs(leg: FlownLeg, now: float, climb: float) -> bool:
    """Whether the robot is still on its way up from the ground when it can do something else."""
    first = min(now + LATENCY_S, leg.law.end_time)
    return float(leg.law.distance_at(first)) < climb - SAME_PLACE_M
