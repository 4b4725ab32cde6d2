"""A new path is tried out before a robot goes over to it, and made slow where it has to be.

What is kept for the tracking error comes from trial drives along the first plan and a slalom. A
path that is laid under way may have tighter bends. So it is driven in the closed loop of the trial
drives, from the state in which the robot is. Where the robot would get farther beside the path than
is kept, it has to be slower; if that doesn't help, the path isn't taken.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.drive_motion import ACROSS, ALONG
from viaspline.kernels.tracking.reference_path import ReferencePath
from viaspline.machine.allowance import TRIAL_SEEDS
from viaspline.machine.drive_ahead import DriveState, drive_ahead, is_random
from viaspline.machine.reference import reference_path_of
from viaspline.machine.trial_drive import speed_profile_of
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.problem.work_budget import DRIVE_AHEAD_S, DRIVE_AHEAD_SECOND_S, TIME_LAW_S
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.trajectory.slow_zones import Slow, slow_between
from viaspline.trajectory.trajectory import Trajectory

MARGIN = 1.25
"""By which what is kept is larger than what a robot gets beside a path in these drives. They are of
the path itself, and short: the largest error of them is about 3.5 standard deviations."""

DRIVES_AHEAD = 3
"""Drives that are tried out where they differ, by the first seeds of the trial drives."""

MAX_TRIALS = 5
"""Time laws that are tried out on a path, each slower than the one before where it has to be."""

SLOWER = 0.5
"""By which a time law gets slower from one trial to the next,"""

CREEP_MPS = 0.02
"""but no slower than this [m/s]."""

PIECE_M = 0.1
"""Stretches that have a speed of their own [m]."""

SETTLING_RATIO = 3.0
"""After a path is the old one again it is looked at for so many distances of convergence."""


def slow_enough(
    context: ReplanContext, solution: Solution, law: Callable[[tuple[Slow, ...]], Trajectory]
) -> tuple[Slow, ...] | None:
    """Where the robot has to be slower than its limits on a new path, to stay as near as is kept.

    Args:
        context: The robot under way.
        solution: The path.
        law: Gives the time law of all of the path with stretches of a lower speed.

    Returns:
        The stretches; None if the robot gets too far beside the path however slow it is.

    Raises:
        SpentBudgetError: When there is no time left for that.
    """
    slow, kept = _slow_already(context, solution), context.task.requirements.tracking_error
    controller = context.progress.controller
    if controller is None or controller.believed is None or kept == 0.0:
        return slow
    reference, until = reference_path_of(solution.path), _looked_at_until(context, solution)
    state = controller.state
    for _ in range(MAX_TRIALS):
        context.requirements.spend(TIME_LAW_S)
        trajectory = law(slow)
        far = _too_far(context, reference, trajectory, state, until)
        if far is None:
            return None
        if not far.size:
            return slow
        slow = _slower(context, slow, trajectory, far)
    return None


def _slow_already(context: ReplanContext, solution: Solution) -> tuple[Slow, ...]:
    """The stretches of the old path that the new one has as well."""
    schedule, here = context.schedule, context.progress.distance
    before = slow_between(schedule.slow, here, solution.changed_from)
    if solution.rejoins_at is None:
        return before
    longer = solution.path.length - schedule.path.length
    rest = slow_between(schedule.slow, solution.rejoins_at - longer, schedule.path.length)
    after = (Slow(part.start + longer, part.end + longer, part.speed) for part in rest)
    return (*before, *after)


def _looked_at_until(context: ReplanContext, solution: Solution) -> float:
    """Distance along a new path up to which it is tried out [m]."""
    if solution.rejoins_at is None:
        return context.schedule.looked_at if context.schedule.is_round else solution.path.length
    return solution.rejoins_at + SETTLING_RATIO * _convergence(
        context, context.task.limits.max_speed
    )


def _convergence(context: ReplanContext, speed: float) -> float:
    """The distance over which a deviation dies out at a speed [m]."""
    model = context.task.model
    assert model is not None
    return max(model.convergence_distance, model.convergence_time * speed)


def _too_far(
    context: ReplanContext,
    reference: ReferencePath,
    trajectory: Trajectory,
    state: DriveState,
    until: float,
) -> Floats | None:
    """Where the robot gets too far beside a path, in the first of some trials in which it does.

    Returns:
        Distances along the path [m], none if it never does; None if it doesn't come to the end.
    """
    robot, model = context.task.mission.robot, context.task.model
    assert model is not None
    reach = 0.0 if robot.footprint is None else robot.outer_radius
    profile = speed_profile_of(trajectory)
    seconds = max(float(trajectory.time_at(until)) - state.time, 0.0)
    for seed in TRIAL_SEEDS[: DRIVES_AHEAD if is_random(robot) else 1]:
        context.requirements.spend(DRIVE_AHEAD_S + DRIVE_AHEAD_SECOND_S * seconds)
        errors = drive_ahead(model, robot, reference, profile, state, until, seed)
        if errors is None:
            return None
        needed = MARGIN * errors.body_deviations(reach)
        first = float(needed[0]) + MARGIN * _coasting(context, state)
        far = errors.progress[needed > _allowed(context, errors.progress, first)]
        if far.size:
            return far
    return np.empty(0)


def _coasting(context: ReplanContext, state: DriveState) -> float:
    """How far a robot that is to stand still moves before it does as it is told now [m]."""
    model = context.task.model
    assert model is not None
    if context.speed > 0.0:
        return 0.0
    return float(np.hypot(state.pose[ALONG], state.pose[ACROSS])) * (model.delay + model.lag)


def _allowed(context: ReplanContext, places: Floats, first: float) -> Floats:
    """What the robot may get beside a path at some places along it [m].

    What it is beside its path already it can't help; but that has to die out.

    Args:
        context: The robot under way.
        places: Distances along the path [m].
        first: What would have to be kept for what it is beside its path now [m].
    """
    kept = context.task.requirements.tracking_error
    gone = np.maximum(places - context.progress.distance, 0.0)
    gone = gone / _convergence(context, context.task.limits.max_speed)
    allowed: Floats = kept + max(first - kept, 0.0) * (1.0 + gone) * np.exp(-gone)
    return allowed


def _slower(
    context: ReplanContext, slow: tuple[Slow, ...], trajectory: Trajectory, far: Floats
) -> tuple[Slow, ...]:
    """The stretches with slower ones where the robot gets too far beside the path, and before.

    Args:
        context: The robot under way.
        slow: The stretches so far.
        trajectory: Which was too fast.
        far: Where it is too far beside the path [m].
    """
    pieces = _pieces(context, trajectory, far)
    starts, ends = PIECE_M * pieces, PIECE_M * (pieces + 1)
    took = np.maximum(trajectory.time_at(ends) - trajectory.time_at(starts), 1e-9)
    speeds = np.maximum(SLOWER * PIECE_M / took, CREEP_MPS)
    marked = set(pieces.tolist())
    others = (part for part in slow if round(part.start / PIECE_M) not in marked)
    slower = map(Slow, starts.tolist(), ends.tolist(), speeds.tolist())
    return (*others, *slower)


def _pieces(context: ReplanContext, trajectory: Trajectory, far: Floats) -> NDArray[np.int64]:
    """Numbers of the pieces on which a robot is to be slower for what it is off at some places."""
    model = context.task.model
    assert model is not None
    speeds = trajectory.speed_at(far)
    late = model.delay + model.lag
    back = np.maximum(model.convergence_distance, (model.convergence_time + late) * speeds)
    last = np.floor(far / PIECE_M)
    # a robot that is late may be too far beside a place that its law has passed
    first = np.minimum(np.floor(np.maximum(far - back, context.progress.distance) / PIECE_M), last)
    marked = np.zeros(int(last.max()) + 2)
    np.add.at(marked, first.astype(np.int64), 1)
    np.add.at(marked, last.astype(np.int64) + 1, -1)
    return np.flatnonzero(np.cumsum(marked) > 0)
