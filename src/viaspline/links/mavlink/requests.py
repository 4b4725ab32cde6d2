"""What a vehicle is asked for: messages, modes, arming, a take-off.

Tested through ``links/mavlink/test_vehicle_drive`` and ``links/mavlink/test_vehicle_runner``.
"""

from __future__ import annotations

from typing import Final

from viaspline.links.mavlink.common_messages import CommandLong, RequestDataStream
from viaspline.links.mavlink.exchange import Said
from viaspline.links.mavlink.mav_words import (
    ARDUPILOT,
    ARM,
    SET_MESSAGE_INTERVAL,
    SET_MODE,
    TAKE_OFF,
)
from viaspline.links.mavlink.vehicle import Vehicle

POSE_HZ: Final = 20.0
SLOW_HZ: Final = 2.0

_POSE: Final = (30, 33)
"""ATTITUDE, GLOBAL_POSITION_INT."""

_STREAMS: Final = ((6, 20), (10, 20), (12, 2), (2, 2))
"""MAV_DATA_STREAMs with their rates [Hz]: POSITION, EXTRA1, EXTRA3, EXTENDED_STATUS."""


def ask_for_streams(vehicle: Vehicle) -> Said:
    """Ask for all that is needed to drive, the old way and the new one."""
    to, at = vehicle.system, vehicle.component
    health = 193 if vehicle.autopilot == ARDUPILOT else 230
    old = tuple(RequestDataStream(rate, to, at, stream, 1) for stream, rate in _STREAMS)
    new = tuple(
        command(vehicle, SET_MESSAGE_INTERVAL, float(number), 1e6 / rate)
        for number, rate in (*((one, POSE_HZ) for one in _POSE), (health, SLOW_HZ), (245, SLOW_HZ))
    )
    return (*old, *new)


def change_mode(vehicle: Vehicle, mode: int) -> CommandLong:
    """Change to a custom mode."""
    return command(vehicle, SET_MODE, *vehicle.mode_params(mode))


def arm(vehicle: Vehicle) -> CommandLong:
    """Be armed: motors may turn."""
    return command(vehicle, ARM, 1.0)


def take_off(vehicle: Vehicle, height: float) -> CommandLong:
    """Take off to a height above home [m]."""
    return command(vehicle, TAKE_OFF, param7=height)


def command(
    vehicle: Vehicle, number: int, param1: float = 0.0, param2: float = 0.0, param3: float = 0.0,
    *, param7: float = 0.0,
) -> CommandLong:  # fmt: skip
    """A command to a vehicle."""
    return CommandLong(
        param1=param1, param2=param2, param3=param3, param4=0.0, param5=0.0, param6=0.0,
        param7=param7, command=number, target_system=vehicle.system,
        target_component=vehicle.component, confirmation=0,
    )  # fmt: skip
