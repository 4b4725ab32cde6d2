"""A crossing in which now the one and now the other passes first is two."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.common_parts import common_parts
from viaspline.kernels.fleet.crossing_leaders import crossing_leaders
from viaspline.kernels.fleet.packed_crossings import PackedCrossings


@pytest.fixture(scope="module")
def planned() -> FleetPlan:
    """One crosses the other's path twice: before that one comes, and after it has passed."""
    straight = {"start": [0, 0], "via": [{"at": [30, 0], "dwell_s": 90}], "goal": [60, 0]}
    arch = {"start": [10, -30], "via": [[10, 20], [50, 20]], "goal": [50, -30]}
    data = [{"name": "straight", "route": straight}, {"name": "arch", "route": arch}]
    return vs.plan_fleet(vs.Fleet.model_validate({"separation_m": 1, "fleet": data}))


def as_one(crossings: FleetCrossings) -> FleetCrossings:
    """Crossings of two robots taken for a single one."""
    packed = crossings.packed
    span = packed.span
    whole = [span[:, 0].min(), span[:, 1].max(), span[:, 2].min(), span[:, 3].max()]
    return replace(
        crossings,
        parts=packed._replace(
            robots=packed.robots[:1], span=np.array([whole]), crossing=0 * packed.crossing
        ),
    )


def test_orders_that_differ_divide_a_crossing(planned: FleetPlan) -> None:
    assert [one.first for one in planned.precedences] == ["straight", "arch"]
    apart = planned.crossings.packed
    found = ordered_crossings(planned.courses, as_one(planned.crossings), planned.laws).packed
    assert found.robots.tolist() == [[0, 1], [0, 1]]
    order = np.argsort(found.span[:, 0])  # along the first one's path
    assert np.abs(found.span[order] - apart.span).max() < 1.0  # whole cells for exact ends
    assert sorted(np.bincount(found.crossing)) == sorted(np.bincount(apart.crossing))


def test_crossings_with_one_order_stay_what_they_are(planned: FleetPlan) -> None:
    crossings = planned.crossings
    assert ordered_crossings(planned.courses, crossings, planned.laws) is crossings


PLACES = st.tuples(st.integers(0, 12), st.integers(0, 12)).map(lambda at: [4.0 * c for c in at])
ROUTES = st.lists(PLACES, min_size=3, max_size=6, unique_by=tuple)


def sampled(planned: FleetPlan, robot: int) -> tuple[Floats, Floats, Floats]:
    """Places each quarter metre along a path [m], from when to when a robot is there [s] (2, k).

    And where they are, (k, 2).
    """
    courses, laws = planned.courses.packed, planned.laws.packed
    begin, end = courses.first[robot], courses.first[robot + 1]
    nodes = courses.distance[begin:end]
    places = np.arange(0.0, nodes[-1], 0.25)
    both = np.column_stack([laws.arrive, np.minimum(laws.leave, 1e9)])[begin:end].ravel()
    times = [np.interp(places + by, np.repeat(nodes, 2), both) for by in (-1e-9, 1e-9)]
    path = planned.plans[planned.courses.names[robot]].path
    return places, np.array(times), path.at_distance(places)


def sooner(planned: FleetPlan, seconds: float) -> FleetLaws:
    """The laws of a plan of two robots, the second of which sets out sooner."""
    packed = planned.laws.packed
    arrive, leave = packed.arrive.copy(), packed.leave.copy()
    arrive[planned.courses.packed.first[1] :] -= seconds
    leave[planned.courses.packed.first[1] :] -= seconds
    return FleetLaws(packed._replace(arrive=arrive, leave=leave))


def crossings_in(
    planned: FleetPlan, found: PackedCrossings, robot: int, place: float, other: float
) -> set[int]:
    """The crossings of which a robot's boxes hold a place of its path and one of the other's."""
    distance = planned.courses.packed.distance
    box = slice(*found.box_first[robot : robot + 2])
    cells = found.cell[box]
    is_in = (distance[cells] <= place) & (place <= distance[cells + 1])
    is_in &= (found.low[box] <= other) & (other <= found.high[box])
    return set(found.crossing[box][is_in].tolist())


def common_by_looking_at_all(planned: FleetPlan) -> set[tuple[float, ...]]:
    """Common parts of the boxes of two robots, from all pairs of boxes."""
    packed, distance = planned.crossings.packed, planned.courses.packed.distance
    found = set()
    for b in range(*packed.box_first[:2]):
        for d in range(*packed.box_first[1:3]):
            since = max(distance[packed.cell[d]], packed.low[b])
            until = min(distance[packed.cell[d] + 1], packed.high[b])
            left = max(distance[packed.cell[b]], packed.low[d])
            right = min(distance[packed.cell[b] + 1], packed.high[d])
            if packed.crossing[b] == packed.crossing[d] and since <= until and left <= right:
                found.add((b, d, left, right, since, until))
    return found


@settings(deadline=None, max_examples=15)
@given(st.lists(ROUTES, min_size=2, max_size=2))
def test_common_parts_are_those_that_all_pairs_of_boxes_have(routes: list[Any]) -> None:
    data = [
        {"name": f"r{k}", "route": {"start": way[0], "via": way[1:-1], "goal": way[-1]}}
        for k, way in enumerate([routes[0], [[x + 2.0, y + 2.0] for x, y in routes[1]]])
    ]
    planned = vs.plan_fleet(vs.Fleet.model_validate({"separation_m": 1, "fleet": data}))
    packed = planned.crossings.packed
    if len(planned.plans) < 2:
        return
    boxes, part = common_parts(planned.courses.packed, packed, np.ones(len(packed.robots), bool))
    rows = np.column_stack([boxes, part]).tolist()
    assert {tuple(row) for row in rows} == common_by_looking_at_all(planned)
    assert rows == sorted(rows, key=lambda row: row[:2])


@settings(deadline=None, max_examples=15)
@given(st.lists(ROUTES, min_size=2, max_size=2), st.floats(0.0, 40.0), st.floats(0.0, 0.95))
def test_what_a_robot_passes_first_is_in_boxes_of_both_that_say_so_however_close_it_is(
    routes: list[list[list[float]]], departs: float, share: float
) -> None:
    data = [
        {"name": f"r{k}", "depart_s": departs * k,
         "route": {"start": way[0], "via": way[1:-1], "goal": way[-1]}}
        for k, way in enumerate([routes[0], [[x + 2.0, y + 2.0] for x, y in routes[1]]])
    ]  # fmt: skip
    planned = vs.plan_fleet(vs.Fleet.model_validate({"separation_m": 1, "fleet": data}))
    if not planned.served or not len(planned.crossings.packed.robots):
        return
    places, times, where = zip(*(sampled(planned, robot) for robot in (0, 1)), strict=True)
    apart = np.linalg.norm(where[0][:, None] - where[1], axis=-1)
    pairs = np.argwhere(apart < 1.999)  # with bodies of half a metre
    (comes, goes), (others_come, others_go) = (one[:, pairs[:, k]] for k, one in enumerate(times))
    is_second = comes >= others_go - 1e-6
    later = (others_come - goes)[~is_second]
    laws = sooner(planned, share * later.min(initial=100.0))
    found = ordered_crossings(planned.courses, as_one(planned.crossings), laws).packed
    leaders, _ = crossing_leaders(planned.courses.packed, found, laws.packed)
    for (i, k), leader in zip(pairs.tolist(), is_second.astype(int).tolist(), strict=True):
        mine = crossings_in(planned, found, 0, places[0][i], places[1][k])
        both = mine & crossings_in(planned, found, 1, places[1][k], places[0][i])
        assert leader in {int(leaders[c]) for c in both}
