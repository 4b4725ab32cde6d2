"""Days on which a plan is hard and is found all the same."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
import shapely

import viaspline as vs
from asked_missions import BOUNDS, Oracle, clear, disc, mission
from viaspline.planning.plan_path import find_path
from viaspline.planning.problem.requirements import LEAST_KEPT_M, Requirements
from viaspline.planning.problem.via_sequence import via_sequence_of


def test_one_via_point_that_is_the_goal_needs_no_more() -> None:
    found = vs.plan(vs.Mission.model_validate({"route": {"start": [0, 0], "via": [[5, 5]]}}))
    assert found.path.length == pytest.approx(math.hypot(5, 5))
    assert [via.name for via in found.path.vias] == ["start", "via 1"]


def test_via_points_a_micrometre_apart_are_served() -> None:
    found = vs.plan(mission([0, 0], [50, 20], [50, 20 + 1.5e-6], [100, 0], known=[disc(25, 8, 4)]))
    assert found.certificate.holds
    assert [via.index for via in found.path.vias if via.kind == "user"] == [0, 1, 2, 3]


@pytest.mark.parametrize("knots", ["uniform", "centripetal", "chordal"])
@pytest.mark.parametrize("gap", [0.0, 1e-9])
def test_via_points_that_coincide_are_served_where_they_get_through(knots: str, gap: float) -> None:
    wanted = mission([0, 0], [50, 20], [100, 0], spline={"knots": knots})
    course = via_sequence_of(wanted)
    first, middle, last = course.vias
    again = type(middle)("again", middle.at + np.array([0.0, gap]), 2)
    twice = type(course)(
        (first, middle, again, last), (course.legs[0], *course.legs), course.spline
    )
    world = vs.World([vs.Obstacle(**disc(25, 8, 4)), vs.Obstacle(**disc(75, 9, 4))])
    found = find_path(twice, world, Requirements(radius=0.5, clearance=0.5, spline=wanted.spline))
    assert found.certificate.holds


@pytest.mark.parametrize("shift", [1e6, -1e6])
def test_a_million_metres_away_everything_is_as_it_is_here(shift: float) -> None:
    known = [disc(50 + shift, 2 + shift, 10), disc(80 + shift, -5 + shift, 4)]
    there = vs.plan(mission([shift, shift], [100 + shift, shift], known=known))
    here = vs.plan(mission([0, 0], [100, 0], known=[disc(50, 2, 10), disc(80, -5, 4)]))
    assert there.certificate.holds
    assert there.path.length == pytest.approx(here.path.length, abs=1e-5)
    assert there.certificate.clearance == pytest.approx(here.certificate.clearance, abs=2e-3)


def test_a_leg_of_a_thousand_kilometres_goes_round_a_pebble() -> None:
    found = vs.plan(mission([0, 0], [1e6, 0], known=[disc(345_678, 0.1, 0.5)]))
    assert found.certificate.holds
    assert found.path.length == pytest.approx(1e6, abs=1.0)


def test_a_goal_in_the_pocket_of_a_polygon_is_reached(shapely_distance: Oracle) -> None:
    pocket = [[40, 20], [80, 20], [80, 60], [70, 60], [70, 30], [50, 30], [50, 60], [40, 60]]
    for ring in (pocket, pocket[::-1]):
        found = vs.plan(mission([60, 5], [60, 35], known=[{"polygon": ring}], bounds=BOUNDS))
        clear(found, shapely_distance)
        assert found.path.length > 100


def test_obstacles_that_overlap_are_gone_round(shapely_distance: Oracle) -> None:
    known = [disc(50, y, 5) for y in range(30, 71, 5)]
    known += [{"polygon": [[40, 45], [60, 40], [60, 60]]}, disc(50, 50, 9)]
    found = vs.plan(mission([10, 50], [90, 51], known=known, bounds=BOUNDS))
    clear(found, shapely_distance)
    assert len(found.ledger) == 1


@pytest.mark.parametrize("spare", [1e-4, 1e-5])
def test_a_gap_hardly_wider_than_the_body_is_passed(spare: float, shapely_distance: Oracle) -> None:
    for known in (
        [disc(50, 25, 24 - spare / 2), disc(50, 75, 24 - spare / 2)],
        [
            {"polygon": [[49, -9], [50, -9], [50, 49 - spare / 2], [49, 49 - spare / 2]]},
            {"polygon": [[49, 109], [50, 109], [50, 51 + spare / 2], [49, 51 + spare / 2]]},
        ],
    ):
        found = vs.plan(mission([10, 30], [90, 80], known=known, bounds=[0, 10, 100, 90]))
        clear(found, shapely_distance)


def test_a_start_that_faces_a_wall_is_served(shapely_distance: Oracle) -> None:
    wall = [[20, 0], [30, 0], [30, 80], [20, 80]]
    for heading, knots in itertools.product((0, 90, 180), ("uniform", "chordal")):
        found = vs.plan(
            mission(
                {"at": [18, 40], "heading_deg": heading}, {"at": [90, 40], "heading_deg": 45},
                known=[{"polygon": wall}], bounds=BOUNDS, spline={"knots": knots},
            )
        )  # fmt: skip
        clear(found, shapely_distance)
        turn = math.remainder(float(found.path.heading(0)) - math.radians(heading), math.tau)
        assert abs(turn) < 1e-6


@pytest.mark.parametrize("count", [1, 2, 5])
@pytest.mark.parametrize("tangents", ["cardinal", "continuous"])
def test_a_closed_route_comes_back_without_a_kink(
    count: int, tangents: str, shapely_distance: Oracle
) -> None:
    angle = np.linspace(0, 2 * np.pi, count + 1, endpoint=False)
    stops = np.column_stack((50 + 35 * np.cos(angle), 50 + 35 * np.sin(angle))).tolist()
    known = [disc(50, 83, 4), disc(50, 50, 6), disc(80, 40, 3)]
    found = vs.plan(
        mission(*stops, known=known, bounds=BOUNDS, closed=True, spline={"tangents": tangents})
    )
    clear(found, shapely_distance)
    end = found.path.domain[1]
    np.testing.assert_array_equal(found.path.evaluate(end), found.path.evaluate(0.0))
    if count > 1:  # there and back again is a turn on the spot
        turn = float(found.path.heading(end)) - float(found.path.heading(0.0))
        assert abs(math.remainder(turn, math.tau)) < 1e-6
    assert [via.index for via in found.path.vias if via.kind == "user"] == [*range(count + 2)]


def test_heights_are_kept_along_a_detour(shapely_distance: Oracle) -> None:
    found = vs.plan(mission([0, 0, 10], [60, 5, 40], [100, 0, 0], known=[disc(30, 2, 6)]))
    clear(found, shapely_distance)
    heights = found.path.evaluate(np.linspace(0, found.path.domain[1], 1000))[:, 2]
    assert heights.min() > -5
    assert heights.max() < 45
    np.testing.assert_array_equal(found.path.evaluate(found.path.vias[-1].u), [100, 0, 0])


def test_a_climb_straight_up_is_no_way_on_the_ground() -> None:
    found = vs.plan(mission([0, 0, 0], [0, 0, 30], [40, 0, 30], known=[disc(20, 0, 4)]))
    assert found.certificate.holds
    assert found.path.length > 70


SPLINES: list[dict[str, Any]] = [
    {"tension": 1.0},
    {"tension": -1.0},
    {"slack": 0.25},
    {"slack": 2.0},
    {"tension": [0.9, -0.9]},
    {"slack": [0.0, 1.0]},
]


@pytest.mark.parametrize("knots", ["uniform", "centripetal", "chordal"])
@pytest.mark.parametrize("tangents", ["cardinal", "continuous"])
@pytest.mark.parametrize("spline", SPLINES)
def test_every_spline_goes_round_what_is_in_the_way(
    spline: Any, tangents: str, knots: str, shapely_distance: Oracle
) -> None:
    known = [disc(30, 22, 8), disc(70, 30, 9), {"polygon": [[44, 60], [56, 60], [50, 95]]}]
    found = vs.plan(
        mission([5, 10], [50, 50], [90, 20], known=known, bounds=BOUNDS,
                spline={**spline, "knots": knots, "tangents": tangents})
    )  # fmt: skip
    clear(found, shapely_distance)
    for stop, via in zip(
        ([5, 10], [50, 50], [90, 20]),
        (via for via in found.path.vias if via.kind == "user"),
        strict=True,
    ):
        np.testing.assert_array_equal(found.path.evaluate(via.u), stop)


@pytest.mark.parametrize("tangents", ["cardinal", "continuous"])
def test_a_bulge_beside_a_clear_straight_line_is_drawn_in(
    tangents: str, shapely_distance: Oracle
) -> None:
    stops = [[10, 50], [40, 90], [70, 50], [95, 50]]
    free = vs.plan(mission(*stops, bounds=BOUNDS, spline={"tangents": tangents, "tension": -0.5}))
    points = free.path.evaluate(np.linspace(0, 3, 3001))
    line = shapely.LineString(stops)
    gaps = shapely.distance(line, shapely.points(points))
    x, y = points[int(gaps.argmax())].tolist()
    known = [disc(x, y, float(gaps.max()) - 1.05)]
    found = vs.plan(
        mission(*stops, known=known, bounds=BOUNDS, spline={"tangents": tangents, "tension": -0.5})
    )
    clear(found, shapely_distance)
    assert found.path.length < 1.05 * free.path.length


def test_a_route_that_crosses_and_repeats_itself_is_served(shapely_distance: Oracle) -> None:
    eight = [[20, 20], [80, 80], [80, 20], [20, 80]]
    found = vs.plan(
        mission(*eight, *eight, known=[disc(50, 50, 6), disc(80, 50, 3)], bounds=BOUNDS)
    )
    clear(found, shapely_distance)
    assert [via.index for via in found.path.vias if via.kind == "user"] == [*range(8)]


def test_a_point_without_clearance_goes_round_and_not_through() -> None:
    robot = {"radius_m": 0, "clearance_m": 0}
    thin = {"polygon": [[40, -5], [41, -5], [41, 5], [40, 5]]}
    found = vs.plan(mission([0, 0], [100, 0], known=[thin, disc(70, 0.5, 4)], robot=robot))
    assert found.certificate.holds
    assert found.path.length > 100.2
    assert len(found.ledger) == 2
    assert Requirements.of(found.mission).required == LEAST_KEPT_M


def test_a_via_point_at_just_what_is_required_is_served(shapely_distance: Oracle) -> None:
    wall = {"polygon": [[20, -10], [80, -10], [80, 0], [20, 0]]}
    for start, goal in (([50, 1], [50, -11]), ([0, 20], [100, 20]), ([21, 1], [79, 1])):
        found = vs.plan(mission(start, [50, 1] if start[0] != 50 else [82, 1], goal, known=[wall]))
        clear(found, shapely_distance)


def test_the_certificate_speaks_of_the_body_and_of_what_is_nearest() -> None:
    found = vs.plan(
        mission([0, 0], [100, 0], known=[disc(50, 0, 10, name="tank"), disc(50, 60, 5)])
    )
    assert found.certificate.obstacle == "tank"
    assert 0.5 - 1e-6 <= found.certificate.clearance < 0.6
    at = np.asarray(found.certificate.tightest_at)
    there = math.hypot(at[0] - 50, at[1]) - 10.5
    assert found.certificate.clearance == pytest.approx(there, abs=1e-3)


def test_stations_stand_where_the_path_runs_through_them() -> None:
    found = vs.plan(mission([0, 0], {"at": [50, 30], "dwell_s": 7, "name": "pump"}, [100, 0]))
    (station,) = found.trajectory.stations
    np.testing.assert_allclose(found.path.at_distance(station.distance), [50, 30], atol=1e-6)
