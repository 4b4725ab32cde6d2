"""Numbers of MAVLink and what people call them.

Source: https://mavlink.io/en/messages/common.html
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

MISSION, FENCE, RALLY = 0, 1, 2
"""MAV_MISSION_TYPEs: what a list of items is."""

LISTS: Final[Mapping[int, str]] = {MISSION: "mission", FENCE: "fence", RALLY: "rally points"}

ACCEPTED: Final = 0
MISSION_ERROR: Final = 1
MISSION_UNSUPPORTED: Final = 3
MISSION_CANCELLED: Final = 15

MISSION_RESULTS: Final[Mapping[int, str]] = {
    0: "accepted",
    1: "error",
    2: "its frame isn't supported",
    3: "not supported",
    4: "no space left for so many items",
    5: "invalid",
    6: "parameter 1 is invalid",
    7: "parameter 2 is invalid",
    8: "parameter 3 is invalid",
    9: "parameter 4 is invalid",
    10: "x is invalid",
    11: "y is invalid",
    12: "its altitude is invalid",
    13: "it came out of order",
    14: "denied",
    15: "cancelled",
}
"""MAV_MISSION_RESULT."""

COMMAND_RESULTS: Final[Mapping[int, str]] = {
    0: "accepted",
    1: "temporarily rejected",
    2: "denied",
    3: "not supported",
    4: "failed",
    5: "in progress",
    6: "cancelled",
    7: "only taken as COMMAND_LONG",
    8: "only taken as COMMAND_INT",
    9: "its frame isn't supported",
}
"""MAV_RESULT."""

SET_MODE: Final = 176
ARM: Final = 400
TAKE_OFF: Final = 22
LAND: Final = 21
SET_MESSAGE_INTERVAL: Final = 511
"""MAV_CMDs that are sent while a vehicle is driven."""

COMMANDS: Final[Mapping[int, str]] = {
    SET_MODE: "the change of its mode",
    ARM: "to be armed",
    TAKE_OFF: "to take off",
    LAND: "to land",
}

GROUND_STATION: Final = 6
NO_AUTOPILOT: Final = 8
ARDUPILOT: Final = 3
PX4: Final = 12

AUTOPILOTS: Final[Mapping[int, str]] = {0: "generic", ARDUPILOT: "ArduPilot", PX4: "PX4"}
"""MAV_AUTOPILOT."""

ROVERS: Final = frozenset({10, 11})
"""MAV_TYPEs on the ground or on the water."""

COPTERS: Final = frozenset({2, 3, 4, 13, 14, 15, 29, 35})
"""MAV_TYPEs that hover."""

TYPES: Final[Mapping[int, str]] = {
    1: "plane",
    2: "copter",
    3: "copter",
    4: "helicopter",
    10: "rover",
    11: "boat",
    12: "submarine",
    13: "copter",
    14: "copter",
    15: "copter",
    29: "copter",
    35: "copter",
}
"""MAV_TYPE."""

ARMED: Final = 128
"""The bit of a base mode that says that it is armed."""

CUSTOM_MODE: Final = 1
"""The bit of a base mode that says that the custom mode counts."""


def mission_result(code: int) -> str:
    """What a MAV_MISSION_RESULT means.

    >>> mission_result(10), mission_result(99)
    ('x is invalid', 'result 99')
    """
    return MISSION_RESULTS.get(code, f"result {code}")


def command_result(code: int) -> str:
    """What a MAV_RESULT means.

    >>> command_result(4)
    'failed'
    """
    return COMMAND_RESULTS.get(code, f"result {code}")
