"""The simulator: the whole world, a sensor, a navigator, and a robot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viaspline.curve.certificate import certify
from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import Plan
from viaspline.robot.driven import Sensed, drive_machine
from viaspline.robot.driven_run import run_of
from viaspline.robot.navigator import Navigator
from viaspline.robot.outcome import outcome
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.perception.range_sensor import RangeSensor
from viaspline.robot.run import Event, Run
from viaspline.trajectory.limits import REACTION_S
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World

Progress = Callable[[float, float, float], None]

PATIENCE = 10.0  # times the planned duration, and
GRACE = 600.0  # this much longer [s]: then the drive is broken off
BLOCK = 1000  # steps that are looked at together


@dataclass(frozen=True)
class _Drive:
    """A drive that is over: its navigator, its time laws with their beginnings, and its end."""

    nav: Navigator
    trajectories: tuple[tuple[float, Trajectory], ...]
    ticks: int
    end: float
    touched: Event | None
    overdue: str | None


def simulate(
    mission: Mission,
    *,
    seed: int = 0,
    step: float = 0.05,
    progress: Progress | None = None,
    plan: Plan | None = None,
) -> Run:
    """Drive a mission in the world as it is, with what is not on the map.

    A robot without a drive follows its path exactly. One with a drive, or with a localisation that
    is not exact, is commanded by the navigator and moves as its machine does, with its delay, its
    limits and its noise: then ``Run.path`` is the way that it really took, its certificate that of
    the driven body, and ``Run.tracking`` what it was off.

    The same mission gives the same run, bit by bit. A drive takes at most ten times its planned
    duration and ten minutes; then it is broken off, with that as its reason.

    Args:
        mission: What to do.
        seed: Of all that is random: the noise of a lidar, of the drive and of the localisation.
        step: Time between two looks of the sensor [s].
        progress: Called with the time [s], the distance driven and the length of the path [m].
        plan: The mission's plan, if there is one already.

    Returns:
        What was driven, whether the robot reached its goal or not: see ``Run.reached``.

    Raises:
        NoPathError: When there is no path at all.
        GeometryError: When the step is not above 0, the sensor sees no farther than the robot's
            body, or a robot with a drive is sent on a route with heights.

    Example:
        >>> run = simulate(Mission.model_validate({
        ...     "world": {"unseen": [{"circle": {"center": [25, 1], "radius": 2}}]},
        ...     "robot": {"sensor": {"range_m": 10}},
        ...     "route": {"start": [0, 0], "goal": [50, 0]},
        ... }))
        >>> run.reached, run.certificate.holds, len(run.replans)
        (True, True, 1)
    """
    if not 0.0 < step < float("inf"):
        raise GeometryError(f"step is {step}; give a time above 0 s")
    world = World.everything(mission)
    nav = Navigator(mission, plan, reaction=max(step, REACTION_S), period=step)
    if nav.controller is not None:
        return _run_of_machine(nav, world, step, progress, seed)
    drive = _drive(nav, world, step, progress, seed)
    return _run(drive, world, step)


def _named_unseen(mission: Mission, world: World) -> tuple[Obstacle, ...]:
    """The unseen obstacles, each with the name that it has in the whole world."""
    first = len(mission.world.known)
    return tuple(
        obstacle.model_copy(update={"name": world.name(first + i)})
        for i, obstacle in enumerate(mission.world.unseen)
    )


def _sensors(
    mission: Mission, world: World, seed: int
) -> tuple[LidarSensor | None, RangeSensor | None]:
    """The sensor that the robot has."""
    sensor = mission.robot.sensor
    if sensor is None:
        return None, None
    if sensor.lidar is not None:
        return LidarSensor(world.obstacles, sensor.lidar, seed), None
    return None, RangeSensor(_named_unseen(mission, world), sensor.reach)


def _drive(
    nav: Navigator, world: World, step: float, progress: Progress | None, seed: int
) -> _Drive:
    lidar, sensor = _sensors(nav.mission, world, seed)
    limit = PATIENCE * nav.plan.trajectory.duration + GRACE
    trajectories: list[tuple[float, Trajectory]] = []
    known: frozenset[Obstacle] = frozenset()
    tick = 0
    touched = _contact(nav, world, np.zeros(1))
    while touched is None:
        time = tick * step
        state = nav.reference(time)
        if lidar is not None:
            _, nav = nav.step(state, lidar.scan(state.position, state.heading, tick), time)
        else:
            sensed = () if sensor is None else sensor.seen(state.position)
            known = known.union(sensed)
            _, nav = nav.step(state, sensed, time)
        if not trajectories or nav.trajectory is not trajectories[-1][1]:
            trajectories.append((time, nav.trajectory))
        if progress is not None:
            progress(time, nav.distance, nav.path.length)
        if nav.finished:
            return _Drive(nav, tuple(trajectories), tick, nav.trajectory.end_time, None, None)
        if time > limit:
            reason = f"the drive was broken off after {time:.0f} s, its limit"
            return _Drive(nav, tuple(trajectories), tick, time, None, reason)
        skipped = 1 if lidar is not None else _quiet(nav, sensor, known, tick, step)
        touched = _contact(nav, world, step * np.arange(tick, tick + skipped + 1, dtype=float))
        tick += skipped
    return _Drive(nav, tuple(trajectories), tick, touched.time, touched, None)


def _quiet(
    nav: Navigator, sensor: RangeSensor | None, known: frozenset[Obstacle], tick: int, step: float
) -> int:
    """Number of steps until the next one that can change anything.

    The robot follows exactly, so a step in which the sensor shows nothing new and the drive is
    not over gives the same navigator whether it is made or left out.
    """
    to_end = int(np.ceil((nav.trajectory.end_time - tick * step) / step))
    most = min(max(to_end, 1), BLOCK)
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
        places = np.asarray(nav.path.at_distance(nav.trajectory.distance_at(fine)))
        depths, nearest = world.nearest(places)
        inside = np.flatnonzero(depths < radius - 1e-9)
        if inside.size:
            i = int(inside[0])
            name = world.name(int(nearest[i]))
            where = tuple(places[i].tolist())
            return Event("contact", float(fine[i]), where, f"touches '{name}'", {"name": name})
    return None


def _run_of_machine(
    nav: Navigator, world: World, step: float, progress: Progress | None, seed: int
) -> Run:
    lidar, sensor = _sensors(nav.mission, world, seed)

    def sense(place: tuple[float, float], heading: float, tick: int) -> Sensed:
        if lidar is not None:
            return lidar.scan(place, heading, tick)
        return () if sensor is None else sensor.seen(place)

    def tell(time: float, nav: Navigator) -> None:
        if progress is not None:
            progress(time, nav.distance, nav.path.length)

    limit = PATIENCE * nav.plan.trajectory.duration + GRACE
    drive = drive_machine(nav, world, step, seed, sense, tell, limit)
    return run_of(drive, world, step)


def _run(drive: _Drive, world: World, step: float) -> Run:
    nav = drive.nav
    reason, events, visits = outcome(nav, drive.end, drive.touched, drive.overdue)
    times = _sample_times(drive, step, events)
    distances, speeds = _along(drive.trajectories, times)
    path = driven(nav.path, float(distances[-1]))
    u = np.asarray(path.parameter(np.minimum(distances, path.length)))
    robot = nav.mission.robot
    return Run(
        plan=nav.plan,
        world=world,
        reached=nav.reached and reason is None,
        reason=reason,
        duration=drive.end,
        path=path,
        certificate=certify(path, world, robot.clearance_m, radius=robot.outer_radius),
        times=times,
        positions=np.asarray(path.evaluate(u)),
        headings=np.asarray(path.heading(u)),
        speeds=speeds,
        curvatures=np.asarray(path.curvature(u)),
        visits=visits,
        events=events,
        replans=nav.replans,
        compute_times=nav.compute_times,
        known=nav.world,
    )


def _sample_times(drive: _Drive, step: float, events: tuple[Event, ...]) -> Floats:
    """Every step and every event, up to the end."""
    ticks = step * np.arange(drive.ticks + 1)
    times = np.concatenate((ticks, [event.time for event in events], [drive.end]))
    return np.unique(times[times <= drive.end])


def _along(
    trajectories: tuple[tuple[float, Trajectory], ...], times: Floats
) -> tuple[Floats, Floats]:
    """Distances [m] and speeds [m/s] at times; each law holds from its beginning to the next."""
    distances, speeds = np.zeros(times.shape), np.zeros(times.shape)
    for begin, trajectory in trajectories:
        later = times >= begin
        distances[later], speeds[later], _ = trajectory.state_at(times[later])
    return distances, speeds


def driven(path: Path, distance: float) -> Path:
    """The exact beginning of a path, with the via points that lie on it."""
    u = float(path.parameter(min(distance, path.length)))
    if u <= 0.0:
        return Path(np.repeat(path.spans[:1, :1], 4, axis=1), path.vias[:1])
    spans = path.section(0.0, u).spans
    return Path(spans, [via for via in path.vias if via.u <= u])
