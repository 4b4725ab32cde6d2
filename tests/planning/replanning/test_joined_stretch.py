"""How a path that is laid anew leaves the old one: run-outs, turns at rest."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from replanned_paths import LEAVING, Oracle, check, disc, start
from shapely.affinity import rotate, translate

import viaspline as vs
from viaspline.curve.bending import curvature_bound
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.problem.splice import run_out
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.replanning.replan import from_rest, reflex
from viaspline.robot.replanning.deadline import STEP_WORK_S


@pytest.mark.parametrize("mode", LEAVING)
def test_an_obstacle_too_near_to_turn_away_from_is_refused(mode: Any) -> None:
    path, world, requirements = start([0, 0], [100, 0])
    world = world.with_obstacles([disc(25.0, 0, 3.9, "crate")])
    with pytest.raises(vs.NoPathError) as caught:
        mode(path, 20.0, world, requirements)
    assert "crate" in caught.value.obstacles
    assert caught.value.remedy


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(
    st.integers(0, 10_000), st.sampled_from([None, "local", "short"]), st.sampled_from([3.0, 8.0])
)
def test_from_rest_a_robot_that_never_turns_on_the_spot_goes_on_with_its_wheels_as_they_are(
    seed: int, detours: str | None, radius: float
) -> None:
    rng = np.random.default_rng(seed)
    stops = [[10.0, 10.0], *rng.uniform(20, 120, (3, 2)).tolist(), [130.0, 130.0]]
    robot = {"min_turn_radius_m": radius, "turn_on_spot": "never"}
    path, world, requirements = start(*stops, robot=robot, spline={}, detours=detours)
    at = float(rng.uniform(0.0, 0.7) * path.length)
    ahead = float(at + rng.uniform(3.0, 20.0))
    place = path.at_distance(min(ahead, path.length)) + rng.normal(0.0, 0.5, 2)
    try:
        found = from_rest(
            path, at, world.with_obstacles([disc(*place.tolist(), 1.0)]), requirements
        )
    except vs.PlanningError:
        return
    u, before = float(found.path.parameter(at)), float(path.parameter(at))
    for beside in (-1e-6, 1e-6):
        assert found.path.curvature(u + beside) == pytest.approx(path.curvature(before), abs=1e-4)
        turn = found.path.heading(u + beside) - path.heading(before)
        assert abs(math.remainder(float(turn), math.tau)) < 1e-4
    assert max(found.path.curvature_jumps()) < 1e-6
    assert curvature_bound(found.path)[0] * radius <= 1.0


@pytest.mark.parametrize(("ahead", "reach"), [(3.3, 0.24), (3.5, 0.24), (4.0, 0.24), (12.0, 1.6)])
def test_near_what_is_in_its_way_a_robot_that_never_turns_on_the_spot_tries_short_run_outs_first(
    ahead: float, reach: float, shapely_distance: Oracle
) -> None:
    robot = {
        "radius_m": 0.5, "clearance_m": 0.3, "min_turn_radius_m": 1.6, "turn_on_spot": "never",
    }  # fmt: skip
    path, world, requirements = start([0, 0], [30, 0], [60, 5], robot=robot)
    world = world.with_obstacles([disc(10.0 + ahead, 0.0, 1.0)])
    found = reflex(path, 10.0, world, requirements.within(WorkBudget(STEP_WORK_S)))
    check(found, path, 10.0, world, shapely_distance, 0.8)
    left = found.path.parameter(found.changed_from)
    length = found.path.distance(np.rint(left) + 1.0) - found.changed_from
    assert length == pytest.approx(reach, abs=1e-3)


def test_from_rest_a_body_turns_only_where_nothing_is_in_its_way() -> None:
    """It turned towards the new path whatever stood beside it, and touched what it had seen."""
    plank, clearance, found = [(-0.3, -0.2), (0.9, -0.2), (0.9, 0.2), (-0.3, 0.2)], 0.05, 0
    path, world, requirements = start(
        [0, 0], [20, 0], robot={"footprint": plank, "clearance_m": clearance}
    )
    for seed in range(12):
        random = np.random.default_rng(seed)
        angle = random.uniform(0.6, 1.4) * random.choice([-1.0, 1.0])
        beside = 10.0 + 0.75 * math.cos(angle), 0.75 * math.sin(angle)
        seen = world.with_obstacles([disc(*beside, 0.1), disc(13.2, 0.1, 2.1)])
        try:
            new = from_rest(path, 10.0, seen, requirements).path
        except vs.PlanningError:
            continue
        found += 1
        way = float(new.heading(float(new.parameter(10.0 + 1e-6))))
        things = [shapely.Point(*beside).buffer(0.1), shapely.Point(13.2, 0.1).buffer(2.1)]
        for heading in np.linspace(0.0, math.remainder(way, math.tau), 60):
            turned = rotate(shapely.Polygon(plank), heading, origin=(0, 0), use_radians=True)
            body = translate(turned, 10.0, 0.0)
            assert min(body.distance(thing) for thing in things) >= clearance - 1e-3
    assert found > 3


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("u", [0.0, 0.3, 1.0, 1.7])
@pytest.mark.parametrize("dimension", [2, 3])
def test_a_run_out_takes_over_place_heading_and_curvature(
    sense: int, u: float, dimension: int
) -> None:
    points = np.array([(0, 0, 0), (10, 5, 2), (20, -5, 1), (35, 0, 9)], float)[:, :dimension]
    curve = vs.CardinalSpline(points)
    out = run_out(curve, u, 3.0, sense=sense)
    easing = PiecewiseCubic(out.span[None])
    np.testing.assert_allclose(easing.evaluate(0.0), curve.evaluate(u), atol=1e-12)
    np.testing.assert_allclose(easing.tangent(0.0), sense * curve.tangent(u), atol=1e-12)
    assert abs(float(easing.curvature(0.0))) == pytest.approx(abs(float(curve.curvature(u))))
    assert abs(float(easing.curvature(1.0))) == pytest.approx(0, abs=1e-9)
    np.testing.assert_allclose(easing.tangent(1.0), out.tangent, atol=1e-12)
    back = out.reversed()
    np.testing.assert_allclose(back.span[3], curve.evaluate(u), atol=1e-12)
    np.testing.assert_allclose(back.tangent, -out.tangent)
    assert 0 < easing.length < 3.5


def test_a_run_out_from_the_corner_of_a_polyline_goes_straight_on() -> None:
    corner = vs.CardinalSpline([(0, 0), (10, 0), (10, 10)], tension=1.0)
    out = run_out(corner, 1.0, 2.0)
    np.testing.assert_allclose(out.span, [(10, 0), (10, 2 / 3), (10, 4 / 3), (10, 2)], atol=1e-12)


@pytest.mark.parametrize("ahead", [1.1e-6, 3e-6, 2e-5, 3e-4, 2e-3, 4e-3, 0.1])
@pytest.mark.parametrize("mode", LEAVING)
def test_a_path_is_left_smoothly_however_near_the_next_via_point_is(
    mode: Any, ahead: float
) -> None:
    """A run-out of micrometres took the curvature from rounding: 0.01 1/m off."""
    path, world, requirements = start(
        [30, 20], [45, 31], [60, 22], [80, 30], [100, 21], robot={"min_turn_radius_m": 1}
    )
    world = world.with_obstacles([disc(72, 27, 1)])
    at = float(path.via_distances[1]) - ahead
    found = mode(path, at, world, requirements)
    u, new_u = (float(p.parameter(found.changed_from)) for p in (path, found.path))
    after = min(round(u), path.domain[1]) if abs(u - round(u)) < 1e-7 else u
    new_after = round(new_u) if abs(new_u - round(new_u)) < 1e-7 else new_u
    assert abs(found.path.curvature(new_after) - path.curvature(after)) < 1e-6
    assert found.changed_from >= at - 1e-9
    turned = float(found.path.heading(new_after)) - float(path.heading(after))
    assert abs(math.remainder(turned, math.tau)) < 1e-8
