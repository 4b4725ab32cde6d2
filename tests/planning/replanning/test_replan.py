import math
from pathlib import Path as FilePath
from typing import Any

import numpy as np
import pytest
from replanned_paths import MODES, Oracle, check, disc, served, start

import viaspline as vs
from viaspline.curve.path import Path, PathVia
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.replanning.replan import from_rest, from_rest_nearby, planned, reflex

EXAMPLES = FilePath(__file__).parents[3] / "examples"
EIGHT = [[20, 20], [80, 80], [80, 20], [20, 80], [20, 20], [80, 80]]


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


def test_from_rest_turns_away_on_the_spot(shapely_distance: Oracle) -> None:
    path, world, requirements = start([0, 0], [100, 0])
    world = world.with_obstacles([disc(25.0, 0, 3.9, "crate")])
    found = from_rest(path, 20.0, world, requirements)
    check(found, path, 20.0, world, shapely_distance)


@pytest.mark.parametrize("mode", MODES)
def test_standing_inside_the_clearance_is_refused(mode: Any) -> None:
    path, world, requirements = start([0, 0], [100, 0])
    with pytest.raises(vs.NoPathError) as caught:
        mode(path, 20.0, world.with_obstacles([disc(24, 0, 3.5, "crate")]), requirements)
    assert "crate" in str(caught.value)
    assert "via point" not in str(caught.value)  # a robot under way is none that could be moved


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


def test_what_is_seen_bit_by_bit_is_not_passed_from_detour_to_detour() -> None:
    """A hose of which a lidar shows more from look to look: a turn of 0.14 m was driven."""
    mission = vs.load(EXAMPLES / "hedges.yaml")
    run = vs.simulate(mission)
    assert run.reached
    assert len(run.replans) > 3
    assert run.path.max_curvature()[0] * mission.robot.radius_m < 1.0
