"""The time laws of a fleet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.trajectory.law_at_nodes import law_at_nodes
from viaspline.trajectory.trajectory import Trajectory


@told_in_lines
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
