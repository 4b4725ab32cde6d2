"""What a robot makes of a scan: it goes on inside of what it has seen, round what is in its way.

Two things keep it safe, and neither waits for the other. The time law ends, at rest, where the
robot is not certain to be free any more: so it stops in time even if there is no way on. And where
the path ahead comes too close to what has been seen, far away or near, a new one is sought.
"""

from __future__ import annotations

import time as clock
from dataclasses import replace

import numpy as np

from viaspline.detour.fit import CLEAR, too_close
from viaspline.errors import GeometryError
from viaspline.robot.journey import SLIP, Journey, Wait, time_law
from viaspline.robot.lidar import Scan
from viaspline.robot.records import give_up, take
from viaspline.robot.reroute import Answer, answer
from viaspline.robot.run import Event
from viaspline.robot.scene import Scene, free_until, scene_of, speed_now
from viaspline.trajectory.retime import braking

SPARE = 0.1
"""What a new path keeps beyond what is required where there is room for it, of that distance: so
that what shows a little more of itself later does not block it again."""

AGAIN = 0.5  # after it has found no way, a robot tries again so much later [s]
PATIENCE = 5.0  # and gives up if it has stood so long without one [s]
STARE = 0.5  # a robot that stands and sees nothing in its way trusts its next step then [s]


def look(journey: Journey, scan: Scan) -> Journey:
    """The journey of a robot with one more scan."""
    assert journey.belief is not None
    belief, _ = journey.belief.with_scan(scan)
    journey = replace(journey, belief=belief, world=belief.world)
    if journey.finished or journey.giving_up is not None:
        return journey
    speed = speed_now(journey)
    free = free_until(journey, journey.world, journey.floor)
    if free is not None:
        journey = _round(replace(journey, dared=0.0), free)
    elif journey.wait is not None and journey.wait.reason is not None:
        journey = replace(journey, wait=None)
    if journey.giving_up is not None:
        return journey
    return _within_sight(journey, speed)


def _round(journey: Journey, free: float) -> Journey:
    """Round what the path comes too close to, if it isn't just been tried in vain."""
    wait = journey.wait
    if wait is not None and wait.reason is not None and journey.time < wait.again:
        return journey
    began = clock.perf_counter()
    scene, found = _answer(journey, free)
    if found.choice is not None:
        journey = take(scene, found.choice, found.skip)
        journey = replace(journey, floor=scene.floor, wait=None)
    else:
        journey = _hold(journey, scene, found.reason)
    spent = clock.perf_counter() - began
    return replace(journey, compute_times=(*journey.compute_times, spent))


def _answer(journey: Journey, free: float) -> tuple[Scene, Answer]:
    """A way on that keeps something to spare; if there is none, one that keeps what it must.

    A robot that has come too close already leaves at the distance that it has.
    """
    names, journey = _detected(journey)
    brief = journey.brief
    world = journey.world
    floor = brief.required
    scene = scene_of(replace(journey, floor=floor), world, names, free, brief)
    room = float(world.distance(journey.path.at_distance(scene.stop)))
    if room < floor:
        eased = replace(brief, clearance=room - 1e-3 - brief.radius)
        scene = replace(scene, brief=eased, floor=eased.required)
        return scene, answer(scene, world)
    spared = replace(brief, clearance=brief.clearance + SPARE * brief.required)
    found = answer(replace(scene, brief=spared), world)
    if found.choice is None:
        found = answer(scene, world)
    return scene, found


def _detected(journey: Journey) -> tuple[tuple[str, ...], Journey]:
    """Names of what is in the way, one for each cluster of it, and the journey with its events."""
    path, world = journey.path, journey.world
    u = float(path.parameter(journey.distance))
    close = too_close(world, path.section(u, path.domain[1]).spans, journey.floor)
    here = journey.place(journey.distance)
    names: list[str] = []
    events: list[Event] = []
    last = np.full(2, np.inf)
    for index in dict.fromkeys(close[close != CLEAR].tolist()):
        circle = world.obstacles[index].circle if index >= 0 else None
        place = np.full(2, np.nan) if circle is None else np.asarray(circle.center)
        if np.hypot(*(place - last)) < 2.0 * journey.brief.required:
            continue
        last, name = place, world.name(index)
        gap = float(world.distances_to(index, here)) if index >= 0 else 0.0
        message = f"sees '{name}' {gap:.1f} m away"
        names.append(name)
        events.append(Event("detected", journey.time, here, message, {"name": name}))
    return tuple(names), journey.noted(*events)


def _hold(journey: Journey, scene: Scene, reason: str) -> Journey:
    """Stay on the path as far as it is clear; give up after a long stand."""
    since = journey.time if journey.wait is None else journey.wait.since
    if journey.wait is None and scene.speed > 0.0:
        here = journey.place(journey.distance)
        journey = journey.noted(Event("braked", journey.time, here, f"brakes: {reason}"))
    if scene.speed > 0.0:
        since = journey.time
    if journey.time - since >= PATIENCE:
        return give_up(journey, scene.speed, reason)
    return replace(journey, wait=Wait(since, journey.time + AGAIN, reason))


def _within_sight(journey: Journey, speed: float) -> Journey:
    """The time law that ends where the robot is not certain to be free any more."""
    distance = journey.distance
    try:
        law = time_law(
            journey, journey.path, journey.turns,
            distance=distance, speed=speed, time=journey.time,
        )  # fmt: skip
    except GeometryError:
        law = braking(distance, speed, journey.limits.max_accel, journey.time)
    journey = replace(journey, law=law)
    end = float(law.distances[-1])
    stands = speed == 0.0 and end <= distance + SLIP and distance < journey.path.length - SLIP
    if not stands or (journey.wait is not None and journey.wait.reason is not None):
        return journey if stands else _unless_blind(journey)
    if journey.dwell is not None:
        return journey
    return _stare(journey)


def _unless_blind(journey: Journey) -> Journey:
    blind = journey.wait is not None and journey.wait.reason is None
    return replace(journey, wait=None) if blind else journey


def _stare(journey: Journey) -> Journey:
    """A robot that has seen nothing in its way for a while trusts that it can take a step."""
    wait = journey.wait or Wait(journey.time, journey.time + STARE)
    if journey.time < wait.again:
        return replace(journey, wait=wait)
    assert journey.belief is not None
    dared = min(journey.distance + journey.belief.echoes.grain, journey.path.length)
    return replace(journey, dared=dared, wait=None)
