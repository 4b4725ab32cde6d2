"""Robots under way for which no path was found, and among what: the same isn't sought twice.

Tested through ``fleet/execution/test_dead_robots``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.errors import NoPathError
from viaspline.fleet.laying.resting_places import RestingPlace
from viaspline.fleet.space.hover_places import HoverPlace
from viaspline.mission.route_spec import Route


@dataclass(frozen=True)
class SoughtWay:
    """What the path of a robot under way is sought by: as long as it is the same, so is the path.

    Attributes:
        route: From where the robot stands.
        around: Where others rest or hover.
        out: Those that never get on any more.
    """

    route: Route
    around: tuple[RestingPlace, ...] | tuple[HoverPlace, ...]
    out: tuple[str, ...]


@dataclass(frozen=True)
class NoWay:
    """That there is no path for a robot.

    Attributes:
        sought: By what it was sought.
        error: What is told of it.
    """

    sought: SoughtWay
    error: NoPathError
