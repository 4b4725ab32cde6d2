"""What is asked of a fleet: robots with their missions over one world."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from viaspline.mission.model import Mission


@dataclass(frozen=True)
class FleetMember:
    """One robot of a fleet.

    Attributes:
        name: Its name in the fleet.
        mission: What it does, over the world of the fleet; ``mission.route.depart_s`` is when it
            departs.
        priority: Who has more is let pass.
        rest: What it does at its goal: ``stay`` there, or ``leave`` the world.
    """

    name: str
    mission: Mission
    priority: float = 0.0
    rest: Literal["stay", "leave"] = "stay"


@dataclass(frozen=True)
class Fleet:
    """Robots with their missions over one world.

    Attributes:
        members: In the order in which they were given.
        separation_m: Free space between any two bodies [m].
    """

    members: tuple[FleetMember, ...]
    separation_m: float
