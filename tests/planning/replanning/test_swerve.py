"""A path through one place beside the old one: laid at once, proven as any other."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.replanning.departure import rolling, standing
from viaspline.planning.replanning.swerve import Swerving, may_swerve


def planned(*known: dict[str, Any], **robot: Any) -> tuple[vs.Plan, Requirements]:
    mission = vs.Mission.model_validate(
        {
            "world": {"known": list(known)},
            "robot": {"radius_m": 0.25, "clearance_m": 0.1, **robot},
            "route": {"start": [0, 0], "via": [[12, 3]], "goal": [24, 0]},
        }
    )
    return vs.plan(mission), Requirements.of(mission)


@settings(max_examples=25, deadline=None)
@given(
    at=st.floats(0.5, 8.0), ahead=st.floats(1.0, 3.0), aside=st.floats(-3.0, 3.0),
)  # fmt: skip
def test_it_leads_through_the_place_and_every_via_point(
    at: float, ahead: float, aside: float
) -> None:
    plan, requirements = planned()
    u = float(plan.path.parameter(at))
    along = np.asarray(plan.path.tangent(u))
    place = plan.path.evaluate(u) + ahead * along + aside * np.array([-along[1], along[0]])
    found = Swerving.off(plan.path, at, plan.world, requirements, rolling).through(place)
    new = found.path
    driven = np.linspace(0.0, at, 50)
    np.testing.assert_allclose(new.at_distance(driven), plan.path.at_distance(driven), atol=1e-7)
    dense = np.asarray(new.at_distance(np.linspace(at, new.length, 20_000)))
    for point in (place, (12, 3), (24, 0)):
        assert np.hypot(*(dense - point).T).min() < 2e-3
    assert [via.index for via in new.vias if via.kind == "user"] == [0, 1, 2]
    before, after = (float(path.parameter(at)) for path in (plan.path, new))
    assert abs(new.heading(after) - plan.path.heading(before)) < 1e-6
    assert abs(new.curvature(after + 1e-9) - plan.path.curvature(before)) < 1e-4


def test_from_rest_it_leaves_for_the_place_at_once() -> None:
    plan, requirements = planned()
    found = Swerving.off(plan.path, 4.0, plan.world, requirements, standing).through(
        np.array([4.0, 6.0])
    )
    assert found.changed_from == pytest.approx(4.0)
    heading = float(found.path.heading(float(found.path.parameter(4.0)) + 1e-9))
    assert np.sin(heading) > 0.9


def test_what_stands_in_its_way_makes_it_none() -> None:
    plan, requirements = planned({"name": "post", "circle": {"center": [8, -2], "radius": 0.5}})
    swerving = Swerving.off(plan.path, 4.0, plan.world, requirements, rolling)
    with pytest.raises(vs.PlanningError, match="no room"):
        swerving.through(np.array([8.0, -2.5]))


def test_none_is_laid_where_sides_or_a_turning_circle_have_a_say() -> None:
    plan, requirements = planned()
    assert may_swerve(plan.path, plan.world, requirements)
    ship, held = planned(min_turn_radius_m=1.0)
    assert not may_swerve(ship.path, ship.world, held)
    post = {"name": "post", "circle": {"center": [8, -2], "radius": 0.5}, "pass_on": "left"}
    asked, free = planned(post)
    assert not may_swerve(asked.path, asked.world, free)
