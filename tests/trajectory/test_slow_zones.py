"""Speed zones against shapely on dense samples, and their bad days."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.curve.slow_parts import ZONE_EDGE_M, slow_parts
from viaspline.errors import GeometryError
from viaspline.mission.model import Mission
from viaspline.mission.world_spec import SpeedZone
from viaspline.planner import plan
from viaspline.robot.simulator import simulate
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime

seeds = st.integers(0, 2**32 - 1)
LIMITS = Limits(max_speed=2.0, max_accel=1.0)


def zone(polygon: object, speed: float = 0.5) -> SpeedZone:
    return SpeedZone.model_validate({"polygon": polygon, "max_speed_mps": speed, "name": "yard"})


def box(x0: float, y0: float, x1: float, y1: float, speed: float = 0.5) -> SpeedZone:
    return zone([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], speed)


def line(length: float = 30.0) -> Path:
    return Path([np.linspace(0, length, 4)[:, None] * [1.0, 0.0]], vias=[])


def star(rng: np.random.Generator) -> list[tuple[float, float]]:
    angles = np.sort(rng.uniform(0, 2 * np.pi, 9))
    radii = rng.uniform(2, 9, 9)
    at = rng.normal(0, 6, 2) + radii[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    return [tuple(corner) for corner in at.tolist()]


@given(seeds)
@settings(deadline=None, max_examples=40)
def test_a_place_is_slow_exactly_where_it_is_inside(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(0, 6, (6, 2)), axis=0)
    path = CardinalSpline(points, knots="centripetal")
    area = shapely.Polygon(star(rng))
    if not area.is_valid:
        return
    u = np.linspace(0, 5, 20_001)
    inside = shapely.contains_xy(area, *path.evaluate(u).T)
    slow = np.zeros(u.size, dtype=bool)
    for low, high, speed in slow_parts(path.spans, [zone(list(area.exterior.coords)[:-1])]):
        assert speed == 0.5
        slow |= (u >= low) & (u <= high)
    assert not np.any(inside & ~slow)
    wrong = shapely.points(path.evaluate(u[slow & ~inside]))
    assert np.all(shapely.distance(area, wrong) <= 2 * ZONE_EDGE_M)


@given(seeds)
@settings(deadline=None, max_examples=30)
def test_a_curve_along_a_turned_edge_is_slow_all_along_it_in_one_part(seed: int) -> None:
    rng = np.random.default_rng(seed)
    way, at = rng.normal(0, 1, 2), rng.normal(0, 20, 2)
    way /= np.hypot(*way)
    across = way[::-1] * (-1.0, 1.0)
    beside = float(rng.uniform(0.0, 0.9)) * ZONE_EDGE_M
    corners = [at, at + 9 * way, at + 9 * way + 4 * across, at + 4 * across]
    edge = at + np.linspace(0, 9, 4)[:, None] * way + beside * across
    area = zone([tuple(corner) for corner in np.array(corners).tolist()])
    (low, high, _), *others = slow_parts(edge[None], [area])
    assert not others
    assert (low, high) == pytest.approx((0.0, 1.0), abs=1e-6)


@given(seeds)
@settings(deadline=None, max_examples=30)
def test_parts_are_as_many_as_the_crossings_say(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = CardinalSpline(np.cumsum(rng.normal(0, 6, (5, 2)), axis=0), knots="centripetal")
    areas = [one for one in (shapely.Polygon(star(rng)) for _ in range(3)) if one.is_valid]
    zones = [zone(list(one.exterior.coords)[:-1], 0.1 * (k + 1)) for k, one in enumerate(areas)]
    inside = [shapely.contains_xy(a, *path.evaluate(np.linspace(0, 4, 200_001)).T) for a in areas]
    runs = [int(within[0]) + int(np.sum(~within[:-1] & within[1:])) for within in inside]
    found = [speed for _, _, speed in slow_parts(path.spans, zones)]
    counted = [found.count(one.max_speed_mps) for one in zones]
    assert all(many >= few for many, few in zip(counted, runs, strict=True))  # samples miss some
    assert sum(counted) - sum(runs) <= 2


def test_a_zone_inside_of_a_span_that_goes_round_it_is_found_only_where_it_is_met() -> None:
    round_it = np.array([[[0.0, 0.0], [30.0, 0.0], [30.0, 20.0], [0.0, 20.0]]])
    assert slow_parts(round_it, [box(8, 9, 9, 10)]) == []
    (part,) = slow_parts(round_it, [box(22, 9, 23, 10)])
    assert 0.4 < part[0] < 0.5 < part[1] < 0.6


def test_a_line_through_a_zone_slows_down_for_it_and_speeds_up_behind() -> None:
    law = retime(line(), LIMITS, zones=[box(10, -1, 20, 1)])
    assert law.speed_at([10.0, 15.0, 20.0]) == pytest.approx([0.5, 0.5, 0.5], abs=1e-5)
    ramp = (2.0**2 - 0.5**2) / 2
    around = 2 * (2.0 + 1.5 + (10 - 2 - ramp) / 2.0)
    assert law.duration == pytest.approx(20.0 + around, abs=1e-4)


def test_of_two_zones_the_slower_one_counts() -> None:
    law = retime(line(), LIMITS, zones=[box(5, -1, 25, 1, 1.0), box(12, -1, 18, 1, 0.25)])
    assert law.speed_at([8.0, 15.0, 23.0]) == pytest.approx([1.0, 0.25, 1.0], abs=1e-5)


def test_a_zone_that_allows_more_than_the_robot_changes_nothing() -> None:
    assert retime(line(), LIMITS, zones=[box(5, -1, 25, 1, 9.0)]).duration == pytest.approx(17.0)


def test_a_station_inside_a_zone_is_a_stop_like_any_other() -> None:
    law = retime(line(), LIMITS, [Station(15.0, 4.0)], zones=[box(10, -1, 20, 1)])
    free = retime(line(), LIMITS, zones=[box(10, -1, 20, 1)])
    assert law.speed_at(15.0) == 0.0
    assert law.duration == pytest.approx(free.duration + 4.0 + 0.5, abs=1e-4)


def test_a_path_along_an_edge_counts_as_inside_and_one_beside_it_does_not() -> None:
    spans = line().spans
    assert slow_parts(spans, [box(10, 0, 20, 1)])[0][:2] == pytest.approx((1 / 3, 2 / 3), abs=1e-6)
    assert slow_parts(spans, [box(10, 1e-5, 20, 1)]) == []


def test_a_path_that_touches_a_corner_passes_it_slowly() -> None:
    law = retime(line(), LIMITS, zones=[zone([(15, 0), (16, 1), (14, 1)])])
    assert law.speed_at(15.0) == pytest.approx(0.5)


def test_a_start_inside_a_zone_that_is_too_fast_brakes_and_says_how_far() -> None:
    law = retime(line(), LIMITS, zones=[box(-1, -1, 20, 1, 1.0)], start_speed=2.0)
    assert law.over_limit_until == pytest.approx(1.5)


def test_zones_hold_on_coupled_limits_as_well() -> None:
    limits = Limits(max_speed=2.0, max_accel=1.0, axis_accel=1.0)
    law = retime(line(), limits, zones=[box(10, -1, 20, 1)])
    assert np.all(law.speed_at(np.linspace(10, 20, 501)) <= 0.5 * (1 + 1e-9))
    expected = retime(line(), LIMITS, zones=[box(10, -1, 20, 1)]).duration
    assert law.duration == pytest.approx(expected, rel=5e-3)


def test_in_space_a_zone_stands_upright() -> None:
    way = np.linspace(0, 30, 4)[:, None] * [1.0, 0.0, 0.5]
    assert len(slow_parts(way[None], [box(10, -1, 20, 1)])) == 1


def test_what_is_no_area_is_refused_by_name() -> None:
    bow = [(0, 0), (4, 4), (4, 0), (0, 4)]
    with pytest.raises(GeometryError, match="speed zone 'yard' isn't an area"):
        retime(line(), LIMITS, zones=[zone(bow)])
    flat = np.linspace(0, 3, 4)[:, None]
    with pytest.raises(GeometryError, match="one dimension"):
        slow_parts(flat[None], [box(0, 0, 1, 1)])


def test_a_plan_and_a_drive_keep_to_the_zones_of_their_mission() -> None:
    mission = Mission.model_validate({
        "world": {
            "unseen": [{"circle": {"center": [40, 0.5], "radius": 2}}],
            "speed_zones": [{"polygon": [[30, -90], [50, -90], [50, 90], [30, 90]],
                             "max_speed_mps": 0.5}],
        },
        "robot": {"sensor": {"range_m": 20}, "max_brake_mps2": 2},
        "route": {"start": [0, 0], "goal": [70, 0]},
    })  # fmt: skip
    assert plan(mission).trajectory.speed_at(40.0) == pytest.approx(0.5)
    run = simulate(mission)
    assert run.reached
    assert run.replans
    x = run.positions[:, 0]
    steps = np.linalg.norm(np.diff(run.positions, axis=0), axis=1) / np.diff(run.times)
    within = (x[1:] < 50) & (x[:-1] > 30)
    assert steps[within].max() <= 0.5 * (1 + 1e-3)
    assert steps.max() > 1.5
