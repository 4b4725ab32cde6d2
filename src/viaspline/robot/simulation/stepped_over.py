"""Steps that are left out while a robot stands, for none of them would change anything.

Tested through ``robot/simulation/test_standstills``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.robot.navigator import Navigator
from viaspline.robot.simulation.sensors import Senses
from viaspline.robot.simulation.standstills import (
    EDGE_S,
    LONG_S,
    LongStay,
    standstill_at,
    unseen_at,
)
from viaspline.tracks.calm_moments import Stretches


@dataclass(frozen=True)
class Stood:
    """A robot stands, and it is known when it has nothing that moves in sight.

    Attributes:
        standstill: Where, and until when.
        calm: When nothing that moves is in sight.
    """

    standstill: LongStay
    calm: Stretches


def stood_on(before: Stood | None, nav: Navigator, senses: Senses, time: float) -> Stood | None:
    """How a robot stands at a time [s]; None: it doesn't, or not for long.

    Args:
        before: How it stood a step before.
        nav: After that step.
        senses: What it is shown.
        time: [s].
    """
    standstill = standstill_at(nav.trajectory, time)
    if standstill is None or standstill.end - time < LONG_S:
        return None
    if before is not None and _is_same(before.standstill, standstill):
        return before
    standstill = LongStay(time, standstill.end, standstill.distance)
    place = np.asarray(nav.path.at_distance(standstill.distance))[:2]
    return Stood(standstill, unseen_at(standstill, senses.all_moving, place, senses.reach))


def _is_same(one: LongStay, other: LongStay) -> bool:
    """Whether a robot goes on to stand as it did."""
    return (one.end, one.distance) == (other.end, other.distance)


def steps_over(stood: Stood | None, nav: Navigator, tick: int, step: float) -> int:
    """Number of steps from one on that can be left out because the robot stands.

    Args:
        stood: How it stands.
        nav: After the step before.
        tick: The next step.
        step: From one step to the next [s].
    """
    time = tick * step
    if stood is None or nav.searches or nav.mission.robot.is_passive:
        return 0
    for begin, end in stood.calm:
        if begin <= time < end:
            return max(math.floor((min(end, nav.quiet_until - EDGE_S) - time) / step), 0)
    return 0
