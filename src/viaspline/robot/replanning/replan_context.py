"""A robot under way that may need a new path: where it can stop, and where it may turn off."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from viaspline.curve.path import PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.checking.conflicts import CLEAR, conflicts_within
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.replanning.sides_ahead import spans_on_wrong_side
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.pending_search import FIRST_STAGE
from viaspline.robot.navigation.progress import REST_MPS, SAME_PLACE_M, Progress
from viaspline.robot.navigation.schedule import Schedule, vias_after
from viaspline.robot.perception.body_room import room_along
from viaspline.robot.run import Event
from viaspline.world.world import World

PATH_END_U = 1e-9
"""A via point whose parameter is nearer than this to the path's end is the goal."""


NOTHING: Mapping[Hashable, object] = MappingProxyType({})
"""What has come before a search that begins."""


@dataclass(frozen=True)
class Obstruction:
    """What a path comes too close to.

    Attributes:
        world: All that it may be too close to.
        names: What is in the way, for people.
        free_until: Up to this distance along the path it is certainly clear [m].
    """

    world: World
    names: tuple[str, ...]
    free_until: float


@dataclass(frozen=True)
class MotionAhead:
    """How a robot moves where its trajectory may be changed: now, or where it is committed to it.

    Attributes:
        speed: [m/s].
        stop: Where the robot stands if it brakes from there, as a distance along the path [m].
        leaves: Where a new path may leave the old one without a stop, the nearest place first [m].
    """

    speed: float
    stop: float
    leaves: tuple[float, ...]

    @classmethod
    def of(
        cls, task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule
    ) -> MotionAhead:
        """The motion of a robot."""
        distance, trajectory = progress.distance, schedule.trajectory
        time = max(progress.time, schedule.committed_until)
        speed, rest = 0.0, distance
        if progress.dwell is None:
            if time > progress.time:
                distance = max(float(trajectory.state_at(time)[0]), distance)
            speed = float(trajectory.state_at(time)[1])
            speed = speed if speed > REST_MPS else 0.0
            rest = trajectory.next_rest(distance + SAME_PLACE_M)
        stop = min(distance + speed * speed / (2.0 * task.limits.brake), rest)
        reaction = speed * max(task.reaction - max(time - progress.time, 0.0), 0.0)
        leaves = {min(distance + reaction, rest): None}
        if task.limits.max_lateral_accel is not None:
            leaves[min(stop + reaction, rest)] = None  # it may be slow enough for a sharper bend
        if knowledge.belief is not None:
            leaves[stop] = None  # there it may have seen enough of another way
        return cls(speed, stop, tuple(leaves))


@dataclass(frozen=True)
class ReplanContext:
    """A robot at the moment in which it decides how to go on.

    Attributes:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: What a new path keeps clear of.
        schedule: What it has meant to do so far.
        requirements: What a new path keeps.
        obstruction: What is in the way of the path so far.
        here: The robot's place on the path [m], shape (d,).
        vias_ahead: The route's points still to come, with their distances along the path [m]; on a
            round only those that are looked at already.
        kept: From where to where the path ahead keeps which distance [m].
        motion: How the robot moves.
        floor: Distance that the path keeps up to where it is left [m].
    """

    task: DriveTask
    progress: Progress
    knowledge: Knowledge
    schedule: Schedule
    requirements: Requirements
    obstruction: Obstruction
    here: tuple[float, ...]
    vias_ahead: tuple[tuple[PathVia, float], ...]
    kept: tuple[tuple[float, float, float], ...]
    motion: MotionAhead
    floor: float

    @classmethod
    def of(
        cls, task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule
    ) -> ReplanContext:
        """A robot as it is now, with nothing in its way."""
        distance, path, until = progress.distance, schedule.path, schedule.looked_at
        kept = schedule.kept(distance, until, task.requirements.required)
        return cls(
            task=task,
            progress=progress,
            knowledge=knowledge,
            schedule=schedule,
            requirements=task.requirements,
            obstruction=Obstruction(knowledge.world, (), path.length),
            here=tuple(np.asarray(path.at_distance(distance)).tolist()),
            vias_ahead=tuple(
                (via, at)
                for via, at in vias_after(path, progress.last_via)
                if at <= until + SAME_PLACE_M
            ),
            kept=kept,
            motion=MotionAhead.of(task, progress, knowledge, schedule),
            floor=kept[0][2],
        )

    def is_goal(self, via: PathVia) -> bool:
        """Whether the drive ends at a point of the route, in this lap or a later one."""
        assert via.index is not None
        laps = self.schedule.laps
        if laps is not None:
            return laps.is_goal(via.index)
        return via.u >= self.schedule.path.domain[1] - PATH_END_U

    @property
    def speed(self) -> float:
        """Of the robot [m/s]."""
        return self.motion.speed

    @property
    def stop(self) -> float:
        """Where the robot stands if it brakes as soon as it can, along the path [m]."""
        return self.motion.stop

    @property
    def leaves(self) -> tuple[float, ...]:
        """Where a new path may leave this one without a stop, the nearest place first [m]."""
        return self.motion.leaves

    @property
    def settled_leave(self) -> float | None:
        """Where alone it may leave this one while its search goes on [m], while that is ahead."""
        pending = self.schedule.pending
        if pending is None or pending.leave is None or pending.leave < self.leaves[0]:
            return None
        return pending.leave

    @property
    def work(self) -> float:
        """What its search has spent so far [s of the reference machine]."""
        budget = self.requirements.budget
        return 0.0 if budget is None else budget.spent

    @property
    def _unbudgeted(self) -> Requirements:
        """What a path keeps: to look at the one that there is, there is always time."""
        return self.requirements.unbudgeted

    def searching(
        self, limit: float, finished: Mapping[Hashable, object] = NOTHING
    ) -> ReplanContext:
        """The robot with what its search may spend, on its way for as long as that takes.

        Args:
            limit: [s of the reference machine], which are taken for seconds.
            finished: What parts of it have come to before; see ``WorkBudget``.
        """
        budget, trajectory = WorkBudget(limit, finished=dict(finished)), self.schedule.trajectory
        until = trajectory.cut_after(self.progress.time + limit)
        task = replace(self.task, requirements=self.task.requirements.within(budget))
        schedule = replace(self.schedule, committed_until=max(until, self.schedule.committed_until))
        return replace(
            self,
            task=task,
            schedule=schedule,
            requirements=self.requirements.within(budget),
            motion=MotionAhead.of(task, self.progress, self.knowledge, schedule),
        )

    def searching_from_the_first(self) -> ReplanContext:
        """The robot with a search that begins with its first stage, whatever was tried before."""
        pending = self.schedule.pending
        if pending is None:
            return self
        begun = replace(pending, begin_with=FIRST_STAGE)
        return replace(self, schedule=replace(self.schedule, pending=begun))

    def free_until(self, world: World) -> float | None:
        """Start of the first span ahead that comes too close to a world [m]; None if none does."""
        path, requirements = self.schedule.path, self._unbudgeted
        for start, u, part, floor in self.parts_ahead():
            conflict = _first_conflict(part, world, floor, requirements)
            if conflict == 0:
                return start
            if conflict is not None:
                return float(path.distance(float(math.floor(u) + conflict)))
        return None

    def on_side_until(self, world: World) -> float | None:
        """Start of the first span ahead that passes something of a world on the wrong side [m].

        None if none does.
        """
        path, here = self.schedule.path, self.progress.distance
        wrong = spans_on_wrong_side(path, float(path.parameter(here)), world, self._unbudgeted)
        return max(here, float(path.distance(float(min(wrong))))) if wrong else None

    def in_the_way(self, world: World) -> tuple[str, ...]:
        """Names of what a world has in the way of the path ahead, one for each span."""
        found = [
            conflicts_within(floor, world, part.spans, self._unbudgeted).tolist()
            for _, _, part, floor in self.parts_ahead()
        ]
        return tuple(dict.fromkeys(world.name(i) for row in found for i in row if i != CLEAR))

    def parts_ahead(self) -> Iterator[tuple[float, float, PiecewiseCubic, float]]:
        """The path ahead in parts that keep different distances.

        Yields:
            From where [m] and from which parameter on, the curve, and the distance kept [m].
        """
        path = self.schedule.path
        for start, end, floor in self.kept:
            if end - start > SAME_PLACE_M:
                first, last = np.asarray(path.parameter(np.array([start, end]))).tolist()
                yield start, first, path.section(first, last), floor

    @property
    def stands_clear(self) -> bool:
        """Whether it touches nothing until it stands, and keeps its distance from then on."""
        touching = self.requirements.radius + self.requirements.tracking_error
        return self._keeps(self.floor, self.stop) and self._is_clear(self.stop, touching)

    def is_clear(self, place: float) -> bool:
        """Whether the path keeps its distance from what is in the way up to a place [m]."""
        return self._is_clear(place, self.floor)

    def _is_clear(self, place: float, floor: float) -> bool:
        path, world, start = self.schedule.path, self.obstruction.world, self.obstruction.free_until
        if place < start:
            return True
        if place - start <= SAME_PLACE_M:
            return self._keeps(floor, place)
        first, last = np.asarray(path.parameter(np.array([start, place]))).tolist()
        return _first_conflict(path.section(first, last), world, floor, self._unbudgeted) is None

    def _keeps(self, floor: float, place: float) -> bool:
        """Whether a place of the path is so far from what is in the way [m]."""
        world, path = self.obstruction.world, self.schedule.path
        room = room_along(world, path, np.array([place]), self.requirements)
        return float(room[0]) >= floor - SAME_PLACE_M

    def clear_leaves(self) -> list[float]:
        """Where a new path can leave this one while the robot rolls on [m]."""
        turns, settled = self.schedule.turns, self.settled_leave
        return [
            leave
            for leave in (self.leaves if settled is None else (settled,))
            if all(abs(turn - leave) > SAME_PLACE_M for turn in turns) and self.is_clear(leave)
        ]

    def detection(self, world: World, index: int) -> Event:
        """The event that something of a world has been seen for the first time."""
        name, gap = world.name(index), float(world.distances_to(index, self.here))
        message = f"sees '{name}' {gap:.1f} m away"
        return Event("detected", self.progress.time, self.here, message, {"name": name})


def _first_conflict(
    curve: PiecewiseCubic, world: World, required: float, requirements: Requirements
) -> int | None:
    """Index of the first span on which the body comes nearer to a world than it may, if one does.

    Args:
        curve: What is driven.
        world: What to keep clear of.
        required: The distance that the curve itself is to keep [m].
        requirements: The body.
    """
    blocked = np.flatnonzero(conflicts_within(required, world, curve.spans, requirements) != CLEAR)
    return int(blocked[0]) if blocked.size else None
