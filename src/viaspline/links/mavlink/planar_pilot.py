"""A navigator at the wheel of a rover or a boat, or of a copter that keeps its height.

Tested through ``links/mavlink/test_closed_loop``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

from viaspline.errors import LinkError
from viaspline.links.mavlink.pilot import FAR_OFF_M, Steering
from viaspline.links.mavlink.setpoints import VehicleMotion
from viaspline.links.mavlink.vehicle_state import VehicleState
from viaspline.mission.model import Mission
from viaspline.robot.navigator import Navigator
from viaspline.robot.state import Command, RobotState

MAX_OFF_START_RAD: Final = math.radians(60.0)
"""A robot that is turned farther away from where its path begins isn't sent off."""

TURN_GAIN_PER_S: Final = 1.5
USUAL_TURN_RADPS: Final = 0.6
STRAIGHT_RAD: Final = math.radians(2.0)
"""Of a turn on the spot by a robot without a drive: per error, at most, and what counts as done."""

HEIGHT_GAIN_PER_S: Final = 0.5
MAX_CLIMB_MPS: Final = 0.5
"""How a copter on a planar mission keeps its height."""


def check_drivable(mission: Mission, name: str) -> None:
    """Refuse what a mission asks for that MAVLink doesn't bring, or an autopilot doesn't do.

    Raises:
        LinkError: It has a lidar, or moves sideways, or among others that move.
    """
    sensor, robot = mission.robot.sensor, mission.robot
    if sensor is not None and sensor.lidar is not None:
        problem = "the robot drives by its lidar, and MAVLink brings no scans"
        raise LinkError(name, problem, "leave robot.sensor out: it then drives by its map alone")
    if robot.held_heading is not None:
        problem = "the robot holds its heading, which autopilots of rovers don't"
        raise LinkError(name, problem, "give it a drive that looks where it goes")
    if robot.moving is not None or any(item.motion is not None for item in mission.world.known):
        problem = "things move in the mission, and their clock isn't the vehicle's"
        raise LinkError(name, problem, "leave out what moves")


@dataclass(frozen=True, eq=False)
class PlanarPilot:
    """A navigator under way.

    Attributes:
        nav: It.
        height: That a copter keeps, above its home [m]; None before the first step.
    """

    nav: Navigator
    height: float | None = None

    @property
    def allowed_m(self) -> float:
        """Within this of its path the body touches nothing."""
        return min(float(self.nav.plan.certificate.clearance), FAR_OFF_M)

    @property
    def takeoff_m(self) -> float | None:
        """It doesn't take off."""
        return None

    @property
    def lands(self) -> bool:
        """It doesn't land."""
        return False

    def too_far(self, state: VehicleState) -> str | None:
        """Why it can't set off from there: too far beside the start, or turned away."""
        path = self.nav.path
        x, y = (float(value) for value in path.evaluate(0.0)[:2])
        off = math.hypot(state.x - x, state.y - y)
        if off > self.allowed_m:
            return (
                f"it stands {off:.2f} m from the start, and {self.allowed_m:.2f} m are proven clear"
            )
        turned = math.remainder(state.heading - float(path.heading(0.0)), math.tau)
        if abs(turned) > MAX_OFF_START_RAD:
            return f"it is turned by {math.degrees(turned):.0f}° from where its path begins"
        return None

    def steered(self, state: VehicleState, time: float) -> tuple[PlanarPilot, Steering]:
        """What the navigator commands."""
        height = state.up if self.height is None else self.height
        measured = RobotState((state.x, state.y), state.heading, state.speed, state.across)
        command, nav = self.nav.step(measured, [], time)
        beside = float(nav.path.project((state.x, state.y)).distance)
        news = tuple(f"{event.kind}: {event.message}" for event in nav.events)
        motion = _motion(command, state, nav, height)
        over = nav.finished and not _turns(command, state)
        failed = nav.reason if nav.finished and not nav.reached else None
        return replace(self, nav=nav, height=height), Steering(motion, beside, over, failed, news)


def _turns(command: Command, state: VehicleState) -> bool:
    """Whether the robot is still turning on the spot."""
    off = math.remainder(command.heading - state.heading, math.tau)
    return command.stopped and not command.finished and abs(off) > STRAIGHT_RAD


def _motion(command: Command, state: VehicleState, nav: Navigator, height: float) -> VehicleMotion:
    along, across = command.velocity
    cos, sin = math.cos(state.heading), math.sin(state.heading)
    climb = max(-MAX_CLIMB_MPS, min(MAX_CLIMB_MPS, HEIGHT_GAIN_PER_S * (height - state.up)))
    rate = command.yaw_rate
    if nav.controller is None and _turns(command, state):
        most = math.radians(nav.mission.robot.max_yaw_rate_degps or math.inf)
        most = min(most, USUAL_TURN_RADPS)
        off = math.remainder(command.heading - state.heading, math.tau)
        rate = max(-most, min(most, TURN_GAIN_PER_S * off))
    velocity = (along * cos - across * sin, along * sin + across * cos, climb)
    return VehicleMotion(along, rate, velocity, command.heading)
