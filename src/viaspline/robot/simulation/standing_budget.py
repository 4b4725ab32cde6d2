"""How long a robot may stand on a simulated drive where that can't be stepped over.

Tested through ``robot/simulation/test_standstills``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.errors import GaveUpError
from viaspline.robot.navigator import Navigator
from viaspline.robot.simulation.sensors import Senses, senses_of
from viaspline.robot.simulation.standstills import LongStay, calm_at, standstills, unseen_at
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

MOST_STOOD_S = 50_000.0
"""For which it is stepped through at most, by all standstills together [s]: a million steps by
the usual one, with two gigabytes of what is kept of them."""


def check_standing_time(nav: Navigator, world: World, seed: int) -> None:
    """See that the standstills of a plan can be simulated.

    Args:
        nav: At the start.
        world: What stands there, seen or not.
        seed: Of what its sensors measure.

    Raises:
        GaveUpError: They would take too long, and too much memory.
    """
    law = nav.plan.trajectory
    stays = standstills(((0.0, law),), law.end_time)
    if math.fsum(one.seconds for one in stays) <= MOST_STOOD_S:  # whatever is stepped over
        return
    senses = senses_of(nav.mission, world, seed)
    found = [(one, *_looked_at(nav, senses, one)) for one in stays]
    total = math.fsum(seconds for _, seconds, _ in found)
    if total <= MOST_STOOD_S:
        return
    longest, _, why = max(found, key=lambda one: one[1])
    named = f"{_named(nav, longest)}, {longest.seconds:g} s long,"
    raise GaveUpError(
        f"{named} can't be simulated: {why}, and by that the drive would be stepped through for "
        f"{total:g} s in which it stands",
        where=np.asarray(nav.plan.path.at_distance(longest.distance)),
        remedy=f"make it shorter, so that these are no more than {MOST_STOOD_S:g} s in all",
        tried=("stepping over the time in which the robot stands",),
    )


def _looked_at(nav: Navigator, senses: Senses, one: LongStay) -> tuple[float, str]:
    """For how long a standstill is stepped through or looked at closely [s], and why."""
    robot, path = nav.mission.robot, nav.plan.path
    if nav.controller is not None:
        return one.seconds, "a robot with a drive or a localisation is moved step by step"
    if robot.is_passive:
        return one.seconds, "under passive safety the robot looks again and again"
    u = np.asarray(path.parameter(one.distance))
    place, heading = np.asarray(path.evaluate(u)), float(path.heading(u))
    moving = MovingObstacles.everything(nav.mission)
    calms = (
        calm_at(one, robot, moving, place, heading),
        unseen_at(one, senses.all_moving, place, senses.reach),
    )
    least = min(math.fsum(end - begin for begin, end in calm) for calm in calms)
    return one.seconds - least, "something that moves is near all the while, or again and again"


def _named(nav: Navigator, one: LongStay) -> str:
    """What a standstill is in the mission."""
    law = nav.plan.trajectory
    if one.begin < law.start_time:
        return "the wait until the departure (route.depart_s)"
    at = next((stop for stop in law.stations if stop.distance == one.distance), None)
    return "a wait under way" if at is None else f"the stay at '{at.name}' (its dwell_s)"
