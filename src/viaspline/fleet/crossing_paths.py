"""The paths of a fleet and where they come near each other: all that timing starts from.

Of a fleet that was prepared before, only what is asked for anew is laid, cut and compared.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.courses import FleetCourses, courses_of
from viaspline.fleet.crossings import FleetCrossings, crossings_of
from viaspline.fleet.laying.alone_paths import AlonePaths
from viaspline.fleet.laying.laid_pieces import THIS_PROCESS, LayingProgress
from viaspline.fleet.laying.lay_paths import LaidPaths, lay_paths
from viaspline.fleet.laying.laying_workers import LayingWorkers
from viaspline.fleet.renewed_courses import renewed_courses
from viaspline.fleet.renewed_crossings import renewed_crossings
from viaspline.fleet.still_world import without_motion
from viaspline.kernels.arrays import Ints
from viaspline.mission.fleet.fleet import Fleet


@dataclass(frozen=True, eq=False)
class CrossingPaths:
    """Paths of a fleet, cut into cells, and where they come near each other.

    Attributes:
        laid: The paths; the robots that have none aren't among the courses.
        separation: Free space between any two bodies [m].
        courses: The paths, cut into cells.
        crossings: Where they come near each other.
    """

    laid: LaidPaths
    separation: float
    courses: FleetCourses
    crossings: FleetCrossings


def crossing_paths(
    fleet: Fleet,
    progress: LayingProgress | None = None,
    before: CrossingPaths | None = None,
    workers: LayingWorkers = THIS_PROCESS,
    alone: AlonePaths | None = None,
) -> CrossingPaths:
    """Lay the paths of a fleet as if nothing moved, and find where they come near each other.

    Args:
        fleet: What is asked for.
        progress: Hears how many paths are laid, and how many there are.
        before: What was found of an earlier state of the fleet; what is found is the same without
            it.
        workers: Who lays the paths; these don't depend on that.
        alone: What each robot does if it is alone, if that is known.

    Raises:
        GeometryError: It is a fleet in space, whose paths ``plan_fleet`` lays.
        GaveUpError: Too many robots pass one place.
        WorkersError: The workers died.

    Example:
        >>> data = {"separation_m": 1, "fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
        ...     {"name": "b", "route": {"start": [20, -20], "goal": [20, 20]}},
        ... ]}
        >>> first = crossing_paths(Fleet.model_validate(data))
        >>> data["fleet"][1]["route"]["goal"] = [25, 20]
        >>> then = crossing_paths(Fleet.model_validate(data), before=first)
        >>> [then.laid.plans[name] is first.laid.plans[name] for name in ("a", "b")]
        [True, False]
    """
    if fleet.is_spatial:
        raise GeometryError("this is a fleet in space; give plan_fleet(fleet) or viaspline plan")
    fleet = without_motion(fleet)
    kept = None if before is None else before.laid.kept
    laid = lay_paths(fleet, progress, kept, workers, alone)
    separation, plans = fleet.separation_m, laid.plans
    changed = _changed(laid, separation, before)
    if before is None or changed is None:
        courses = courses_of(plans, separation)
        return CrossingPaths(laid, separation, courses, crossings_of(courses))
    if not changed.size:
        return CrossingPaths(laid, separation, before.courses, before.crossings)
    courses = renewed_courses(before.courses, plans, separation, changed)
    crossings = renewed_crossings(before.crossings, before.courses, courses, changed)
    return CrossingPaths(laid, separation, courses, crossings)


def _changed(laid: LaidPaths, separation: float, before: CrossingPaths | None) -> Ints | None:
    """The robots that have other paths than before; None if it is another fleet.

    Paths that weren't laid again are the same objects.
    """
    if before is None or before.separation != separation:
        return None
    known = before.laid.plans
    if tuple(known) != tuple(laid.plans):
        return None
    changed = [plan is not known[name] for name, plan in laid.plans.items()]
    return np.flatnonzero(changed).astype(np.int64)
