"""A real autopilot in the loop, where somebody has one: VIASPLINE_SITL=tcp:127.0.0.1:5760.

It has to be a rover, with ArduPilot's own simulator behind it or with its wheels in the air: it is
armed, and drives 45 m round an obstacle.
"""

import os
import time

import pytest

from viaspline.formats.local_frame import LocalFrame
from viaspline.links.mavlink.addresses import parse_address
from viaspline.links.mavlink.conversation import Conversation
from viaspline.links.mavlink.drive_orders import DriveOrders
from viaspline.links.mavlink.mav_words import FENCE, MISSION
from viaspline.links.mavlink.mission_items import lists_of
from viaspline.links.mavlink.planar_pilot import PlanarPilot
from viaspline.links.mavlink.transport import open_transport
from viaspline.links.mavlink.upload_mission import upload_mission
from viaspline.links.mavlink.vehicle_drive import VehicleDrive
from viaspline.links.mavlink.vehicle_runner import VehicleRunner, prepared
from viaspline.links.mavlink.vehicle_state import vehicle_state
from viaspline.links.mavlink.way_to_upload import proven_way
from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.robot.navigator import Navigator

ADDRESS = os.environ.get("VIASPLINE_SITL")


@pytest.mark.slow
@pytest.mark.skipif(ADDRESS is None, reason="VIASPLINE_SITL names no autopilot")
def test_a_real_rover_takes_a_mission_and_follows_round_an_obstacle() -> None:
    assert ADDRESS is not None
    talk = Conversation(open_transport(parse_address(ADDRESS)), ADDRESS)
    vehicle, _ = talk.find(None, 30.0)
    telemetry = prepared(talk, vehicle, 120.0, print)
    assert telemetry.position is not None
    origin = (telemetry.position.lat / 1e7, telemetry.position.lon / 1e7)
    frame = LocalFrame(*origin)
    here = vehicle_state(telemetry, frame, time.monotonic())
    mission = Mission.model_validate({
        "world": {"known": [{"name": "tank", "circle": {"center": [22, 0.5], "radius": 3}}]},
        "robot": {"radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 1.5, "max_accel_mps2": 0.5,
                  "drive": {"ackermann": {"wheelbase_m": 1, "max_steer_deg": 30}, "lag_s": 0.3,
                            "delay_s": 0.15}},
        "route": {"start": {"at": [here.x, here.y], "heading_deg": here.heading * 57.29578},
                  "goal": [45, 0]},
    })  # fmt: skip
    planned = plan(mission)
    way = proven_way(planned, origin, "round")
    done = upload_mission(talk, vehicle, lists_of(way.itinerary), way.itinerary.home, print)
    assert done.counts[MISSION] > 2
    assert done.counts[FENCE] == 1
    pilot = PlanarPilot(Navigator(mission, planned))
    telemetry = prepared(talk, vehicle, 30.0, print)
    assert vehicle.modes is not None
    drive = VehicleDrive(vehicle, vehicle.modes, pilot, frame, DriveOrders(True, 30.0), telemetry)
    runner = VehicleRunner(talk, drive, print)
    ended = runner.run()
    talk.close()
    assert ended.reached, ended.words
    assert runner.drive.farthest < 0.3
