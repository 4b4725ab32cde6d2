"""Whatever is handed in from Python: an answer, or an error of the package's own."""

from collections.abc import Callable
from functools import cached_property
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import viaspline as vs

MISSION = vs.Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}})
LIMITS = vs.Limits(max_speed=1, max_accel=1)
PLAN = Path(__file__).parent / "formats" / "data" / "yard.plan"
CELLS = np.zeros((2, 2), np.bool_)
CART = vs.Obstacle(
    circle={"center": (0, 0), "radius": 1}, motion={"from": (0, 5), "velocity_mps": (1, 0)}
)
STATE = vs.RobotState((0.0, 0.0), 0.0, 0.0)
FLEET = vs.Fleet.model_validate(
    {"fleet": [{"name": "a", "route": {"start": [0, 0], "goal": [9, 0]}}]}
)
TO_NOWHERE = "no such folder/x.plan"

JUNK: list[Any] = [
    None, "x", b"x", float("nan"), 10**400, -1, [], {}, [[1]], [["a", "b"]], [None], object(),
    np.array([1, 2]), [[0, 0], [float("nan"), 1]], np.zeros((0, 2)), np.zeros((2, 2, 2)),
    np.array(["a"]), print, "x" * 5000, "\0",
]  # fmt: skip


class Made:
    """What has to be planned, timed or packed first: each when a test first asks for it."""

    @cached_property
    def curve(self) -> vs.CardinalSpline:
        return vs.CardinalSpline([[0, 0], [1, 0], [2, 1]])

    @cached_property
    def law(self) -> vs.Trajectory:
        return vs.retime(self.curve, LIMITS)

    @cached_property
    def world(self) -> vs.World:
        return vs.World()

    @cached_property
    def moving(self) -> vs.MovingObstacles:
        return vs.MovingObstacles([CART])

    @cached_property
    def plan(self) -> vs.Plan:
        return vs.plan(MISSION)

    @cached_property
    def saved(self) -> Path:
        folder = Path(mkdtemp())
        self.plan.save(folder)
        return folder

    @cached_property
    def navigator(self) -> vs.Navigator:
        return vs.Navigator(MISSION, warm=False)

    @cached_property
    def axes(self) -> Axes:
        return Figure().add_subplot()

    @cached_property
    def fleet_plan(self) -> vs.FleetPlan:
        return vs.plan_fleet(FLEET)

    @cached_property
    def fleet_navigator(self) -> vs.FleetNavigator:
        return vs.FleetNavigator(self.fleet_plan, warm=False)


MADE = Made()


def uncallable(junk: Any) -> Any:
    """Junk that isn't a function: what one does is up to who wrote it."""
    return None if callable(junk) else junk


def unsaid(junk: Any) -> Any:
    """Junk that isn't the name of a file or a folder, which would be written."""
    return None if isinstance(junk, str) else junk


SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
VERBS: dict[str, Callable[[Any], Any]] = {
    "plan": vs.plan,
    "simulate": vs.simulate,
    "Navigator": vs.Navigator,
    "advise_tension": vs.advise_tension,
    "Mission": vs.Mission.model_validate,
    "load": vs.load,
    "origin_of": vs.origin_of,
    "load ground": lambda junk: vs.load(PLAN, ground=junk),
    "load_map": vs.load_map,
    "load_plan": vs.load_plan,
    "load_fleet_plan": vs.load_fleet_plan,
    "load_plan mission": lambda junk: vs.load_plan(MADE.saved, junk),
    "Plan save": lambda junk: MADE.plan.save(unsaid(junk)),
    "Plan samples": lambda junk: MADE.plan.samples(junk),
    "Plan plot": lambda junk: MADE.plan.plot(junk if junk is not None else 5),
    "Run animate": lambda junk: vs.simulate(MISSION, plan=MADE.plan).animate(MADE.axes, pace=junk),
    "CardinalSpline": vs.CardinalSpline,
    "CardinalSpline tension": lambda junk: vs.CardinalSpline([[0, 0], [1, 0]], tension=junk),
    "World body_distance": lambda junk: MADE.world.body_distance(
        (0, 0), junk, [(0, 0), (1, 0), (0, 1)]
    ),
    "CardinalSpline closed": lambda junk: vs.CardinalSpline([[0, 0], [1, 0]], closed=junk),
    "CardinalSpline knots": lambda junk: vs.CardinalSpline([[0, 0], [1, 0]], knots=junk),
    "PiecewiseCubic": vs.PiecewiseCubic,
    "Path": lambda junk: vs.Path(junk, vias=[]),
    "evaluate": lambda junk: MADE.curve.evaluate(junk),
    "at_distance": lambda junk: MADE.curve.at_distance(junk),
    "project": lambda junk: MADE.curve.project(junk),
    "World": vs.World,
    "World bounds": lambda junk: vs.World(bounds=junk),
    "World fences": lambda junk: vs.World(fences=junk),
    "distance": lambda junk: MADE.world.distance(junk),
    "certify curve": lambda junk: vs.certify(junk, MADE.world, 1.0),
    "certify world": lambda junk: vs.certify(MADE.curve, junk, 1.0),
    "certify clearance": lambda junk: vs.certify(MADE.curve, MADE.world, junk),
    "Limits": lambda junk: vs.Limits(max_speed=junk, max_accel=1),
    "retime": lambda junk: vs.retime(junk, LIMITS),
    "retime limits": lambda junk: vs.retime(MADE.curve, junk),
    "retime stations": lambda junk: vs.retime(MADE.curve, LIMITS, junk),
    "retime_lap": lambda junk: vs.retime_lap(junk, LIMITS),
    "retime_lap limits": lambda junk: vs.retime_lap(MADE.curve, junk),
    "retime zones": lambda junk: vs.retime(MADE.curve, LIMITS, zones=junk),
    "Station distance": lambda junk: vs.retime(MADE.curve, LIMITS, [vs.Station(junk)]),
    "Station dwell": lambda junk: vs.retime(MADE.curve, LIMITS, [vs.Station(1.0, junk)]),
    "simulate seed": lambda junk: vs.simulate(MISSION, seed=junk),
    "simulate step": lambda junk: vs.simulate(MISSION, step=junk),
    "simulate plan": lambda junk: vs.simulate(MISSION, plan=junk),
    "simulate progress": lambda junk: vs.simulate(MISSION, progress=uncallable(junk)),
    "simulate pace": lambda junk: vs.simulate(MISSION, pace=uncallable(junk)),
    "Navigator plan": lambda junk: vs.Navigator(MISSION, junk),
    "Navigator reaction": lambda junk: vs.Navigator(MISSION, reaction=junk),
    "Navigator period": lambda junk: vs.Navigator(MISSION, period=junk),
    "Navigator warm": lambda junk: vs.Navigator(MISSION, warm=junk),
    "Navigator progress": lambda junk: vs.Navigator(MISSION, progress=uncallable(junk)),
    "warm": lambda junk: MADE.navigator.warm(uncallable(junk)),
    "Navigator step": lambda junk: MADE.navigator.step(junk, [], 0.0),
    "Navigator sensed": lambda junk: MADE.navigator.step(STATE, junk, 0.0),
    "Navigator time": lambda junk: MADE.navigator.step(STATE, [], junk),
    "Navigator reference": lambda junk: MADE.navigator.reference(junk),
    "RobotState position": lambda junk: MADE.navigator.step(vs.RobotState(junk, 0.0, 0.0), [], 0.0),
    "RobotState heading": lambda junk: MADE.navigator.step(
        vs.RobotState((0, 0), junk, 0.0), [], 0.0
    ),
    "RobotState speed": lambda junk: MADE.navigator.step(vs.RobotState((0, 0), 0.0, junk), [], 0.0),
    "RobotState across": lambda junk: MADE.navigator.step(
        vs.RobotState((0, 0), 0, 0, junk), [], 0.0
    ),
    "RobotState stamp": lambda junk: MADE.navigator.step(
        vs.RobotState((0, 0), 0.0, 0.0, stamp=junk), [], 0.0
    ),
    "Logbook": lambda junk: vs.Logbook().note(junk),
    "Obstacle": vs.Obstacle.model_validate,
    "Obstacle circle": lambda junk: vs.Obstacle(circle=junk),
    "Obstacle radius": lambda junk: vs.Obstacle(circle={"center": (0, 0), "radius": junk}),
    "Obstacle polygon": lambda junk: vs.Obstacle(polygon=junk),
    "Obstacle ball": lambda junk: vs.Obstacle(ball=junk),
    "Obstacle box": lambda junk: vs.Obstacle(box={"min": (0, 0, 0), "max": junk}),
    "Obstacle voxels": lambda junk: vs.Obstacle(voxels=junk),
    "Obstacle height_m": lambda junk: vs.Obstacle(polygon=SQUARE, height_m=junk),
    "Voxels": lambda junk: vs.Voxels(junk, 1.0),
    "Voxels cell": lambda junk: vs.Voxels(CELLS[None], junk),
    "Voxels origin": lambda junk: vs.Voxels(CELLS[None], 1.0, junk),
    "fly": vs.fly,
    "SpatialWorld": vs.SpatialWorld.of,
    "SpatialWorld names": lambda junk: vs.SpatialWorld.of([], junk),
    "SpatialWorld ground": lambda junk: vs.SpatialWorld.of(ground=junk),
    "SpatialWorld distance": lambda junk: vs.SpatialWorld.of(ground=0.0).distance(junk),
    "Terrain": lambda junk: vs.Terrain(junk, 1.0),
    "Terrain cell": lambda junk: vs.Terrain(np.zeros((2, 2)), junk),
    "Terrain origin": lambda junk: vs.Terrain(np.zeros((2, 2)), 1.0, junk),
    "Terrain height_at": lambda junk: vs.Terrain(np.zeros((2, 2)), 1.0).height_at(junk),
    "Obstacle name": lambda junk: vs.Obstacle(circle={"center": (0, 0), "radius": 1}, name=junk),
    "Obstacle grid": lambda junk: vs.Obstacle(grid=junk),
    "SpeedZone": vs.SpeedZone.model_validate,
    "SpeedZone polygon": lambda junk: vs.SpeedZone(polygon=junk, max_speed_mps=1.0),
    "SpeedZone speed": lambda junk: vs.SpeedZone(polygon=SQUARE, max_speed_mps=junk),
    "Grid": lambda junk: vs.Grid(junk, 1.0),
    "Grid resolution": lambda junk: vs.Grid(CELLS, junk),
    "Grid origin": lambda junk: vs.Grid(CELLS, 1.0, junk),
    "Grid unknown": lambda junk: vs.Grid(CELLS, 1.0, unknown=junk),
    "Grid center": lambda junk: vs.Grid(CELLS, 1.0).center(junk, 0),
    "Grid to_cells": vs.Grid(CELLS, 1.0).to_cells,
    "Path vias": lambda junk: vs.Path(MADE.curve.spans, vias=junk),
    "section": lambda junk: MADE.curve.section(junk, 1.0),
    "sample": lambda junk: MADE.curve.sample(junk),
    "evaluate derivative": lambda junk: MADE.curve.evaluate(0.5, junk),
    "certify footprint": lambda junk: vs.certify(MADE.curve, MADE.world, 1.0, footprint=junk),
    "advise_tension tensions": lambda junk: vs.advise_tension(MISSION, junk),
    "advise_tension world": lambda junk: vs.advise_tension(MISSION, world=junk),
    "Trajectory": lambda junk: MADE.law.state_at(junk),
    "Trajectory.speed_at": lambda junk: MADE.law.speed_at(junk),
    "Trajectory.time_at": lambda junk: MADE.law.time_at(junk),
    "MovingObstacles": vs.MovingObstacles,
    "MovingObstacles since": lambda junk: vs.MovingObstacles([CART], since=junk),
    "MovingObstacles distance": lambda junk: MADE.moving.distance([(0, 0)], times=junk),
    "MovingSighting": lambda junk: vs.MovingSighting(0, junk, (0, 0, 0), (0, 0)),
    "MovingSighting index": lambda junk: vs.MovingSighting(junk, CART, (0, 0, 0), (0, 0)),
    "MovingSighting frame": lambda junk: vs.MovingSighting(0, CART, junk, (0, 0)),
    "MovingSighting velocity": lambda junk: vs.MovingSighting(0, CART, (0, 0, 0), junk),
    "Scan": lambda junk: vs.Scan((0, 0), 0.0, 0.0, 0.1, 9.0, junk),
    "Scan from_laserscan": lambda junk: vs.Scan.from_laserscan(junk, 0, 0.1, 0, 9, (0, 0, 0)),
    "Scan angle_min": lambda junk: vs.Scan.from_laserscan([1.0, 2], junk, 0.1, 0, 9, (0, 0, 0)),
    "Scan step": lambda junk: vs.Scan.from_laserscan([1.0, 2], 0, junk, 0, 9, (0, 0, 0)),
    "Scan range_min": lambda junk: vs.Scan.from_laserscan([1.0], 0, 0.1, junk, 9, (0, 0, 0)),
    "Scan reach": lambda junk: vs.Scan.from_laserscan([1.0], 0, 0.1, 0, junk, (0, 0, 0)),
    "Scan pose": lambda junk: vs.Scan.from_laserscan([1.0], 0, 0.1, 0, 9, junk),
    "Scan mount": lambda junk: vs.Scan.from_laserscan([1.0], 0, 0.1, 0, 9, (0, 0, 0), mount=junk),
    "Scan position": lambda junk: vs.Scan(junk, 0.0, 0.0, 0.1, 9.0, [1.0, 2.0]),
    "Scan heading": lambda junk: vs.Scan((0, 0), junk, 0.0, 0.1, 9.0, [1.0, 2.0]),
    "Scan increment": lambda junk: vs.Scan((0, 0), 0.0, 0.0, junk, 9.0, [1.0, 2.0]),
    "Scan range_max": lambda junk: vs.Scan((0, 0), 0.0, 0.0, 0.1, junk, [1.0, 2.0]),
    "certify_moving": lambda junk: vs.certify_moving(junk, MADE.law, MADE.moving, 1.0),
    "certify_moving law": lambda junk: vs.certify_moving(MADE.curve, junk, MADE.moving, 1.0),
    "certify_moving moving": lambda junk: vs.certify_moving(MADE.curve, MADE.law, junk, 1.0),
    "certify_moving clearance": lambda junk: vs.certify_moving(
        MADE.curve, MADE.law, MADE.moving, junk
    ),
    "certify_moving hold": lambda junk: vs.certify_moving(
        MADE.curve, MADE.law, MADE.moving, 1.0, hold=junk
    ),
    "Fleet": vs.Fleet.model_validate,
    "Fleet separation": lambda junk: vs.Fleet.of(FLEET.members, junk),
    "plan_fleet": vs.plan_fleet,
    "plan_fleet workers": lambda junk: vs.plan_fleet(FLEET, workers=junk),
    "plan_fleet improve": lambda junk: vs.plan_fleet(FLEET, improve=junk),
    "plan_fleet periods": lambda junk: vs.plan_fleet(FLEET, periods=junk),
    "plan_fleet progress": lambda junk: vs.plan_fleet(FLEET, progress=uncallable(junk)),
    "simulate_fleet": vs.simulate_fleet,
    "simulate_fleet delays": lambda junk: vs.simulate_fleet(FLEET, junk, MADE.fleet_plan),
    "simulate_fleet plan": lambda junk: vs.simulate_fleet(FLEET, plan=junk),
    "simulate_fleet seed": lambda junk: vs.simulate_fleet(FLEET, plan=MADE.fleet_plan, seed=junk),
    "simulate_fleet step": lambda junk: vs.simulate_fleet(FLEET, plan=MADE.fleet_plan, step=junk),
    "Delays": lambda junk: vs.Delays(slowed=junk),
    "Delays halts": lambda junk: vs.Delays(halts=junk),
    "FleetNavigator": vs.FleetNavigator,
    "FleetNavigator margin": lambda junk: vs.FleetNavigator(MADE.fleet_plan, margin_m=junk),
    "FleetNavigator tolerance": lambda junk: vs.FleetNavigator(
        MADE.fleet_plan, stops_within_m=junk
    ),
    "FleetNavigator robot": lambda junk: MADE.fleet_navigator.with_robot(junk),
    "FleetNavigator elsewhere": lambda junk: MADE.fleet_navigator.rerouted("a", junk),
    "FleetNavigator stopping": lambda junk: MADE.fleet_navigator.stopping(junk),
    "export": lambda junk: vs.export(junk, "x.csv"),
    "export path": lambda junk: vs.export(MADE.plan, junk),
    "export origin": lambda junk: vs.export(MADE.plan, TO_NOWHERE, origin=junk),
    "export chord_error": lambda junk: vs.export(MADE.plan, TO_NOWHERE, chord_error=junk),
    "export acceptance": lambda junk: vs.export(MADE.plan, TO_NOWHERE, acceptance=junk),
    "export spacing": lambda junk: vs.export(MADE.plan, TO_NOWHERE, spacing=junk),
    "export name": lambda junk: vs.export(MADE.plan, TO_NOWHERE, name=junk),
    "ExportOptions": lambda junk: vs.ExportOptions(junk).checked(),
    "export_fleet": lambda junk: vs.export_fleet(junk, TO_NOWHERE),
    "export_fleet path": lambda junk: vs.export_fleet(MADE.fleet_plan, junk),
    "export_fleet options": lambda junk: vs.export_fleet(MADE.fleet_plan, TO_NOWHERE, junk),
    "FleetMember": lambda junk: vs.add_robot(MADE.fleet_plan, vs.FleetMember("b", junk)),
    "add_robot": lambda junk: vs.add_robot(junk, FLEET.members[0]),
    "add_robot member": lambda junk: vs.add_robot(MADE.fleet_plan, junk),
    "remove_robot": lambda junk: vs.remove_robot(junk, "a"),
    "remove_robot name": lambda junk: vs.remove_robot(MADE.fleet_plan, junk),
    "reroute_robot": lambda junk: vs.reroute_robot(junk, FLEET.members[0]),
    "reroute_robot member": lambda junk: vs.reroute_robot(MADE.fleet_plan, junk),
    "FleetNavigator period": lambda junk: vs.FleetNavigator(MADE.fleet_plan, period=junk),
    "FleetNavigator reports": lambda junk: MADE.fleet_navigator.step(junk, 0.0),
    "FleetNavigator time": lambda junk: MADE.fleet_navigator.step([], junk),
    "ProgressReport name": lambda junk: MADE.fleet_navigator.step(
        [vs.ProgressReport(junk, 0.0, 0.0)], 0.0
    ),
    "ProgressReport time": lambda junk: MADE.fleet_navigator.step(
        [vs.ProgressReport("a", junk, 0.0)], 0.0
    ),
    "ProgressReport distance": lambda junk: MADE.fleet_navigator.step(
        [vs.ProgressReport("a", 0.0, junk)], 0.0
    ),
}
RESULTS = {
    "Certificate", "Command", "Exported", "FleetCommand", "FleetPlan", "FleetRun",
    "MovingCertificate", "Plan",
    "Run", "SpatialPlan", "SpatialRun", "TensionAdvice",
}  # fmt: skip


@pytest.mark.parametrize("verb", VERBS)
def test_junk_has_an_answer_or_an_error_of_the_packages_own(verb: str) -> None:
    for junk in JUNK:
        try:
            VERBS[verb](junk)
        except vs.ViasplineError:
            pass
        except BaseException as error:
            error.add_note(f"{verb}, with {junk!r:.40}")
            raise


def test_every_exported_name_is_tried() -> None:
    tried = {name.split()[0] for name in VERBS}
    errors = {name for name in vs.__all__ if name.endswith(("Error", "Warning"))}
    assert set(vs.__all__) - tried - errors - RESULTS == {"__version__"}


def test_a_part_of_a_mission_that_is_built_alone_names_its_keys_and_the_remedy() -> None:
    with pytest.raises(vs.MissionError, match=r"circle\.radius: -1 is negative.*not less than"):
        vs.Obstacle(circle={"center": (0, 0), "radius": -1})
    with pytest.raises(vs.MissionError) as told:
        vs.SpeedZone.model_validate({"poligon": SQUARE, "max_speed_mps": "fast"})
    assert [fault.key for fault in told.value.faults] == ["poligon", "max_speed_mps"]
    assert "polygon" in told.value.faults[0].remedy
    inside = {"world": {"known": [{"circle": {"center": (0, 0), "radius": -1}}]}}
    with pytest.raises(vs.MissionError, match=r"world\.known\[0\]\.circle\.radius"):
        vs.Mission.model_validate({**inside, "route": {"start": [5, 5], "goal": [9, 9]}})


@pytest.mark.parametrize("value", [None, "3", [0.0, None], ["1", "2"], np.array(["1"])])
def test_nothing_and_text_are_no_numbers(value: Any) -> None:
    for ask in (MADE.law.state_at, MADE.law.time_at, MADE.curve.evaluate, MADE.curve.at_distance):
        with pytest.raises(vs.GeometryError, match="expected numbers"):
            ask(value)


def test_whole_numbers_of_any_size_flags_and_lists_are_numbers() -> None:
    for value in (1, True, 10**30, np.float32(0.5), [0, 1], np.int8(1)):
        assert np.isfinite(MADE.law.state_at(value)[0]).all()


def test_text_is_no_number_either_where_one_is_expected() -> None:
    for made in (lambda: vs.Limits(max_speed="2", max_accel=1), lambda: MADE.plan.samples("1")):
        with pytest.raises(vs.GeometryError, match="give a number"):
            made()


@pytest.mark.parametrize("asked", [{"clearance": -1}, {"clearance": 1, "radius": -1}])
def test_a_proof_of_less_than_nothing_is_refused(asked: dict[str, float]) -> None:
    curve, moving = MADE.curve, MADE.moving
    with pytest.raises(vs.GeometryError, match=r"is -1\.0; give 0 or more"):
        vs.certify(curve, MADE.world, **asked)
    with pytest.raises(vs.GeometryError, match=r"is -1\.0; give 0 or more"):
        vs.certify_moving(curve, MADE.law, moving, **asked)


def test_what_a_world_would_pass_over_is_refused() -> None:
    disc = {"center": (0, 0), "radius": 1}
    both = vs.Obstacle(circle=disc, polygon=[(5, 0), (9, 0), (9, 9)])
    with pytest.raises(vs.GeometryError, match="two shapes, circle and polygon"):
        vs.World([both])
    cart = vs.Obstacle(circle=disc, motion={"from": (9, 0), "velocity_mps": (1, 0)})
    with pytest.raises(vs.GeometryError, match="obstacle 0 moves, and a World stands still"):
        vs.World([cart])
