"""The courses of a fleet of which some robots have another path than before."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from viaspline.fleet.courses import AnyPlan, FleetCourses, courses_of
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.packed_courses import PackedCourses


def renewed_courses(
    before: FleetCourses, plans: Mapping[str, AnyPlan], separation: float, changed: Ints
) -> FleetCourses:
    """Courses of which some are cut anew; the same as if all of them were.

    Args:
        before: The courses as they were.
        plans: By the names of the same robots, in the same order.
        separation: Free space between any two bodies, the same as before [m].
        changed: The robots whose plans aren't those that were cut before, increasing, (k,).

    Example:
        >>> from viaspline.mission.model import Mission
        >>> from viaspline.planner import plan
        >>> to = lambda x: plan(
        ...     Mission.model_validate({"route": {"start": [0, 0], "goal": [x, 0]}}))
        >>> plans = {"a": to(9), "b": to(5)}
        >>> courses = courses_of(plans, 1.0)
        >>> longer = renewed_courses(courses, {**plans, "b": to(8)}, 1.0, np.array([1]))
        >>> [longer.packed.distance[last - 1].item() for last in longer.packed.first[1:]]
        [9.0, 8.0]
    """
    names = tuple(plans)
    fresh = courses_of({names[k]: plans[names[k]] for k in changed.tolist()}, separation)
    at = {robot: k for k, robot in enumerate(changed.tolist())}
    own = [(fresh, at[robot]) if robot in at else (before, robot) for robot in range(len(names))]
    parts = [(courses.packed, k) for courses, k in own]
    bodies = [courses.bodies[k] for courses, k in own if courses.bodies is not None]
    slices = [(packed, slice(packed.first[k], packed.first[k + 1])) for packed, k in parts]

    def joined(key: str) -> Floats:
        return np.concatenate([getattr(packed, key)[part] for packed, part in slices])

    sizes = [part.stop - part.start for _, part in slices]
    return FleetCourses(
        names,
        PackedCourses(
            first=np.cumsum([0, *sizes], dtype=np.int64),
            distance=joined("distance"),
            place=joined("place"),
            bow=joined("bow"),
            reach=np.array([packed.reach[k] for packed, k in parts]),
        ),
        np.array(bodies) if bodies else None,
    )
