"""Lay a spline through your via points, round whatever stands in the way, proven clear.

The flow is the folder tree:
mission → world → curve → planning → trajectory → machine → robot → report.

>>> import viaspline as vs
>>> mission = vs.Mission.model_validate({
...     "world": {"bounds": [0, 0, 100, 100],
...               "known": [{"name": "tank", "circle": {"center": [50, 52], "radius": 10}}]},
...     "route": {"start": [10, 50], "via": [[70, 60]], "goal": [90, 20]},
... })
>>> plan = vs.plan(mission)
>>> plan.certificate.holds, [via.name for via in plan.path.vias if via.kind == "user"]
(True, ['start', 'via 1', 'goal'])
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from viaspline.advice import TensionAdvice, advise_tension
    from viaspline.curve.cardinal import CardinalSpline
    from viaspline.curve.certificate import Certificate, certify
    from viaspline.curve.path import Path
    from viaspline.curve.piecewise import PiecewiseCubic
    from viaspline.errors import (
        GaveUpError,
        GeometryError,
        MissionError,
        MissionWarning,
        NoPathError,
        OutputError,
        PlanningError,
        SavedPlanError,
        ViasplineError,
    )
    from viaspline.exports.export_options import ExportOptions
    from viaspline.exports.export_path import Exported, export, export_fleet
    from viaspline.fleet.execution.changed_plans import add_robot, remove_robot, reroute_robot
    from viaspline.fleet.execution.delays import Delays
    from viaspline.fleet.execution.fleet_messages import FleetCommand, ProgressReport
    from viaspline.fleet.execution.fleet_navigator import FleetNavigator
    from viaspline.fleet.execution.fleet_run import FleetRun
    from viaspline.fleet.execution.simulate_fleet import simulate_fleet
    from viaspline.fleet.fleet_plan import FleetPlan
    from viaspline.fleet.plan_fleet import plan_fleet
    from viaspline.fleet.saved.load_fleet_plan import load_fleet_plan
    from viaspline.formats.load import load, origin_of
    from viaspline.maps.grid import Grid
    from viaspline.maps.terrain import Terrain
    from viaspline.maps.voxels import Voxels
    from viaspline.mission.fleet.fleet import Fleet, FleetMember
    from viaspline.mission.load_map import load_map
    from viaspline.mission.model import Mission
    from viaspline.mission.shapes.obstacle import Obstacle
    from viaspline.mission.world_spec import SpeedZone
    from viaspline.plan_mission import plan
    from viaspline.planner import Plan
    from viaspline.robot.logbook import Logbook
    from viaspline.robot.navigator import Navigator
    from viaspline.robot.perception.lidar import Scan
    from viaspline.robot.perception.moving.motion_sensor import MovingSighting
    from viaspline.robot.run import Run
    from viaspline.robot.simulator import simulate
    from viaspline.robot.state import Command, RobotState
    from viaspline.saved_plans.load_plan import load_plan
    from viaspline.space.online.fly import fly
    from viaspline.space.spatial_plan import SpatialPlan
    from viaspline.space.spatial_run import SpatialRun
    from viaspline.trajectory.lap import retime_lap
    from viaspline.trajectory.limits import Limits, Station
    from viaspline.trajectory.moving_certificate import MovingCertificate, certify_moving
    from viaspline.trajectory.retime import retime
    from viaspline.trajectory.trajectory import Trajectory
    from viaspline.world.moving_obstacles import MovingObstacles
    from viaspline.world.space.spatial_world import SpatialWorld
    from viaspline.world.world import World

_HOMES = {
    "CardinalSpline": "curve.cardinal",
    "Certificate": "curve.certificate",
    "Command": "robot.state",
    "Delays": "fleet.execution.delays",
    "ExportOptions": "exports.export_options",
    "Exported": "exports.export_path",
    "Fleet": "mission.fleet.fleet",
    "FleetCommand": "fleet.execution.fleet_messages",
    "FleetMember": "mission.fleet.fleet",
    "FleetNavigator": "fleet.execution.fleet_navigator",
    "FleetPlan": "fleet.fleet_plan",
    "FleetRun": "fleet.execution.fleet_run",
    "GaveUpError": "errors",
    "GeometryError": "errors",
    "Grid": "maps.grid",
    "Limits": "trajectory.limits",
    "Logbook": "robot.logbook",
    "Mission": "mission.model",
    "MissionError": "errors",
    "MissionWarning": "errors",
    "MovingCertificate": "trajectory.moving_certificate",
    "MovingObstacles": "world.moving_obstacles",
    "MovingSighting": "robot.perception.moving.motion_sensor",
    "Navigator": "robot.navigator",
    "NoPathError": "errors",
    "Obstacle": "mission.shapes.obstacle",
    "OutputError": "errors",
    "Path": "curve.path",
    "PiecewiseCubic": "curve.piecewise",
    "Plan": "planner",
    "PlanningError": "errors",
    "ProgressReport": "fleet.execution.fleet_messages",
    "RobotState": "robot.state",
    "Run": "robot.run",
    "SavedPlanError": "errors",
    "Scan": "robot.perception.lidar",
    "SpatialPlan": "space.spatial_plan",
    "SpatialRun": "space.spatial_run",
    "SpatialWorld": "world.space.spatial_world",
    "SpeedZone": "mission.world_spec",
    "Station": "trajectory.limits",
    "TensionAdvice": "advice",
    "Terrain": "maps.terrain",
    "Trajectory": "trajectory.trajectory",
    "ViasplineError": "errors",
    "Voxels": "maps.voxels",
    "World": "world.world",
    "add_robot": "fleet.execution.changed_plans",
    "advise_tension": "advice",
    "certify": "curve.certificate",
    "certify_moving": "trajectory.moving_certificate",
    "export": "exports.export_path",
    "export_fleet": "exports.export_path",
    "fly": "space.online.fly",
    "load": "formats.load",
    "load_fleet_plan": "fleet.saved.load_fleet_plan",
    "load_map": "mission.load_map",
    "load_plan": "saved_plans.load_plan",
    "origin_of": "formats.load",
    "plan": "plan_mission",
    "plan_fleet": "fleet.plan_fleet",
    "remove_robot": "fleet.execution.changed_plans",
    "reroute_robot": "fleet.execution.changed_plans",
    "retime": "trajectory.retime",
    "retime_lap": "trajectory.lap",
    "simulate": "robot.simulator",
    "simulate_fleet": "fleet.execution.simulate_fleet",
}

__all__ = [*sorted(_HOMES), "__version__"]


def __getattr__(name: str) -> Any:
    """Import a public name when it is first used: numba and shapely take their time."""
    if name not in _HOMES:
        raise AttributeError(f"module 'viaspline' has no attribute {name!r}")
    return getattr(import_module(f"viaspline.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    return list(__all__)
