"""Where something that a lidar doesn't see may come from: how far it saw, and the gaps in that."""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.robot.perception.lidar import Scan


def reach_and_mouths(scan: Scan, least: float) -> tuple[float, Floats]:
    """How far a scan saw, and the lines through which what was hidden may come.

    What was seen is the star of the beams. Whoever comes into it crosses its rim: between the ends
    of two neighbouring beams, through a surface that both of them hit, or where they reached as far
    as they can. So with ends that are no farther apart than ``least`` the rim there is a surface,
    or too narrow a gap; all the rest of it that is nearer than the reach is a mouth. A beam that
    measured nothing is left out, as if its neighbours stood side by side.

    What comes from outside of the field of view isn't reckoned with: behind a robot that doesn't
    look back there may always be something.

    Args:
        scan: A look round.
        least: Nothing narrower than this moves [m].

    Returns:
        (reach [m], mouths ``x0, y0, x1, y1`` [m], shape (k, 4)): 0 if no beam measured anything.

    Example:
        >>> ranges = np.full(41, np.inf)
        >>> ranges[10:20] = 3.0
        >>> scan = Scan((0.0, 0.0), 0.0, -0.4, 0.02, 9.0, ranges)
        >>> reach, mouths = reach_and_mouths(scan, least=0.3)
        >>> round(reach, 2), np.hypot(mouths[:, 0], mouths[:, 1]).round(2).tolist()
        (9.0, [9.0, 3.0])
    """
    measured = np.flatnonzero(~np.isnan(scan.ranges))
    if not measured.size:
        return 0.0, np.empty((0, 4))
    lengths = scan.free[measured]
    angles = scan.first_direction + measured * scan.angle_increment
    rays = np.column_stack((np.cos(angles), np.sin(angles)))
    ends = np.asarray(scan.position[:2]) + lengths[:, None] * rays
    following = np.roll(np.arange(measured.size), -1)
    apart = np.hypot(*(ends[following] - ends).T)
    wide = apart > least
    wide &= ~(np.isinf(scan.ranges[measured]) & np.isinf(scan.ranges[measured[following]]))
    if len(scan.ranges) < round(math.tau / scan.angle_increment):
        wide[-1] = False
    steps = np.diff(measured, append=measured[-1] + 1)
    reach = scan.range_max * math.cos(min(0.5 * scan.angle_increment * int(steps.max()), math.pi))
    return max(reach, 0.0), np.column_stack((ends, ends[following]))[wide]
