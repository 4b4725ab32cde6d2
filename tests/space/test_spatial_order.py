"""The order of via points in space, against all orders by a cost of the test's own."""

from __future__ import annotations

import math
from itertools import pairwise, permutations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.mission.model import Mission
from viaspline.space.spatial_order import ordered_in_space

Place = tuple[float, float, float]
SPEED, UP, DOWN = 8.0, 2.0, 1.0

places = st.lists(
    st.tuples(st.integers(0, 60), st.integers(0, 60), st.integers(3, 40)),
    min_size=4, max_size=6, unique=True,
)  # fmt: skip


def seconds(a: Place, b: Place) -> float:
    """What a straight way takes at best."""
    rise = b[2] - a[2]
    return max(math.dist(a, b) / SPEED, rise / UP, -rise / DOWN)


def mission(points: list[Place], **route: object) -> Mission:
    start, *via, goal = (list(map(float, point)) for point in points)
    return Mission.model_validate({
        "robot": {"radius_m": 0.3, "max_speed_mps": SPEED, "max_climb_mps": UP,
                  "max_descent_mps": DOWN},
        "route": {"start": start, "via": via, "goal": goal, "order": "shortest", **route},
    })  # fmt: skip


def total(points: list[Place], objective: str) -> float:
    return sum(math.dist(a, b) if objective == "length" else seconds(a, b)
               for a, b in pairwise(points))  # fmt: skip


@settings(max_examples=25)
@given(points=places, objective=st.sampled_from(["length", "time"]))
def test_where_nothing_stands_no_order_of_the_via_points_costs_less(
    points: list[Place], objective: str
) -> None:
    asked = mission(points, optimise=objective)
    found = [points[0], *(via.at for via in ordered_in_space(asked).route.via), points[-1]]
    least = min(
        total([points[0], *order, points[-1]], objective) for order in permutations(points[1:-1])
    )
    assert total(found, objective) <= least + 1e-6  # type: ignore[arg-type]


def test_a_round_with_a_wall_visits_what_is_on_one_side_of_it_first() -> None:
    wall = {"box": {"min": [-2, -200, 0], "max": [2, 40, 300]}}
    data = {
        "world": {"known": [wall], "altitude": {"max_m": 60}, "ground": {"flat_m": 0}},
        "robot": {"radius_m": 0.3},
        "route": {"start": [-30, -20, 10], "via": [[6, -20, 10], [-6, -20, 10], [6, -40, 10],
                  [-6, -40, 10]], "goal": [30, -20, 10], "order": "shortest"},
    }  # fmt: skip
    plan = vs.plan(Mission.model_validate(data))
    sides = [math.copysign(1, via.at[0]) for via in plan.mission.route.via]
    assert sides == [-1, -1, 1, 1]
    assert plan.certificate.holds


def test_a_landing_counts_with_what_it_descends() -> None:
    data = {
        "world": {"ground": {"flat_m": 0}},
        "robot": {"max_speed_mps": SPEED, "max_climb_mps": UP, "max_descent_mps": DOWN},
        "route": {"start": [0, 0, 2], "via": [[20, 0, 4], [22, 0, 60]],
                  "land": {"at": [42, 0]}, "order": "shortest"},
    }  # fmt: skip
    order = ordered_in_space(Mission.model_validate(data)).route.via
    heights = [via.at[2] for via in order]
    assert heights == [60, 4]  # descending takes twice as long, but has to be done in either order


def test_via_points_keep_the_names_of_their_places_in_the_given_order() -> None:
    asked = mission([(0, 0, 5), (30, 0, 5), (10, 0, 5), (40, 0, 5)])
    assert [via.name for via in ordered_in_space(asked).route.via] == ["via 2", "via 1"]


def test_a_given_order_is_kept() -> None:
    asked = mission([(0, 0, 5), (30, 0, 5), (10, 0, 5), (40, 0, 5)], order="given")
    assert ordered_in_space(asked) is asked


def test_very_many_via_points_are_put_in_a_short_order() -> None:
    rng = np.random.default_rng(3)
    shuffled = [(float(k), 0.0, 5.0 + 0.1 * k) for k in rng.permutation(np.arange(1, 80))]
    asked = mission([(0, 0, 5), *shuffled, (90, 0, 14)])  # type: ignore[list-item]
    xs = [via.at[0] for via in ordered_in_space(asked).route.via]
    assert xs == sorted(xs)


def test_the_order_in_space_is_not_said_to_be_the_best() -> None:
    from viaspline.planning.routing.visit_order import is_surely_shortest

    assert not is_surely_shortest(mission([(0, 0, 5), (30, 0, 5), (10, 0, 5), (40, 0, 5)]))
