"""From what a vehicle says, north, east, down and clockwise, to a mission's metres and angles."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.formats.local_frame import LocalFrame
from viaspline.links.mavlink.telemetry import Telemetry


@dataclass(frozen=True)
class VehicleState:
    """Where a vehicle is in the frame of a mission.

    Attributes:
        x: East [m].
        y: North [m].
        up: Above its home [m].
        heading: Of its body, anticlockwise from east [rad].
        speed: Forward, along its body [m/s].
        across: To the left, across its body [m/s].
        climb: Upward [m/s].
    """

    x: float
    y: float
    up: float
    heading: float
    speed: float
    across: float
    climb: float


def heading_of(yaw: float) -> float:
    """The heading, anticlockwise from east, of a yaw, clockwise from north [rad]; and back.

    >>> heading_of(0.0) == math.pi / 2, heading_of(math.pi / 2)
    (True, 0.0)
    """
    return math.remainder(math.pi / 2 - yaw, math.tau)


def vehicle_state(telemetry: Telemetry, frame: LocalFrame, now: float) -> VehicleState:
    """Where a vehicle is now: where it was last, moved on by its speed and its turn since.

    Args:
        telemetry: With a position and an attitude.
        frame: The mission's.
        now: [s].
    """
    position, attitude = telemetry.position, telemetry.attitude
    assert position is not None
    assert attitude is not None
    x, y = frame.to_local(position.lat / 1e7, position.lon / 1e7).tolist()
    north, east, down = position.vx / 100.0, position.vy / 100.0, position.vz / 100.0
    moved, turned = now - telemetry.position_at, now - telemetry.attitude_at
    yaw = attitude.yaw + turned * attitude.yawspeed
    return VehicleState(
        x=x + moved * east,
        y=y + moved * north,
        up=position.relative_alt / 1e3 - moved * down,
        heading=heading_of(yaw),
        speed=north * math.cos(yaw) + east * math.sin(yaw),
        across=north * math.sin(yaw) - east * math.cos(yaw),
        climb=-down,
    )
