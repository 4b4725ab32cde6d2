"""A path round something takes up the old one at a via point, or before that if it is better."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.machine.turns_on_spot import corners
from viaspline.planning.checking.driving_time import driving_time
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.replanning.replan import reflex
from viaspline.planning.replanning.taking_up import LEFT_S


def mission(*stops: tuple[float, float], optimise: str = "time") -> vs.Mission:
    route = {"start": stops[0], "via": stops[1:-1], "goal": stops[-1], "optimise": optimise}
    robot = {"radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 2.0, "max_accel_mps2": 1.0,
             "max_lateral_accel_mps2": 0.5}  # fmt: skip
    return vs.Mission.model_validate({"robot": robot, "route": route})


def met(asked: vs.Mission, at: float, aside: float, radius: float) -> tuple[vs.Plan, vs.World]:
    """The plan, and a world in which a disc stands beside its path, some metres ahead."""
    plan = vs.plan(asked)
    u = float(plan.path.parameter(at))
    ahead, left = plan.path.evaluate(u), plan.path.tangent(u)[::-1] * (-1.0, 1.0)
    disc = vs.Obstacle(circle={"center": (ahead + aside * left).tolist(), "radius": radius})
    return plan, plan.world.with_obstacles([disc])


def cost(path: vs.Path, needs: Requirements) -> float:
    rests = np.zeros(len(path.spans) + 1, np.bool_)
    rests[[0, -1]] = True
    return driving_time(path.spans, needs.objective.pace, rests)


def sharpest_radius(path: vs.Path, begin: float) -> float:
    u = np.linspace(float(path.parameter(begin)), path.domain[1], 20_001)
    return float(1.0 / np.abs(path.curvature(u)).max())


def test_a_turn_round_a_via_point_is_driven_as_it_was_behind_what_came_into_the_way() -> None:
    asked = mission((50, 250), (140, 170), (270, 150), (290, 390))
    plan, world = met(asked, 187.0, -8.0, 8.0)
    needs = Requirements.of(asked)
    new = reflex(plan.path, 150.0, world, needs)
    assert sharpest_radius(plan.path, 150.0) > 2.0
    assert sharpest_radius(new.path, 150.0) > 2.0  # 0.5 m where it is taken up at the via point
    assert new.rejoins_at is not None
    assert new.rejoins_at <= new.path.distance(new.path.vias[-2].u)
    assert new.certificate.holds


@settings(max_examples=15, deadline=None)
@given(
    st.floats(0.2, 0.8), st.floats(-3.0, 3.0), st.floats(1.0, 6.0), st.integers(0, 2**31),
    st.sampled_from(["time", "length"]),
)  # fmt: skip
def test_a_path_that_may_be_taken_up_sooner_is_never_the_dearer_for_it(
    share: float, aside: float, radius: float, seed: int, optimise: str
) -> None:
    stops = [tuple(p) for p in np.random.default_rng(seed).uniform(0.0, 150.0, (4, 2)).tolist()]
    asked = mission(*stops, optimise=optimise)
    try:
        plan, world = met(asked, share * vs.plan(asked).path.length, aside, radius)
    except vs.PlanningError:
        return
    at = max(share * plan.path.length - 25.0, 0.0)
    needs = Requirements.of(asked)
    little = WorkBudget(LEFT_S)  # is never left when a path was laid: so none is sought sooner
    try:
        late = reflex(plan.path, at, world, Requirements(**{**vars(needs), "budget": little}))
    except vs.PlanningError:
        return
    new = reflex(plan.path, at, world, needs)
    assert new.certificate.holds
    for via in plan.path.vias:
        if via.kind == "user":
            assert via.at in [one.at for one in new.path.vias if one.kind == "user"]
    if optimise == "time":
        assert cost(new.path, needs) <= cost(late.path, needs) * (1.0 + 1e-3)
    else:
        assert new.path.length <= late.path.length + 1e-6


def test_nothing_is_sought_where_little_work_is_left() -> None:
    asked = mission((50, 250), (140, 170), (270, 150), (290, 390))
    plan, world = met(asked, 187.0, -8.0, 8.0)
    needs = Requirements.of(asked)
    little = Requirements(**{**vars(needs), "budget": WorkBudget(LEFT_S)})
    late = reflex(plan.path, 150.0, world, little)
    assert late.rejoins_at == pytest.approx(late.path.distance(late.path.vias[-2].u))


def station_behind_a_wall(**robot: object) -> tuple[vs.Plan, vs.World]:
    """A station to the north, and a wall across the way that is longer on its left."""
    asked = vs.Mission.model_validate(
        {
            "robot": {"radius_m": 0.4, "clearance_m": 0.3, "max_speed_mps": 1.2,
                      "max_accel_mps2": 0.6, "max_lateral_accel_mps2": 0.5, **robot},
            "route": {"start": [0, 0], "via": [{"at": [2, 20], "dwell_s": 5}], "goal": [40, 21]},
        }
    )  # fmt: skip
    plan = vs.plan(asked)
    wall = vs.Obstacle(capsule={"from": (-9.0, 16.0), "to": (4.5, 18.3), "radius": 0.1})
    return plan, plan.world.with_obstacles([wall])


def test_a_robot_that_stands_at_its_station_turns_there_instead_of_a_loop_before_it() -> None:
    plan, world = station_behind_a_wall()
    new = reflex(plan.path, 5.0, world, Requirements.of(plan.mission))
    station = next(via for via in new.path.vias if via.index == 1)
    at, angles = corners(new.path)
    assert at == pytest.approx([new.path.distance(station.u)])
    assert abs(angles[0]) > 0.3
    assert station.dwell == 5.0
    u = np.linspace(*new.path.domain, 20_001)
    assert float(np.min(world.distance(new.path.evaluate(u)))) > 0.7 - 1e-6
    headings = np.unwrap(np.asarray(new.path.heading(u)))
    assert np.ptp(headings) < 1.5 * np.pi  # and no circle
    names = [via.name for via in plan.path.vias if via.kind == "user"]
    assert [via.name for via in new.path.vias if via.kind == "user"] == names


def test_a_robot_that_never_turns_on_the_spot_arrives_as_it_did_on_its_old_path() -> None:
    plan, world = station_behind_a_wall(min_turn_radius_m=1.0, turn_on_spot="never")
    new = reflex(plan.path, 5.0, world, Requirements.of(plan.mission))
    assert corners(new.path)[0].size == 0
    assert new.path.curvature_jumps().max() < 1e-6


def corner_at_a_station(*known: tuple[float, float]) -> tuple[vs.Plan, vs.World]:
    """A way to a station, a turn there and another way on, and posts on these."""
    asked = vs.Mission.model_validate({
        "robot": {"radius_m": 0.3, "clearance_m": 0.2, "max_speed_mps": 2, "max_accel_mps2": 1},
        "route": {"start": [0, 0], "via": [{"at": [12, 0], "dwell_s": 6}], "goal": [3, 9]},
    })  # fmt: skip
    plan = vs.plan(asked)
    assert len(corners(plan.path)[0]) == 1
    posts = [vs.Obstacle(circle={"center": at, "radius": 0.4}) for at in known]
    return plan, plan.world.with_obstacles(posts)


@pytest.mark.parametrize("post", [(8.0, 0.1), (10.3, -0.1), (10.5, 1.3), (7.0, 5.2)])
def test_a_corner_at_a_station_is_come_to_and_left_from_any_direction(
    post: tuple[float, float],
) -> None:
    plan, world = corner_at_a_station(post)
    needs = Requirements.of(plan.mission)
    new = reflex(plan.path, 2.0, world, needs)
    assert new.certificate.holds
    station = next(via for via in new.path.vias if via.index == 1)
    assert station.at == (12.0, 0.0)
    assert [via.name for via in new.path.vias if via.kind == "user"] == ["start", "via 1", "goal"]
    at, _ = corners(new.path)
    assert at == pytest.approx([new.path.distance(station.u)])
    assert new.path.length < plan.path.length + 0.6  # a loop before it takes several metres
    assert sharpest_radius(new.path, 0.0) > needs.radius
    u = np.linspace(*new.path.domain, 20_001)
    assert float(np.min(world.distance(new.path.evaluate(u)))) > needs.required - 1e-6
