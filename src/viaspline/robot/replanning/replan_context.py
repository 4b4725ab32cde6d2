"""A robot under way that may need a new path: where it can stop, and where it may turn off."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from viaspline.curve.path import PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.checking.conflicts import CLEAR, conflicts_within
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.sides_ahead import spans_on_wrong_side
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import SAME_PLACE_M, Progress
from viaspline.robot.navigation.schedule import Schedule, vias_after
from viaspline.robot.run import Event
from viaspline.world.world import World

PATH_END_U = 1e-9
"""A via point whose parameter is nearer than this to the path's end is the goal."""


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
        speed: Of the robot [m/s].
        stop: Where the robot stands if it brakes now, as a distance along the path [m].
        leaves: Where a new path may leave this one without a stop, the nearest place first [m].
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
    speed: float
    stop: float
    leaves: tuple[float, ...]
    floor: float

    @classmethod
    def of(
        cls, task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule
    ) -> ReplanContext:
        """A robot as it is now, with nothing in its way."""
        distance, path, trajectory = progress.distance, schedule.path, schedule.trajectory
        speed, rest = 0.0, distance
        if progress.dwell is None:
            speed = float(trajectory.state_at(progress.time)[1])
            rest = trajectory.next_rest(distance + SAME_PLACE_M)
        stop = min(distance + speed * speed / (2.0 * task.limits.brake), rest)
        reaction = speed * task.reaction
        leaves = {min(distance + reaction, rest): None}
        if task.limits.max_lateral_accel is not None:
            leaves[min(stop + reaction, rest)] = None  # it may be slow enough for a sharper bend
        if knowledge.belief is not None:
            leaves[stop] = None  # there it may have seen enough of another way
        until = schedule.looked_at
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
            speed=speed,
            stop=stop,
            leaves=tuple(leaves),
            floor=kept[0][2],
        )

    def is_goal(self, via: PathVia) -> bool:
        """Whether the drive ends at a point of the route, in this lap or a later one."""
        assert via.index is not None
        laps = self.schedule.laps
        if laps is not None:
            return laps.is_goal(via.index)
        return via.u >= self.schedule.path.domain[1] - PATH_END_U

    def free_until(self, world: World) -> float | None:
        """Start of the first span ahead that comes too close to a world [m]; None if none does."""
        path = self.schedule.path
        for start, u, part, floor in self.parts_ahead():
            conflict = _first_conflict(part, world, floor, self.requirements)
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
        wrong = spans_on_wrong_side(path, float(path.parameter(here)), world, self.requirements)
        return max(here, float(path.distance(float(min(wrong))))) if wrong else None

    def in_the_way(self, world: World) -> tuple[str, ...]:
        """Names of what a world has in the way of the path ahead, one for each span."""
        found = [
            conflicts_within(floor, world, part.spans, self.requirements).tolist()
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

    def is_clear(self, place: float) -> bool:
        """Whether the path keeps its distance from what is in the way up to a place [m]."""
        path, world, start = self.schedule.path, self.obstruction.world, self.obstruction.free_until
        if place < start:
            return True
        if place - start <= SAME_PLACE_M:
            point = np.asarray(path.at_distance(place))
            return float(world.distance(point)) >= self.floor - SAME_PLACE_M
        first, last = np.asarray(path.parameter(np.array([start, place]))).tolist()
        part = path.section(first, last)
        return _first_conflict(part, world, self.floor, self.requirements) is None

    def clear_leaves(self) -> list[float]:
        """Where a new path can leave this one while the robot rolls on [m]."""
        turns = self.schedule.turns
        return [
            leave
            for leave in self.leaves
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
