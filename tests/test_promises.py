"""The promises that hold for every path that the package hands out; the fifth is in
``test_same_bytes``."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import viaspline as vs
from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.replanning import replan

Oracle = Callable[..., Any]
Floats = NDArray[np.float64]
Make = Callable[..., vs.Mission | None]
seeds = st.integers(0, 1_000_000)
MODES = ("reflex", "planned", "from_rest")


def planned(mission: vs.Mission) -> vs.Plan | None:
    try:
        return vs.plan(mission)
    except vs.PlanningError as error:
        check_reason(error)
        return None


def check_reason(error: vs.PlanningError) -> None:
    assert error.reason
    assert error.remedy
    assert np.isfinite(error.where).all()


def bezier(spans: Any, count: int) -> Floats:
    """Points of all spans by Bernstein polynomials, (m * count, d)."""
    w = np.linspace(0, 1, count)
    basis = np.array([(1 - w) ** 3, 3 * w * (1 - w) ** 2, 3 * w**2 * (1 - w), w**3])
    return np.einsum("kw,mkd->mwd", basis, np.asarray(spans)).reshape(-1, np.shape(spans)[2])


def least_distance(oracle: Oracle, spans: Any, world: vs.World) -> float:
    xy = bezier(spans, 120)[:, :2]
    return float(oracle(xy, world.obstacles, world.bounds, world.fences).min())


def users(path: vs.Path) -> list[Any]:
    return [via for via in path.vias if via.kind == "user"]


# 1. Through every via point, in order, exactly.


@given(seeds)
def test_the_path_runs_through_every_via_point_in_order(random_mission: Make, seed: int) -> None:
    mission = random_mission(seed)
    assume(mission is not None)
    assert mission is not None
    found = planned(mission)
    if found is None:
        return
    stops = [np.array(via.at) for _, via in mission.route.points()]
    if mission.route.closed:
        stops.append(stops[0])
    served = users(found.path)
    assert [via.index for via in served] == list(range(len(stops)))
    for via, stop in zip(served, stops, strict=True):
        np.testing.assert_array_equal(found.path.evaluate(via.u), stop)
        np.testing.assert_array_equal(via.at, stop)
    everything = [via.u for via in found.path.vias]
    assert everything == sorted(everything)
    for via in found.path.vias:
        np.testing.assert_allclose(found.path.evaluate(via.u), via.at, atol=1e-9)
    for end, u in (("start", 0.0), ("goal", found.path.domain[1])):
        point = getattr(mission.route, end)
        heading = None if point is None else point.heading_deg
        # at tension 1 the curve is the polyline and has no tangent to turn
        if heading is not None and np.linalg.norm(found.path.evaluate(u, 1)[:2]) > 1e-6:
            turn = float(found.path.heading(u)) - math.radians(heading)
            assert abs(math.remainder(turn, math.tau)) < 1e-6


# 2. Proven, not sampled.


@settings(max_examples=40)
@given(seeds)
def test_the_certificate_holds_and_shapely_agrees(
    random_mission: Make, shapely_distance: Oracle, seed: int
) -> None:
    mission = random_mission(seed)
    assume(mission is not None)
    assert mission is not None
    found = planned(mission)
    if found is None:
        return
    robot = mission.robot
    least = least_distance(shapely_distance, found.path.spans, found.world)
    assert found.certificate.holds
    assert found.certificate.required == robot.clearance_m
    assert least >= robot.radius_m + robot.clearance_m - PROOF_SLACK_M - 1e-9
    assert found.certificate.clearance <= least - robot.radius_m + 1e-9


# 3. If there is a way, it is found; if there is none, the reason is given.


@settings(max_examples=80)
@given(seeds)
@example(1057)  # a robot without a size took minutes along walls that it touches
def test_a_dense_world_is_served_or_refused_with_a_reason(random_mission: Make, seed: int) -> None:
    rng = np.random.default_rng(seed)
    mission = random_mission(seed, most=int(rng.choice([40, 60, 80])))
    if mission is None:
        return
    found = planned(mission)
    assert found is None or found.certificate.holds


@settings(max_examples=60)
@given(seeds)
@example(7545)  # the curve was clear to within less than the certificate could prove
@example(593)  # a string that found no place in a wide gap took it for a narrow one
@example(1711)  # a neighbour turned the tangents of a leg that had been led round already
def test_where_shapely_sees_a_corridor_there_is_a_path(random_mission: Make, seed: int) -> None:
    mission = random_mission(seed, most=70, sides=False)
    assume(mission is not None)
    assert mission is not None
    required = mission.robot.radius_m + mission.robot.clearance_m
    world = vs.World.known(mission)
    shapes = [
        shapely.Point(o.circle.center).buffer(o.circle.radius + required + 0.01, quad_segs=64)
        if o.circle is not None
        else shapely.Polygon(o.polygon).buffer(required + 0.01, quad_segs=64)
        for o in world.obstacles
    ]
    x0, y0, x1, y1 = mission.world.bounds or (0, 0, 0, 0)
    inner = shapely.box(x0 + required, y0 + required, x1 - required, y1 - required)
    for fence in world.fences:
        inner = inner.intersection(shapely.Polygon(fence).buffer(-required - 0.01, quad_segs=64))
    free = inner.difference(shapely.union_all(shapes).buffer(1e-3))
    parts = getattr(free, "geoms", [free])
    stops = [shapely.Point(via.at[:2]) for _, via in mission.route.points()]
    rooms = [[k for k, part in enumerate(parts) if part.covers(stop)] for stop in stops]
    if all(rooms) and len({room[0] for room in rooms}) == 1:
        assert vs.plan(mission).certificate.holds


# 4. A detour changes only the spans that it must.


@given(seeds)
@pytest.mark.parametrize("tangents", ["cardinal", "continuous"])
def test_spans_away_from_a_detour_stay_as_they_are_to_the_bit(tangents: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    stops = np.cumsum(rng.uniform(15, 30, (8, 2)) * [1.0, 0.3], axis=0)
    knots = str(rng.choice(["uniform", "centripetal", "chordal"]))
    start, *via, goal = stops.tolist()
    mission: dict[str, Any] = {
        "route": {"start": start, "via": via, "goal": goal},
        "spline": {"tension": float(rng.uniform(-0.5, 1)), "knots": knots, "tangents": tangents},
    }
    free = vs.plan(vs.Mission.model_validate(mission)).path
    blocked = int(rng.integers(0, 7))
    was = {via.index: round(via.u) for via in users(free)}
    middle = free.evaluate((was[blocked] + was[blocked + 1]) / 2).tolist()
    mission["world"] = {"known": [{"circle": {"center": middle, "radius": 2.0}}]}
    found = vs.plan(vs.Mission.model_validate(mission)).path
    at = {via.index: round(via.u) for via in users(found)}
    changed = [
        leg
        for leg in range(7)
        if not np.array_equal(
            found.spans[at[leg] : at[leg + 1]], free.spans[was[leg] : was[leg + 1]]
        )
    ]
    # a span of a cardinal spline depends on the two points before it and the two after it
    assert blocked in changed
    assert set(changed) <= {blocked - 1, blocked, blocked + 1}


def sides_of(path: vs.Path, u: float) -> tuple[Floats, Floats, float, float]:
    """Unit tangents and signed curvatures just before and just after a joint, from the spans."""
    k = round(u)
    before, after = np.asarray(path.spans[k - 1])[::-1], np.asarray(path.spans[k])
    out = []
    for control, sense in ((before, -1.0), (after, 1.0)):
        first = 3 * (control[1] - control[0])[:2]
        second = 6 * (control[2] - 2 * control[1] + control[0])[:2]
        speed = float(np.linalg.norm(first))
        bend = float(first[0] * second[1] - first[1] * second[0]) / speed**3
        out.append((sense * first / speed, sense * bend))
    return out[0][0], out[1][0], out[0][1], out[1][1]


def under_way(
    random_mission: Make, seed: int
) -> tuple[vs.Mission, vs.Plan, float, vs.World] | None:
    """A plan that is being driven, a place on it, and a world with something new ahead."""
    rng = np.random.default_rng(seed)
    mission = random_mission(seed, most=15, sides=False)
    if mission is None or (mission.route.closed and len(mission.route.via) < 2):
        return None
    found = planned(mission)
    if found is None:
        return None
    path, required = found.path, mission.robot.radius_m + mission.robot.clearance_m
    at = float(rng.uniform(0, 0.6) * path.length)
    if rng.random() < 0.3:
        at = float(rng.choice(path.via_distances[:-1]))
    ahead = float(rng.uniform(at, path.length))
    middle = path.at_distance(ahead)[:2] + rng.normal(0, 1, 2)
    new = vs.Obstacle(circle={"center": tuple(middle.tolist()), "radius": rng.uniform(0.3, 3)})
    if np.linalg.norm(middle - path.at_distance(at)[:2]) < new.circle.radius + required + 1:
        return None
    return mission, found, at, found.world.with_obstacles([new])


def attempt(
    mode: str, path: vs.Path, at: float, world: vs.World, brief: Requirements
) -> Solution | None:
    try:
        found: Solution = getattr(replan, mode)(path, at, world, brief)
    except vs.PlanningError as error:
        check_reason(error)
        return None
    return found


@settings(max_examples=40)
@given(seeds, st.sampled_from(MODES))
def test_a_new_path_under_way_keeps_what_was_driven_and_is_proven_ahead(
    random_mission: Make, shapely_distance: Oracle, seed: int, mode: str
) -> None:
    case = under_way(random_mission, seed)
    assume(case is not None)
    assert case is not None
    mission, old, at, world = case
    brief = Requirements.of(mission)
    found = attempt(mode, old.path, at, world, brief)
    if found is None:
        return
    new, leaves = found.path, found.changed_from
    assert leaves >= at - 1e-6
    driven = np.linspace(0, leaves, 200)
    np.testing.assert_allclose(new.at_distance(driven), old.path.at_distance(driven), atol=1e-6)
    whole = int(old.path.parameter(leaves) + 1e-9)
    np.testing.assert_array_equal(new.spans[:whole], old.path.spans[:whole])
    u = float(new.parameter(leaves))
    if new.length - leaves > 1e-3:
        ahead = new.section(min(u, new.domain[1] - 1e-6), new.domain[1])
        least = least_distance(shapely_distance, ahead.spans, world)
        assert found.certificate.holds
        assert least >= brief.required - PROOF_SLACK_M - 1e-9
        assert found.certificate.clearance <= least - brief.radius + 1e-8
    np.testing.assert_allclose(
        new.at_distance(found.certificate.tightest_distance),
        found.certificate.tightest_at,
        atol=1e-5,
    )
    np.testing.assert_allclose(
        new.evaluate(found.certificate.tightest_u), found.certificate.tightest_at, atol=1e-5
    )
    assert [via.index for via in users(new)] == [via.index for via in users(old.path)]
    for via in new.vias:
        np.testing.assert_allclose(new.evaluate(via.u), via.at, atol=1e-9)
    goal = mission.route.goal
    end = new.domain[1]
    if goal is not None and goal.heading_deg is not None and np.any(new.evaluate(end, 1)[:2]):
        turn = float(new.heading(end)) - math.radians(goal.heading_deg)
        assert abs(math.remainder(turn, math.tau)) < 1e-6


@settings(max_examples=40)
@given(seeds, st.sampled_from(("reflex", "planned")))
def test_both_joints_of_a_new_path_continue_place_heading_and_curvature(
    random_mission: Make, seed: int, mode: str
) -> None:
    case = under_way(random_mission, seed)
    assume(case is not None)
    assert case is not None
    mission, old, at, world = case
    found = attempt(mode, old.path, at, world, Requirements.of(mission))
    if found is None or found.path is old.path:
        return
    new, leaves = found.path, found.changed_from
    u = round(float(new.parameter(leaves)))
    before = float(old.path.parameter(leaves))
    if abs(before - round(before)) < 1e-6:
        before = float(round(before))
    if u > 0 and np.linalg.norm(old.path.evaluate(before, 1)[:2]) > 1e-3 and new.dimension == 2:
        _, tangent, _, bend = sides_of(new, u)
        np.testing.assert_allclose(tangent, old.path.tangent(before)[:2], atol=1e-9)
        # of the old path the side after the place counts: as that would have gone on
        assert bend == pytest.approx(float(old.path.curvature(before)), rel=1e-6, abs=1e-6)
    np.testing.assert_allclose(new.evaluate(float(u)), old.path.evaluate(before), atol=1e-9)
    if found.rejoins_at is not None:
        k = round(float(new.parameter(found.rejoins_at)))
        rest = len(new.spans) - k
        np.testing.assert_array_equal(new.spans[k:], old.path.spans[-rest:])
        first = new.spans[k, 1, :2] - new.spans[k, 0, :2]
        if np.linalg.norm(first) > 1e-3 and new.dimension == 2:
            arriving, going_on, bend, old_bend = sides_of(new, k)
            np.testing.assert_allclose(arriving, going_on, atol=1e-9)
            assert bend == pytest.approx(old_bend, rel=1e-6, abs=1e-6)
    for k in range(u + 1, len(new.spans)):
        ends = new.spans[k - 1, 3] - new.spans[k - 1, 2], new.spans[k, 1] - new.spans[k, 0]
        lengths = [float(np.linalg.norm(end)) for end in ends]
        if min(lengths) > 1e-6:
            assert float(ends[0] @ ends[1]) / math.prod(lengths) > 1 - 1e-6  # never a kink
