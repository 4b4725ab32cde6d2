"""The messages that are spoken here, each with its fields in the order of the wire.

Their numbers, fields and checksums are those of MAVLink's common and ardupilotmega dialects:
https://mavlink.io/en/messages/common.html

Tested through ``links/mavlink/test_frames``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from viaspline.links.mavlink.message import (
    F32,
    I16,
    I32,
    U8,
    U16,
    U32,
    U64,
    MavlinkMessage,
    Text50,
)


@dataclass(frozen=True)
class Heartbeat(MavlinkMessage, number=0, extra=50):
    """Here I am: what a vehicle is, and in which mode it is."""

    custom_mode: U32
    type: U8
    autopilot: U8
    base_mode: U8
    system_status: U8
    mavlink_version: U8


@dataclass(frozen=True)
class Attitude(MavlinkMessage, number=30, extra=39):
    """How a vehicle's body lies, angles clockwise seen from above [rad], [rad/s]."""

    time_boot_ms: U32
    roll: F32
    pitch: F32
    yaw: F32
    rollspeed: F32
    pitchspeed: F32
    yawspeed: F32


@dataclass(frozen=True)
class GlobalPositionInt(MavlinkMessage, number=33, extra=104):
    """Where a vehicle is: 1e-7 degrees, millimetres; north, east, down [cm/s]."""

    time_boot_ms: U32
    lat: I32
    lon: I32
    alt: I32
    relative_alt: I32
    vx: I16
    vy: I16
    vz: I16
    hdg: U16


@dataclass(frozen=True)
class MissionRequest(MavlinkMessage, number=40, extra=230):
    """A vehicle asks for an item, the old way."""

    seq: U16
    target_system: U8
    target_component: U8
    mission_type: U8


@dataclass(frozen=True)
class MissionRequestList(MavlinkMessage, number=43, extra=132):
    """Asks how many items there are."""

    target_system: U8
    target_component: U8
    mission_type: U8


@dataclass(frozen=True)
class MissionCount(MavlinkMessage, number=44, extra=221):
    """How many items there are."""

    count: U16
    target_system: U8
    target_component: U8
    mission_type: U8


@dataclass(frozen=True)
class MissionClearAll(MavlinkMessage, number=45, extra=232):
    """Asks to forget all items."""

    target_system: U8
    target_component: U8
    mission_type: U8


@dataclass(frozen=True)
class MissionAck(MavlinkMessage, number=47, extra=153):
    """What came of a list of items."""

    target_system: U8
    target_component: U8
    type: U8
    mission_type: U8


@dataclass(frozen=True)
class MissionRequestInt(MavlinkMessage, number=51, extra=196):
    """Asks for an item."""

    seq: U16
    target_system: U8
    target_component: U8
    mission_type: U8


@dataclass(frozen=True)
class RequestDataStream(MavlinkMessage, number=66, extra=148):
    """Asks for a group of messages, as older autopilots have it [Hz]."""

    req_message_rate: U16
    target_system: U8
    target_component: U8
    req_stream_id: U8
    start_stop: U8


@dataclass(frozen=True)
class MissionItemInt(MavlinkMessage, number=73, extra=38):
    """An item of a mission, a fence or the rally points; x, y in 1e-7 degrees, z in metres."""

    param1: F32
    param2: F32
    param3: F32
    param4: F32
    x: I32
    y: I32
    z: F32
    seq: U16
    command: U16
    target_system: U8
    target_component: U8
    frame: U8
    current: U8
    autocontinue: U8
    mission_type: U8


@dataclass(frozen=True)
class CommandLong(MavlinkMessage, number=76, extra=152):
    """A command, to be answered by a ``CommandAck``."""

    param1: F32
    param2: F32
    param3: F32
    param4: F32
    param5: F32
    param6: F32
    param7: F32
    command: U16
    target_system: U8
    target_component: U8
    confirmation: U8


@dataclass(frozen=True)
class CommandAck(MavlinkMessage, number=77, extra=143):
    """What came of a command."""

    command: U16
    result: U8
    progress: U8
    result_param2: I32
    target_system: U8
    target_component: U8


@dataclass(frozen=True)
class SetPositionTargetLocalNed(MavlinkMessage, number=84, extra=143):
    """What a vehicle is to do now: north, east, down or forward, right, down; yaw clockwise."""

    time_boot_ms: U32
    x: F32
    y: F32
    z: F32
    vx: F32
    vy: F32
    vz: F32
    afx: F32
    afy: F32
    afz: F32
    yaw: F32
    yaw_rate: F32
    type_mask: U16
    target_system: U8
    target_component: U8
    coordinate_frame: U8


@dataclass(frozen=True)
class EkfStatusReport(MavlinkMessage, number=193, extra=71):
    """How well an ArduPilot knows where it is."""

    velocity_variance: F32
    pos_horiz_variance: F32
    pos_vert_variance: F32
    compass_variance: F32
    terrain_alt_variance: F32
    flags: U16
    airspeed_variance: F32


@dataclass(frozen=True)
class EstimatorStatus(MavlinkMessage, number=230, extra=163):
    """How well a PX4 knows where it is."""

    time_usec: U64
    vel_ratio: F32
    pos_horiz_ratio: F32
    pos_vert_ratio: F32
    mag_ratio: F32
    hagl_ratio: F32
    tas_ratio: F32
    pos_horiz_accuracy: F32
    pos_vert_accuracy: F32
    flags: U16


@dataclass(frozen=True)
class ExtendedSysState(MavlinkMessage, number=245, extra=130):
    """Whether a vehicle stands on the ground."""

    vtol_state: U8
    landed_state: U8


@dataclass(frozen=True)
class Statustext(MavlinkMessage, number=253, extra=83):
    """Words of a vehicle."""

    severity: U8
    text: Text50
    id: U16
    chunk_seq: U8


MESSAGES: Final[dict[int, type[MavlinkMessage]]] = {
    kind.NUMBER: kind
    for kind in (
        Heartbeat,
        Attitude,
        GlobalPositionInt,
        MissionRequest,
        MissionRequestList,
        MissionCount,
        MissionClearAll,
        MissionAck,
        MissionRequestInt,
        RequestDataStream,
        MissionItemInt,
        CommandLong,
        CommandAck,
        SetPositionTargetLocalNed,
        EkfStatusReport,
        EstimatorStatus,
        ExtendedSysState,
        Statustext,
    )
}
"""Every kind of message, by its number."""
