from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.fleet.laying.step_aside import can_step_aside, stepped_aside
from viaspline.mission.model import Mission
from viaspline.planner import plan

ROBOT = {"radius_m": 0.5, "max_speed_mps": 2, "max_accel_mps2": 1, "max_lateral_accel_mps2": 0.8}


def mission(*points: tuple[float, float], **more: object) -> Mission:
    start, *via, goal = points
    return Mission.model_validate(
        {"robot": ROBOT, "route": {"start": start, "via": via, "goal": goal}, **more}
    )


discs = st.lists(st.tuples(st.floats(15, 65), st.floats(-1.5, 1.5)), min_size=1, max_size=4).map(
    lambda places: np.array([(x, y, 2.0) for x, y in places])
)


@given(discs)
def test_the_path_keeps_its_distance_its_ends_and_its_direction(rests: np.ndarray) -> None:
    straight = plan(mission((0, 0), (80, 0)))
    found = stepped_aside(straight, rests).plan
    if found is None:
        return
    path = found.path
    line = path.evaluate(np.linspace(*path.domain, 4000))
    for x, y, kept in rests:
        assert np.hypot(*(line - (x, y)).T).min() >= kept - 2e-4
    assert path.spans[0, 0].tolist() == [0, 0]
    assert path.spans[-1, 3].tolist() == [80, 0]
    out = path.spans[1:, 1] - path.spans[1:, 0]
    into = path.spans[:-1, 3] - path.spans[:-1, 2]
    turned = out[:, 0] * into[:, 1] - out[:, 1] * into[:, 0]
    assert np.abs(turned).max() < 1e-6
    assert found.certificate.holds
    assert (path.spans[1:, 0] == path.spans[:-1, 3]).all()


def test_a_robot_needs_not_slow_down_for_one_disc_in_the_open() -> None:
    straight = plan(mission((0, 0), (80, 0)))
    found = stepped_aside(straight, np.array([(40.0, 0.3, 2.0)])).plan
    assert found is not None
    assert found.path.length < straight.path.length + 0.6
    assert found.trajectory.duration < straight.trajectory.duration + 0.4
    assert PiecewiseCubic(found.path.spans).max_curvature()[0] < 0.21


def test_it_steps_to_the_side_on_which_no_other_disc_is() -> None:
    straight = plan(mission((0, 0), (80, 0)))
    found = stepped_aside(straight, np.array([(40.0, -0.3, 2.0), (40.0, 3.5, 2.0)])).plan
    assert found is not None
    assert found.path.evaluate(np.linspace(*found.path.domain, 900))[:, 1].min() < -2.0


@given(st.floats(-0.9, 0.9), st.floats(-0.3, 0.3), st.floats(3.2, 4.2))
def test_it_goes_past_both_of_two_discs_between_which_it_has_no_room(
    beside: float, along: float, gap: float
) -> None:
    straight = plan(mission((0, 0), (120, 0)))
    row = [(60.0, beside, 2.1), (60.0 + along, beside + gap, 2.1), (60.0, beside - gap, 2.1)]
    found = stepped_aside(straight, np.array(row)).plan
    assert found is not None
    line = found.path.evaluate(np.linspace(*found.path.domain, 9000))
    for x, y, kept in row:
        assert np.hypot(*(line - (x, y)).T).min() >= kept - 2e-4
    assert found.path.length < straight.path.length + 12.0
    assert found.drivability.sharpest_radius > 1.0


def test_it_swings_through_a_via_point_that_is_near() -> None:
    straight = plan(mission((0, 0), (40, 0), (80, 0)))
    found = stepped_aside(straight, np.array([(43.0, 0.3, 2.0)])).plan
    assert found is not None
    (via,) = (one for one in found.path.vias if one.index == 1)
    assert found.path.evaluate(via.u) == pytest.approx([40, 0], abs=1e-12)
    assert abs(float(found.path.heading(via.u))) > 0.2


def test_a_body_that_follows_any_bend_steps_aside_and_is_proven_where_it_does() -> None:
    body = ROBOT | {"footprint": [[-0.2, -0.4], [1.2, -0.4], [1.2, 0.4], [-0.2, 0.4]]}
    del body["radius_m"]
    for wall, is_clear in (([40.0, 3.2], True), ([40.0, 2.22], False)):
        world = {"known": [{"circle": {"center": wall, "radius": 0.5}}]}
        straight = plan(mission((0, 0), (80, 0), robot=body, world=world))
        found = stepped_aside(straight, np.array([(40.0, -1.2, 2.0)])).plan
        assert (found is not None) == is_clear
        if found is not None:
            line = found.path.evaluate(np.linspace(*found.path.domain, 4000))
            assert np.hypot(*(line - (40.0, -1.2)).T).min() >= 2.0 - 2e-4
            assert found.certificate.holds


def test_it_says_for_which_disc_there_is_no_room() -> None:
    walls = [{"polygon": [[0, y], [80, y], [80, y + 1], [0, y + 1]]} for y in (2.0, -3.0)]
    corridor = plan(mission((0, 0), (80, 0), world={"known": walls}))
    found = stepped_aside(corridor, np.array([(20.0, 50.0, 2.0), (40.0, 0.0, 2.0)]))
    assert found.plan is None
    assert found.no_room_for == 1


def test_a_robot_that_cannot_follow_any_bend_does_not_step_aside() -> None:
    assert can_step_aside(plan(mission((0, 0), (80, 0))))
    car = ROBOT | {"min_turn_radius_m": 4.0}
    assert not can_step_aside(plan(mission((0, 0), (80, 0), robot=car)))


@given(st.floats(8, 72), st.floats(-1.2, 1.2))
def test_a_path_that_bends_is_led_aside_without_kinks(along: float, beside: float) -> None:
    bent = plan(mission((0, 0), (25, 15), (50, 15), (80, 0)))
    s = along / 80 * bent.path.length
    x, y = np.asarray(bent.path.at_distance(s)).tolist()
    heading = float(bent.path.heading(bent.path.parameter(s)))
    disc = (x - beside * np.sin(heading), y + beside * np.cos(heading), 2.0)
    found = stepped_aside(bent, np.array([disc])).plan
    if found is None:
        return
    assert found.drivability.sharpest_radius > 1.0
    joints = np.arange(1.0, len(found.path.spans))
    before, behind = found.path.curvature(joints - 1e-7), found.path.curvature(joints + 1e-7)
    assert np.abs(before - behind).max() < 0.7


def test_a_round_goes_on_at_its_seam_as_it_did() -> None:
    lap = plan(
        Mission.model_validate(
            {"robot": ROBOT, "route": {"start": [0, 0], "via": [[40, 0], [20, 30]], "closed": True}}
        )
    )
    found = stepped_aside(lap, np.array([(4.0, -2.0, 2.0), (1.5, 7.0, 2.0)])).plan
    assert found is not None
    assert found.path.length > lap.path.length
    first, last = found.path.spans[[0, -1]]
    ahead, before = first[1] - first[0], last[3] - last[2]
    turned = ahead[0] * before[1] - ahead[1] * before[0]
    assert abs(turned) < 1e-9 * np.hypot(*ahead) * np.hypot(*before)
    assert ahead @ before > 0.0


@given(st.floats(-5, 5), st.floats(-1.5, 1.5))
@example(-1.87, 0.66)
@example(2.3, -0.97)
def test_a_round_steps_aside_beside_its_seam_as_it_does_elsewhere(
    along: float, beside: float
) -> None:
    route = {"start": [0, 0], "via": [[40, 0], [20, 30]], "closed": True}
    lap = plan(Mission.model_validate({"robot": ROBOT, "route": route}))
    s = along % lap.path.length
    x, y = np.asarray(lap.path.at_distance(s)).tolist()
    heading = float(lap.path.heading(lap.path.parameter(s)))
    disc = (x - beside * np.sin(heading), y + beside * np.cos(heading), 2.0)
    assume(np.hypot(*disc[:2]) > 2.2)
    found = stepped_aside(lap, np.array([disc])).plan
    if (along, beside) in ((-1.87, 0.66), (2.3, -0.97)):
        assert found is not None
    if found is None:
        return
    path = found.path
    line = path.evaluate(np.linspace(*path.domain, 9000))
    assert np.hypot(*(line - disc[:2]).T).min() >= 2.0 - 2e-4
    users = [via for via in path.vias if via.kind == "user"]
    places = path.evaluate(np.array([via.u for via in users]))
    assert places == pytest.approx(np.array([(0, 0), (40, 0), (20, 30), (0, 0)]), abs=1e-9)
    assert [via.index for via in users] == [via.index for via in lap.path.vias]
    ahead, before = path.spans[0, 1] - path.spans[0, 0], path.spans[-1, 3] - path.spans[-1, 2]
    assert np.linalg.det([ahead, before]) == pytest.approx(0.0, abs=1e-9)
    assert ahead @ before > 0.0


def test_a_path_as_round_as_the_robot_is_laid_anew_where_stepping_aside_is_sharper() -> None:
    """Two discs leave no wider bends between them."""
    robot = {"radius_m": 2.5, "max_speed_mps": 2}
    straight = plan(Mission.model_validate(
        {"robot": robot, "route": {"start": [0, 0], "goal": [40, 0]}}
    ))  # fmt: skip
    for y in np.linspace(0.0, 2.0, 9):
        rests = np.array([(18.0, y, 2.4), (22.0, -y, 2.4)])
        found = stepped_aside(straight, rests).plan
        assert found is None or found.drivability.sharpest_radius >= 0.999 * 2.5
