"""The run of a machine: the curve that it truly drove, and what is proven of it.

Tested through ``robot/simulation/test_machine_drive``.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viaspline.curve.certificate import Certificate, certify
from viaspline.curve.path import Path, PathVia
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.drive_motion import ROW_HEADING, ROW_TIME, ROW_X, ROW_Y
from viaspline.machine.trace import trace
from viaspline.machine.travel import travel_of
from viaspline.machine.turned_in_place import turned_in_place
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.run import Run, Visit
from viaspline.robot.simulation.appearance import Appearance
from viaspline.robot.simulation.body_among_movers import movers_about
from viaspline.robot.simulation.contact import with_contacts
from viaspline.robot.simulation.driven_motion import DrivenMotion
from viaspline.robot.simulation.machine_drive import MachineDrive
from viaspline.robot.simulation.near_misses import near_misses
from viaspline.robot.simulation.outcome import outcome
from viaspline.tracks.encounters import DrivenStates, encounters, touched_by
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

PASSING_WINDOW_M = 1.0
"""A via point is passed within so much of its place along the path [m]."""

TURN_SLACK_M = 5e-4
"""Between the poses of a body that turns where it stands no point of it moves more than twice this
[m]."""

MIN_CURVATURE_SPEED_MPS = 0.1
"""A robot that is slower has no curvature to speak of [m/s]."""


def run_of_machine(drive: MachineDrive, world: World, step: float) -> Run:
    """The run of a drive that is over.

    Args:
        drive: The drive.
        world: Everything that was there.
        step: From one sample to the next [s].
    """
    nav, rows = drive.nav, drive.rows
    robot, end = nav.mission.robot, float(drive.rows[-1, ROW_TIME])
    reason, events, visits = outcome(nav, drive.book, end, drive.touched, drive.overdue)
    path, bound, u = driven_path(drive)
    certificate = proven(path, world, robot)
    certificate = replace(certificate, clearance=certificate.clearance - bound)
    certificate = min((certificate, *_proven_in_place(drive, path, u, world)), key=_clearance)
    ticks = step * np.arange(math.floor(end / step + 1e-9) + 1)
    times = np.unique(np.concatenate((ticks, [event.time for event in events], [end])))
    times = times[times <= end]
    travel = travel_of(drive.model, rows)
    speeds = np.interp(times, rows[:, ROW_TIME], travel.speeds)
    rates = np.interp(times, rows[:, ROW_TIME], travel.turn_rates)
    headings = np.interp(times, rows[:, ROW_TIME], rows[:, ROW_HEADING])
    least = MIN_CURVATURE_SPEED_MPS
    motion = _motion(drive, step)
    near = () if certificate.holds else near_misses(nav.mission, world, motion)
    moving = MovingObstacles.everything(nav.mission)
    met = None
    if len(moving):
        appearance = Appearance(nav.mission, world, moving, motion)
        states = _states(drive, travel.speeds)
        radius, movers = movers_about(robot, moving, motion)
        met = encounters(states, robot, radius, movers, appearance.was_late)
        events = with_contacts(events, met, states)
    reason = reason or touched_by(met)
    return Run(
        plan=nav.plan,
        world=world,
        reached=nav.reached and reason is None,
        reason=reason,
        duration=end,
        path=path,
        certificate=certificate,
        times=times,
        positions=np.asarray(path.evaluate(np.interp(times, rows[:, ROW_TIME], u))),
        headings=np.remainder(headings + np.pi, 2.0 * np.pi) - np.pi,
        speeds=speeds,
        curvatures=np.where(speeds > least, rates / np.maximum(speeds, least), 0.0),
        visits=missed(drive, visits),
        events=events,
        replans=drive.book.replans,
        compute_times=drive.book.compute_times,
        known=nav.world,
        tracking=drive.tracking,
        moving=moving,
        encounters=met,
        shortfalls=near,
    )


def _states(drive: MachineDrive, speeds: Floats) -> DrivenStates:
    """Where the robot was when."""
    rows = drive.rows
    moments = rows[:, ROW_TIME]

    def state_at(times: Floats) -> tuple[Floats, Floats]:
        x, y = (np.interp(times, moments, rows[:, column]) for column in (ROW_X, ROW_Y))
        return np.column_stack((x, y)), np.abs(np.interp(times, moments, speeds))

    return DrivenStates(float(moments[0]), float(moments[-1]), state_at)


def _motion(drive: MachineDrive, step: float) -> DrivenMotion:
    """What was driven, moment by moment."""
    rows = drive.rows
    times, places = rows[:, ROW_TIME], rows[:, ROW_X : ROW_Y + 1]
    steps = np.hypot(*np.diff(places, axis=0).T)
    return DrivenMotion(
        times, places, rows[:, ROW_HEADING], travel_of(drive.model, rows).speeds,
        np.concatenate(([0.0], np.cumsum(steps))), step,
    )  # fmt: skip


def proven(path: PiecewiseCubic, world: World, robot: RobotSpec) -> Certificate:
    """The proven clearance of a robot's body along a curve."""
    if robot.footprint is None:
        return certify(path, world, robot.clearance_m, radius=robot.radius_m)
    return certify(path, world, robot.clearance_m, footprint=robot.footprint)


def _proven_in_place(
    drive: MachineDrive, path: Path, u: Floats, world: World
) -> tuple[Certificate, ...]:
    """What is proven of a body where it stood and turned: of poses that its curve doesn't have.

    Args:
        drive: The drive.
        path: Its curve.
        u: Its parameter at every row.
        world: Everything that was there.

    Returns:
        None for a disc, and where it never stood.
    """
    robot = drive.nav.mission.robot
    if robot.footprint is None:
        return ()
    places, spacing = drive.rows[:, ROW_X : ROW_Y + 1], 2.0 * TURN_SLACK_M / robot.outer_radius
    rows, headings, off = turned_in_place(places, drive.rows[:, ROW_HEADING], spacing)
    if not rows.size:
        return ()
    gaps, nearest = world.body_nearest(places[rows], headings, robot.footprint)
    k = int(gaps.argmin())
    at, row = float(u[rows[k]]), rows[k]
    in_place = Certificate(
        float(gaps[k]) - off - TURN_SLACK_M, robot.clearance_m, tuple(places[row].tolist()), at,
        float(path.distance(at)), world.name(int(nearest[k])), None, float(headings[k]),
    )  # fmt: skip
    return (in_place,)


def _clearance(certificate: Certificate) -> float:
    return certificate.clearance


def driven_path(drive: MachineDrive) -> tuple[Path, float, Floats]:
    """The curve of the true motion with the via points that were passed, and its bound [m].

    Returns:
        The path, how far it may be from the true motion [m], and its parameter at every row.
    """
    robot = drive.nav.mission.robot
    reach = 0.0 if robot.footprint is None else robot.outer_radius
    courses = travel_of(drive.model, drive.rows).courses
    curve, bound, u = trace(drive.rows[:, ROW_X : ROW_Y + 1], courses, reach)
    vias: list[PathVia] = []
    for via, distance in zip(drive.path.vias, drive.path.via_distances, strict=True):
        row = _passing(drive, via, float(distance))
        if row is not None:
            least = vias[-1].u if vias else 0.0
            vias.append(replace(via, u=max(float(u[row]), least)))
    return Path(curve.spans, vias), bound, u


def _passing(drive: MachineDrive, via: PathVia, distance: float) -> int | None:
    """The row at which the robot was nearest to a via point when it passed there."""
    progress = drive.tracking.progress
    if progress[-1] < distance - PASSING_WINDOW_M:
        return None
    rows = np.flatnonzero(np.abs(progress - distance) <= PASSING_WINDOW_M)
    if not rows.size:
        return None
    away = np.hypot(*(drive.rows[rows, ROW_X : ROW_Y + 1] - np.array(via.at[:2])).T)
    return int(rows[int(away.argmin())])


def missed(drive: MachineDrive, visits: tuple[Visit, ...]) -> tuple[Visit, ...]:
    """The visits with how near the true motion came to each via point."""
    places = {via.at: row for via, row in _passings(drive)}
    return tuple(
        replace(
            visit, miss=math.dist(drive.rows[places[visit.at], ROW_X : ROW_Y + 1], visit.at[:2])
        )
        if visit.status == "served" and visit.at in places
        else visit
        for visit in visits
    )


def _passings(drive: MachineDrive) -> list[tuple[PathVia, int]]:
    found = []
    for via, distance in zip(drive.path.vias, drive.path.via_distances, strict=True):
        row = _passing(drive, via, float(distance))
        if row is not None and via.kind == "user":
            found.append((via, row))
    return found
