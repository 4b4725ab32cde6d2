"""The MAV_CMDs that matter here, by what they mean for a path over the ground.

Numbers and meanings: https://mavlink.io/en/messages/common.html

Tested through ``formats/test_qgc_plan``.
"""

from __future__ import annotations

from typing import Final

HOME_RETURN: Final = 20
UNLIMITED_LOITER: Final = 17
CHANGE_SPEED: Final = 178

WAYPOINTS: Final = frozenset({16, 82})
TAKEOFFS: Final = frozenset({22, 24, 84})
LANDINGS: Final = frozenset({21, 85})
LOITERS: Final = frozenset({17, 18, 19, 31})
DELAYS: Final = frozenset({93, 112})
PLACES: Final = WAYPOINTS | TAKEOFFS | LANDINGS | LOITERS | frozenset({94})
"""Commands that send the vehicle to their position."""

DWELLING: Final = WAYPOINTS | frozenset({19})
"""Commands whose first parameter is a time to stay [s]."""

HEADED: Final = frozenset({16, 21, 22})
"""Commands whose fourth parameter is a heading [deg]; 0 is what ArduPilot's planners fill in."""

INCLUSION_CORNER: Final = 5001
EXCLUSION_CORNER: Final = 5002
INCLUSION_CIRCLE: Final = 5003
EXCLUSION_CIRCLE: Final = 5004
LOOKS_AT: Final = frozenset({80, 195, 201})
"""Commands that turn the vehicle, or its camera, to their position."""
LOOKS_AHEAD: Final = 197
"""The command that ends that."""

FENCE_COMMANDS: Final = frozenset(range(5001, 5005))

NAMES: Final[dict[int, str]] = {
    16: "way point",
    17: "unlimited loiter",
    18: "loiter turns",
    19: "loiter for a time",
    20: "return to launch",
    21: "landing",
    22: "takeoff",
    23: "local landing",
    24: "local takeoff",
    30: "change of altitude",
    31: "loiter to altitude",
    34: "orbit",
    80: "region of interest",
    82: "spline way point",
    83: "altitude wait",
    84: "VTOL takeoff",
    85: "VTOL landing",
    92: "guided mode",
    93: "delay",
    94: "payload placing",
    112: "delay",
    113: "change of altitude",
    114: "distance condition",
    115: "heading condition",
    177: "jump",
    178: "change of speed",
    179: "change of home",
    181: "relay",
    182: "repeated relay",
    183: "servo",
    184: "repeated servo",
    189: "start of landing",
    191: "go-around",
    195: "region of interest",
    196: "region of interest at the next way point",
    197: "end of region of interest",
    200: "camera control",
    201: "region of interest",
    202: "camera setting",
    203: "camera trigger",
    205: "gimbal control",
    206: "camera trigger distance",
    207: "fence switch",
    208: "parachute",
    211: "gripper",
    214: "camera trigger interval",
    216: "sprayer",
    222: "guided limits",
    530: "camera mode",
    1000: "gimbal control",
    2000: "photograph",
    2001: "end of photographs",
    2500: "video",
    2501: "end of video",
    3000: "VTOL transition",
    5000: "fence return point",
    5001: "inclusion fence corner",
    5002: "exclusion fence corner",
    5003: "inclusion fence circle",
    5004: "exclusion fence circle",
    5100: "rally point",
}


def command_name(command: int) -> str:
    """What people call a command.

    >>> command_name(206), command_name(31010)
    ('camera trigger distance', 'MAV_CMD 31010')
    """
    return NAMES.get(command, f"MAV_CMD {command}")
