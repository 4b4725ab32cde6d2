"""The ledger of a robot with a body or a turning circle: sides as they are driven."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.curve.bending import curvature_bound
from viaspline.curve.piecewise import PiecewiseCubic

BODY = [[-0.4, -0.5], [1.6, -0.5], [1.6, 0.5], [-0.4, 0.5]]
RADIUS = 2.5


def mission(seed: int) -> vs.Mission | None:
    """Two discs in the way of two legs that meet at an angle."""
    rng = np.random.default_rng(seed)
    vias = np.array([[0.0, 0.0], [30.0, 0.0], [30.0, 0.0]])
    vias[2] += rng.uniform(-30, 30, 2)
    if np.linalg.norm(vias[2] - vias[1]) < 15:
        return None
    known = [
        {"circle": {"center": [12, rng.uniform(-1, 1)], "radius": 2.0}},
        {"circle": {"center": (0.5 * (vias[1] + vias[2])).tolist(), "radius": 1.5}},
    ]
    robot = {"footprint": BODY, "clearance_m": 0.3, "min_turn_radius_m": RADIUS}
    robot |= {"tracking_error_m": 0.1}
    a, b, c = vias.tolist()
    route = {"start": a, "via": [b], "goal": c}
    try:
        return vs.Mission.model_validate(
            {"world": {"known": known}, "robot": robot, "route": route}
        )
    except vs.MissionError:  # the goal lies beside the first disc
        return None


def gap(spans: Any, world: vs.World) -> float:
    """Distance between the body and the discs at poses every few centimetres [m], by shapely."""
    curve = PiecewiseCubic(spans)
    u = np.linspace(*curve.domain, int(curve.length / 0.03))
    heading, at = np.asarray(curve.heading(u)), np.asarray(curve.evaluate(u))
    c, s = np.cos(heading)[:, None], np.sin(heading)[:, None]
    x, y = np.array(BODY).T
    bodies = shapely.polygons(np.stack((c * x - s * y, s * x + c * y), 2) + at[:, None])
    discs = [o.circle for o in world.obstacles if o.circle is not None]
    return min(
        float(shapely.distance(shapely.Point(disc.center), bodies).min()) - disc.radius
        for disc in discs
    )


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=12)
def test_every_side_that_is_offered_could_be_driven_and_costs_what_it_says(seed: int) -> None:
    asked = mission(seed)
    plan = None if asked is None else planned(asked)
    if asked is None or plan is None:
        return
    for entry in plan.ledger:
        assert entry.chosen is not None
        for candidate in entry.candidates:
            if candidate.impossible is not None:
                assert candidate.side in candidate.impossible
                continue
            assert curvature_bound(PiecewiseCubic(candidate.spans))[0] * RADIUS <= 1.0
            seen = gap(candidate.spans, plan.world)
            assert candidate.clearance is not None
            assert 0.4 - 1e-6 <= candidate.clearance <= seen + 1e-9
            assert candidate.clearance == pytest.approx(seen, abs=0.01)


@given(st.integers(0, 2**32 - 1))
@example(11)  # for a point the other sides are shorter, for this robot by 3.1 m longer
@example(
    5003
)  # both ways round the second disc are equally long, and go with either round the first
@settings(max_examples=12)
def test_the_side_that_is_taken_is_the_one_that_is_driven_and_no_other_makes_the_whole_sooner(
    seed: int,
) -> None:
    asked = mission(seed)
    plan = None if asked is None else planned(asked)
    if asked is None or plan is None:
        return
    takes = plan.trajectory.duration
    for entry in plan.ledger:
        assert entry.chosen is not None
        for other in ("left", "right"):
            forced = plan_on_side(asked, entry.members, other)
            if forced is not None:
                assert takes <= forced.trajectory.duration * (1 + 2e-3)


def plan_on_side(asked: vs.Mission, members: tuple[str, ...], side: str) -> vs.Plan | None:
    """The plan with a side that is asked for, if there is one."""
    data = asked.model_dump(mode="json", exclude_none=True)
    for k, obstacle in enumerate(data["world"]["known"]):
        if f"obstacle {k + 1}" in members:
            obstacle["pass_on"] = side
    return planned(vs.Mission.model_validate(data))


def planned(asked: vs.Mission) -> vs.Plan | None:
    try:
        return vs.plan(asked)
    except vs.PlanningError:
        return None
