import copy
import math
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import viaspline as vs
from viaspline.errors import Fault
from viaspline.presentable.compared_by_value import hashed, is_same

MISSION = vs.Mission.model_validate(
    {
        "world": {
            "bounds": [0, 0, 100, 100],
            "known": [
                {"name": "tank", "circle": {"center": [50, 52], "radius": 10}},
                {"polygon": [[1, 1], [3, 1], [2, 3]]},
            ],
            "unseen": [{"circle": {"center": [65, 60], "radius": 2}}],
        },
        "robot": {"sensor": {"range_m": 20}},
        "route": {"start": [10, 50], "via": [[70, 60]], "goal": [90, 20]},
    }
)
TOWER = {"circle": {"center": [25, 0.5], "radius": 4}, "height_m": [0, 30]}
FLIGHT = vs.Mission.model_validate(
    {"world": {"known": [TOWER]}, "route": {"start": [0, 0, 10], "goal": [50, 0, 10]}}
)
PAIR = vs.Fleet.model_validate(
    {
        "robots": {"cart": {"radius_m": 0.4}},
        "fleet": [
            {"name": "a", "robot": "cart", "route": {"start": [0, 0], "goal": [40, 0]}},
            {"name": "b", "robot": "cart", "route": {"start": [20, -20], "goal": [20, 20]}},
        ],
    }
)
CART = vs.Obstacle(
    circle={"center": (0, 0), "radius": 1}, motion={"from": (60, 95), "velocity_mps": (0, -1)}
)
AMONG = vs.Mission.model_validate(
    {**MISSION.model_dump(by_alias=True, exclude_defaults=True), "world": {"known": [CART]}}
)
CELLS = np.array([[True, False], [False, False]])


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """A value of every class that is exported, by the name of its class or of its kind."""
    plan, flown, fleet_plan = vs.plan(MISSION), vs.plan(FLIGHT), vs.plan_fleet(PAIR)
    driven = MISSION.model_copy(
        update={
            "robot": MISSION.robot.model_validate(
                {"radius_m": 0.3, "drive": {"differential": {"track_m": 0.4}}}
            ),
            "world": MISSION.world.model_copy(update={"unseen": ()}),
        }
    )
    among = vs.plan(AMONG)
    return {
        "CardinalSpline": vs.CardinalSpline([(0, 0), (3, 1), (5, 0)], tension=0.2),
        "Certificate": plan.certificate,
        "Command": vs.Navigator(MISSION).step(vs.RobotState((10.0, 50.0), 0.0, 0.0), [], 0.0)[0],
        "Delays": vs.Delays(slowed=0.3),
        "Fleet": PAIR,
        "FleetCommand": vs.FleetNavigator(fleet_plan).step([], 0.0)[0]["a"],
        "ExportOptions": vs.ExportOptions(origin=(47.4, 8.5)),
        "Exported": vs.export(plan, tmp_path_factory.mktemp("exported") / "patrol.csv"),
        "FleetMember": PAIR.members[0],
        "FleetPlan": fleet_plan,
        "FleetRun": vs.simulate_fleet(PAIR, plan=fleet_plan),
        "Grid": vs.Grid(CELLS, 0.5, unknown=CELLS),
        "Limits": vs.Limits(max_speed=1, max_accel=1),
        "Mission": MISSION,
        "MovingCertificate": among.moving_certificate,
        "MovingObstacles": vs.MovingObstacles([CART]),
        "MovingSighting": vs.MovingSighting(0, CART, (0, 0, 0), (0, 0)),
        "Obstacle": MISSION.world.known[1],
        "Path": plan.path,
        "PiecewiseCubic": vs.PiecewiseCubic([[[0, 0], [1, 0], [2, 0], [3, 0]]]),
        "Plan": plan,
        "Plan among what moves": among,
        "ProgressReport": vs.ProgressReport("a", 0.0, 0.0),
        "RobotState": vs.RobotState((0.0, 0.0), 0.0, 0.0),
        "Run": vs.simulate(MISSION, plan=plan),
        "Run of a machine": vs.simulate(driven),
        "Scan": vs.Scan((1.0, 2.0), 0.0, -1.5, 1.5, 9.0, [math.inf, 3.0, math.nan]),  # type: ignore[arg-type]
        "SpatialPlan": flown,
        "SpatialRun": vs.fly(flown),
        "SpatialWorld": flown.world,
        "SpeedZone": vs.SpeedZone(polygon=[(0, 0), (1, 0), (1, 1)], max_speed_mps=1),
        "Station": vs.Station(3.0, 4.0, "pump"),
        "TensionAdvice": vs.advise_tension(MISSION, [0.0, 0.5]),
        "Terrain": vs.Terrain(np.array([[0.0, 1.0], [2.0, math.nan]]), 1.0),
        "Trajectory": plan.trajectory,
        "Voxels": vs.Voxels(CELLS[None], 1.0),
        "World": plan.world,
    }


VERBS = {name for name in vs.__all__ if name[0].islower()}
ERRORS = {name for name in vs.__all__ if name.endswith(("Error", "Warning"))}
WITH_A_STATE = {"FleetNavigator", "Logbook", "Navigator"}
COPIES: dict[str, Callable[[Any], Any]] = {
    "deep": copy.deepcopy,
    "shallow": copy.copy,
    "pickled": lambda value: pickle.loads(pickle.dumps(value)),
}


def test_every_exported_class_of_values_is_tried(made: dict[str, Any]) -> None:
    classes = set(vs.__all__) - VERBS - ERRORS - {"__version__"} - WITH_A_STATE
    assert classes <= set(made)
    for name in classes:
        assert type(made[name]).__name__ == name


@pytest.mark.parametrize("kind", COPIES)
def test_a_copy_equals_its_original_and_has_its_hash(kind: str, made: dict[str, Any]) -> None:
    for name, value in made.items():
        again = COPIES[kind](value)
        assert again == value, name
        assert value == again, name
        assert hash(again) == hash(value), name
        assert len({value, again}) == 1, name
        assert value != object(), name
        assert value != "a text", name


@pytest.mark.parametrize(
    "error",
    [
        vs.NoPathError("a wall", where=(1, 2), remedy="move it", obstacles=["wall"]),
        vs.GaveUpError("too long", where=(1, 2), remedy="wait", tried=["all"], via="pump"),
        vs.OutputError("plan.json", "can't be written"),
        vs.SavedPlanError("plan.json", "is no plan"),
        vs.MissionError([Fault("route", "is empty", "give a goal")]),
        vs.GeometryError("NaN"),
    ],
    ids=lambda error: type(error).__name__,
)
def test_a_copy_of_an_error_says_the_same_with_the_same_data(error: vs.ViasplineError) -> None:
    for again in (copy.deepcopy(error), pickle.loads(pickle.dumps(error))):
        assert type(again) is type(error)
        assert str(again) == str(error)
        assert vars(again) == vars(error)


def test_a_value_is_told_in_ten_lines_at_most(made: dict[str, Any]) -> None:
    for name, value in made.items():
        told = repr(value)
        assert 0 < len(told) <= 1000, name
        assert told.count("\n") < 10, name


def test_two_plans_of_one_mission_are_equal_and_of_another_they_are_not(
    made: dict[str, Any],
) -> None:
    plan, again = made["Plan"], vs.plan(MISSION)
    assert again == plan
    assert hash(again) == hash(plan)
    tank = vs.Obstacle(name="tank", circle={"center": (50, 52), "radius": 10.001})
    world = MISSION.world.model_copy(update={"known": (tank,)})
    other = vs.plan(MISSION.model_copy(update={"world": world}))
    assert other != plan
    assert other.path != plan.path
    assert other.world != plan.world
    assert other.certificate != plan.certificate
    assert len({plan, again, other}) == 2


def test_a_run_is_the_same_whatever_the_clock_says(made: dict[str, Any]) -> None:
    run, again = made["Run"], vs.simulate(MISSION, plan=made["Plan"])
    assert again == run
    assert again.compute_times != run.compute_times or not run.compute_times
    assert vs.simulate(MISSION, plan=made["Plan"], step=0.1) != run


def test_worlds_are_told_apart_by_what_is_in_them() -> None:
    here = vs.Obstacle(circle={"center": (0, 0), "radius": 1})
    there = vs.Obstacle(circle={"center": (0, 1), "radius": 1})
    worlds = [
        vs.World(), vs.World([here]), vs.World([there]), vs.World([here, there]),
        vs.World([here], bounds=(-9, -9, 9, 9)),
        vs.World([here], fences=[[(-9, -9), (9, -9), (0, 9)]]),
    ]  # fmt: skip
    assert len(set(worlds)) == len(worlds)
    assert vs.World([here]).with_obstacles([there]) == vs.World([here, there])
    assert len({vs.MovingObstacles([CART]), vs.MovingObstacles([CART], since=1.0)}) == 2


def test_curves_are_told_apart_by_their_class_and_all_that_they_are_made_of() -> None:
    points = [(0, 0), (3, 1), (5, 0)]
    spline = vs.CardinalSpline(points)
    assert spline == vs.CardinalSpline(np.array(points))
    assert spline != vs.CardinalSpline(points, tension=0.1)
    assert spline != vs.PiecewiseCubic(spline.spans)
    assert vs.Path(spline.spans, []) != vs.PiecewiseCubic(spline.spans)
    assert spline != vs.CardinalSpline([(*point, 0) for point in points])


values = st.recursive(
    st.one_of(
        st.none(),
        st.text(max_size=3),
        st.integers(-5, 5),
        st.floats(),
        arrays.arrays(
            st.sampled_from([np.float64, np.int64, np.bool_]), arrays.array_shapes(max_side=3)
        ),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3),
        st.tuples(inner, inner),
        st.dictionaries(st.text(max_size=2), inner, max_size=3),
    ),
    max_leaves=8,
)


@given(value=values)
def test_whatever_is_compared_equals_its_copy(value: Any) -> None:
    again = copy.deepcopy(value)
    assert is_same(value, again)
    assert hash(hashed(value)) == hash(hashed(again))


@given(one=values, other=values)
def test_what_is_the_same_has_the_same_hash_and_both_ways(one: Any, other: Any) -> None:
    assert is_same(one, other) == is_same(other, one)
    if is_same(one, other):
        assert hash(hashed(one)) == hash(hashed(other))


def test_arrays_are_the_same_by_shape_and_by_number() -> None:
    assert is_same(np.array([math.nan, -0.0]), np.array([math.nan, 0.0]))
    assert hashed(np.array([math.nan, -0.0])) == hashed(np.array([-math.nan, 0.0]))
    assert not is_same(np.zeros(2), np.zeros((2, 1)))
    assert not is_same(np.zeros(2), [0.0, 0.0])
    assert not is_same(np.zeros(0), None)
    assert not is_same({"a": 1}, {"a": 1, "b": 2})
