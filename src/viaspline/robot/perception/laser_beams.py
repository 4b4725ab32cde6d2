"""The beams of ROS's LaserScan as a ``Scan`` has them: anticlockwise, one turn at most."""

from __future__ import annotations

import math

import numpy as np

from viaspline.errors import GeometryError
from viaspline.handed_in import number_from, numbers_from
from viaspline.kernels.arrays import Floats

ONE_BEAM_RAD = math.radians(1.0)
"""From beam to beam of a scan that has one or none, of which nobody can say [rad]."""

ROUNDING = 1e-6
"""Part of a beam's angle by which a full turn may be missed: messages hold 32 bits."""


def laser_beams(
    ranges: object,
    angle_min: object,
    angle_increment: object,
    range_min: object,
    range_max: object,
) -> tuple[Floats, float, float]:
    """The beams of a LaserScan in anticlockwise order, without those that tell nothing.

    Args:
        ranges: As in the message [m], shape (beams,).
        angle_min: Direction of the first beam [rad].
        angle_increment: From each beam to the next, below 0 if they run clockwise [rad].
        range_min: What is nearer was not measured [m].
        range_max: What is farther was not measured [m].

    Returns:
        Distances, infinite where nothing was met and NaN where nothing was measured [m], shape
        (n,), n >= 1; direction of the first beam and from each beam to the next, above 0 [rad].

    Raises:
        GeometryError: When a number makes no scan.

    Example:
        >>> laser_beams([9.0, 1.0, np.inf], 1.0, -0.5, 0.1, 5.0)
        (array([inf,  1., nan]), 0.0, 0.5)
    """
    found = numbers_from("ranges", ranges).astype(np.float64)
    first, step = (
        number_from("angle_min", angle_min),
        number_from("angle_increment", angle_increment),
    )
    least, most = number_from("range_min", range_min), number_from("range_max", range_max)
    if found.ndim != 1:
        raise GeometryError(f"ranges have shape {found.shape}; give one for each beam")
    if not (math.isfinite(first) and math.isfinite(step)):
        raise GeometryError(
            f"angle_min is {first} and angle_increment {step}; give the angles of the beams in rad"
        )
    if not (math.isfinite(most) and 0.0 <= least < most):
        raise GeometryError(
            f"range_min is {least} m and range_max {most} m; give 0 <= range_min < range_max"
        )
    if step == 0.0 and found.size > 1:
        raise GeometryError(
            f"angle_increment is 0 for {found.size} beams; give what is between them"
        )
    told = np.isposinf(found) | ((found >= least) & (found <= most))
    beams = np.where(told, found, np.nan)
    if beams.size < 2:
        none = np.array([np.nan]) if not beams.size else beams
        return none, first, abs(step) or ONE_BEAM_RAD
    turn = max(math.floor(math.tau / abs(step) * (1.0 + ROUNDING)), 1)
    if beams.size > turn:  # the last of them are the latest
        first, beams = first + step * (beams.size - turn), beams[-turn:]
    if step < 0.0:
        first, beams = first + step * (beams.size - 1), beams[::-1].copy()
    return beams, first, min(abs(step), math.tau / max(beams.size - 1, 1))
