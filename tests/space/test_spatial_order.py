"""The order of via points in space, against all orders by a cost of the test's own."""

from __future__ import annotations

import math
from itertools import pairwise, permutations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.errors import NoPathError
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


def test_no_order_comes_down_through_a_roof_to_where_it_lands() -> None:
    """Coming from the high point would be shorter, but for the roof over the landing."""
    roof = {"box": {"min": [36, -4, 10], "max": [46, 4, 11]}}
    asked = Mission.model_validate({
        "world": {"ground": {"flat_m": 0}, "known": [roof]},
        "robot": {"radius_m": 0.4, "half_height_m": 0.2},
        "route": {"start": [0, 0, 4], "via": [[10, 0, 4], [22, 0, 20]],
                  "land": {"at": [41, 0]}, "order": "shortest"},
    })  # fmt: skip
    assert [via.at[0] for via in ordered_in_space(asked).route.via] == [22, 10]
    assert vs.plan(asked).certificate.holds


def test_via_points_keep_the_names_of_their_places_in_the_given_order() -> None:
    asked = mission([(0, 0, 5), (30, 0, 5), (10, 0, 5), (40, 0, 5)])
    assert [via.name for via in ordered_in_space(asked).route.via] == ["via 2", "via 1"]


GATES = st.lists(
    st.tuples(st.integers(0, 60), st.integers(0, 60), st.integers(3, 40), st.integers(-170, 180),
              st.booleans()),
    min_size=1, max_size=5, unique_by=lambda row: row[:2],
)  # fmt: skip


def asked_through(rows: list[tuple[int, int, int, int, bool]], **route: object) -> Mission:
    """A flight in the best order through places and gates, each x, y, z, facing, whether a gate."""
    via = [
        {"gate": {"at": [x, y, z], "facing_deg": facing, "width_m": 3, "height_m": 3}}
        if is_gate
        else {"at": [x, y, z]}
        for x, y, z, facing, is_gate in rows
    ]
    whole = {"start": [-9, -9, 9], "via": via, "order": "shortest", **route}
    return Mission.model_validate({"robot": {"radius_m": 0.3}, "route": whole})


@settings(max_examples=15)
@given(rows=GATES, closed=st.booleans(), objective=st.sampled_from(["length", "time"]))
def test_what_is_planned_through_gates_in_the_best_order_is_a_sound_mission_and_exported(
    rows: list[tuple[int, int, int, int, bool]], closed: bool, objective: str, tmp_path_factory: Any
) -> None:
    ends = {"closed": True} if closed else {"goal": [70, 20, 9]}
    try:
        plan = vs.plan(asked_through(rows, optimise=objective, **ends))
    except (vs.MissionError, NoPathError):
        assert any(is_gate for *_, is_gate in rows)  # which every order passes backwards
        return
    written = plan.mission.model_dump(mode="json", exclude_unset=True)
    assert Mission.model_validate(written) == plan.mission
    vs.export(plan, tmp_path_factory.mktemp("order") / "flight.csv")


def test_what_is_planned_through_gates_in_the_best_order_can_be_saved_and_loaded(
    tmp_path: Path,
) -> None:
    rows = [(25, 0, 5, 0, False), (10, 0, 5, 180, True)]
    plan = vs.plan(asked_through(rows, goal=[40, 0, 5]))
    plan.save(tmp_path)
    assert vs.load_plan(tmp_path) == plan


def test_gates_that_no_order_passes_forwards_are_refused_by_name() -> None:
    def gate(x: float, y: float, facing: float) -> dict[str, object]:
        return {"gate": {"at": [x, y, 5], "facing_deg": facing, "width_m": 3, "height_m": 3}}

    # Each would do, were the other one passed on the right side of it.
    route = {"start": [50, 50, 5], "via": [gate(0, 60, 90), gate(30, 70, 180)],
             "goal": [80, 10, 5], "order": "shortest"}  # fmt: skip
    with pytest.raises(NoPathError, match="every order of the via points passes a gate backwards"):
        ordered_in_space(Mission.model_validate({"robot": {"radius_m": 0.3}, "route": route}))


def test_gates_among_very_many_via_points_are_passed_forwards() -> None:
    rng = np.random.default_rng(7)
    via = [
        {"gate": {"at": [*at, 9], "facing_deg": float(facing), "width_m": 3, "height_m": 3}}
        for at, facing in zip(
            rng.uniform(0, 200, (60, 2)).tolist(), rng.uniform(-180, 180, 60), strict=True
        )
    ]
    route = {"start": [0, 0, 9], "via": via, "goal": [210, 0, 9], "order": "shortest"}
    asked = Mission.model_validate({"robot": {"radius_m": 0.3}, "route": route})
    given = ordered_in_space(asked).model_dump(mode="json", exclude_defaults=True)
    assert Mission.model_validate(given).route.order == "given"  # or a gate would face away


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
