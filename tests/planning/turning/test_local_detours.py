"""Lanes that stay lanes: local detours, measured with shapely on samples of the exact curve."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.mission.spline_spec import SplineSpec
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.replanning import replan

NEAR_M = 1.0
TAUT = SplineSpec(tension=0.0)
ROBOT = {"radius_m": 1.0, "clearance_m": 1.0, "max_speed_mps": 3.0, "max_accel_mps2": 0.5,
         "max_lateral_accel_mps2": 0.5}  # fmt: skip


def lanes(rng: np.random.Generator, count: int) -> list[np.ndarray]:
    """Corners of lanes one behind the other, none of which comes near to another."""
    places, heading = [np.zeros(2)], float(rng.uniform(-math.pi, math.pi))
    while len(places) <= count:
        turned = heading + float(rng.uniform(-2.2, 2.2))
        end = places[-1] + rng.uniform(100, 500) * np.array((math.cos(turned), math.sin(turned)))
        lane = shapely.LineString((places[-1], end))
        if all(shapely.distance(lane, shapely.Point(place)) > 60 for place in places[:-1]):
            places.append(end)
            heading = turned
    return places


def island(rng: np.random.Generator, a: np.ndarray, b: np.ndarray) -> tuple[dict[str, Any], float]:
    """A disc or a polygon near the middle of a lane, and its width [m]."""
    reach = 0.5 * float(rng.uniform(5, 30))
    along = (b - a) / math.dist(a, b)
    across = np.array((-along[1], along[0]))
    middle = 0.5 * (a + b) + float(rng.uniform(-0.3, 0.3)) * reach * across
    if rng.random() < 0.5:
        return {"circle": {"center": middle.tolist(), "radius": reach}}, 2.0 * reach
    count = int(rng.integers(5, 10))
    angles = (np.arange(count) + rng.uniform(0, 0.6, count)) * math.tau / count
    ring = middle + reach * np.column_stack((np.cos(angles), np.sin(angles)))
    width = max(float(np.ptp(ring @ along)), float(np.ptp(ring @ across)))
    return {"polygon": ring.tolist()}, width


def mission(places: Any, known: Any, robot: Any = None, **route: Any) -> vs.Mission:
    places = [np.asarray(place).tolist() for place in places]
    ends = {"start": places[0], "via": places[1:-1], "goal": places[-1]}
    asked = ROBOT | (robot or {})
    if "footprint" in asked:
        del asked["radius_m"]
    return vs.Mission.model_validate(
        {"world": {"known": known}, "robot": asked, "route": ends | route}
    )


def shares(path: vs.Path) -> list[tuple[float, float]]:
    """Of each leg the share of its line that is kept, and the length of the line [m]."""
    found = []
    for before, after in pairwise([via for via in path.vias if via.kind == "user"]):
        places = path.evaluate(np.linspace(before.u, after.u, 4000))[:, :2]
        line = shapely.LineString((before.at[:2], after.at[:2]))
        at = line.interpolate(np.arange(0.0, line.length, 0.25))
        near = shapely.dwithin(shapely.LineString(places), at, NEAR_M)
        found.append((float(np.mean(near)), float(line.length)))
    return found


@pytest.mark.slow
@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000))
def test_of_a_lane_with_an_island_all_but_four_of_its_widths_is_kept(seed: int) -> None:
    rng = np.random.default_rng(seed)
    places = lanes(rng, int(rng.integers(1, 4)))
    made = [island(rng, a, b) for a, b in pairwise(places)]
    plan = vs.plan(mission(places, [shape for shape, _ in made], detours="local"))
    assert plan.certificate.clearance >= 1.0 - 1e-6
    for (share, length), (_, width) in zip(shares(plan.path), made, strict=True):
        assert share >= 1.0 - 4.0 * width / length


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000), st.sampled_from(["left", "right"]))
def test_an_island_is_passed_on_the_side_that_is_asked_for(seed: int, side: str) -> None:
    rng = np.random.default_rng(seed)
    ends = np.array(((0.0, 0.0), (400.0, 0.0)))
    shape, _ = island(rng, *ends)
    plan = vs.plan(mission(ends, [shape | {"pass_on": side}], detours="local"))
    (group,) = [entry for entry in plan.ledger if entry.chosen is not None]
    assert group.chosen is not None
    assert group.chosen.side == side
    at = plan.path.evaluate(np.linspace(*plan.path.domain, 4000))
    middle = at[np.argmax(np.abs(at[:, 1])), 1]
    assert (middle > 0.0) == (side == "left")


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 10_000))
def test_a_turning_circle_and_a_long_body_keep_their_lanes_within_their_limits(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ends = np.array(((0.0, 0.0), (float(rng.uniform(250, 500)), 0.0)))
    circle = float(rng.uniform(3, 8))
    shape, width = island(rng, *ends)
    assume(width < 0.1 * ends[1, 0])
    robot: dict[str, Any] = {"min_turn_radius_m": circle}
    if rng.random() < 0.5:
        robot |= {"footprint": [[-1, -0.8], [2, -0.8], [2, 0.8], [-1, 0.8]]}
    plan = vs.plan(mission(ends, [shape], robot, detours="local"))
    u = np.linspace(*plan.path.domain, 20_000)
    assert np.abs(plan.path.curvature(u)).max() * circle <= 1.0
    assert plan.certificate.clearance >= 1.0 - 1e-6
    ((share, length),) = shares(plan.path)
    assert share >= 1.0 - (3.0 * width + 8.0 * circle) / length


@pytest.mark.slow
@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000))
def test_by_itself_it_is_so_of_a_lane_ten_times_as_long_as_its_island_is_wide(seed: int) -> None:
    rng = np.random.default_rng(seed)
    places = lanes(rng, 1)
    shape, width = island(rng, *places)
    reach = ROBOT["radius_m"] + ROBOT["clearance_m"]
    assume(math.dist(*places) > 10.0 * max(width, 0.5 * width + reach))
    ((share, length),) = shares(vs.plan(mission(places, [shape])).path)
    assert share >= 1.0 - 4.0 * width / length


def test_round_the_tip_of_something_large_a_path_swerves_as_gently_as_full_speed_needs() -> None:
    wedge = [{"polygon": [[195, -60], [260, -60], [200, 2]]}]
    plan = vs.plan(mission(((0, 0), (400, 0)), wedge, detours="local"))
    curvature = plan.path.curvature(np.linspace(*plan.path.domain, 20_000))
    assert np.abs(curvature).max() * 3.0**2 < 1.05 * 0.5
    assert shares(plan.path)[0][0] > 0.8


def test_on_a_short_lane_turns_are_no_wider_than_there_is_room_for_before_its_ends() -> None:
    disc = [{"circle": {"center": [50, 1], "radius": 10}}]
    ((share, length),) = shares(vs.plan(mission(((0, 0), (100, 0)), disc, detours="local")).path)
    assert share >= 1.0 - 4.0 * 20.0 / length


def test_two_islands_far_apart_leave_the_lane_between_them() -> None:
    discs = [{"circle": {"center": [x, 0.5], "radius": 4}} for x in (100, 300)]
    plan = vs.plan(mission(((0, 0), (400, 0)), discs, detours="local"))
    at = plan.path.evaluate(np.linspace(*plan.path.domain, 8000))
    between = at[(at[:, 0] > 140) & (at[:, 0] < 260)]
    assert np.abs(between[:, 1]).max() < 0.3


def test_islands_too_near_to_each_other_are_gone_round_as_one() -> None:
    discs = [{"circle": {"center": [x, 0.5], "radius": 6}} for x in (190, 210)]
    plan = vs.plan(mission(((0, 0), (400, 0)), discs, detours="local"))
    at = plan.path.evaluate(np.linspace(*plan.path.domain, 8000))
    between = at[(at[:, 0] > 190) & (at[:, 0] < 210)]
    assert np.abs(between[:, 1]).min() > 4.0
    assert np.abs(at[at[:, 0] < 130, 1]).max() < 0.5


@pytest.mark.parametrize("length", [300.0, 600.0])
def test_a_lane_is_kept_unless_it_is_short_beside_what_stands_in_it(length: float) -> None:
    disc = [{"circle": {"center": [length / 2, 1], "radius": 20}}]
    ends = ((0, 0), (length, 0))
    given, local, short = (
        vs.plan(mission(ends, disc, **route)).path.length
        for route in ({}, {"detours": "local"}, {"detours": "short"})
    )
    assert short < local
    assert given == (local if length > 10 * 40 else short)


def test_a_path_that_stays_within_the_required_distance_of_its_line_does_not_swerve_for_it() -> (
    None
):
    post = [{"circle": {"center": [60, -1.8], "radius": 0.1}}]
    ends = ((0, 0), (120, 0))
    given, short = (vs.plan(mission(ends, post, **route)) for route in ({}, {"detours": "short"}))
    assert given.path.spans.tolist() == short.path.spans.tolist()
    at = given.path.evaluate(np.linspace(*given.path.domain, 4000))
    assert np.abs(at[:, 1]).max() < 2.0


def test_a_line_that_costs_much_time_is_left_unless_it_is_asked_for() -> None:
    """At full speed this robot turns with 100 m: the way back to the line has to be much slower."""
    disc = [{"circle": {"center": [60, 1], "radius": 5}}]
    ends = ((0, 0), (120, 0))
    quick = {"max_speed_mps": 10.0, "max_accel_mps2": 1.0, "max_lateral_accel_mps2": 1.0}
    given, local, short = (
        vs.plan(mission(ends, disc, quick, **route)).trajectory.duration
        for route in ({}, {"detours": "local"}, {"detours": "short"})
    )
    assert given == short < 0.95 * local


def test_the_shortest_way_is_taken_where_length_is_what_counts() -> None:
    disc = [{"circle": {"center": [300, 1], "radius": 5}}]
    ends = ((0, 0), (600, 0))
    given, short = (
        vs.plan(mission(ends, disc, optimise="length", **route)).path.length
        for route in ({}, {"detours": "short"})
    )
    assert given == short
    assert shares(vs.plan(mission(ends, disc, optimise="length", detours="local")).path)[0][0] > 0.9


def test_where_a_tension_is_stated_a_blocked_leg_keeps_its_lane_and_a_free_one_is_the_spline() -> (
    None
):
    disc = [{"circle": {"center": [300, 1], "radius": 5}}]
    places = ((0, 0), (600, 0), (1200, 60), (1800, 0))
    free, bent = (
        vs.plan(mission(places, known).model_copy(update={"spline": TAUT})).path
        for known in ([], disc)
    )
    assert shares(bent)[0][0] > 0.9
    np.testing.assert_array_equal(bent.spans[-1], free.spans[-1])
    assert np.abs(bent.curvature(np.linspace(bent.vias[-2].u, bent.domain[1], 99))).max() > 1e-4


@pytest.mark.parametrize("detours", [None, "local"])
@pytest.mark.parametrize("mode", [replan.planned, replan.from_rest])
def test_a_path_that_is_laid_anew_beside_its_lane_gets_back_to_it_where_nothing_stands_ahead(
    mode: Any, detours: Any
) -> None:
    disc = [{"circle": {"center": [150, 1], "radius": 5}}]
    asked = mission(((0, 0), (300, 0)), disc, detours=detours)
    plan = vs.plan(asked)
    at = next(s for s in np.arange(150.0, 170.0, 0.5) if plan.path.at_distance(s)[0] > 151.0)
    assert abs(plan.path.at_distance(at)[1]) > 5.0
    new = mode(plan.path, at, plan.world, Requirements.of(asked)).path
    beyond = new.at_distance(np.linspace(at, new.length, 2000))
    off = beyond[np.abs(beyond[:, 1]) > NEAR_M, 0]
    assert off.max() < 200.0


def test_a_lane_that_is_short_beside_what_has_been_passed_is_not_gone_back_to() -> None:
    disc = [{"circle": {"center": [150, 1], "radius": 20}}]
    asked = mission(((0, 0), (300, 0)), disc)
    plan = vs.plan(asked)
    at = next(s for s in np.arange(150.0, 200.0, 0.5) if plan.path.at_distance(s)[0] > 165.0)
    new = replan.planned(plan.path, at, plan.world, Requirements.of(asked)).path
    assert new.length < plan.path.length + 0.5


def test_a_path_on_which_the_robot_goes_round_something_new_gets_back_to_its_lane() -> None:
    asked = mission(((0, 0), (300, 0)), []).model_dump(exclude_unset=True)
    asked["world"]["unseen"] = [{"circle": {"center": [150, 1], "radius": 5}}]
    asked["robot"]["sensor"] = {"range_m": 60}
    run = vs.simulate(vs.Mission.model_validate(asked))
    assert run.reached
    assert run.replans
    beside = np.abs(run.positions[:, 1]) > NEAR_M
    off = run.positions[beside, 0]
    assert off.min() > 90.0
    assert off.max() < 195.0


def hall(*boxes: tuple[int, int, int, int]) -> list[dict[str, Any]]:
    """A map of squares of 0.5 m, 100 m x 40 m, with walls round it and blocked boxes [cells]."""
    blocked = np.zeros((80, 200), bool)
    blocked[[0, -1]] = blocked[:, [0, -1]] = True
    for x0, y0, x1, y1 in boxes:
        blocked[y0:y1, x0:x1] = True
    return [{"grid": vs.Grid(blocked, 0.5)}]


SLOW = {"radius_m": 0.4, "clearance_m": 0.3, "max_speed_mps": 2.0, "max_accel_mps2": 1.0}


def test_a_wall_of_a_map_that_juts_into_the_line_makes_no_lane_of_it() -> None:
    corner = hall((100, 0, 200, 42))
    ends = ((4.0, 17.0), (96.0, 24.5))
    plan = vs.plan(mission(ends, corner, SLOW))
    shortest = vs.plan(mission(ends, corner, SLOW, detours="short"))
    assert plan.ledger[0].chosen is not None
    assert np.array_equal(plan.path.spans, shortest.path.spans)


def test_a_shelf_of_a_map_leaves_a_lane_what_it_is() -> None:
    shelf = hall((98, 36, 102, 44))
    ends = ((4.0, 20.5), (96.0, 20.5))
    ((share, length),) = shares(vs.plan(mission(ends, shelf, SLOW)).path)
    ((short, _),) = shares(vs.plan(mission(ends, shelf, SLOW, detours="short")).path)
    assert share >= 1.0 - 4.0 * 4.0 / length > short
