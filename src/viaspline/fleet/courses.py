"""The paths of a fleet as the courses that its robots drive, cut into cells."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.handed_in import number_from
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet import cut_courses as columns
from viaspline.kernels.fleet.cut_courses import cut_courses
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_paths import PackedPaths
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.planner import Plan
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.space.meeting.gap_of_bodies import SpatialCourses
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.trajectory.trajectory import Trajectory

END_CELL_M = 0.01
"""Length of the first and of the last cell of a course [m]."""
SAME_KNOT_M = 1e-7
"""Knots that are no farther apart are one [m]."""
ROUNDED_M = 1e-11
"""By which a place along a path that was reckoned otherwise may differ [m]."""
AnyPlan: TypeAlias = Plan | SpatialPlan
"""Of a robot in the plane, or of one in space."""

OFF_PATH_SHARE = 1e-9
"""Of a path's length, by which its time law may end beyond it by rounding."""


@told_in_lines
@dataclass(frozen=True, eq=False)
class FleetCourses(ComparedByValue):
    """Paths of robots, cut into cells.

    Attributes:
        names: The robots, in the order of the courses.
        packed: The courses as kernels see them. In space its places have three columns, and its
            reaches are what robots take up seen from above.
        bodies: In space the upright cylinders of the robots, radius and half height, and what is
            kept about them, half of the separation included [m], (n, 3); None in the plane.
    """

    names: tuple[str, ...]
    packed: PackedCourses
    bodies: Floats | None = None

    def in_space(self) -> SpatialCourses:
        """Courses in space, all of which are there all the time."""
        assert self.bodies is not None, "courses in space have bodies"
        there = np.ones(len(self.packed.distance), np.bool_)
        return SpatialCourses(self.names, self.packed, self.bodies, there)


@dataclass(frozen=True, eq=False)
class FleetPath(ComparedByValue):
    """What becomes a course: a path, and how far its robot keeps others away.

    Attributes:
        path: What is driven, all of its laps.
        knots: Distances along it that have to be nodes, not decreasing [m], (k,).
        reach: Of the robot, with its half of the separation [m]; see ``PackedCourses``.
        body: In space its row of ``FleetCourses.bodies``; None in the plane.
    """

    path: PiecewiseCubic
    knots: Floats
    reach: float
    body: tuple[float, float, float] | None = None


NO_LAWS: Mapping[str, Trajectory] = MappingProxyType({})


def courses_of(
    plans: Mapping[str, AnyPlan],
    separation: float,
    laws: Mapping[str, Trajectory] = NO_LAWS,
) -> FleetCourses:
    """The paths of plans, cut into cells; the time laws of the plans change at nodes alone.

    Args:
        plans: By the names of their robots.
        separation: Free space between any two bodies [m].
        laws: Other time laws along these paths, by name, which change at nodes alone as well.

    Returns:
        Courses in the order of the plans. A robot's reach is the smallest circle about its
        reference point that holds its body, what it gets beside its path, and half of the
        separation.

    Raises:
        GeometryError: The separation is no finite number of 0 or more.

    Example:
        >>> from viaspline.mission.model import Mission
        >>> from viaspline.planner import plan
        >>> route = {"start": [0, 0], "via": [[5, 3]], "goal": [9, 0]}
        >>> courses = courses_of({"r1": plan(Mission.model_validate({"route": route}))}, 1.0)
        >>> courses.names, courses.packed.reach
        (('r1',), array([1.]))
        >>> bool(np.diff(courses.packed.distance).max() <= 0.5)
        True
    """
    separation = number_from("separation", separation)
    if not 0.0 <= separation < np.inf:
        raise GeometryError(f"separation is {separation} m; give a finite distance of 0 or more")
    paths = [
        fleet_path(plan, separation, *([laws[name].distances] if name in laws else []))
        for name, plan in plans.items()
    ]
    return courses_along(tuple(plans), paths)


def fleet_path(plan: AnyPlan, separation: float, *knots: Floats) -> FleetPath:
    """The path of a plan, as it is to be cut.

    Args:
        plan: Its time law changes at nodes alone.
        separation: Free space between any two bodies [m].
        knots: Other distances that have to be nodes, not decreasing [m].
    """
    places = plan.trajectory.distances
    for more in knots:
        places = _joined(places, more)
    robot, half = plan.mission.robot, 0.5 * separation
    cuts = _with_short_ends(places, plan.path.length)
    if isinstance(plan, SpatialPlan):
        flying = FlyingBody.of(robot)
        kept = flying.margin + half
        body = (flying.radius, flying.half_height, kept)
        return FleetPath(plan.path, cuts, flying.radius + kept, body)
    return FleetPath(plan.path, cuts, robot.outer_radius + plan.tracking_error + half)


def path_cut_at(plan: AnyPlan, separation: float, nodes: Floats) -> FleetPath:
    """The path of a plan, to be cut at the very nodes of a course of it.

    It is cut as well where its law changes far from all of them. Of nodes that differ by rounding
    alone, as those of two laws that were reckoned otherwise, each is kept.

    Args:
        plan: With its time law.
        separation: Free space between any two bodies [m].
        nodes: Distances, not decreasing [m], (k,).
    """
    path = fleet_path(plan, separation)
    return replace(path, knots=_joined(nodes, path.knots))


def courses_along(names: Sequence[str], paths: Sequence[FleetPath]) -> FleetCourses:
    """Paths cut into cells: at their knots, where spans meet, and in between.

    Cells are at most 0.5 m long. They are halved while a bound of how far the curve is from the
    evenly driven chord is above 0.02 m, where the curvature allows that.

    Args:
        names: Of the robots.
        paths: Theirs.

    Raises:
        GeometryError: A knot lies beyond the end of its path, or some paths are in the plane and
            others in space.
    """
    for name, one in zip(names, paths, strict=True):
        length = one.path.length
        if one.knots.size and one.knots[-1] > length + OFF_PATH_SHARE * (1.0 + length):
            raise GeometryError(
                f"the time law of '{name}' ends at {one.knots[-1]:g} m of a path of {length:g} m; "
                "give the law of this path"
            )
    if not paths:
        return FleetCourses((), _empty())
    if len({one.body is None for one in paths}) > 1:
        raise GeometryError("some paths are in the plane and others in space; give one kind")
    tables = [one.path.packed_length for one in paths]
    rows, at, along = (tuple(parts) for parts in zip(*tables, strict=True))
    knots = tuple(one.knots for one in paths)
    packed = PackedPaths(
        np.concatenate(rows), _firsts(rows), np.concatenate(at), np.concatenate(along),
        _firsts(at), np.concatenate(knots), _firsts(knots),
    )  # fmt: skip
    nodes, first = cut_courses(packed)
    flown = [one.body for one in paths if one.body is not None]
    place = nodes[:, columns.X : columns.Y + 1].copy()
    if flown:
        place = _places_in_space(paths, nodes[:, columns.DISTANCE], first)
    return FleetCourses(
        tuple(names),
        PackedCourses(
            first=first,
            distance=nodes[:, columns.DISTANCE].copy(),
            place=place,
            bow=nodes[:, columns.BOW].copy(),
            reach=np.array([one.reach for one in paths]),
        ),
        np.array(flown) if flown else None,
    )


def _places_in_space(paths: Sequence[FleetPath], distance: Floats, first: Ints) -> Floats:
    """The nodes on curves in space [m], (nodes, 3)."""
    return np.concatenate(
        [
            np.asarray(one.path.at_distance(np.minimum(distance[a:b], one.path.length)))
            for one, a, b in zip(paths, first[:-1].tolist(), first[1:].tolist(), strict=True)
        ]
    )


def _joined(knots: Floats, more: Floats) -> Floats:
    """Knots, and those of others that aren't as good as there.

    Of two others that are near one knot both are kept: between them a speed may change at once.
    """
    at = np.searchsorted(knots, more)
    low, high = np.maximum(at - 1, 0), np.minimum(at, len(knots) - 1)
    nearest = np.where(more - knots[low] < knots[high] - more, low, high)
    off = np.abs(more - knots[nearest])
    is_step = (np.diff(nearest) == 0) & (np.diff(more) > ROUNDED_M)
    is_step &= np.maximum(off[1:], off[:-1]) <= SAME_KNOT_M
    is_two = np.append(is_step, False) | np.append(False, is_step)
    is_new = (off > SAME_KNOT_M) | (is_two & (off > ROUNDED_M))
    return np.sort(np.concatenate([knots, more[is_new]]))


def _with_short_ends(knots: Floats, length: float) -> Floats:
    """Knots, and two more that make the first and the last cell short.

    A robot that stands at an end counts as one that is anywhere in that cell.
    """
    if length <= 4.0 * END_CELL_M:
        return knots
    return _joined(knots, np.array([END_CELL_M, length - END_CELL_M]))


def _firsts(arrays: Sequence[Floats]) -> Ints:
    """Where each array begins in all of them behind each other, and where the last one ends."""
    return np.cumsum([0, *(len(array) for array in arrays)], dtype=np.int64)


def _empty() -> PackedCourses:
    none = np.zeros(0)
    return PackedCourses(np.zeros(1, np.int64), none, np.zeros((0, 2)), none.copy(), none.copy())
