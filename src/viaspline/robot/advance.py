"""How far along its path the robot has come, and what happened on the way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.curve.path import PathVia
from viaspline.kernels.tracking.control_law import CROSS_TRACK
from viaspline.robot.controller import Controller
from viaspline.robot.journey import SAME_PLACE_M, Dwell, NavigationState, trajectory_on
from viaspline.robot.run import Event, Visit
from viaspline.robot.state import RobotState

ON_PATH = 1e-6  # nearer than this the measured state is the planned one [m]
DRIFT = 0.05  # farther than this from where it should be along the path, a new time law [m]


def advance(journey: NavigationState, state: RobotState, time: float) -> NavigationState:
    """The journey at a later time, with the robot as measured.

    Progress is a distance along the path. It is looked for near the place where the time law has
    the robot, and never goes back, so a path that crosses or repeats itself makes no difference.
    """
    if journey.controller is not None:
        return _piloted(journey, journey.controller, state, time)
    should, speed, _ = (float(x) for x in journey.trajectory.state_at(time))
    here = np.asarray(journey.path.at_distance(should))
    off = float(np.linalg.norm(np.asarray(state.position) - here))
    if off <= ON_PATH:
        return happened(
            replace(journey, time=time, distance=max(should, journey.distance), off=0.0)
        )
    low = journey.distance
    high = min(should + max(1.0, 2.0 * off), journey.trajectory.next_rest(max(should, low)))
    distance, off = project(journey, state.position, low, max(high, low))
    journey = replace(journey, time=time, distance=distance, off=off)
    if abs(distance - should) > DRIFT and journey.giving_up is None:
        journey = happened(journey)
        speed = min(state.speed, float(journey.trajectory.speed_at(distance)))
        trajectory = trajectory_on(journey, speed=speed, time=time)
        return replace(journey, trajectory=trajectory)
    return happened(replace(journey, distance=max(should, low)))


def _piloted(
    journey: NavigationState, controller: Controller, state: RobotState, time: float
) -> NavigationState:
    """The journey of a robot with a drive: its law waits for it where it is too far behind."""
    controller = controller.on(journey.path, journey.trajectory).step(state, time)
    trajectory = (
        journey.trajectory
        if controller.late <= 0.0
        else journey.trajectory.delayed(controller.late)
    )
    now = time + controller.ahead
    distance = max(float(trajectory.distance_at(now)), journey.distance)
    off = abs(float(controller.note[CROSS_TRACK]))
    return happened(
        replace(
            journey,
            controller=controller,
            trajectory=trajectory,
            time=now,
            distance=distance,
            off=off,
        )
    )


def commanded(
    before: NavigationState, journey: NavigationState, state: RobotState, time: float
) -> NavigationState:
    """The journey when its pilot has decided, by the path and the law that there are now."""
    if journey.controller is None or before.controller is None:
        return journey
    controller = journey.controller
    if journey.path is not controller.path or journey.trajectory is not controller.trajectory:
        waited = controller.late > 0.0
        controller = before.controller.on(journey.path, journey.trajectory).step(state, time)
        if controller.late > 0.0 and not waited:
            journey = replace(journey, trajectory=journey.trajectory.delayed(controller.late))
    return replace(journey, controller=controller.gave(time))


def project(
    journey: NavigationState, position: tuple[float, ...], low: float, high: float
) -> tuple[float, float]:
    """The nearest place of the path between two distances, and how far it is away [m]."""
    point = np.asarray(position)
    while True:
        places = np.linspace(low, high, 33)
        gaps = np.linalg.norm(np.asarray(journey.path.at_distance(places)) - point, axis=1)
        k = int(gaps.argmin())
        if high - low <= SAME_PLACE_M:
            return float(places[k]), float(gaps[k])
        low, high = float(places[max(k - 1, 0)]), float(places[min(k + 1, 32)])


def happened(journey: NavigationState) -> NavigationState:
    """Note every via point that was passed, every stay that is over, and the end of the drive."""
    journey = _stay(journey)
    while journey.ahead and journey.dwell is None:
        via, distance = journey.ahead[0]
        if journey.distance < distance - SAME_PLACE_M:
            break
        journey = _stay(_pass(journey, via, distance))
    return _end(journey)


def _stay(journey: NavigationState) -> NavigationState:
    stay = journey.dwell
    if stay is None or journey.time < stay.until:
        return journey
    leaves = Event("dwell", stay.until, stay.at, f"the stay at '{stay.name}' is over")
    return replace(journey.noted(leaves), dwell=None)


def _pass(journey: NavigationState, via: PathVia, distance: float) -> NavigationState:
    assert via.index is not None
    if journey.trajectory.distances[0] <= distance:
        time = min(float(journey.trajectory.time_at(distance)), journey.time)
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


def _end(journey: NavigationState) -> NavigationState:
    end = float(journey.trajectory.distances[-1])
    over = journey.time >= journey.trajectory.end_time and journey.distance >= end - SAME_PLACE_M
    waits = journey.giving_up is None and end < journey.path.length - SAME_PLACE_M
    if journey.finished or journey.dwell is not None or waits or not over:
        return journey
    time, where = journey.trajectory.end_time, journey.place(end)
    if journey.giving_up is not None:
        journey = journey.noted(Event("stopped", time, where, f"stands: {journey.giving_up}"))
    else:
        journey = journey.noted(Event("reached", time, where, f"is at {_goal(journey)}"))
    return replace(journey, finished=True)


def _goal(journey: NavigationState) -> str:
    if journey.mission.route.closed:
        return "its start again"
    return f"'{journey.path.vias[-1].name}'" if journey.path.vias else "its goal"
