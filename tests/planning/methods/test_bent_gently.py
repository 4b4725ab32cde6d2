"""Paths bent less, beside the lines and turns that they were."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
import shapely
from shapely.affinity import affine_transform

import viaspline as vs
from viaspline.kernels.curve.measure import bending
from viaspline.planning.methods.bent_gently import BentGently
from viaspline.planning.problem.path_pace import Pace
from viaspline.planning.turning.tension_search import GENTLE_SHARE, TensionSearch

KEPT = 1.0
SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
CART = ((-0.7, -0.6), (1.3, -0.6), (1.3, 0.6), (-0.7, 0.6))


def mission(seed: int, speed: float = 2.0, **route: object) -> vs.Mission:
    random = np.random.default_rng((77, seed))
    discs = [
        {"circle": {"center": random.uniform((10, -12), (90, 12)).tolist(), "radius": radius}}
        for radius in random.uniform(1.0, 5.0, 7).tolist()
    ]
    return vs.Mission.model_validate({
        "world": {"known": discs},
        "robot": {"radius_m": 0.6, "clearance_m": 0.4, "max_speed_mps": speed, "max_accel_mps2": 1},
        "route": {"start": [0, 0], "via": [[50, 20]], "goal": [100, 0], "detours": "short"} | route,
    })  # fmt: skip


def of_body(asked: vs.Mission) -> vs.Mission:
    """The same for a cart as wide, with a long nose."""
    limits = asked.robot.model_dump(exclude_defaults=True, exclude={"radius_m"})
    return vs.Mission.model_validate({
        "world": asked.world, "route": asked.route, "robot": limits | {"footprint": CART},
    })  # fmt: skip


def without(monkeypatch: pytest.MonkeyPatch, asked: vs.Mission) -> vs.Plan:
    """As it is planned with lines and turns alone."""
    with monkeypatch.context() as patched:
        patched.setattr(BentGently, "lay", lambda self, *given: self.method.lay(*given))
        return vs.plan(asked)


def test_paths_bend_less_take_hardly_longer_and_keep_all_that_they_kept(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    saved = []
    for seed in range(6):
        asked = mission(seed)
        turns, plan = without(monkeypatch, asked), vs.plan(asked)
        before, after = bending(turns.path.spans)[0], bending(plan.path.spans)[0]
        saved.append(1.0 - after / before)
        assert after <= before
        assert plan.trajectory.duration <= 1.004 * turns.trajectory.duration
        assert plan.certificate.clearance >= 0.4
        assert plan.path.curvature_jumps().max() < 1e-6
        (via,) = [via for via in plan.path.vias if via.kind == "user" and via.at == (50.0, 20.0)]
        assert plan.path.evaluate(via.u).tolist() == [50.0, 20.0]
        places = plan.path.evaluate(np.linspace(*plan.path.domain, 4001))
        solid = [
            shapely.Point(disc.circle.center).buffer(disc.circle.radius, 64)
            for disc in asked.world.known
            if disc.circle is not None
        ]
        gaps = shapely.distance(shapely.points(places), shapely.union_all(solid))
        assert gaps.min() >= KEPT - 1e-6
    assert np.median(saved) > 0.05


def test_a_curve_past_two_discs_is_that_of_least_bending() -> None:
    """Beside the middle of one disc and free at both ends, its curvature falls evenly to zero."""
    asked = vs.Mission.model_validate({
        "world": {"known": [{"circle": {"center": [50, -3], "radius": 3.5}}]},
        "robot": {"radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 2},
        "route": {"start": [0, 0], "goal": [100, 0], "detours": "short"},
    })  # fmt: skip
    path = vs.plan(asked).path
    half = np.array([abs(path.curvature(u)) for u in np.linspace(0.0, len(path.spans), 401)])[:201]
    peak = half.max()
    assert peak == pytest.approx(3.0 * 1.5 / 50.0**2, rel=0.05)  # a beam's: 3 height / half²
    assert np.diff(half).min() > -0.02 * peak


@pytest.mark.parametrize("route", [{"optimise": "length"}, {"spline": True}])
def test_paths_that_are_not_bent_are_as_they_were(
    monkeypatch: pytest.MonkeyPatch, route: dict[str, object]
) -> None:
    asked = mission(3, **{key: value for key, value in route.items() if key != "spline"})
    if "spline" in route:
        asked = asked.model_copy(update={"spline": asked.spline.model_copy(update={"tension": 0})})
    np.testing.assert_array_equal(without(monkeypatch, asked).path.spans, vs.plan(asked).path.spans)


@pytest.mark.parametrize("seed", range(4))
def test_given_headings_are_kept_straight_and_the_path_between_bends_less(
    monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    ends = {
        "start": {"at": [0, 0], "heading_deg": 40},
        "goal": {"at": [100, 0], "heading_deg": -30},
    }
    asked = mission(seed, **ends)
    turns, plan = without(monkeypatch, asked), vs.plan(asked)
    assert bending(plan.path.spans)[0] < 0.98 * bending(turns.path.spans)[0]
    path = plan.path
    for u, heading in ((0.0, 40.0), (float(len(path.spans)), -30.0)):
        along = np.radians(heading)
        np.testing.assert_allclose(path.tangent(u), (np.cos(along), np.sin(along)), atol=1e-9)
        assert abs(path.curvature(u)) < 1e-7
    assert path.curvature_jumps().max() < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_a_round_bends_less_and_goes_on_at_its_seam_without_a_jump(
    monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    asked = mission(seed, speed=6.0, via=[[50, 20], [100, 0]], goal=None, closed=True)
    if seed % 2:
        asked = of_body(asked)
    turns, plan = without(monkeypatch, asked), vs.plan(asked)
    path, last = plan.path, float(len(plan.path.spans))
    assert bending(path.spans)[0] < 0.98 * bending(turns.path.spans)[0]
    assert plan.trajectory.duration <= 1.004 * turns.trajectory.duration
    np.testing.assert_allclose(path.tangent(0.0), path.tangent(last), atol=1e-9)
    assert path.curvature(0.0) == pytest.approx(path.curvature(last), abs=1e-7)
    assert path.evaluate(last).tolist() == path.evaluate(0.0).tolist() == [0.0, 0.0]


@pytest.mark.parametrize("closed", [False, True])
def test_lanes_stay_as_they_were_and_what_leaves_them_bends_less(
    monkeypatch: pytest.MonkeyPatch, closed: bool
) -> None:
    ends: dict[str, object] = {"via": [[300, 0], [300, 200]], "goal": None if closed else [0, 200]}
    asked = vs.Mission.model_validate({
        "world": {"known": [
            {"circle": {"center": [150, 1], "radius": 4}},
            {"circle": {"center": [298, 100], "radius": 5}},
        ]},
        "robot": {"radius_m": 0.6, "clearance_m": 0.4, "max_speed_mps": 2, "max_accel_mps2": 1},
        "route": {"start": [0, 0], "detours": "local", "closed": closed} | ends,
    })  # fmt: skip
    turns, plan = without(monkeypatch, asked).path, vs.plan(asked).path
    assert bending(plan.spans)[0] < 0.995 * bending(turns.spans)[0]
    kept = {spans.tobytes() for spans in plan.spans}
    long = [spans for spans in turns.spans if np.hypot(*(spans[3] - spans[0])) > 50.0]
    assert len(long) >= 4
    assert all(spans.tobytes() in kept for spans in long)
    assert plan.curvature_jumps().max() < 1e-6


def test_no_turn_gets_sharper_that_has_to_be_slowed_down_for_unless_it_is_sooner(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for seed, speed in product(range(4), (2.0, 6.0)):
        asked = mission(seed, speed=speed, via=[[50, 20], [20, -15], [80, -15]])
        turns, plan = without(monkeypatch, asked), vs.plan(asked)
        is_sooner = plan.trajectory.duration < turns.trajectory.duration
        fast = 1.0 / speed**2  # what may be driven at full speed
        least = max(bending(turns.path.spans)[1], fast)
        assert is_sooner or bending(plan.path.spans)[1] <= 1.002 * least


def test_where_corners_cost_time_a_path_that_bends_less_is_driven_sooner(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    saved = []
    for seed in range(6):
        asked = mission(seed, speed=6.0, via=[[50, 20], [20, -15], [80, -15]])
        turns, plan = without(monkeypatch, asked), vs.plan(asked)
        saved.append(1.0 - plan.trajectory.duration / turns.trajectory.duration)
    assert min(saved) > -0.004
    assert np.median(saved) > 0.01


@pytest.mark.parametrize(("wide", "long", "lateral"), [(2.0, 8.0, 1.0), (3.0, 16.0, 0.5)])
def test_where_the_robot_slows_down_for_a_corner_its_turn_is_blunter_and_sooner(
    monkeypatch: pytest.MonkeyPatch, wide: float, long: float, lateral: float
) -> None:
    """Against the inner corner of a corridor, where what bends least has its curvature pointed."""
    side = long + wide
    asked = vs.Mission.model_validate({
        "world": {
            "bounds": [0, 0, side, side],
            "known": [{"polygon": [[0, wide], [long, wide], [long, side], [0, side]]}],
        },
        "robot": {
            "radius_m": 0.3, "clearance_m": 0.2, "max_speed_mps": 2,
            "max_accel_mps2": 1, "max_lateral_accel_mps2": lateral,
        },
        "route": {"start": [0.6, wide / 2], "goal": [side - wide / 2, side - 0.6]},
    })  # fmt: skip
    blunt = vs.plan(asked)
    with monkeypatch.context() as patched:
        patched.setattr(Pace, "slowing", np.inf)
        pointed = vs.plan(asked)
    assert blunt.trajectory.duration < 0.999 * pointed.trajectory.duration
    assert bending(blunt.path.spans)[1] < 0.9 * bending(pointed.path.spans)[1]
    assert bending(blunt.path.spans)[0] < 1.03 * bending(pointed.path.spans)[0]
    assert blunt.certificate.clearance >= 0.2


def test_bodies_bend_as_little_as_discs_that_are_as_wide(monkeypatch: pytest.MonkeyPatch) -> None:
    ring = shapely.Polygon(CART)
    for seed in range(4):
        disc, cart = mission(seed, speed=6.0), of_body(mission(seed, speed=6.0))
        best, turns, plan = vs.plan(disc), without(monkeypatch, cart), vs.plan(cart)
        assert plan.trajectory.duration <= 1.002 * turns.trajectory.duration
        assert plan.trajectory.duration <= 1.01 * best.trajectory.duration
        assert bending(plan.path.spans)[0] <= 1.1 * bending(best.path.spans)[0]
        assert plan.certificate.clearance >= 0.4
        at = np.linspace(*plan.path.domain, 2001)
        poses = zip(plan.path.evaluate(at), plan.path.tangent(at), strict=True)
        bodies = [affine_transform(ring, [t[0], -t[1], t[1], t[0], *p]) for p, t in poses]
        solid = [
            shapely.Point(one.circle.center).buffer(one.circle.radius, 64)
            for one in cart.world.known
            if one.circle is not None
        ]
        assert shapely.distance(bodies, shapely.union_all(solid)).min() >= 0.4 - 1e-6


def test_a_body_that_has_no_room_to_turn_at_its_ends_bends_less_between_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    walls = [
        {"polygon": [[x, y], [x + 5, y], [x + 5, y + 1], [x, y + 1]]}
        for x in (-2, 57)
        for y in (1.2, -2.2)
    ]
    free = of_body(mission(0, goal=[59, 0], via=[]))
    known = [*walls, {"circle": {"center": [30, 1], "radius": 5}}]
    asked = vs.Mission.model_validate({
        "world": {"known": known}, "robot": free.robot, "route": free.route,
    })  # fmt: skip
    turns, plan = without(monkeypatch, asked).path, vs.plan(asked).path
    assert bending(plan.spans)[0] < 0.9 * bending(turns.spans)[0]
    for u, end in ((0.0, 0.0), (float(len(plan.spans)), float(len(turns.spans)))):
        np.testing.assert_allclose(plan.tangent(u), turns.tangent(end), atol=1e-9)


def among_cells(seed: int, radius: float) -> vs.Mission:
    """A disc among blocked cells of a quarter of a metre."""
    blocked = np.argwhere(np.random.default_rng(seed).uniform(size=(40, 16)) < 0.3) / 4
    cells = [{"polygon": (at + SQUARE / 4).tolist()} for at in blocked]
    return vs.Mission.model_validate({
        "world": {"known": cells},
        "robot": {"radius_m": radius, "clearance_m": 0, "max_speed_mps": 2, "max_accel_mps2": 1},
        "route": {"start": [-0.2, 2.1], "goal": [10.2, 2.1]},
    })  # fmt: skip


@pytest.mark.parametrize("seed", [1, 13])
def test_small_robots_are_no_later_than_larger_ones(seed: int) -> None:
    thin, fat = (vs.plan(among_cells(seed, radius)) for radius in (0.0005, 0.01))
    times = thin.trajectory.duration, fat.trajectory.duration
    assert times[0] <= (1.0 + GENTLE_SHARE) * times[1]  # 10.1 and 8.5 s for 1, before
    assert thin.certificate.clearance >= 0.0


def through_door(width: float, off: float) -> vs.Mission:
    """A disc of a metre, and a door of some width in a wall, so far beside the straight way."""
    jambs = [
        {"polygon": (np.array([10.0, low]) + SQUARE * (0.2, high - low)).tolist()}
        for low, high in ((-30.0, off - 0.5 * width), (off + 0.5 * width, 30.0))
    ]
    discs = [
        {"circle": {"center": at, "radius": 1}} for at in ((4.0, 1.0), (15.0, -0.5))
    ]  # fmt: skip
    return vs.Mission.model_validate({
        "world": {"known": jambs + discs},
        "robot": {"radius_m": 0.5, "clearance_m": 0, "max_speed_mps": 2, "max_accel_mps2": 1},
        "route": {"start": [0, 0], "goal": [20, 0]},
    })  # fmt: skip


@pytest.mark.parametrize(("spare", "off"), [(5e-4, 0.0), (0.02, 0.0), (1e-3, 4.0), (0.01, 1.5)])
def test_doors_that_just_fit_are_driven_through_as_soon_as_wide_ones(
    spare: float, off: float
) -> None:
    wide, fits = (vs.plan(through_door(1.0 + more, off)) for more in (0.3, spare))
    within = 1.01 * wide.trajectory.duration  # 16.7 and 12.9 s for 1e-3 and 4, before
    assert fits.trajectory.duration <= within
    assert fits.certificate.clearance >= 0.0


def test_where_no_strip_with_more_places_is_tried_none_would_be_taken(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """In the open such a strip lies as the one with fewer does: what comes of it is known."""
    tried: list[bool] = []
    may = TensionSearch.may_be_taken_finer.fget
    assert may is not None

    def noted(search: TensionSearch) -> bool:
        tried.append(may(search))
        return True

    for seed in range(24):
        rng = np.random.default_rng(seed)
        points = rng.uniform(0.0, 60.0, (int(rng.integers(4, 7)), 2)).tolist()
        asked = vs.Mission.model_validate(
            {
                "robot": {"radius_m": 0.5, "max_speed_mps": 2.0, "max_lateral_accel_mps2": 0.8},
                "route": {"start": points[0], "via": points[1:-1], "goal": points[-1]},
            }
        )
        found = vs.plan(asked)
        with monkeypatch.context() as patched:
            patched.setattr(TensionSearch, "may_be_taken_finer", property(noted))
            always = vs.plan(asked)
        assert found.path.spans.tobytes() == always.path.spans.tobytes()
    assert tried.count(False) > 5
    assert tried.count(True) > 0


@pytest.mark.parametrize("seed", [0, 41, 66])
def test_limits_are_kept_between_via_points_closer_together_than_a_turn(seed: int) -> None:
    random = np.random.default_rng((78, seed))
    places = random.uniform(2, 28, (3, 2))
    way = random.uniform(0, 2 * np.pi, 3)
    near = np.column_stack((np.cos(way), np.sin(way))) * random.uniform(0.12, 0.64, (3, 1))
    *vias, goal = np.stack((places, places + near), axis=1).reshape(-1, 2).round(3).tolist()
    robot = {"radius_m": 0.3, "clearance_m": 0.1, "max_speed_mps": 2, "max_accel_mps2": 0.8}
    plan = vs.plan(vs.Mission.model_validate(
        {"world": {}, "robot": robot, "route": {"start": [15, 15], "via": vias, "goal": goal}}
    ))  # fmt: skip
    count = len(plan.path.spans)
    places, bends = (what(np.linspace(0, count, 40 * count + 1)) for what in
                     (plan.path.evaluate, plan.path.curvature))  # fmt: skip
    along = np.cumsum(np.hypot(*np.diff(places, axis=0, prepend=places[:1]).T))
    at = np.minimum(along, plan.trajectory.distances[-1])
    speeds = np.array([plan.trajectory.speed_at(each) for each in at.tolist()])
    assert (speeds**2 * np.abs(bends)).max() < 1.001 * 0.8
    assert np.abs(bends).max() * 0.3 <= 1.0
    assert plan.drivability.verdict == "good"
