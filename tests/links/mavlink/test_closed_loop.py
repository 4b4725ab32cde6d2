"""Vehicles driven in a closed loop, speaking through pymavlink, in simulated time."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from pymavlink_vehicle import (
    ARDUPILOT,
    BOAT,
    COPTER,
    ORIGIN,
    PX4,
    ROVER,
    PymavlinkVehicle,
)
from simulated_link import SimulatedLink

from viaspline.formats.local_frame import LocalFrame
from viaspline.links.mavlink.conversation import Conversation
from viaspline.links.mavlink.drive_orders import DriveOrders, Ended
from viaspline.links.mavlink.flight_pilot import FlightPilot
from viaspline.links.mavlink.pilot import Pilot
from viaspline.links.mavlink.planar_pilot import PlanarPilot
from viaspline.links.mavlink.vehicle_drive import VehicleDrive
from viaspline.links.mavlink.vehicle_runner import VehicleRunner, prepared
from viaspline.mission.model import Mission
from viaspline.plan_mission import plan
from viaspline.robot.navigator import Navigator

ROUND_A_TANK = {
    "world": {"known": [{"name": "tank", "circle": {"center": [12, 0.5], "radius": 2}}]},
    "robot": {
        "radius_m": 0.4, "clearance_m": 0.5, "max_speed_mps": 1.5,
        "drive": {"differential": {"track_m": 0.5}, "lag_s": 0.2, "delay_s": 0.05},
    },
    "route": {"start": {"at": [0, 0], "heading_deg": 0}, "goal": [24, 0]},
}  # fmt: skip


def planar(data: dict[str, Any]) -> PlanarPilot:
    return PlanarPilot(Navigator(Mission.model_validate(data)))


def driven(
    vehicle: PymavlinkVehicle, pilot: Pilot, *, loss: float = 0.0, arms: bool = True
) -> tuple[Ended, VehicleDrive, list[str]]:
    """Drive a vehicle to the end of its mission."""
    link = SimulatedLink(vehicle, loss=loss)
    told: list[str] = []
    talk = Conversation(link, "udp:test", clock=link.now, sleep=link.sleep)
    found, _ = talk.find(None, 10.0)
    telemetry = prepared(talk, found, 10.0, told.append)
    assert found.modes is not None
    frame = LocalFrame(*ORIGIN)
    orders = DriveOrders(arms, 10.0)
    drive = VehicleDrive(found, found.modes, pilot, frame, orders, telemetry)
    runner = VehicleRunner(talk, drive, told.append)
    return runner.run(), runner.drive, told


def off_path(vehicle: PymavlinkVehicle, *paths: Any) -> float:
    """How far it really was off a path, or off the nearest of some, by shapely."""
    line = shapely.MultiLineString([
        np.asarray(path.evaluate(np.linspace(*path.domain, 4000)))[:, :2] for path in paths
    ])  # fmt: skip
    track = [(x, y) for _, x, y, _ in vehicle.trace]
    return float(shapely.distance(shapely.points(track), line).max())


@pytest.mark.parametrize("kind", [ROVER, BOAT])
def test_a_rover_follows_round_an_obstacle_within_a_fifth_of_a_metre(kind: int) -> None:
    vehicle, pilot = PymavlinkVehicle(kind=kind), planar(ROUND_A_TANK)
    ended, drive, _ = driven(vehicle, pilot)
    assert ended == Ended(True, "it has reached its goal; HOLD")
    assert math.dist((vehicle.x, vehicle.y), (24, 0)) < 0.2
    assert off_path(vehicle, pilot.nav.path) < 0.2
    nearest = min(math.dist((x, y), (12, 0.5)) for _, x, y, _ in vehicle.trace)
    assert nearest > 2 + 0.4
    assert drive.farthest < 0.2
    assert vehicle.mode == 4


def test_it_follows_with_a_slower_machine_than_it_was_told_of_and_lost_packets() -> None:
    vehicle, pilot = PymavlinkVehicle(lag=0.35), planar(ROUND_A_TANK)
    ended, _, _ = driven(vehicle, pilot, loss=0.1)
    assert ended.reached
    assert off_path(vehicle, pilot.nav.path) < 0.2


def test_it_comes_to_its_path_from_beside_it() -> None:
    vehicle, pilot = PymavlinkVehicle(at=(0.0, 0.35), heading=0.2), planar(ROUND_A_TANK)
    ended, _, _ = driven(vehicle, pilot)
    assert ended.reached
    assert math.dist((vehicle.x, vehicle.y), (24, 0)) < 0.2


def test_a_robot_of_which_no_drive_is_known_follows_too() -> None:
    data = {**ROUND_A_TANK, "robot": {"radius_m": 0.4, "clearance_m": 0.5, "max_speed_mps": 1.5}}
    vehicle, pilot = PymavlinkVehicle(lag=0.2), planar(data)
    ended, _, _ = driven(vehicle, pilot)
    assert ended.reached
    assert (
        off_path(vehicle, pilot.nav.path) < 0.8
    )  # a lag that nobody told of, in a long gentle bend


def test_a_rover_of_px4_follows_bearings() -> None:
    vehicle, pilot = PymavlinkVehicle(autopilot=PX4), planar(ROUND_A_TANK)
    ended, _, _ = driven(vehicle, pilot)
    assert ended == Ended(True, "it has reached its goal; HOLD")
    assert off_path(vehicle, pilot.nav.path) < 0.3


def test_a_station_is_served_standing() -> None:
    data = {
        **ROUND_A_TANK,
        "route": {
            "start": {"at": [0, 0], "heading_deg": 0}, "via": [{"at": [8, 3], "dwell_s": 4}],
            "goal": [16, 0],
        },
    }  # fmt: skip
    vehicle, pilot = PymavlinkVehicle(), planar(data)
    ended, _, _ = driven(vehicle, pilot)
    assert ended.reached
    near = [t for t, x, y, _ in vehicle.trace if math.dist((x, y), (8, 3)) < 0.2]
    assert near[-1] - near[0] > 4.0


@pytest.mark.parametrize("knows_its_drive", [True, False])
def test_a_corner_is_turned_on_the_spot(knows_its_drive: bool) -> None:
    robot = {"radius_m": 0.4, "turn_on_spot": "vias", "max_speed_mps": 1.5}
    if knows_its_drive:
        robot["drive"] = {"differential": {"track_m": 0.5}, "lag_s": 0.2, "delay_s": 0.05}
    route = {"start": {"at": [0, 0], "heading_deg": 0}, "via": [[5, 0]], "goal": [5, 5]}
    vehicle, pilot = PymavlinkVehicle(), planar({"robot": robot, "route": route})
    ended, _, _ = driven(vehicle, pilot)
    assert ended.reached
    assert math.dist((vehicle.x, vehicle.y), (5, 5)) < 0.25
    assert off_path(vehicle, pilot.nav.path) < 0.25


def test_laps_are_driven_one_after_the_other() -> None:
    data = {
        **ROUND_A_TANK, "world": {},
        "route": {
            "start": {"at": [0, 0], "heading_deg": 0}, "via": [[8, 0], [8, 6], [0, 6]],
            "closed": True, "laps": 2,
        },
    }  # fmt: skip
    vehicle, pilot = PymavlinkVehicle(), planar(data)
    ended, drive, _ = driven(vehicle, pilot)
    assert ended.reached
    away = [math.dist((x, y), (8, 6)) < 0.3 for _, x, y, _ in vehicle.trace]
    assert sum(b and not a for a, b in pairwise(away)) == 2
    assert drive.farthest < 0.2


IN_SPACE = {
    "world": {
        "ground": {"flat_m": 0},
        "known": [{"name": "mast", "circle": {"center": [15, 0.2], "radius": 1.5},
                   "height_m": [0, 30]}],
    },
    "robot": {
        "radius_m": 0.4, "half_height_m": 0.2, "clearance_m": 0.8, "max_speed_mps": 2,
        "max_accel_mps2": 1, "max_climb_mps": 1, "max_descent_mps": 1,
    },
    "route": {
        "start": [0, 0], "takeoff": {"to_agl_m": 5}, "via": [{"at": [15, 8], "agl_m": 8}],
        "land": {"at": [30, 0]},
    },
}  # fmt: skip


@pytest.mark.parametrize("autopilot", [ARDUPILOT, PX4])
def test_a_copter_takes_off_flies_and_lands(autopilot: int) -> None:
    planned = plan(Mission.model_validate(IN_SPACE))
    vehicle = PymavlinkVehicle(kind=COPTER, autopilot=autopilot)
    ended, _, _ = driven(vehicle, FlightPilot(planned))
    assert ended == Ended(True, "it has landed")
    assert math.dist((vehicle.x, vehicle.y), (30, 0)) < 0.5
    assert max(up for *_, up in vehicle.trace) > 7.5
    path = planned.path
    line = np.asarray(path.evaluate(np.linspace(0, path.domain[1], 4000)))
    track = np.array([(x, y, up) for _, x, y, up in vehicle.trace])[::10]
    apart = np.linalg.norm(track[:, None] - line[None], axis=2).min(axis=1)
    assert apart.max() < 0.4


def test_a_copter_on_a_planar_mission_keeps_its_height() -> None:
    vehicle, pilot = PymavlinkVehicle(kind=COPTER), planar(ROUND_A_TANK)
    vehicle.up, vehicle.armed = 10.0, True
    ended, drive, _ = driven(vehicle, pilot)
    assert ended == Ended(True, "it has reached its goal; BRAKE")
    assert all(abs(up - 10.0) < 0.3 for *_, up in vehicle.trace)
    assert isinstance(drive.pilot, PlanarPilot)
    laid_anew = drive.pilot.nav.path  # a copter isn't the cart that the mission says: it is told
    assert off_path(vehicle, pilot.nav.path, laid_anew) < 0.3
