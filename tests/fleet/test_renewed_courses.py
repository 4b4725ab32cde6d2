"""Courses of which some are cut anew are all of them, node by node, as if cut at once."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.fleet.courses import courses_of
from viaspline.fleet.renewed_courses import renewed_courses
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan

places = st.tuples(st.integers(0, 30), st.integers(0, 30))


def planned(points: list[tuple[int, int]], radius: float = 0.5) -> Plan:
    route: dict[str, Any] = {"start": points[0], "via": points[1:-1], "goal": points[-1]}
    return plan(Mission.model_validate({"robot": {"radius_m": radius}, "route": route}))


@settings(max_examples=15, deadline=None)
@given(
    st.lists(st.lists(places, min_size=2, max_size=4, unique=True), min_size=1, max_size=4),
    st.data(),
)
def test_they_are_those_that_are_cut_at_once(
    routes: list[list[tuple[int, int]]], data: st.DataObject
) -> None:
    plans = {f"r{k}": planned(route) for k, route in enumerate(routes)}
    before = courses_of(plans, 1.0)
    changed = data.draw(st.sets(st.integers(0, len(routes) - 1), min_size=1))
    for k in changed:
        plans[f"r{k}"] = planned([(40, 40), (k, 50), (60, 5 * k)], radius=0.7)
    found = renewed_courses(before, plans, 1.0, np.array(sorted(changed)))
    at_once = courses_of(plans, 1.0)
    assert found.names == at_once.names
    for key, values in at_once.packed._asdict().items():
        assert np.array_equal(getattr(found.packed, key), values), key
        assert getattr(found.packed, key).dtype == values.dtype
