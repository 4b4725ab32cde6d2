"""The simulated drive of a machine: it is commanded, and moves as its drive lets it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.control_law import HIGH, LOW, NOTES, PLACE, PROGRESS
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.kernels.tracking.drive_motion import (
    ACROSS,
    ALONG,
    HEADING,
    ROW_TIME,
    SUBSTEP_S,
    X,
    Y,
    move,
)
from viaspline.machine.drive_noise import DriveNoise
from viaspline.machine.reference import reference_path_of
from viaspline.machine.tracking import Tracking
from viaspline.machine.trial_drive import first_row, start_of
from viaspline.robot.logbook import Logbook
from viaspline.robot.navigator import Navigator
from viaspline.robot.run import Event
from viaspline.robot.simulation.contact import first_contact
from viaspline.robot.simulation.driven_step import DrivenStep, StepWatcher, unwatched
from viaspline.robot.simulation.pace import Pace, by_work, seconds_from, steps_taken
from viaspline.robot.simulation.sensors import senses_of
from viaspline.robot.state import RobotState
from viaspline.world.world import World

Tell = Callable[[float, Navigator], None]

STANDSTILL_MPS = 1e-3
"""A robot that is slower stands [m/s]."""

MAX_LINGER_S = 5.0
"""After the end of its drive it is waited for that at most so long [s]."""


@dataclass(frozen=True, eq=False)
class MachineDrive:
    """A drive that is over.

    Attributes:
        nav: The navigator at its end.
        book: What happened.
        path: Which it drove, all of it.
        model: What drove.
        rows: The true motion at every step, as of the kernel ``move``, shape (n, ROW).
        tracking: What it was off from its path.
        touched: The contact that ended it.
        overdue: Why it was broken off.
    """

    nav: Navigator
    book: Logbook
    path: Path
    model: DriveModel
    rows: Floats
    tracking: Tracking
    touched: Event | None
    overdue: str | None


def drive_machine(
    nav: Navigator,
    world: World,
    step: float,
    seed: int,
    tell: Tell,
    limit: float,
    pace: Pace = by_work,
    watch: StepWatcher = unwatched,
) -> MachineDrive:
    """Drive until the navigator has finished and the robot stands.

    Args:
        nav: At the start.
        world: Everything that is there.
        step: From one look and one command to the next [s].
        seed: Of the noise of the drive, of the localisation and of a lidar.
        tell: Called with the time and the navigator at every step.
        limit: The drive is broken off at this time [s].
        pace: How long a search keeps the robot from looking again.
        watch: Called with every step.
    """
    controller = nav.controller
    assert controller is not None
    senses = senses_of(nav.mission, world, seed)
    model, faults = controller.model, DriveNoise(nav.mission.robot, seed)
    substeps = max(math.ceil(step / SUBSTEP_S - 1e-9), 1)
    state = start_of(model, controller.reference)
    rows, notes = [first_row(state)], []
    contact = first_contact(nav.mission.robot, world, rows[0])
    book, overdue, tick = Logbook(), None, 0
    while contact is None:
        time = tick * step
        x, y, heading = (state[: HEADING + 1] + faults.measured(1)[0]).tolist()
        believed = RobotState((x, y), heading, float(state[ALONG]), float(state[ACROSS]))
        place = float(state[X]), float(state[Y])
        sensed = senses.at(place, float(state[HEADING]), tick, time)
        command, nav = nav.step(believed, sensed, time)
        book.note(nav)
        watch(DrivenStep(time, believed, sensed, command, nav))
        controller = nav.controller
        assert controller is not None
        notes.append(_along_all(controller.note, nav.driven))
        tell(time, nav)
        if _is_over(nav, time, math.hypot(state[ALONG], state[ACROSS])):
            break
        if time > limit:
            overdue = f"the drive was broken off after {time:.0f} s, its limit"
            break
        for _ in range(steps_taken(seconds_from(pace, nav), step)):
            moved = move(
                model, state, tick * step, step / substeps, controller.given.copy(),
                faults.driven(substeps),
            )  # fmt: skip
            contact = first_contact(nav.mission.robot, world, np.vstack((rows[-1][-1:], moved)))
            rows.append(moved)
            tick += 1
            if contact is not None:
                break
    track = np.concatenate(rows)
    if contact is not None:
        track = track[track[:, ROW_TIME] <= contact.time + 1e-9]
    noted = np.array(notes) if notes else np.zeros((1, NOTES))
    driven = book.path(nav) if nav.driven > 0.0 else nav.path
    reference = reference_path_of(driven) if nav.driven > 0.0 else controller.reference
    tracking = Tracking.of(model, reference, noted, track)
    return MachineDrive(nav, book, driven, model, track, tracking, contact, overdue)


def _along_all(note: Floats, driven: float) -> Floats:
    """What a controller noted, with its places along all that was driven before its path [m]."""
    if driven == 0.0:
        return note
    moved = note.copy()
    moved[[PLACE, LOW, HIGH, PROGRESS]] += driven
    return moved


def _is_over(nav: Navigator, time: float, speed: float) -> bool:
    end = nav.trajectory.end_time
    return (
        nav.finished and time >= end and (abs(speed) < STANDSTILL_MPS or time >= end + MAX_LINGER_S)
    )
