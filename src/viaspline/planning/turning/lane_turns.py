r"""The turns with which a path leaves a lane and meets it again.

A path that goes aside by w with turns and counter-turns of the radius R, whose curvature rises
evenly, takes :math:`\sqrt{8 R w}` along the line. So near to what it goes round it leaves; with R
no larger than what the robot needs at full speed, and so small that what it drives off the line is
in proportion to what it goes round: all but a little of four widths of that, from where it is
farther beside the line than half of what it keeps from obstacles.

Tested through ``planning/turning/test_local_detours``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats

BESIDE_LANE = 0.5  # it, a path is still on it: in required distances
OFF_WIDTHS = 1.42  # of what is gone round, that are driven off the line on each side of its middle
FITTING = 0.95  # of the radius with which a turn fits on a short lane just so
OVER = 0.3  # less, of how long the path stays aside
OFF_SIZES = 0.62  # of it with what is kept from it, that may be driven off on each side in any case
_PART = np.linspace(0.0, 0.5, 33)
_RISE = np.where(
    _PART < 0.25, 16.0 / 3.0 * _PART**3, 2.0 * _PART - 0.5 + 16.0 / 3.0 * (0.5 - _PART) ** 3
)
"""How far aside a turn and a counter-turn lead, over how far in the end, in their first half."""


@dataclass(frozen=True)
class LaneTurns:
    """Turns off a lane and onto it.

    Attributes:
        least: The least radius of a turn [m].
        widest: That of one at full speed [m].
        required: What is kept from obstacles [m].
        reach: How far along the lane they are stretched, over what they need.
    """

    least: float
    widest: float
    required: float
    reach: float

    def radius(self, aside: float, size: float, over: float, room: float) -> float:
        """With which a path goes aside [m] round something.

        Args:
            aside: How far [m].
            size: Of what it goes round, with what is kept from it [m].
            over: How long the path stays aside, from its first bend to its last [m].
            room: Between that and the nearer end of the lane [m]. Turns are no wider than fit
                there, if such a width does.
        """
        least = OFF_SIZES * max(size, 2.0 * aside)
        widths = OFF_WIDTHS * (size - 2.0 * self.required) - OVER * over
        aside = max(aside, 1e-9 * size)
        off_lane = 1.0 - _part_within(BESIDE_LANE * self.required / aside)
        fitting, narrow = (
            (off / off_lane) ** 2 / (8.0 * aside) for off in (max(widths, least), least)
        )
        root = math.sqrt(2.0 * aside + max(room, 0.0)) - math.sqrt(2.0 * aside)
        fitting = max(min(fitting, FITTING * root * root), narrow)
        return float(np.clip(fitting, self.least, self.widest))

    def length(self, aside: float, radius: float) -> float:
        """Along the lane, of a turn and a counter-turn that lead so far aside [m]."""
        return self.reach * math.sqrt(8.0 * radius * min(aside, 2.0 * radius))


def turn_aside(aside: Floats, radius: float) -> Floats:
    """By how much a path turns with a radius, and back again, to get so far aside [rad], (n,)."""
    turn: Floats = np.minimum(np.sqrt(aside / (2.0 * radius)), 0.5 * math.pi)
    return turn


def _part_within(rise: float) -> float:
    """The part of a turn and a counter-turn that is within a part of how far aside they lead.

    No more than nine tenths.
    """
    first = float(np.interp(min(rise, 1.0 - rise), _RISE, _PART))
    return min(first if rise < 0.5 else 1.0 - first, 0.9)
