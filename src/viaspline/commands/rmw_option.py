"""The middleware of a robot's nodes: in words of ours, or as ``RMW_IMPLEMENTATION`` has it.

Tested through ``commands/test_drive_command``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import click

NAMES: Final[Mapping[str, str]] = {
    "zenoh": "zenoh",
    "dds": "dds",
    "rmw_zenoh_cpp": "zenoh",
    "rmw_cyclonedds_cpp": "dds",
    "rmw_fastrtps_cpp": "dds",
    "rmw_fastrtps_dynamic_cpp": "dds",
    "rmw_connextdds": "dds",
}
"""The two kinds, by all their names."""


class RmwName(click.ParamType[str]):
    """Either of the two, by any of its names."""

    name = "rmw"

    def convert(self, value: Any, param: Any, ctx: Any) -> str:
        """``zenoh`` or ``dds``."""
        found = NAMES.get(str(value))
        if found is None:
            self.fail(f"{value!r} isn't known; give zenoh or dds, or one of {', '.join(NAMES)}")
        return found


RMW = click.option(
    "--rmw", type=RmwName(), default="zenoh", show_default=True, metavar="zenoh|dds",
    envvar="RMW_IMPLEMENTATION", help="ROS: the middleware of the robot's nodes.",
)  # fmt: skip
