import math

import numpy as np
import pytest

import viaspline as vs
from viaspline.maps.terrain import Terrain
from viaspline.mission.model import Mission
from viaspline.space.spatial_request import spatial_limits_of, spatial_problem_of
from viaspline.space.timing.yaw_profile import FacingAlong, FacingFixed, FacingPlace


def mission(**parts: dict[str, object]) -> Mission:
    route = {"start": [0, 0], "takeoff": {"to_agl_m": 12}, "land": {"at": [60, 0]}}
    world = {"ground": {"flat_m": 100}}
    return Mission.model_validate(
        {
            "world": {**world, **parts.pop("world", {})},
            "robot": parts.pop("robot", {}),
            "route": {**route, **parts.pop("route", {})},
        }
    )


def test_a_flight_goes_from_above_where_it_takes_off_to_above_where_it_lands() -> None:
    problem = spatial_problem_of(mission(route={"via": [{"at": [30, 9], "agl_m": 20}]}))
    assert [via.at.tolist() for via in problem.vias] == [
        [0, 0, 112], [30, 9, 120], [60, 0, 120]
    ]  # fmt: skip
    assert problem.takeoff is not None
    assert problem.landing is not None
    assert problem.takeoff[2] == problem.landing[2] == 100.5
    assert [via.dwell for via in problem.vias] == [0.0, None, 0.0]


@pytest.mark.parametrize(
    ("above", "limits"),
    [
        ("home", (105, 150, -math.inf, math.inf)),
        ("amsl", (5, 50, -math.inf, math.inf)),
        ("ground", (-math.inf, math.inf, 5, 50)),
    ],
)
def test_an_altitude_counts_from_what_it_says(above: str, limits: tuple[float, ...]) -> None:
    altitude = {"min_m": 5, "max_m": 50, "above": above}
    route = {"start": [0, 0, 120 if above != "amsl" else 20], "goal": [9, 0, 120], "land": None}
    if above == "amsl":
        route["goal"] = [9, 0, 20]
    ground = {"flat_m": 100 if above != "amsl" else 0}
    asked = mission(
        world={"altitude": altitude, "ground": ground}, route={**route, "takeoff": None}
    )
    assert spatial_problem_of(asked).world.band.numbers == limits


def test_a_body_with_a_half_height_is_the_core_and_one_without_is_a_ball() -> None:
    upright = spatial_problem_of(mission(robot={"radius_m": 0.4, "half_height_m": 0.2}))
    assert (upright.radius, upright.world.packed.core.tolist()) == (0.0, [0.4, 0.2])
    ball = spatial_problem_of(mission(robot={"radius_m": 0.4}))
    assert (ball.radius, ball.world.packed.core.tolist()) == (0.4, [0.0, 0.0])


def test_a_gate_is_passed_along_the_way_that_it_faces() -> None:
    gate = {"gate": {"at": [30, 0, 110], "facing_deg": 90, "width_m": 4, "height_m": 3}}
    problem = spatial_problem_of(mission(route={"via": [gate]}))
    way = problem.vias[1].direction
    assert way is not None
    assert np.allclose(way, (0, 1, 0))


def test_yaw_is_what_the_route_says() -> None:
    assert spatial_problem_of(mission()).facing == FacingAlong()
    fixed = mission(route={"yaw": {"fixed_deg": 90}})
    assert spatial_problem_of(fixed).facing == FacingFixed(math.pi / 2)
    to = mission(route={"yaw": {"to": [5, 6, 0]}})
    assert spatial_problem_of(to).facing == FacingPlace(5, 6)


def test_speeds_up_and_down_are_limits_only_where_they_are_less_than_the_speed() -> None:
    free = spatial_limits_of(mission(robot={"max_speed_mps": 3}))
    assert (free.climb, free.descent, free.vertical_accel) == (None, None, None)
    slow = spatial_limits_of(
        mission(robot={"max_speed_mps": 9, "max_climb_mps": 2, "max_vertical_accel_mps2": 0.5})
    )
    assert (slow.climb, slow.descent, slow.vertical_accel) == (2, 2, 0.5)


def test_a_vertical_acceleration_as_large_as_the_one_along_the_path_is_a_limit_too() -> None:
    asked = {"max_accel_mps2": 1, "max_lateral_accel_mps2": 0.75}
    limits = spatial_limits_of(mission(robot={**asked, "max_vertical_accel_mps2": 1}))
    assert limits.vertical_accel == 1
    limits = spatial_limits_of(mission(robot={**asked, "max_vertical_accel_mps2": 1.25}))
    assert limits.vertical_accel is None


@pytest.mark.parametrize("altitude", [None, {"min_m": 9, "above": "ground"}])
@pytest.mark.parametrize("steep", [0.0, 1.5])
def test_uphill_it_lands_from_as_high_as_the_ground_there_asks_for(
    altitude: dict[str, object] | None, steep: float
) -> None:
    x = np.arange(0.0, 101.0, 5.0)
    heights = np.clip(steep * (x - 40.0), 0.0, 60.0) + 20.0 * (x > 60)
    hill = Terrain(np.tile(heights, (21, 1)), 5.0)
    asked = Mission.model_validate({
        "world": {"ground": {"terrain": hill}, **({"altitude": altitude} if altitude else {})},
        "robot": {"radius_m": 0.5, "half_height_m": 0.2, "clearance_m": 1.5},
        "route": {"start": [10, 50, 12], "land": {"at": [72.5, 52.5]}},
    })  # fmt: skip
    problem = spatial_problem_of(asked)
    top = problem.vias[-1].at
    over = top[2] - float(hill.height_at((72.5, 52.5)))
    assert problem.world.distance(top) >= 1.5
    assert over >= (9.0 if altitude else 1.7)
    assert over < 12.0
    plan = vs.plan(asked)
    assert plan.certificate.holds
    flight = vs.fly(plan)
    assert flight.reached
