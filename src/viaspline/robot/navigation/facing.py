"""Which way a robot without a drive looks: it turns on the spot no faster than it may.

Where it looks goes along with its progress, not with its time law: laws are found anew while it
turns, for other paths and for less of one.
"""

from __future__ import annotations

import math

from viaspline.curve.path import Path
from viaspline.machine.turns_on_spot import CORNER_RAD, TURN, heading_onward
from viaspline.mission.spot_turning import SpotTurning
from viaspline.robot.navigation.progress import REST_MPS, SAME_PLACE_M, Progress
from viaspline.trajectory.limits import Station
from viaspline.trajectory.trajectory import Trajectory

SAME_WAY_RAD = 1e-9
"""Headings nearer than this are the same [rad]."""


def facing_at(
    progress: Progress, path: Path, law: Trajectory, turning: SpotTurning, time: float
) -> float | None:
    """Which way a robot looks that has followed its path exactly up to a later time.

    Args:
        progress: How far it had come.
        path: What it drives.
        law: When it is where on that.
        turning: How it turns on the spot.
        time: [s].

    Returns:
        [rad]; None where that takes no time, or is told by a controller.
    """
    if progress.facing is None:
        return None
    distance, speed, _ = (float(value) for value in law.state_at(time))
    distance = max(distance, progress.distance)
    before = max(distance - 2.0 * SAME_PLACE_M, progress.distance)
    came = float(path.heading(float(path.parameter(before))))
    if speed > REST_MPS:
        return came
    facing, since, onward = progress.facing, progress.time, heading_onward(path, distance)
    if distance > progress.distance + SAME_PLACE_M:
        facing, since = came, max(since, float(law.time_at(distance)))
        if abs(math.remainder(onward - facing, math.tau)) <= CORNER_RAD:
            return onward  # it is steered away
    angle, turned = math.remainder(onward - facing, math.tau), turning.rate * max(time - since, 0.0)
    return onward if abs(angle) <= turned else facing + math.copysign(turned, angle)


def turn_to(
    facing: float, path: Path, distance: float, turning: SpotTurning, *, is_new: bool
) -> Station | None:
    """The stay of a robot that looks another way than its path leads on from where it stands.

    Args:
        facing: Which way it looks [rad].
        path: What it is to drive.
        distance: Where it stands along that [m].
        turning: How it turns on the spot.
        is_new: Whether it hasn't begun to turn to that path: as little as steers away is no turn.
    """
    angle = abs(math.remainder(heading_onward(path, distance) - facing, math.tau))
    if angle <= (CORNER_RAD if is_new else SAME_WAY_RAD):
        return None
    return Station(distance, turning.time(angle), TURN)
