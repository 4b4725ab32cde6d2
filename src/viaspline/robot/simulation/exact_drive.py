"""The simulated drive of a robot that follows its path exactly."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.logbook import Logbook
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.range_sensor import RangeSensor
from viaspline.robot.run import Event
from viaspline.robot.simulation.contact import first_contact
from viaspline.robot.simulation.driven_motion import DrivenMotion
from viaspline.robot.simulation.driven_step import DrivenStep, StepWatcher, unwatched
from viaspline.robot.simulation.machine_drive import Tell
from viaspline.robot.simulation.pace import Pace, by_work, seconds_from, steps_taken
from viaspline.robot.simulation.sensors import senses_of
from viaspline.robot.simulation.stepped_over import Stood, steps_over, stood_on
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World

MAX_QUIET_STEPS = 1000
"""Steps in which nothing changes that are looked at together."""


@dataclass(frozen=True)
class ExactDrive:
    """A drive that is over.

    Attributes:
        nav: The navigator at its end.
        book: What happened.
        trajectories: Each time law that was driven and when its part began [s]; its distances are
            along all of the drive.
        ticks: Steps of the drive.
        end: When it ended [s].
        touched: The contact that ended it.
        overdue: Why it was broken off.
    """

    nav: Navigator
    book: Logbook
    trajectories: tuple[tuple[float, Trajectory], ...]
    ticks: int
    end: float
    touched: Event | None
    overdue: str | None


def drive_exactly(
    nav: Navigator,
    world: World,
    step: float,
    seed: int,
    tell: Tell,
    limit: float,
    pace: Pace = by_work,
    watch: StepWatcher = unwatched,
) -> ExactDrive:
    """Drive until the navigator has finished; the robot is always where it should be.

    Args:
        nav: At the start.
        world: Everything that is there.
        step: From one look and one command to the next [s].
        seed: Of the lidar's noise.
        tell: Called with the time and the navigator at every step that is not left out.
        limit: The drive is broken off at this time [s].
        pace: How long a search keeps the robot from looking again.
        watch: Called with every step that is not left out.
    """
    senses = senses_of(nav.mission, world, seed)
    sensor = senses.standing
    book, last = Logbook(), None
    trajectories: list[tuple[float, Trajectory]] = []
    stood: Stood | None = None
    known: frozenset[Obstacle] = frozenset()
    tick = 0
    touched = _contact(nav, world, np.zeros(1))
    while touched is None:
        time = tick * step
        state = nav.reference(time)
        sensed = senses.at(state.position, state.heading, tick, time)
        if not isinstance(sensed, Scan):
            known = known.union(one for one in sensed if isinstance(one, Obstacle))
        command, nav = nav.step(state, sensed, time)
        book.note(nav)
        watch(DrivenStep(time, state, sensed, command, nav))
        if nav.trajectory is not last:
            last = nav.trajectory
            trajectories.append((time, last.moved(nav.driven)))
        tell(time, nav)
        if nav.finished:
            end = nav.trajectory.end_time
            return ExactDrive(nav, book, tuple(trajectories), tick, end, None, None)
        if time > limit:
            reason = f"the drive was broken off after {time:.0f} s, its limit"
            return ExactDrive(nav, book, tuple(trajectories), tick, time, None, reason)
        steady = senses.lidar is None and senses.moving is None and not nav.searches
        skipped = _quiet(nav, sensor, known, tick, step) if steady else 1
        skipped = max(skipped, steps_taken(seconds_from(pace, nav), step))
        touched = _contact(nav, world, step * np.arange(tick, tick + skipped + 1, dtype=float))
        tick += skipped
        if touched is None:
            stood = stood_on(stood, nav, senses, tick * step)
            tick += steps_over(stood, nav, tick, step)
    return ExactDrive(nav, book, tuple(trajectories), tick, touched.time, touched, None)


def _quiet(
    nav: Navigator, sensor: RangeSensor | None, known: frozenset[Obstacle], tick: int, step: float
) -> int:
    """Number of steps until the next one that can change anything.

    The robot follows exactly, so a step in which the sensor shows nothing new and the drive is
    not over gives the same navigator whether it is made or left out.
    """
    to_end = int(np.ceil((nav.quiet_until - tick * step) / step))
    most = min(max(to_end, 1), MAX_QUIET_STEPS)
    if sensor is None:
        return most
    times = step * np.arange(tick + 1, tick + most + 1)
    places = np.asarray(nav.path.at_distance(nav.trajectory.distance_at(times)))
    first = sensor.first_sight(places, known)
    return most if first is None else first + 1


def _contact(nav: Navigator, world: World, times: Floats) -> Event | None:
    """The first touch of the body while it follows its path over some times [s]."""
    radius = nav.mission.robot.outer_radius
    distances = np.asarray(nav.trajectory.distance_at(times))
    gaps = world.distance(nav.path.at_distance(distances)) - radius
    steps = np.diff(distances, prepend=distances[0])
    for k in np.flatnonzero(gaps <= steps).tolist():
        fine = np.linspace(times[max(k - 1, 0)], times[k], 33)
        u = np.asarray(nav.path.parameter(nav.trajectory.distance_at(fine)))
        places, headings = np.asarray(nav.path.evaluate(u)), np.asarray(nav.path.heading(u))
        still = np.zeros(len(fine))
        motion = DrivenMotion(fine, places[:, :2], headings, still, still, 1.0).with_turns()
        rows = np.column_stack((motion.times, motion.places, motion.headings))
        contact = first_contact(nav.mission.robot, world, rows)
        if contact is not None:
            where = tuple(places[int(fine.searchsorted(contact.time))].tolist())
            return replace(contact, at=where)
    return None
