"""What was found out while the paths of a fleet were laid, for the next time that it is asked for.

While one robot's route is changed by hand, the paths of the others stay what they were.

Tested through ``fleet/laying/test_laid_again``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from viaspline.fleet.laying.lay_among_rests import LaidPath, lay_among_rests
from viaspline.fleet.laying.resting_places import RestingPlaces
from viaspline.fleet.not_served import NotServed
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.model import Mission
from viaspline.planner import Plan
from viaspline.world.world import World


@dataclass(frozen=True, eq=False)
class PathAlone:
    """What a robot does if it is alone.

    Attributes:
        mission: Its via points in the order in which they are served.
        plan: Of that.
    """

    mission: Mission
    plan: Plan


@dataclass(frozen=True, eq=False)
class KeptPaths:
    """What was found out of a fleet.

    Attributes:
        asked: The mission of each robot as it was asked for, by name.
        worlds: The worlds that were packed, each with a mission that has it.
        alone: The path of each robot as if it were alone, or why there is none, by name.
        rests: Where robots rest.
        laid: The path of each robot among these, by name.
    """

    asked: Mapping[str, Mission]
    worlds: tuple[tuple[Mission, World], ...]
    alone: Mapping[str, PathAlone | NotServed]
    rests: RestingPlaces
    laid: Mapping[str, LaidPath]

    def alone_of(self, member: FleetMember) -> PathAlone | NotServed | None:
        """The path of a robot as if it were alone, if the same was asked for; else None."""
        asked = self.asked.get(member.name)
        if asked is None or not _is_same(asked, member.mission):
            return None
        return self.alone[member.name]

    def laid_of(self, name: str, alone: PathAlone, reach: float, rests: RestingPlaces) -> LaidPath:
        """The path of a robot among resting places: the very one that it had, if it is the same.

        Args:
            name: The robot.
            alone: Its path as if it were alone.
            reach: How far it keeps others away on its part [m].
            rests: Of all robots.

        Raises:
            PlanningError: When there is no path round robots that can't leave.
        """
        known = self.laid.get(name) if self.alone.get(name) is alone else None
        if known is not None and rests.places == self.rests.places:
            return known
        found = lay_among_rests(alone.plan, alone.mission, name, reach, rests)
        if known is None or not np.array_equal(found.plan.path.spans, known.plan.path.spans):
            return found
        return LaidPath(known.plan, found.passed)


def _is_same(one: Mission, other: Mission) -> bool:
    """Whether two missions ask for the same; parts that are shared aren't looked into."""
    parts = ((getattr(one, key), getattr(other, key)) for key in ("route", "robot", "spline"))
    pairs = (*parts, (one.world, other.world))  # worlds are large: they come last
    return all(a is b or a == b for a, b in pairs)
