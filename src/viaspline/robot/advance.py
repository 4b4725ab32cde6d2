"""How far along its path the robot has come, and what happened on the way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.curve.path import PathVia
from viaspline.kernels.tracking.control_law import ASIDE
from viaspline.robot.controller import Pilot
from viaspline.robot.journey import SLIP, Dwell, Journey, law_on
from viaspline.robot.run import Event, Visit
from viaspline.robot.state import RobotState

ON_PATH = 1e-6  # nearer than this the measured state is the planned one [m]
DRIFT = 0.05  # farther than this from where it should be along the path, a new time law [m]


def advance(journey: Journey, state: RobotState, time: float) -> Journey:
    """The journey at a later time, with the robot as measured.

    Progress is a distance along the path. It is looked for near the place where the time law has
    the robot, and never goes back, so a path that crosses or repeats itself makes no difference.
    """
    if journey.pilot is not None:
        return _piloted(journey, journey.pilot, state, time)
    should, speed, _ = (float(x) for x in journey.law.state_at(time))
    here = np.asarray(journey.path.at_distance(should))
    off = float(np.linalg.norm(np.asarray(state.position) - here))
    if off <= ON_PATH:
        return happened(
            replace(journey, time=time, distance=max(should, journey.distance), off=0.0)
        )
    low = journey.distance
    high = min(should + max(1.0, 2.0 * off), journey.law.next_rest(max(should, low)))
    distance, off = project(journey, state.position, low, max(high, low))
    journey = replace(journey, time=time, distance=distance, off=off)
    if abs(distance - should) > DRIFT and journey.giving_up is None:
        journey = happened(journey)
        speed = min(state.speed, float(journey.law.speed_at(distance)))
        law = law_on(journey, speed=speed, time=time)
        return replace(journey, law=law)
    return happened(replace(journey, distance=max(should, low)))


def _piloted(journey: Journey, pilot: Pilot, state: RobotState, time: float) -> Journey:
    """The journey of a robot with a drive: its law waits for it where it is too far behind."""
    pilot = pilot.on(journey.path, journey.law).step(state, time)
    law = journey.law if pilot.late <= 0.0 else journey.law.delayed(pilot.late)
    now = time + pilot.ahead
    distance = max(float(law.distance_at(now)), journey.distance)
    off = abs(float(pilot.note[ASIDE]))
    return happened(replace(journey, pilot=pilot, law=law, time=now, distance=distance, off=off))


def commanded(before: Journey, journey: Journey, state: RobotState, time: float) -> Journey:
    """The journey when its pilot has decided, by the path and the law that there are now."""
    if journey.pilot is None or before.pilot is None:
        return journey
    pilot = journey.pilot
    if journey.path is not pilot.path or journey.law is not pilot.trajectory:
        waited = pilot.late > 0.0
        pilot = before.pilot.on(journey.path, journey.law).step(state, time)
        if pilot.late > 0.0 and not waited:
            journey = replace(journey, law=journey.law.delayed(pilot.late))
    return replace(journey, pilot=pilot.gave(time))


def project(
    journey: Journey, position: tuple[float, ...], low: float, high: float
) -> tuple[float, float]:
    """The nearest place of the path between two distances, and how far it is away [m]."""
    point = np.asarray(position)
    while True:
        places = np.linspace(low, high, 33)
        gaps = np.linalg.norm(np.asarray(journey.path.at_distance(places)) - point, axis=1)
        k = int(gaps.argmin())
        if high - low <= SLIP:
            return float(places[k]), float(gaps[k])
        low, high = float(places[max(k - 1, 0)]), float(places[min(k + 1, 32)])


def happened(journey: Journey) -> Journey:
    """Note every via point that was passed, every stay that is over, and the end of the drive."""
    journey = _stay(journey)
    while journey.ahead and journey.dwell is None:
        via, distance = journey.ahead[0]
        if journey.distance < distance - SLIP:
            break
        journey = _stay(_pass(journey, via, distance))
    return _end(journey)


def _stay(journey: Journey) -> Journey:
    stay = journey.dwell
    if stay is None or journey.time < stay.until:
        return journey
    leaves = Event("dwell", stay.until, stay.at, f"the stay at '{stay.name}' is over")
    return replace(journey.noted(leaves), dwell=None)


def _pass(journey: Journey, via: PathVia, distance: float) -> Journey:
    assert via.index is not None
    if journey.law.distances[0] <= distance:
        time = min(float(journey.law.time_at(distance)), journey.time)
    else:
        time = journey.time
    on_curve = np.asarray(journey.path.evaluate(via.u))
    miss = float(np.linalg.norm(on_curve - np.asarray(via.at))) + journey.off
    visit = Visit(via.name, via.at, "served", time, miss)
    journey = replace(journey, last=via.index, served=(*journey.served, (via.index, visit)))
    if via.dwell > 0.0:
        stay = Dwell(via.name, via.at, time + via.dwell)
        message = f"stops at '{via.name}' for {via.dwell:g} s"
        arrived = Event("arrived", time, via.at, message, {"dwell_s": via.dwell})
        return replace(journey.noted(arrived), dwell=stay)
    if via.index > 0 and journey.ahead:
        return journey.noted(Event("via", time, via.at, f"passes '{via.name}'"))
    return journey


def _end(journey: Journey) -> Journey:
    end = float(journey.law.distances[-1])
    over = journey.time >= journey.law.end_time and journey.distance >= end - SLIP
    waits = journey.giving_up is None and end < journey.path.length - SLIP
    if journey.finished or journey.dwell is not None or waits or not over:
        return journey
    time, where = journey.law.end_time, journey.place(end)
    if journey.giving_up is not None:
        journey = journey.noted(Event("stopped", time, where, f"stands: {journey.giving_up}"))
    else:
        journey = journey.noted(Event("reached", time, where, f"is at {_goal(journey)}"))
    return replace(journey, finished=True)


def _goal(journey: Journey) -> str:
    if journey.mission.route.closed:
        return "its start again"
    return f"'{journey.path.vias[-1].name}'" if journey.path.vias else "its goal"
