"""Courses, against the curve itself, sampled."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.fleet.courses import FleetCourses, FleetPath, courses_along, courses_of
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.retime import retime

seeds = st.integers(0, 100_000)
CUSP = [[[0, 0], [6, 0], [-3, 0.0], [3, 0]], [[3, 0], [3, 0], [3, 2], [3, 5]]]


def drive(seed: int, tension: float = 0.0) -> FleetPath:
    """A random spline with the knots of its fastest drive."""
    rng = np.random.default_rng(seed)
    path = CardinalSpline(rng.uniform(0, 20, (int(rng.integers(2, 7)), 2)), tension=tension)
    law = retime(path, Limits(max_speed=2, max_accel=1, max_lateral_accel=0.8))
    return FleetPath(path, law.distances, 1.0)


def mission(**keys: object) -> Plan:
    return plan(Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}, **keys}))


def off_the_chord(path: PiecewiseCubic, courses: FleetCourses) -> np.ndarray:
    """By how much each cell's curve leaves its evenly driven chord, by 21 samples."""
    packed = courses.packed
    w = np.linspace(0.0, 1.0, 21)[:, None]
    s = packed.distance[:-1] + w * np.diff(packed.distance)
    on_curve = path.at_distance(np.minimum(s, path.length))
    on_chord = packed.place[:-1] + w[:, :, None] * np.diff(packed.place, axis=0)
    return np.linalg.norm(on_curve - on_chord, axis=2).max(axis=0)


@settings(max_examples=40)
@given(seeds, st.sampled_from([0.0, 0.5, 1.0]))
def test_nodes_lie_on_the_curve_and_no_cell_bows_out_farther_than_it_says(
    seed: int, tension: float
) -> None:
    one = drive(seed, tension)
    courses = courses_along(["a"], [one])
    packed = courses.packed
    assert packed.first.tolist() == [0, packed.distance.size]
    steps = np.diff(packed.distance)
    assert (steps > 0.0).all()
    assert (steps <= 0.5 + 1e-12).all()
    assert np.isin(one.knots, packed.distance).all()
    assert packed.bow[-1] == 0.0
    assert (off_the_chord(one.path, courses) <= packed.bow[:-1] + 1e-9).all()
    assert ((packed.bow[:-1] <= 0.02) | (steps <= 0.04)).all()


def test_a_cusp_inside_of_a_span_is_bounded_as_well() -> None:
    cusp = PiecewiseCubic(CUSP)
    one = FleetPath(cusp, np.array([0.0, cusp.length]), 1.0)
    courses = courses_along(["a"], [one])
    bow = courses.packed.bow[:-1]
    assert (off_the_chord(cusp, courses) <= bow + 1e-9).all()
    assert bow.max() <= 0.02
    assert bow.size < 60


def test_courses_lie_behind_each_other_as_each_is_alone() -> None:
    paths = [drive(seed) for seed in range(5)]
    names = [str(i) for i in range(5)]
    together = courses_along(names, paths).packed
    for i, (name, path) in enumerate(zip(names, paths, strict=True)):
        alone = courses_along([name], [path]).packed
        part = slice(together.first[i], together.first[i + 1])
        for whole, one in zip(together[1:4], alone[1:4], strict=True):
            assert (whole[part] == one).all()


def test_a_path_that_is_a_single_place_has_two_nodes() -> None:
    point = PiecewiseCubic([[[1, 2]] * 4])
    packed = courses_along(["a"], [FleetPath(point, np.zeros(2), 0.5)]).packed
    assert packed.distance.tolist() == [0.0, 0.0]
    assert packed.place.tolist() == [[1.0, 2.0], [1.0, 2.0]]


def test_a_fleet_of_none_has_no_courses() -> None:
    courses = courses_of({}, 1.0)
    assert courses.names == ()
    assert courses.packed.first.tolist() == [0]


def test_a_law_that_goes_on_beyond_its_path_is_refused_by_name() -> None:
    one = drive(1)
    with pytest.raises(GeometryError, match="'r7'"):
        courses_along(["r7"], [FleetPath(one.path, one.knots * 1.01, 1.0)])


@pytest.mark.parametrize("separation", [-1.0, np.inf, np.nan])
def test_a_separation_that_is_none_is_refused(separation: float) -> None:
    with pytest.raises(GeometryError, match="separation"):
        courses_of({}, separation)


def test_a_robot_reaches_as_far_as_its_body_its_error_and_half_of_the_separation() -> None:
    corners = [[-0.5, -0.3], [0.4, -0.3], [0.4, 0.3], [-0.5, 0.3]]
    plans = {
        "disc": mission(robot={"radius_m": 0.4, "tracking_error_m": 0.1}),
        "body": mission(robot={"footprint": corners}),
    }
    courses = courses_of(plans, 1.0)
    assert courses.names == ("disc", "body")
    assert courses.packed.reach.tolist() == pytest.approx([1.0, np.hypot(0.5, 0.3) + 0.5])


def test_laps_and_stations_are_all_of_the_course() -> None:
    via = [{"at": [5, 0], "name": "pump", "dwell_s": 3}, [5, 5], [0, 5]]
    route = {"start": [0, 0], "via": via, "closed": True, "laps": 3}
    whole = plan(Mission.model_validate({"route": route}))
    packed = courses_of({"r": whole}, 1.0).packed
    assert packed.distance[-1] == whole.trajectory.distances[-1]
    assert len(whole.trajectory.stations) >= 3
    for station in whole.trajectory.stations:
        node = int(np.searchsorted(packed.distance, station.distance))
        assert packed.distance[node] == station.distance
        assert packed.place[node] == pytest.approx([5, 0], abs=1e-6)
