"""What a robot does about what moves: go on, slow down, pass on another side, brake.

Its path is timed anew first. Where that costs much, or can't be done, it is led round what it would
meet, on either side, and the earliest arrival wins; a step that has no time for all of these ways
leaves the rest to the next one. What moves may turn: so there is room to spare
beside it, and where that can't be, what is required. Where nothing is found the robot takes what
meets something last, also beside its path, and braking if that is no worse.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from viaspline.errors import GeometryError
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.reschedule import rescheduled, trajectory_within_sight
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.replanning.path_candidate import PathCandidate
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.transitions import take_over
from viaspline.robot.yielding.meeting_ahead import meeting_ahead
from viaspline.robot.yielding.out_of_the_way import out_of_the_way
from viaspline.robot.yielding.swerves import Swerves
from viaspline.robot.yielding.ways_past import Way, try_ways, ways_past
from viaspline.tracks.patience import APART_M, FREE_S, GAIN_S, PATIENCE_S, RETRY_S
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles


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
    goes_on = schedule.next_way > 0 or progress.time >= schedule.timed_at + RETRY_S
    if kept == 0 and not (schedule.gives_way and goes_on):
        return Decision(schedule if schedule.next_way == 0 else replace(schedule, next_way=0))
    if 0 < kept < len(APART_M) and not goes_on:
        return Decision(schedule)
    context = ReplanContext.of(task, progress, knowledge, schedule)
    tried, free = [], _free_law(context)
    for apart in APART_M[: max(kept, 1)]:
        tried.append(_Waiting.of(replace(context, task=replace(task, apart=apart)), free))
        if tried[-1].schedule is not None:
            break
    if tried[0].late <= PATIENCE_S:
        return Decision(tried[0].given(progress))
    paths = Swerves(context)
    decision, next_way = _by_another_way(context, tried, paths)
    if decision is None and kept < len(APART_M):
        decision = Decision(replace(schedule, timed_at=progress.time))
    if decision is None:
        decision = out_of_the_way(context, free, paths)
    return replace(decision, schedule=replace(decision.schedule, next_way=next_way))


@dataclass(frozen=True)
class _Waiting:
    """What a robot comes to that stays on its path, and keeps some room to what moves.

    Attributes:
        context: The robot, that is to keep so much.
        free: The law that it would drive if nothing moved.
        schedule: With a law past what moves; None if none was found.
    """

    context: ReplanContext
    free: Trajectory
    schedule: Schedule | None

    @classmethod
    def of(cls, context: ReplanContext, free: Trajectory) -> _Waiting:
        return cls(context, free, _on_path(context))

    @property
    def ends(self) -> float:
        """When it arrives [s]."""
        return math.inf if self.schedule is None else self.schedule.trajectory.end_time

    @property
    def late(self) -> float:
        """So much later than if nothing moved [s]."""
        return self.ends - self.free.end_time

    def given(self, progress: Progress) -> Schedule:
        """Its schedule, taken."""
        assert self.schedule is not None
        return _giving_way(self.schedule, progress, self.late)


def _by_another_way(
    context: ReplanContext, waiting: Sequence[_Waiting], paths: Swerves
) -> tuple[Decision | None, int]:
    """What keeps clear of all that moves: waiting for it, or another way; None if neither does.

    Returns:
        That, and which of the ways is tried in the next step; 0 if all were.
    """
    ways: list[tuple[Way, _Waiting]] = []
    for one in waiting:
        if one.late > PATIENCE_S:
            before = one.ends - GAIN_S
            ways += [(way, one) for way in ways_past(one.context, one.free, paths, before)]

    def is_worth(candidate: PathCandidate, number: int) -> bool:
        return candidate.trajectory.end_time + GAIN_S < ways[number][1].ends

    progress = context.progress
    tried = try_ways([way for way, _ in ways], context.schedule.next_way, is_worth)
    if tried.best is not None:
        candidate, number = tried.best
        decision = take_over(ways[number][1].context, candidate, {})
        taken = _giving_way(decision.schedule, progress, math.inf)
        return replace(decision, schedule=taken), 0
    last = waiting[-1]
    return None if last.schedule is None else Decision(last.given(progress)), tried.next_way


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
