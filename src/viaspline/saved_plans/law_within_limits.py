"""The law of a saved plan that isn't the fastest, held against what its robot can do.

Tested through ``saved_plans/test_load_plan``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Final

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.saved_plans.plan_file import PlanFile
from viaspline.saved_plans.saved_law import saved_law
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.trajectory import Trajectory

PROVEN_OFF_M: Final = 1e-3
"""Two proofs of one clearance differ by no more."""
TIMED_OFF: Final = 1e-6
"""Part of a time or a speed by which another machine may round it."""
GRIDS_OFF: Final = 1e-3
"""Part of the greatest speed by which laws differ that know their limits at other places."""
_COLUMNS: Final = ("distances", "speeds", "times", "accelerations", "changes", "jerks")


def law_within_limits(
    plan: PlanFile, path: Path, free: Trajectory, limits: Limits, stops: Iterable[Station]
) -> Trajectory:
    """The law of a file, within the limits of its robot.

    Args:
        plan: The file.
        path: Its path.
        free: The fastest law along that if nothing moved.
        limits: Of the robot along its path.
        stops: Where it has to stay, and for how long.

    Raises:
        SavedPlanError: The law isn't one of the robot on the path.
    """
    law = saved_law(plan)
    if not math.isclose(law.distances[-1], path.length, rel_tol=1e-9, abs_tol=1e-9):
        raise plan.wrong("trajectory.law doesn't end where the path does")
    if law.start_time != free.start_time or law.distances[0] != 0.0:
        raise plan.wrong("trajectory.law doesn't begin where and when the mission does")
    allowed = np.asarray(free.speed_at(law.distances))
    if (law.speeds > allowed + GRIDS_OFF * limits.max_speed).any():
        raise plan.wrong("trajectory.law is faster than the robot's limits allow")
    over = np.maximum(law.accelerations - limits.max_accel, -limits.brake - law.accelerations)
    faster = np.maximum(over, 0.0) @ np.diff(law.times)  # pieces of no length have any acceleration
    if faster > TIMED_OFF * (1.0 + law.duration):
        raise plan.wrong("trajectory.law speeds up or brakes harder than the robot may")
    for stop in stops:
        at = np.abs(law.distances - stop.distance) <= 1e-9 * (1.0 + path.length)
        if not at.any() or np.ptp(law.times[at]) < stop.dwell - TIMED_OFF:
            raise plan.wrong(f"trajectory.law doesn't stay at '{stop.name}' as long as asked")
    check_duration(plan, law)
    return law


def law_of_file(
    plan: PlanFile, path: Path, made: Trajectory, limits: Limits, stops: Iterable[Station]
) -> Trajectory:
    """The law of a file, which is one that was made again or within the limits of the robot.

    A robot of a fleet departs by the clock of the fleet, and waits for others.

    Args:
        plan: The file.
        path: Its path.
        made: The law as it was made again.
        limits: Of the robot along its path.
        stops: Where it has to stay, and for how long.

    Raises:
        SavedPlanError: The law isn't one of the robot on the path, or lasts longer than is said.
    """
    law = saved_law(plan)
    begun = (
        made
        if law.start_time == made.start_time
        else made.delayed(law.start_time - made.start_time)
    )
    if _is_as_made(law, begun):
        check_duration(plan, law)
        return law
    return law_within_limits(plan, path, begun, limits, stops)


def _is_as_made(law: Trajectory, made: Trajectory) -> bool:
    """Whether two laws are one, but for how another machine rounds."""
    if law.stations != made.stations or len(law.times) != len(made.times):
        return False
    return all(_near(getattr(law, name), getattr(made, name)) for name in _COLUMNS)


def _near(one: Floats | None, other: Floats | None) -> bool:
    """Whether two columns are one; none stands for noughts."""
    first, second = (0.0 if column is None else column for column in (one, other))
    return np.allclose(first, second, TIMED_OFF, TIMED_OFF)


def check_duration(plan: PlanFile, law: Trajectory) -> None:
    """See that a law lasts as long as the file says.

    Raises:
        SavedPlanError: It doesn't.
    """
    said = plan.number("trajectory", "duration_s")
    plan.check("duration [s]", said, law.duration, TIMED_OFF * (1.0 + law.duration))


def check_moving_proof(plan: PlanFile, found: MovingCertificate) -> None:
    """Hold the proof that was made again against what the file says of it.

    Raises:
        SavedPlanError: It says something else, or the drive isn't clear of what moves.
    """
    said = plan.number("certificate", "moving", "clearance_m")
    plan.check("clearance to what moves [m]", said, found.clearance, PROVEN_OFF_M)
    if not found.holds:
        raise plan.wrong("the drive doesn't keep its clearance to what moves")
