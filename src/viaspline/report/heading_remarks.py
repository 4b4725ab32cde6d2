"""Headings that look as if they had been written in radians."""

from __future__ import annotations

import math
from typing import Final

from viaspline.mission.model import Mission

WRITTEN_TO_DEG: Final = 0.0051
"""How near to an eighth of a turn in radians a number lies that was written with two decimals."""


def heading_remarks(mission: Mission) -> list[str]:
    """A sentence for each heading of the start and the goal that is an angle in radians, likely.

    Those are the eighths of a turn, with a fraction; whoever means degrees seldom writes 1.57.

    >>> end = {"at": [9, 0], "heading_deg": 1.5708}
    >>> heading_remarks(Mission.model_validate({"route": {"start": [0, 0], "goal": end}}))
    ['the heading_deg 1.5708 of the goal looks like radians: those would be 90 degrees']
    """
    route = mission.route
    ends = (("start", route.start), ("goal", route.goal))
    return [
        f"the heading_deg {end.heading_deg:g} of the {name} looks like radians: those would be "
        f"{degrees} degrees"
        for name, end in ends
        if end is not None
        and end.heading_deg is not None
        and (degrees := _meant_deg(end.heading_deg)) is not None
    ]


def _meant_deg(written: float) -> int | None:
    """The degrees of an eighth of a turn that was written in radians; None if it wasn't one."""
    eighths = round(written / (math.pi / 4))
    is_near = abs(written - eighths * math.pi / 4) < WRITTEN_TO_DEG
    return 45 * eighths if is_near and 0 < abs(eighths) <= 8 else None
