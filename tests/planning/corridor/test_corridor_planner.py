"""Paths along corridors: inside by proof, through their via points, as straight as they can be."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.mission.strip import Strip, corridor_area
from viaspline.planning.corridor.corridor_planner import line_through


def ring(radius: float = 30.0, right: float = 4.0, left: float = 4.0, waves: float = 0.0) -> list:
    angle = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    radii = radius * (1 + waves * np.sin(3 * angle))
    widths = np.full(90, right), np.full(90, left)
    return np.column_stack((radii * np.cos(angle), radii * np.sin(angle), *widths)).tolist()


def planned(line: list, robot: dict | None = None, world: dict | None = None, **route) -> vs.Plan:
    return vs.plan(
        vs.Mission.model_validate({
            "robot": {"radius_m": 0.5, "clearance_m": 0.25} | (robot or {}),
            "world": world or {},
            "route": {"start": line[0][:2], "corridor": {"line": line}} | route,
        })
    )  # fmt: skip


def least_room(plan: vs.Plan) -> float:
    """By shapely, dense [m]; negative outside."""
    area = corridor_area(plan.mission.route)
    points = shapely.points(plan.path.evaluate(np.linspace(*plan.path.domain, 20_001)))
    room = shapely.distance(area.boundary, points)
    return float(np.where(area.contains(points), room, -room).min())


def test_a_straight_lane_is_driven_straight() -> None:
    lane = [[x, 0.0, 2, 2] for x in range(0, 101, 10)]
    plan = planned(lane, goal=[100, 0])
    assert plan.path.length == pytest.approx(100, abs=1e-6)
    assert plan.path.max_curvature()[0] < 1e-6


def test_a_bend_is_cut_as_far_as_the_corridor_lets() -> None:
    plan = planned(ring(30, 4, 4), closed=True, start=[33.2, 0])
    assert plan.certificate.holds
    assert least_room(plan) >= 0.75 - 1e-6
    # a ring's line of least curvature is the outer circle that the robot still fits in
    assert plan.path.max_curvature()[0] == pytest.approx(1 / 33.2, rel=0.03)


def test_the_curve_is_seamless_in_place_heading_and_curvature() -> None:
    plan = planned(ring(waves=0.2), closed=True)
    loop = vs.PiecewiseCubic(plan.path.spans, closed=True)
    assert loop.curvature_jumps().max() < 1e-6
    assert plan.path.spans[0, 0].tolist() == plan.path.spans[-1, 3].tolist()


def test_a_corner_bends_less_than_any_circle_in_the_middle() -> None:
    corner = [[x, 0.0, 5, 5] for x in range(0, 41, 4)]
    angle = np.linspace(0, np.pi / 2, 8)[1:]
    corner += np.column_stack(
        (40 + 8 * np.sin(angle), 8 - 8 * np.cos(angle), *np.full((2, 7), 5.0))
    ).tolist()
    corner += [[48.0, y, 5, 5] for y in range(12, 53, 4)]
    plan = planned(corner, goal=[48, 52])
    assert plan.certificate.holds
    assert plan.path.max_curvature()[0] < 1 / 16


@settings(max_examples=10, deadline=None)
@given(
    st.floats(0.0, 0.25), st.floats(2.5, 5.0), st.floats(2.5, 5.0),
    st.lists(st.tuples(st.integers(5, 84), st.floats(-0.6, 0.6)), max_size=3,
             unique_by=lambda gate: gate[0] // 15),
)  # fmt: skip
def test_it_stays_inside_and_runs_through_its_via_points(
    waves: float, right: float, left: float, gates: list[tuple[int, float]]
) -> None:
    line = ring(20, right, left, waves)
    table = np.array(line)
    strip = Strip.of_rows(line, closed=True)
    vias = []
    for row, share in sorted(gates):
        edge = strip.left[row] if share > 0 else strip.right[row]
        vias.append((table[row, :2] + abs(share) * (edge - table[row, :2])).tolist())
    plan = planned(line, closed=True, via=vias)
    assert plan.certificate.holds
    assert least_room(plan) >= 0.75 - 1e-5
    for via in plan.path.vias:
        np.testing.assert_allclose(plan.path.evaluate(via.u), via.at, atol=1e-12)
    users = [via for via in plan.path.vias if via.kind == "user"]
    assert [list(via.at) for via in users[1:-1]] == vias
    distances = plan.path.via_distances
    assert (np.diff(distances) > 0).all()


def test_headings_at_the_ends_are_kept() -> None:
    lane = [[x, 0.0, 6, 6] for x in range(0, 61, 5)]
    plan = planned(
        lane, start={"at": [0, 0], "heading_deg": 30}, goal={"at": [60, 1], "heading_deg": -20}
    )
    assert np.degrees(plan.path.heading(0.0)) == pytest.approx(30, abs=1e-3)
    assert np.degrees(plan.path.heading(plan.path.domain[1])) == pytest.approx(-20, abs=1e-3)


def test_it_goes_round_what_stands_in_the_corridor() -> None:
    rock = {"name": "rock", "circle": {"center": [0, 30.5], "radius": 1.0}}
    plan = planned(ring(), closed=True, world={"known": [rock]})
    assert plan.certificate.holds
    points = plan.path.evaluate(np.linspace(*plan.path.domain, 20_001))
    assert np.hypot(*(points - (0, 30.5)).T).min() >= 1.75 - 1e-5
    assert least_room(plan) >= 0.75 - 1e-5


def test_what_blocks_the_corridor_is_named() -> None:
    wall = {"name": "wall", "polygon": [[-1, 25], [1, 25], [1, 35], [-1, 35]]}
    with pytest.raises(vs.NoPathError, match="the corridor is blocked") as caught:
        planned(ring(), closed=True, world={"known": [wall]})
    assert np.hypot(*np.array(caught.value.where)) < 40


def test_a_place_that_is_too_narrow_is_named_with_its_width() -> None:
    line = ring()
    line[40][2:] = [0.6, 0.6]
    with pytest.raises(vs.NoPathError, match=r"1\.2 m wide, and the robot needs 1\.5 m") as caught:
        planned(line, closed=True)
    np.testing.assert_allclose(caught.value.where, line[40][:2], atol=1e-6)
    assert caught.value.obstacles == ("corridor",)


def test_via_points_against_the_direction_are_refused() -> None:
    line = ring()
    with pytest.raises(vs.NoPathError, match="'via 2' lies before 'via 1' along the corridor"):
        planned(line, closed=True, via=[line[40][:2], line[20][:2]])


def test_a_turning_circle_is_kept_or_the_bend_is_named() -> None:
    line = ring(10, 3, 3)
    plan = planned(line, {"min_turn_radius_m": 9.0}, closed=True)
    assert plan.path.max_curvature()[0] <= 1 / 9 + 1e-9
    with pytest.raises(vs.NoPathError, match="the corridor bends so sharply"):
        planned(line, {"min_turn_radius_m": 15.0}, closed=True)


def test_a_figure_of_eight_is_driven_lane_by_lane() -> None:
    t = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    line = np.column_stack((60 * np.sin(t), 30 * np.sin(2 * t), np.full((120, 2), 4.0))).tolist()
    plan = planned(line, closed=True)
    assert plan.certificate.holds
    strip = Strip.of_rows(line, closed=True)
    at = np.linspace(0, plan.path.length, 121)[:-1]
    points = plan.path.at_distance(at)
    rows = strip.track(points, 0, 8)
    assert (np.diff(rows) >= 0).all()
    assert np.linalg.norm(points - strip.middle[rows], axis=1).max() < 4.5


def test_widths_about_the_route_are_a_bound() -> None:
    route = {"start": [0, 0], "via": [[40, 0], [40, 40]], "goal": [0, 40]}
    wide = vs.plan(vs.Mission.model_validate({"route": route}))
    lane = {"corridor": {"left_m": 1.6, "right_m": 1.6}}
    narrow = vs.plan(vs.Mission.model_validate({"route": route | lane}))
    assert narrow.certificate.holds
    assert narrow.certificate.obstacle == "corridor"
    area = corridor_area(narrow.mission.route)
    points = shapely.points(narrow.path.evaluate(np.linspace(*narrow.path.domain, 5001)))
    assert area.contains(points).all()
    assert shapely.distance(area.boundary, points).min() >= 1.0 - 1e-5
    assert wide.certificate.obstacle is None


def test_a_line_alone_is_a_function_of_its_strip() -> None:
    strip = Strip.of_rows(ring(waves=0.2), closed=True)
    first = line_through(strip, 1.0, places=[strip.middle[5]])
    again = line_through(strip, 1.0, places=[strip.middle[5]])
    np.testing.assert_array_equal(first.spans, again.spans)
    assert first.at.tolist() == [0]
