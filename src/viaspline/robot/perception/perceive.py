"""What a robot makes of a scan: it goes on inside of what it has seen, round what is in its way.

Two things keep it safe, and neither waits for the other. The time law ends, at rest, where the
robot is not certain to be free any more: so it stops in time even if there is no way on. And where
the path ahead comes too close to what has been seen, far away or near, a new one is sought.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.robot.journey import SAME_PLACE_M, NavigationState, Wait, sighted, trajectory_on
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.replanning.replan_context import free_until, speed_now
from viaspline.robot.replanning.replan_from_scan import better, way_round

STARE = 0.5  # a robot that stands and sees nothing in its way trusts its next step then [s]


def look(journey: NavigationState, scan: Scan) -> NavigationState:
    """The journey of a robot with one more scan."""
    assert journey.belief is not None
    belief, news = journey.belief.with_scan(scan)
    journey = replace(journey, belief=belief, world=belief.world)
    if journey.finished or journey.giving_up is not None:
        return journey
    speed = speed_now(journey)
    free = free_until(journey, journey.world)
    if free is not None:
        journey = way_round(replace(journey, probed_until=0.0), free)
    else:
        journey = better(_free_again(journey), opened=news.gone > 0)
    if journey.giving_up is not None:
        return journey
    return _within_sight(journey, speed)


def _free_again(journey: NavigationState) -> NavigationState:
    blocked = journey.wait is not None and journey.wait.reason is not None
    return replace(journey, wait=None) if blocked else journey


def _within_sight(journey: NavigationState, speed: float) -> NavigationState:
    """The time law that ends where the robot is not certain to be free any more."""
    journey = sighted(journey)
    journey = replace(journey, trajectory=trajectory_on(journey, speed=speed, time=journey.time))
    distance = journey.distance
    wait = journey.wait
    if wait is not None and wait.reason is not None:
        return journey
    stuck = speed == 0.0 and float(journey.trajectory.distances[-1]) <= distance + SAME_PLACE_M
    if not stuck or journey.dwell is not None or distance >= journey.path.length - SAME_PLACE_M:
        return journey if wait is None else replace(journey, wait=None)
    return _stare(journey)


def _stare(journey: NavigationState) -> NavigationState:
    """A robot that has seen nothing in its way for a while trusts that it can take a small step.

    A sensor with a narrow field of view never shows all that the body is going to touch.
    """
    wait = journey.wait or Wait(journey.time, journey.time + STARE)
    if journey.time < wait.again:
        return replace(journey, wait=wait)
    probed_until = min(journey.distance + journey.cell_size, journey.path.length)
    return replace(journey, probed_until=probed_until, wait=None)
