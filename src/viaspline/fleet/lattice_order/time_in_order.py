"""The laws of a fleet by the order in which its robots pass each other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.lattice_order.lattice_paths import PassingSteps
from viaspline.fleet.lattice_order.passing_orders import passing_orders
from viaspline.fleet.lattice_order.untangled_orders import untangled_orders
from viaspline.fleet.timing.rides import FleetRides
from viaspline.fleet.timing.time_paths import Timing, standing_laws
from viaspline.kernels.arrays import Ints
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.rides_in_order import rides_in_order
from viaspline.kernels.fleet.yielding_ride import CLEAR, timed_in_order

ROUNDS = 400
"""In which rides are reckoned, at most."""


def time_in_order(
    courses: FleetCourses,
    crossings: FleetCrossings,
    rides: FleetRides,
    steps: Sequence[PassingSteps],
) -> Timing:
    """Time robots along their paths so that they pass in the order of a lattice.

    Those whose orders have a circle that can't be undone are timed after all others, and let them
    pass.

    Args:
        courses: Their paths.
        crossings: Where these come near each other.
        rides: How they drive alone.
        steps: At which step each robot is where, in the order of the courses.

    Returns:
        The laws of all. ``blocked`` names robots that have none; where the order of others could
        not be kept in so many rounds it names these, and the laws are not clear of each other.
    """
    orders = passing_orders(courses, crossings, steps, rides.packed.vanishes)
    second, circular = untangled_orders(courses, crossings, orders)
    second &= ~circular[crossings.packed.other]
    ends = np.array([one.steps[-1] for one in steps])
    order = np.argsort(ends, kind="stable").astype(np.int64)
    laws = standing_laws(courses)
    led = order[~circular[order]]
    keeps = rides_in_order(
        courses.packed, crossings.packed, rides.packed, laws.packed, second, led, ROUNDS
    )
    if not keeps.all():
        return Timing(laws, {robot: robot for robot in np.flatnonzero(~keeps | circular).tolist()})
    return Timing(
        laws, _timed_after(courses, crossings, rides, laws.packed, order[circular[order]])
    )


def _timed_after(
    courses: FleetCourses, crossings: FleetCrossings, rides: FleetRides, laws: PackedLaws,
    robots: Ints,
) -> dict[int, int]:  # fmt: skip
    """Time robots after all others. Those that can't let these pass, each with one of them.

    Args:
        courses: The paths.
        crossings: Where they come near each other.
        rides: How robots drive alone.
        laws: Of the others; written to.
        robots: Which, in their order, (k,).
    """
    if not robots.size:
        return {}
    packed = crossings.packed
    passages = passages_of(courses.packed, packed)
    boxes = timed_in_order(courses.packed, packed, passages, rides.packed, laws, robots)
    failed = boxes != CLEAR
    others = packed.other[boxes[failed]].tolist()
    return dict(zip(robots[failed].tolist(), others, strict=True))
