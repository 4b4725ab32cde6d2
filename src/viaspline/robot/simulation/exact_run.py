"""The run of a robot that follows its path exactly: the part of it that was driven.

Tested through ``robot/test_simulator``.
"""

from __future__ import annotations

import numpy as np

from viaspline.curve.path import SEAM, Path
from viaspline.kernels.arrays import Floats
from viaspline.robot.run import Event, Run
from viaspline.robot.simulation.appearance import Appearance
from viaspline.robot.simulation.body_among_movers import movers_about
from viaspline.robot.simulation.contact import with_contacts
from viaspline.robot.simulation.driven_motion import DrivenMotion
from viaspline.robot.simulation.exact_drive import ExactDrive
from viaspline.robot.simulation.machine_run import proven
from viaspline.robot.simulation.near_misses import near_misses
from viaspline.robot.simulation.outcome import outcome
from viaspline.robot.simulation.standstills import calm_at, standstills
from viaspline.tracks.calm_moments import Stretches, kept_moments, spread_moments
from viaspline.tracks.encounters import DrivenStates, encounters, touched_by
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

ROUNDING = 1e-12
"""Part of a path's length that may be missing at its end though all of it was driven."""

MOMENTS = 10
"""At which it is looked at what the body was near to, in every step."""


def run_of_exact(drive: ExactDrive, world: World, step: float) -> Run:
    """The run of a drive that is over.

    Args:
        drive: The drive.
        world: Everything that was there.
        step: From one sample to the next [s].
    """
    nav = drive.nav
    reason, events, visits = outcome(nav, drive.book, drive.end, drive.touched, drive.overdue)
    moving = MovingObstacles.everything(nav.mission)
    whole = drive.book.path(nav)
    calm = _calm(drive, whole, moving)
    times = _sample_times(drive, step, events, calm)
    distances, speeds = _along(drive.trajectories, times)
    path = driven_part(whole, float(distances[-1]))
    u = np.asarray(path.parameter(np.minimum(distances, path.length)))
    robot = nav.mission.robot
    certificate = proven(path, world, robot)
    motion, met = None, None
    if len(moving) or not certificate.holds:  # a long drive has very many moments
        motion = _motion(drive, path, step, calm)
    near = () if motion is None or certificate.holds else near_misses(nav.mission, world, motion)
    if motion is not None and len(moving):
        appearance = Appearance(nav.mission, world, moving, motion)
        states = _states(drive, path, calm)
        radius, movers = movers_about(robot, moving, motion)
        met = encounters(states, robot, radius, movers, appearance.was_late)
        events = with_contacts(events, met, states)
    reason = reason or touched_by(met)
    return Run(
        plan=nav.plan,
        world=world,
        reached=nav.reached and reason is None,
        reason=reason,
        duration=drive.end,
        path=path,
        certificate=certificate,
        times=times,
        positions=np.asarray(path.evaluate(u)),
        headings=np.asarray(path.heading(u)),
        speeds=speeds,
        curvatures=np.asarray(path.curvature(u)),
        visits=visits,
        events=events,
        replans=drive.book.replans,
        compute_times=drive.book.compute_times,
        known=nav.world,
        moving=moving,
        encounters=met,
        shortfalls=near,
    )


def _calm(drive: ExactDrive, path: Path, moving: MovingObstacles) -> Stretches:
    """When the robot stood for long, and nothing that moves mattered."""
    robot = drive.nav.mission.robot
    calm: list[tuple[float, float]] = []
    for standstill in standstills(drive.trajectories, drive.end):
        u = np.asarray(path.parameter(min(standstill.distance, path.length)))
        place, heading = np.asarray(path.evaluate(u)), float(path.heading(u))
        calm += calm_at(standstill, robot, moving, place, heading)
    return calm


def _states(drive: ExactDrive, path: Path, calm: Stretches) -> DrivenStates:
    """Where the robot was when."""

    def state_at(times: Floats) -> tuple[Floats, Floats]:
        distances, speeds = _along(drive.trajectories, times)
        places = np.asarray(path.at_distance(np.minimum(distances, path.length)))
        return places[:, :2], speeds

    return DrivenStates(0.0, drive.end, state_at, calm)


def _motion(drive: ExactDrive, path: Path, step: float, calm: Stretches) -> DrivenMotion:
    """What was driven, moment by moment."""
    count = max(round(MOMENTS * drive.end / step), 1)
    times = spread_moments(0.0, drive.end, count, calm)
    distances, speeds = _along(drive.trajectories, times)
    u = np.asarray(path.parameter(np.minimum(distances, path.length)))
    places, headings = np.asarray(path.evaluate(u))[:, :2], np.asarray(path.heading(u))
    return DrivenMotion(times, places, headings, speeds, distances, step).with_turns()


def _sample_times(
    drive: ExactDrive, step: float, events: tuple[Event, ...], calm: Stretches
) -> Floats:
    """Every step, but few where it is calm, and every event, up to the end."""
    ticks = step * kept_moments(drive.ticks, step, calm)
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


def driven_part(path: Path, distance: float) -> Path:
    """The exact beginning of a path, with the via points that lie on it."""
    if distance >= path.length * (1.0 - ROUNDING):
        return Path(path.spans, [via for via in path.vias if via.name != SEAM])
    u = float(path.parameter(distance))
    if u <= 0.0:
        return Path(np.repeat(path.spans[:1, :1], 4, axis=1), path.vias[:1])
    spans = path.section(0.0, u).spans
    return Path(spans, [via for via in path.vias if via.u <= u])
