"""What a vehicle is to do now, as its autopilot takes it.

ArduPilot's rovers take a speed along the body, its sign in vx, and a yaw rate; PX4's take a
velocity over the ground, to whose bearing the body turns; copters a velocity and a yaw. Sources:
https://ardupilot.org/dev/docs/mavlink-rover-commands.html,
https://docs.px4.io/main/en/flight_modes/offboard.html

Tested through ``links/mavlink/test_vehicle_drive``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from viaspline.links.mavlink.common_messages import SetPositionTargetLocalNed
from viaspline.links.mavlink.mav_words import ARDUPILOT
from viaspline.links.mavlink.vehicle import Vehicle
from viaspline.links.mavlink.vehicle_state import VehicleState, heading_of

LOCAL_NED: Final = 1
BODY_NED: Final = 8

_NO_PLACE: Final = 0b111
_NO_ACCELERATION: Final = 0b111 << 6
_NO_YAW: Final = 1 << 10
_NO_YAW_RATE: Final = 1 << 11

SPEED_AND_RATE: Final = _NO_PLACE | _NO_ACCELERATION | _NO_YAW
VELOCITY_AND_YAW: Final = _NO_PLACE | _NO_ACCELERATION | _NO_YAW_RATE
VELOCITY: Final = _NO_PLACE | _NO_ACCELERATION | _NO_YAW | _NO_YAW_RATE

BEARING_AHEAD_S: Final = 0.5
"""PX4's rovers turn to a bearing with about twice the error per second: the bearing that is meant
is where a yaw rate leads in this time."""


class VehicleMotion(NamedTuple):
    """What a vehicle is to do.

    Attributes:
        speed: Along its body [m/s].
        yaw_rate: Anticlockwise [rad/s].
        velocity: Over the ground: east, north, up [m/s].
        heading: That its body should have, anticlockwise from east [rad].
    """

    speed: float
    yaw_rate: float
    velocity: tuple[float, float, float]
    heading: float


def standstill(state: VehicleState) -> VehicleMotion:
    """Staying where it is, as it is turned."""
    return VehicleMotion(0.0, 0.0, (0.0, 0.0, 0.0), state.heading)


def setpoint(
    vehicle: Vehicle, motion: VehicleMotion, heading: float, now: float
) -> SetPositionTargetLocalNed:
    """The message that has a vehicle move so.

    Args:
        vehicle: It.
        motion: What it is to do.
        heading: That it has [rad].
        now: [s].
    """
    east, north, up = motion.velocity
    if vehicle.is_copter:
        yaw = heading_of(motion.heading)
        return _target(vehicle, now, LOCAL_NED, VELOCITY_AND_YAW, (north, east, -up), yaw=yaw)
    if vehicle.autopilot == ARDUPILOT:
        ahead = (motion.speed, 0.0, 0.0)
        return _target(vehicle, now, BODY_NED, SPEED_AND_RATE, ahead, rate=-motion.yaw_rate)
    bearing = heading + BEARING_AHEAD_S * motion.yaw_rate
    north, east = motion.speed * math.sin(bearing), motion.speed * math.cos(bearing)
    return _target(vehicle, now, LOCAL_NED, VELOCITY, (north, east, 0.0))


def _target(
    vehicle: Vehicle, now: float, frame: int, mask: int, velocity: tuple[float, float, float], *,
    yaw: float = 0.0, rate: float = 0.0,
) -> SetPositionTargetLocalNed:  # fmt: skip
    return SetPositionTargetLocalNed(
        time_boot_ms=int(now * 1e3) & 0xFFFFFFFF,
        x=0.0, y=0.0, z=0.0, vx=velocity[0], vy=velocity[1], vz=velocity[2],
        afx=0.0, afy=0.0, afz=0.0, yaw=yaw, yaw_rate=rate, type_mask=mask,
        target_system=vehicle.system, target_component=vehicle.component, coordinate_frame=frame,
    )  # fmt: skip
