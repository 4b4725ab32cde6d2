"""Where the robots of a fleet lose time to each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.kernels.arrays import Floats


@dataclass(frozen=True, eq=False)
class LostTimes:
    """How much longer robots take than if they were alone, at the nodes of their courses.

    Attributes:
        standing: At a node, beyond the time that the robot has to stand there [s], (nodes,).
        driving: In the cell that begins at a node [s], (nodes,); less than 0 where a robot makes
            up for it; 0 at a last node.
    """

    standing: Floats
    driving: Floats

    @property
    def all(self) -> Floats:
        """Standing and driving together, where time is lost [s], (nodes,)."""
        return np.maximum(self.standing + self.driving, 0.0)


def lost_times(plan: FleetPlan) -> LostTimes:
    """What each robot of a fleet loses at each node and in each cell of its course.

    Args:
        plan: Of the fleet. What it doesn't serve loses nothing.

    Example:
        >>> from viaspline.fleet.plan_fleet import plan_fleet
        >>> from viaspline.mission.fleet.fleet import Fleet, FleetMember
        >>> from viaspline.mission.model import Mission
        >>> mission = lambda start, goal: Mission.model_validate(
        ...     {"route": {"start": start, "goal": goal}})
        >>> a, b = mission((0, 0), (40, 0)), mission((20, -20), (20, 20))
        >>> plan = plan_fleet(Fleet.of([FleetMember("a", a), FleetMember("b", b)], 1.0))
        >>> lost = lost_times(plan)
        >>> (waiting,) = [one.waits_s for one in plan.precedences]
        >>> bool(lost.all.sum() >= waiting > 0.0)
        True
    """
    first = plan.courses.packed.first
    ends = first[1:] - 1
    laws, alone = plan.laws.packed, plan.alone_laws.packed
    with np.errstate(invalid="ignore"):
        standing = (laws.leave - laws.arrive) - (alone.leave - alone.arrive)
        driving = np.append(laws.arrive[1:] - laws.leave[:-1], 0.0)
        driving -= np.append(alone.arrive[1:] - alone.leave[:-1], 0.0)
    starts = first[:-1]
    standing[starts] = laws.leave[starts] - alone.leave[starts]
    standing[ends] = driving[ends] = 0.0
    timed = np.repeat(laws.is_timed, np.diff(first))
    return LostTimes(np.where(timed, standing, 0.0), np.where(timed, driving, 0.0))
