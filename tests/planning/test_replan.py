import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.affinity import rotate, translate

import viaspline as vs
from viaspline.curve.bending import curvature_bound
from viaspline.curve.path import Path, PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.splice import run_out
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.replan import from_rest, from_rest_nearby, planned, reflex
from viaspline.robot.replanning.deadline import STEP_WORK_S

Oracle = Callable[..., Any]
MODES = [reflex, planned, from_rest]
LEAVING = [reflex, planned]
EIGHT = [[20, 20], [80, 80], [80, 20], [20, 80], [20, 20], [80, 80]]


def disc(x: float, y: float, radius: float, name: str | None = None) -> vs.Obstacle:
    return vs.Obstacle(circle={"center": (x, y), "radius": radius}, name=name)


def start(*stops: Any, **more: Any) -> tuple[Path, vs.World, Requirements]:
    route = {"start": stops[0], "via": list(stops[1:-1]), "goal": stops[-1]}
    if "detours" in more:
        route["detours"] = more.pop("detours")
    if more.pop("closed", False):
        route = {"start": stops[0], "via": list(stops[1:]), "closed": True}
    more.setdefault("spline", {"tangents": "cardinal"})  # a span from via point to via point
    mission = vs.Mission.model_validate({"route": route, **more})
    plan = vs.plan(mission)
    return plan.path, plan.world, Requirements.of(mission)


def served(path: Path) -> list[int | None]:
    return [via.index for via in path.vias if via.kind == "user"]


def check(
    found: Solution, old: Path, at: float, world: vs.World, oracle: Oracle, required: float = 1.0
) -> None:
    """What was driven stays, what lies ahead is clear, the joints are smooth."""
    new = found.path
    assert found.certificate.holds
    driven = np.linspace(0, found.changed_from, 300)
    np.testing.assert_allclose(new.at_distance(driven), old.at_distance(driven), atol=1e-7)
    ahead = new.at_distance(np.linspace(found.changed_from, new.length, 20_000))
    assert oracle(ahead[:, :2], world.obstacles, world.bounds).min() >= required - 2e-6
    assert found.changed_from >= at - 1e-9


@pytest.mark.parametrize("mode", MODES)
def test_a_path_that_is_clear_stays_or_is_laid_anew_and_is_proven(
    mode: Any, shapely_distance: Oracle
) -> None:
    path, world, requirements = start([0, 0], [50, 20], [100, 0])
    world = world.with_obstacles([disc(50, 60, 5)])
    found = mode(path, 10.0, world, requirements)
    check(found, path, 10.0, world, shapely_distance)
    if mode is reflex:
        assert found.path is path
        assert found.rejoins_at == 10.0
        np.testing.assert_allclose(
            path.at_distance(found.certificate.tightest_distance),
            found.certificate.tightest_at,
            atol=1e-5,
        )


def test_a_reflex_changes_only_what_is_near(shapely_distance: Oracle) -> None:
    stops = [[25.0 * k, 12.0 * (k % 2)] for k in range(9)]
    path, world, requirements = start(*stops)
    middle = path.evaluate(3.5)
    world = world.with_obstacles([disc(*middle.tolist(), 2)])
    found = reflex(path, 5.0, world, requirements)
    check(found, path, 5.0, world, shapely_distance)
    assert found.rejoins_at is not None
    before, after = path.distance(3.0), path.distance(4.0)
    assert found.changed_from == pytest.approx(before, abs=1e-6)
    assert path.length - after == pytest.approx(found.path.length - found.rejoins_at, abs=1e-6)
    np.testing.assert_array_equal(found.path.spans[:3], path.spans[:3])
    np.testing.assert_array_equal(found.path.spans[-4:], path.spans[-4:])
    assert served(found.path) == list(range(9))


LAP = [[0, 0], [60, 0], [60, 40], [0, 40]]


@pytest.mark.parametrize("mode", [reflex, from_rest_nearby])
def test_what_is_in_the_way_in_every_lap_changes_every_lap_there_and_nothing_else(
    mode: Any, shapely_distance: Oracle
) -> None:
    path, world, requirements = start(*3 * LAP, [0, 0])
    world = world.with_obstacles([disc(*path.evaluate([0.5, 4.5, 8.5]).mean(axis=0).tolist(), 4)])
    found = mode(path, 5.0, world, requirements)
    check(found, path, 5.0, world, shapely_distance)
    assert found.rejoins_at is not None
    left = path.length - path.via_distances[9]  # of the third lap, from its first via point on
    assert found.path.length - found.rejoins_at == pytest.approx(left, abs=1e-6)
    assert served(found.path) == list(range(13))
    old = {span.tobytes() for span in path.spans.round(9)}
    same = [span.tobytes() in old for span in found.path.spans.round(9)]
    assert sum(same) >= 9  # of twelve legs three are blocked


def test_from_rest_nearby_leaves_a_path_that_is_clear_or_blocked_to_its_goal_to_others() -> None:
    path, world, requirements = start(*LAP)
    with pytest.raises(vs.NoPathError, match="nothing is in the way"):
        from_rest_nearby(path, 5.0, world, requirements)
    last = world.with_obstacles([disc(*path.evaluate(2.5).tolist(), 3)])
    with pytest.raises(vs.NoPathError, match="nothing of the path would stay"):
        from_rest_nearby(path, 5.0, last, requirements)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("lap", [0, 1])
def test_paths_that_cross_and_repeat_themselves_go_on_in_order(
    mode: Any, lap: int, shapely_distance: Oracle
) -> None:
    path, world, requirements = start(*EIGHT)
    at = float(path.distance(4.4)) if lap else 5.0
    world = world.with_obstacles([disc(62, 57, 3)])
    found = mode(path, at, world, requirements)
    check(found, path, at, world, shapely_distance)
    assert served(found.path) == list(range(6))
    u = [via.u for via in found.path.vias if via.kind == "user"]
    assert u == sorted(u)


@pytest.mark.parametrize("mode", [planned, from_rest])
def test_points_to_skip_are_left_out_and_the_others_served(
    mode: Any, shapely_distance: Oracle
) -> None:
    path, world, requirements = start(*EIGHT)
    world = world.with_obstacles([disc(80, 20, 5, "new")])
    with pytest.raises(vs.NoPathError) as caught:
        mode(path, 5.0, world, requirements)
    assert caught.value.via == "via 2"
    assert caught.value.obstacles == ("new",)
    found = mode(path, 5.0, world, requirements, skip={2})
    check(found, path, 5.0, world, shapely_distance)
    assert served(found.path) == [0, 1, 3, 4, 5]


@pytest.mark.parametrize("mode", MODES)
def test_an_obstacle_on_the_goal_is_named(mode: Any) -> None:
    path, world, requirements = start([0, 0], [50, 20], [100, 0])
    with pytest.raises(vs.NoPathError) as caught:
        mode(path, 10.0, world.with_obstacles([disc(101, 0, 3, "crate")]), requirements)
    assert caught.value.via == "goal"
    assert caught.value.obstacles == ("crate",)
    assert caught.value.remedy


@pytest.mark.parametrize("mode", LEAVING)
def test_an_obstacle_too_near_to_turn_away_from_is_refused(mode: Any) -> None:
    path, world, requirements = start([0, 0], [100, 0])
    world = world.with_obstacles([disc(25.0, 0, 3.9, "crate")])
    with pytest.raises(vs.NoPathError) as caught:
        mode(path, 20.0, world, requirements)
    assert "crate" in caught.value.obstacles
    assert caught.value.remedy


def test_from_rest_turns_away_on_the_spot(shapely_distance: Oracle) -> None:
    path, world, requirements = start([0, 0], [100, 0])
    world = world.with_obstacles([disc(25.0, 0, 3.9, "crate")])
    found = from_rest(path, 20.0, world, requirements)
    check(found, path, 20.0, world, shapely_distance)


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


@pytest.mark.parametrize("mode", MODES)
def test_standing_inside_the_clearance_is_refused(mode: Any) -> None:
    path, world, requirements = start([0, 0], [100, 0])
    with pytest.raises(vs.NoPathError) as caught:
        mode(path, 20.0, world.with_obstacles([disc(24, 0, 3.5, "crate")]), requirements)
    assert "crate" in str(caught.value)


@pytest.mark.parametrize("mode", [planned, from_rest])
def test_there_is_no_way_on_from_the_goal(mode: Any) -> None:
    path, world, requirements = start([0, 0], [100, 0])
    with pytest.raises(vs.NoPathError, match="left to go to"):
        mode(path, path.length, world, requirements)


def test_at_the_goal_there_is_nothing_to_avoid() -> None:
    path, world, requirements = start([0, 0], [100, 0])
    found = reflex(path, path.length, world.with_obstacles([disc(50, 0, 3)]), requirements)
    assert found.path is path
    assert found.certificate.holds


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("tension", [1.0, 0.9, 0.0, -1.0])
@pytest.mark.parametrize("at", [1.0, 0.5])
def test_corners_and_loose_curves_can_be_left(
    mode: Any, tension: float, at: float, shapely_distance: Oracle
) -> None:
    path, world, requirements = start(
        [0, 0], [40, 20], [80, 0], [120, 20], spline={"tension": tension}
    )
    world = world.with_obstacles([disc(*path.evaluate(1.5).tolist(), 3)])
    found = mode(path, float(path.distance(at)), world, requirements)
    check(found, path, float(path.distance(at)), world, shapely_distance)
    assert served(found.path) == [0, 1, 2, 3]


@pytest.mark.parametrize("mode", MODES)
def test_the_heading_at_the_goal_is_kept(mode: Any) -> None:
    path, world, requirements = start([0, 0], [50, 20], {"at": [100, 0], "heading_deg": 90})
    found = mode(path, 10.0, world.with_obstacles([disc(80, 12, 4)]), requirements)
    end = found.path.domain[1]
    assert float(found.path.heading(end)) == pytest.approx(math.pi / 2)


@pytest.mark.parametrize("mode", MODES)
def test_a_closed_route_still_comes_home(mode: Any, shapely_distance: Oracle) -> None:
    path, world, requirements = start([0, 0], [50, 30], [100, 0], [50, -30], closed=True)
    world = world.with_obstacles([disc(*path.evaluate(3.5).tolist(), 3)])
    found = mode(path, 30.0, world, requirements)
    check(found, path, 30.0, world, shapely_distance)
    assert served(found.path) == [0, 1, 2, 3, 4]
    np.testing.assert_allclose(found.path.evaluate(found.path.domain[1]), [0, 0], atol=1e-12)


@pytest.mark.parametrize("mode", MODES)
def test_heights_go_on_under_way(mode: Any, shapely_distance: Oracle) -> None:
    path, world, requirements = start([0, 0, 5], [50, 20, 30], [100, 0, 10])
    world = world.with_obstacles([disc(70, 15, 3)])
    found = mode(path, 30.0, world, requirements)
    check(found, path, 30.0, world, shapely_distance)
    np.testing.assert_allclose(found.path.evaluate(found.path.domain[1]), [100, 0, 10])


@pytest.mark.parametrize("mode", MODES)
def test_replans_can_follow_each_other(mode: Any, shapely_distance: Oracle) -> None:
    path, world, requirements = start([0, 0], [60, 30], [120, 0], [180, 30])
    at = 0.0
    for k in range(6):
        at += 15.0
        ahead = path.at_distance(min(at + 14.0, path.length - 8.0))
        world = world.with_obstacles([disc(float(ahead[0]), float(ahead[1]) + 1.0, 2.0, f"n{k}")])
        found = mode(path, at, world, requirements)
        check(found, path, at, world, shapely_distance)
        path = found.path
        assert served(path) == [0, 1, 2, 3]


@pytest.mark.parametrize("gap", [1e-7, 1e-4, 0.3])
@pytest.mark.parametrize("mode", MODES)
def test_a_via_point_just_ahead_is_not_run_past(
    mode: Any, gap: float, shapely_distance: Oracle
) -> None:
    path, world, requirements = start([0, 0], [50, 0], [100, 40])
    world = world.with_obstacles([disc(*path.evaluate(1.5).tolist(), 3)])
    at = float(path.distance(1.0)) - gap
    found = mode(path, at, world, requirements)
    check(found, path, at, world, shapely_distance)
    assert served(found.path) == [0, 1, 2]
    u = [via.u for via in found.path.vias if via.kind == "user"]
    between = found.path.section(float(found.path.parameter(at)), u[1]) if gap > 1e-6 else None
    assert between is None or between.length < 1.5 * gap


# The run-out


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


def test_a_path_of_one_span_can_be_replanned() -> None:
    vias = [
        PathVia("start", (0.0, 0.0), "user", 0.0, index=0),
        PathVia("goal", (30.0, 0.0), "user", 1.0, index=1),
    ]
    path = Path([[[0, 0], [10, 0], [20, 0], [30, 0]]], vias)
    world = vs.World([disc(15, 0.5, 2)])
    found = reflex(path, 0.0, world, Requirements(radius=0.5, clearance=0.5))
    assert found.certificate.holds
    assert served(found.path) == [0, 1]


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
