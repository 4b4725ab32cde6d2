"""Wider turns for a robot that drifts off where its path is as tight as its steering.

Tested through ``test_reserve``.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

from viaspline.errors import GeometryError
from viaspline.machine.allowance import TrialDrives
from viaspline.machine.steering_reserve import (
    ENOUGH_RESERVE,
    roomy_turn_radius,
    steering_reserve,
    with_steering_to_spare,
)

RESERVES = (ENOUGH_RESERVE, 0.5 * ENOUGH_RESERVE)
"""What turns are to leave of the steering to correct with: the next where that doesn't fit."""

DRIFT = 1.5
"""A robot drifts that gets more than so many times as far beside a path as with steering to spare.
Of 32 random robots 7 get up to 1.24 times as far, and the others 1.7 to 26 times."""


def eased_turns(trials: TrialDrives) -> Iterator[tuple[float, float]]:
    """Radii of turns that leave a robot steering to correct with, in place of those of a path.

    Args:
        trials: Its trial drives along the path.

    Yields:
        The radius, each less wide than the one before, and what to keep for the robot's tracking
        error then, about [m]; nothing where the robot doesn't drift off the path.
    """
    robot = trials.robot
    sharpest = trials.path.max_curvature()[0]
    if steering_reserve(robot, sharpest) >= ENOUGH_RESERVE:
        return
    spared = replace(trials, robot=with_steering_to_spare(robot))
    kept = 0.0
    with suppress(GeometryError):  # it doesn't come to its end: nothing is known of what to keep
        if trials.largest_deviation / max(spared.largest_deviation, 1e-9) <= DRIFT:
            return
        kept = spared.allowance
    before = None
    for reserve in RESERVES:
        radius = roomy_turn_radius(robot, reserve)
        if steering_reserve(robot, sharpest) < reserve and radius != before:
            yield radius, kept
            before = radius
