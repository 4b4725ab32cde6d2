"""Orders that go round in a circle, and the same with other ones at hand."""

import numpy as np
from straight_fleets import REACH, Line, courses_on, crossings_on

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings, box_owners
from viaspline.fleet.lattice_order.passing_orders import PassingOrders
from viaspline.fleet.lattice_order.untangled_orders import untangled_orders

TRIANGLE: list[Line] = [
    ((-20.0, 0.0), (40.0, 0.0)), ((25.0, -10.0), (-5.0, 35.0)), ((15.0, 35.0), (-5.0, -20.0))
]  # fmt: skip
"""Each comes to the next one's line first, and then to that of the one before."""


def orders_of(courses, crossings, first, forced=False):
    """Orders by who passes each crossing first."""
    robot = box_owners(crossings)
    second = robot != np.array(first)[crossings.crossing]
    along = np.stack(
        [courses.distance[crossings.cell], courses.distance[crossings.cell + 1]], axis=1
    )
    beside = np.stack([crossings.low, crossings.high], axis=1)
    is_lower = robot == crossings.robots[crossings.crossing, 0]
    settled, clear = np.full(second.size, forced), np.ones(len(crossings.robots))
    return PassingOrders(second, second, settled, is_lower, along, beside, clear)


def found_of(forced):
    courses = courses_on(TRIANGLE, REACH)
    crossings = crossings_on(courses)
    pairs = [tuple(pair) for pair in crossings.robots.tolist()]
    some = []
    for winners in ({(0, 1): 1, (0, 2): 0, (1, 2): 2}, {(0, 1): 0, (0, 2): 2, (1, 2): 1}):
        orders = orders_of(courses, crossings, [winners[pair] for pair in pairs], forced)
        fleet = FleetCourses(("a", "b", "c"), courses)
        second, circular = untangled_orders(fleet, FleetCrossings(crossings), orders)
        some.append((orders, second, circular, crossings))
    return some


def test_a_circle_is_undone_by_another_order_at_one_crossing() -> None:
    changed = []
    for orders, second, circular, crossings in found_of(forced=False):
        assert not circular.any()
        changed.append(len(np.unique(crossings.crossing[second != orders.second])))
        lower, upper = orders.is_lower, ~orders.is_lower
        for k in range(len(crossings.robots)):
            of_it = crossings.crossing == k
            assert (second[of_it & lower].all() and not second[of_it & upper].any()) or (
                second[of_it & upper].all() and not second[of_it & lower].any()
            )
    assert sorted(changed) == [0, 1]


def test_orders_that_are_forced_stay_and_the_robots_of_their_circle_are_told() -> None:
    told = []
    for orders, second, circular, _ in found_of(forced=True):
        assert (second == orders.second).all()
        told.append(circular.tolist())
    assert sorted(told) == [[False] * 3, [True] * 3]
