"""What a robot does about what moves: go on, slow down, pass on another side, brake.

Its path is timed anew first. Where that costs much, or can't be done, it is led round what it would
meet, on either side, and the earliest arrival wins. What moves may turn: so there is room to spare
beside it, and where that can't be, what is required. Where nothing is found the robot takes what
meets something last, also beside its path, and braking if that is no worse.
"""

from __future__ import annotations

import math
from dataclasses import replace

from viaspline.errors import GeometryError, PlanningError
from viaspline.mission.shapes.obstacle import Side
from viaspline.planning import replan
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.reschedule import (
    rescheduled,
    trajectory_within_sight,
)
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.replanning.path_candidate import PathCandidate, timed
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.transitions import take_over
from viaspline.robot.yielding.meeting_ahead import meeting_ahead
from viaspline.robot.yielding.out_of_the_way import out_of_the_way
from viaspline.robot.yielding.swerves import driven, swerves
from viaspline.spacetime.standing_ghost import standing_ghost
from viaspline.spacetime.timed_problem import without_lanes
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles

APART_M = (0.3, 0.0)
"""What it keeps to what moves beyond what is required [m], the most that can be: that may turn."""

RETRY_S = 0.3
"""A robot that gives way looks so often for something better [s]."""

PATIENCE_S = 1.0
"""It waits so much longer than it would drive before it looks at other sides [s]."""

GAIN_S = 0.5
"""Another side has to be so much sooner than waiting [s]."""

SIDE_WORK_S = 0.03
"""What may be spent on laying one other path [s of the reference machine]."""

FREE_S = 0.05
"""Who comes no later than this doesn't give way [s]."""

SIDES: tuple[Side, Side] = ("left", "right")


def give_way(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule
) -> Decision:
    """The schedule of a robot that meets nothing that moves, as far as is known.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known, with what moves.
        schedule: What it has meant to do so far.
    """
    if schedule.giving_up is not None or progress.finished:
        return Decision(schedule)
    kept = _kept(task, progress, knowledge, schedule)
    if kept == 0 and not _hopes_for_more(progress, schedule):
        return Decision(schedule)
    if 0 < kept < len(APART_M) and progress.time < schedule.timed_at + RETRY_S:
        return Decision(schedule)
    for apart in APART_M[: max(kept, 1)]:
        wide = replace(task, apart=apart)
        decision = _clear_of_all(ReplanContext.of(wide, progress, knowledge, schedule))
        if decision is not None:
            return decision
    if kept < len(APART_M):
        return Decision(replace(schedule, timed_at=progress.time))
    context = ReplanContext.of(task, progress, knowledge, schedule)
    return out_of_the_way(context, _free_law(context))


def _kept(task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule) -> int:
    """Which of ``APART_M`` the robot keeps by what it means to do; their number if none.

    What is on the map doesn't turn: from that it keeps what is required.
    """
    path, law, now = schedule.path, schedule.trajectory, progress.time
    if meeting_ahead(task, knowledge.moving, path, law, now) is not None:
        return len(APART_M)
    sensed = knowledge.sensed_moving
    for k, apart in enumerate(APART_M[:-1]):
        if meeting_ahead(replace(task, apart=apart), sensed, path, law, now) is None:
            return k
    return len(APART_M) - 1


def _clear_of_all(context: ReplanContext) -> Decision | None:
    """What keeps clear of all that moves: waiting for it, or another side; None if neither does."""
    progress, free = context.progress, _free_law(context)
    waiting = _on_path(context)
    late = math.inf if waiting is None else waiting.trajectory.end_time - free.end_time
    if waiting is not None and late <= PATIENCE_S:
        return Decision(_giving_way(waiting, progress, late))
    other = _other_side(context, free)
    if other is not None and (
        waiting is None or other.trajectory.end_time + GAIN_S < waiting.trajectory.end_time
    ):
        decision = take_over(context, other, {})
        return replace(decision, schedule=_giving_way(decision.schedule, progress, math.inf))
    return None if waiting is None else Decision(_giving_way(waiting, progress, late))


def _hopes_for_more(progress: Progress, schedule: Schedule) -> bool:
    """Whether a robot that gives way may have a better way by now."""
    return schedule.gives_way and progress.time >= schedule.timed_at + RETRY_S


def _giving_way(schedule: Schedule, progress: Progress, late: float) -> Schedule:
    """The schedule of a robot that gives way if it comes later for it [s]."""
    return replace(schedule, timed_at=progress.time, gives_way=late > FREE_S)


def _free_law(context: ReplanContext) -> Trajectory:
    """The law that the robot would drive on its path if nothing moved."""
    knowledge = replace(context.knowledge, moving=MovingObstacles())
    return rescheduled(
        context.task, context.progress, knowledge, context.schedule, context.speed
    ).trajectory


def _on_path(context: ReplanContext) -> Schedule | None:
    """The schedule with a law past what moves on the path that there is."""
    try:
        law = trajectory_within_sight(
            context.task, context.progress, context.knowledge, context.schedule, context.speed,
            path=context.schedule.path, turns=context.schedule.turns,
            at_least=context.schedule.probed_until,
        )  # fmt: skip
    except GeometryError:
        return None
    return replace(context.schedule, trajectory=law)


def _other_side(context: ReplanContext, free: Trajectory) -> PathCandidate | None:
    """The path past what is met first that arrives first; None if none has a law.

    Where there is room for that it swerves: round what moves, few paths are found that have a law,
    and they cost most. Else it is led round.
    """
    moving, path = context.knowledge.moving, context.schedule.path
    meeting = meeting_ahead(context.task, moving, path, free, context.progress.time)
    if meeting is None:
        return None
    paths = swerves(context)
    if paths:
        found = driven(context, paths, context.knowledge)
    else:
        found = [
            candidate
            for window in meeting.windows
            for side in SIDES
            if (candidate := _led_round(context, meeting.obstacle, side, window)) is not None
        ]
    return min(found, key=lambda candidate: candidate.trajectory.end_time, default=None)


def _led_round(
    context: ReplanContext, obstacle: int, side: Side, window: tuple[float, float]
) -> PathCandidate | None:
    """The path on one side of where an obstacle is for a while, with its law."""
    apart = context.task.apart
    made = standing_ghost(context.knowledge.moving, obstacle, side, window, apart)
    if made is None:
        return None
    ghost, _ = made
    world = context.knowledge.world.with_obstacles([ghost])
    index, required = len(world) - 1, context.requirements.required
    places = [context.here[:2], *(via.at[:2] for via, _ in context.vias_ahead)]
    if (world.distances_to(index, places) < required).any():
        return None
    searching = context.searching(SIDE_WORK_S)
    path, until = context.schedule.path, context.schedule.looked_at
    stands = context.speed == 0.0
    lay = replan.from_rest if stands else replan.planned
    leave = context.stop if stands else context.leaves[0]
    try:
        requirements = without_lanes(searching.requirements)
        solution = lay(path, leave, world, requirements, (), until)
        return timed(context, "from_rest" if stands else "planned", solution)
    except PlanningError:
        return None
