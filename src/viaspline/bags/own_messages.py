"""The messages of viaspline's own, which hold exactly what a navigator was given and decided.

Messages of ROS keep ranges in single precision and leave out what an obstacle is; a drive is
replayed from these.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from viaspline.ros_messages.message_book import MessageBook
from viaspline.ros_messages.message_definitions import DEFINITIONS

STEP: Final = "viaspline_msgs/msg/Step"
TOLD: Final = "viaspline_msgs/msg/ToldObstacle"
STEP_TOPIC: Final = "/viaspline/step"
TOLD_TOPIC: Final = "/viaspline/obstacles"

OWN_DEFINITIONS: Mapping[str, str] = MappingProxyType(
    {
        TOLD: "uint32 number\nstring obstacle",  # JSON, as of a mission
        "viaspline_msgs/msg/Moving": (
            "uint32 index\nuint32 number\nfloat64[3] frame\nfloat64[2] velocity"
        ),
        "viaspline_msgs/msg/ExactScan": (
            "float64[] position\nfloat64 heading\nfloat64 angle_min\nfloat64 angle_increment\n"
            "float64 range_max\nfloat64[] ranges\nfloat64[<=1] stamp"
        ),
        "viaspline_msgs/msg/Command": (
            "float64 speed\nfloat64 acceleration\nfloat64 curvature\nfloat64 yaw_rate\n"
            "float64[] position\nfloat64 heading\nfloat64 distance\nbool stopped\nbool finished\n"
            "float64[2] velocity\nstring[] actuator_names\nfloat64[] actuators"
        ),
        "viaspline_msgs/msg/Event": (
            "string kind\nfloat64 time\nfloat64[] at\nstring message\nstring data"  # JSON
        ),
        STEP: (
            "float64 time\nfloat64[] position\nfloat64 heading\nfloat64 speed\n"
            "float64 speed_across\nfloat64[<=1] stamp\nviaspline_msgs/ExactScan[<=1] scan\n"
            "uint32[] told\n"
            "viaspline_msgs/Moving[] moving\nviaspline_msgs/Command command\n"
            "viaspline_msgs/Event[] events\nfloat64 path_length\nfloat64 end_time"
        ),
    }
)
"""The fields of each type, by its full name."""


def bag_book() -> MessageBook:
    """The types of a bag: those of ROS, and viaspline's own.

    >>> STEP in bag_book()
    True
    """
    return MessageBook({**DEFINITIONS, **OWN_DEFINITIONS})
