"""A new path with its time law, as a robot under way could go over to it.

Tested through ``robot/replanning/test_decide`` and ``robot/replanning/test_hold_to_path``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from viaspline.errors import GeometryError
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.problem.work_budget import JERK_LAW_S, LAW_AMONG_S, TIME_LAW_S
from viaspline.robot.navigation.law_horizon import reach_of_all
from viaspline.robot.navigation.progress import SAME_PLACE_M
from viaspline.robot.navigation.reschedule import braking_at_once, trajectory_within_sight
from viaspline.robot.navigation.schedule import ReducedClearance
from viaspline.robot.replanning.hold_to_path import slow_enough
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.run import Mode
from viaspline.trajectory.slow_zones import Slow
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles


@dataclass(frozen=True)
class PathCandidate:
    """A new path that the robot could go over to.

    Attributes:
        mode: How it was found; see ``Replan``.
        solution: The path, and from where on it is new.
        turns: Distances along it where the robot turns on the spot [m].
        trajectory: The time law along it, from here and now on.
        slow: Where the robot has to be slower than its limits, to stay near enough to the path.
        reduced: Where it keeps less clearance than it should, if it does.
        waits: Whether the robot stands where it begins, until what moves leaves it a law.
    """

    mode: Mode
    solution: Solution
    turns: tuple[float, ...]
    trajectory: Trajectory
    slow: tuple[Slow, ...]
    reduced: ReducedClearance | None
    waits: bool = False


def timed(
    context: ReplanContext, mode: Mode, solution: Solution, turns: tuple[float, ...] = ()
) -> PathCandidate | None:
    """A path with its trajectory; None if the robot can't go over to it.

    It can't if it is too fast, or if it got farther beside the path than is kept for that.

    Args:
        context: The robot under way.
        mode: How the path was found; from rest the robot turns where it stops.
        solution: The path.
        turns: More distances along it where the robot turns, from rest [m].

    Raises:
        SpentBudgetError: When there is no time left for that.
    """
    trajectory = first_law(context, mode, solution, turns)
    if trajectory is None:
        return None
    return slowed(context, mode, solution, trajectory, turns)


def slowed(
    context: ReplanContext,
    mode: Mode,
    solution: Solution,
    trajectory: Trajectory,
    turns: tuple[float, ...] = (),
) -> PathCandidate | None:
    """A path with its trajectory, as slow as it has to be; None if the robot can't go over to it.

    Args:
        context: The robot under way.
        mode: How the path was found.
        solution: The path.
        trajectory: That of ``first_law``.
        turns: As for ``timed``.

    Raises:
        SpentBudgetError: When there is no time left for that.
    """
    corners, stands = _corners(context, mode, solution, turns), mode == "from_rest"
    try:
        slow = slow_enough(
            context, solution, lambda slow: _as_if_seen(context, solution, corners, slow)
        )
        if slow:
            trajectory = _in_sight(context, solution, corners, slow, stands=stands)
    except GeometryError:
        return None  # it could not stop within what it has seen of it
    if slow is None:
        return None
    return PathCandidate(mode, solution, corners, trajectory, slow, context.schedule.reduced)


def awaited(context: ReplanContext, solution: Solution) -> PathCandidate | None:
    """A path from rest before which the robot stands for what moves, which leaves it no law yet.

    Args:
        context: The robot under way.
        solution: The path; it isn't met by what stands.

    Returns:
        None if nothing moves, or if the robot couldn't go over to it then either.

    Raises:
        SpentBudgetError: When there is no time left for that.
    """
    if not len(context.knowledge.moving):
        return None
    alone = replace(context, knowledge=replace(context.knowledge, moving=MovingObstacles()))
    candidate = timed(alone, "from_rest", solution)
    if candidate is None:
        return None
    stop = braking_at_once(context.task, context.progress, context.schedule, context.speed)
    return replace(candidate, trajectory=stop, waits=True)


def first_law(
    context: ReplanContext, mode: Mode, solution: Solution, turns: tuple[float, ...] = ()
) -> Trajectory | None:
    """The trajectory of a path by which it is tried out; None: the robot is too fast for any.

    Args:
        context: The robot under way.
        mode: How the path was found.
        solution: The path.
        turns: As for ``timed``.

    Raises:
        SpentBudgetError: When there is no time left for that.
    """
    corners, stands = _corners(context, mode, solution, turns), mode == "from_rest"
    try:
        trajectory = _in_sight(context, solution, corners, (), stands=stands)
    except GeometryError:
        return None  # it could not stop within what it has seen of it
    is_too_fast = trajectory.over_limit_until is not None and not stands
    return None if is_too_fast else trajectory


def _corners(
    context: ReplanContext, mode: Mode, solution: Solution, turns: tuple[float, ...]
) -> tuple[float, ...]:
    """Distances along a path where the robot turns on the spot [m]; from rest where it stops."""
    leave = solution.changed_from
    corners = tuple(turn for turn in context.schedule.turns if turn <= leave + SAME_PLACE_M)
    return (*corners, context.stop, *turns) if mode == "from_rest" else corners


def _in_sight(
    context: ReplanContext,
    solution: Solution,
    corners: tuple[float, ...],
    slow: tuple[Slow, ...],
    *,
    stands: bool,
) -> Trajectory:
    """The trajectory of a path as far as the robot is certain to be free."""
    has_jerk = context.task.limits.max_jerk is not None
    cost = LAW_AMONG_S if len(context.knowledge.moving) else TIME_LAW_S
    context.requirements.spend(JERK_LAW_S if has_jerk else cost)
    return trajectory_within_sight(
        context.task,
        context.progress,
        context.knowledge,
        replace(context.schedule, held_at=math.inf, slow=slow),
        context.speed,
        path=solution.path,
        turns=corners,
        shared=solution.changed_from,
        at_least=context.stop if stands else 0.0,
    )


def _as_if_seen(
    context: ReplanContext, solution: Solution, corners: tuple[float, ...], slow: tuple[Slow, ...]
) -> Trajectory:
    """The trajectory of all of a path, if nothing else is seen; a limit of the jerk left out."""
    task = replace(context.task, limits=replace(context.task.limits, max_jerk=None))
    return trajectory_within_sight(
        task,
        context.progress,
        replace(context.knowledge, belief=None),
        replace(context.schedule, held_at=math.inf, slow=slow),
        context.speed,
        path=solution.path,
        turns=corners,
        reach=reach_of_all(context.schedule),
    )
