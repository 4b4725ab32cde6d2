"""The time laws of a fleet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.trajectory.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
class FleetLaws(ComparedByValue):
    """When every robot of a fleet is where.

    Attributes:
        packed: As kernels see them.
    """

    packed: PackedLaws


def static_laws(courses: FleetCourses, trajectories: Sequence[Trajectory]) -> FleetLaws:
    """The laws of robots that heed nobody, at the nodes of their courses.

    They are exact, for every point of a trajectory is a node. All robots stay at their goals.

    Args:
        courses: Their paths, cut into cells.
        trajectories: Of each robot, in the order of the courses.

    Example:
        >>> from viaspline.curve.path import Path
        >>> from viaspline.fleet.courses import FleetPath, courses_along
        >>> from viaspline.trajectory.limits import Limits, Station
        >>> from viaspline.trajectory.retime import retime
        >>> path = Path([[[0, 0], [1, 0], [2, 0], [3, 0]]], vias=[])
        >>> law = retime(path, Limits(max_speed=1, max_accel=1), [Station(1.0, dwell=5.0)])
        >>> courses = courses_along(["a"], [FleetPath(path, law.distances, reach=1.0)])
        >>> packed = static_laws(courses, [law]).packed
        >>> node = courses.packed.distance.tolist().index(1.0)
        >>> [float(one[node]) for one in (packed.arrive, packed.leave, packed.speed)]
        [2.0, 7.0, 0.0]
    """
    packed = courses.packed
    arrive, leave, speed = (np.empty_like(packed.distance) for _ in range(3))
    for k, trajectory in enumerate(trajectories):
        part = slice(packed.first[k], packed.first[k + 1])
        arrive[part], leave[part], speed[part] = law_at_nodes(trajectory, packed.distance[part])
    is_timed = np.ones(len(courses.names), dtype=np.bool_)
    return FleetLaws(PackedLaws(arrive, leave, speed, is_timed))


def law_at_nodes(law: Trajectory, nodes: Floats) -> tuple[Floats, Floats, Floats]:
    """When a robot comes to nodes, when it goes on, and how fast it is there, (k,) each.

    Args:
        law: It stands at its start from its first time on, and at its end for ever.
        nodes: Distances, from the start to the end [m], (k,).
    """
    come, speed = law.time_at(nodes), law.speed_at(nodes)
    first = np.minimum(law.distances.searchsorted(nodes, side="left"), len(law.times) - 1)
    last = np.maximum(law.distances.searchsorted(nodes, side="right") - 1, 0)
    known = law.distances[first] == nodes
    arrive = np.where(known, law.times[first], come)
    leave = np.where(known, law.times[last], come)
    speed = np.where(known, law.speeds[last], speed)
    arrive[0], leave[-1] = law.times[0], np.inf
    return arrive, leave, speed
