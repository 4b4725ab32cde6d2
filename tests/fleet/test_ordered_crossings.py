"""A crossing in which now the one and now the other passes first is two."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import viaspline as vs
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.ordered_crossings import ordered_crossings


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
        packed=packed._replace(
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
