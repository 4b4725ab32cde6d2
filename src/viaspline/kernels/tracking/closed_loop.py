"""Following a path with its time law: the closed loop, and how far off the robot was.

Tested through ``machine/test_trial_drive``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel
from viaspline.kernels.tracking.control_law import (
    HIGH,
    LATE,
    LOW,
    NOTED_ACROSS,
    NOTED_ALONG,
    NOTED_TURN,
    NOTES,
    PAST_CORNER_M,
    PLACE,
    REST,
    SPEED,
    TIME,
    decide_into,
)
from viaspline.kernels.tracking.drive_model import DriveModel, clip, wanted_heading
from viaspline.kernels.tracking.drive_motion import (
    ACROSS,
    ALONG,
    COMMAND,
    GIVEN_AT,
    ROW,
    ROW_HEADING,
    ROW_TIME,
    ROW_X,
    ROW_Y,
    STATE,
    TO_ACROSS,
    TO_ALONG,
    TO_TURN,
    move_into,
)
from viaspline.kernels.tracking.reference_path import (
    ReferencePath,
    beside,
    heading_error,
    nearest_on,
    on_reference,
)
from viaspline.kernels.tracking.reference_timing import SpeedProfile


@kernel
def drive(
    model: DriveModel,
    reference: ReferencePath,
    profile: SpeedProfile,
    state: Floats,
    memory: Floats,
    given: Floats,
    begin: float,
    until: float,
    period: float,
    substeps: int,
    measured: Floats,
    noise: Floats,
) -> tuple[Floats, Floats, int]:
    """A drive along a path: measure, decide, move, until the time law is over or a place is passed.

    Args:
        model: The drive, with its noise.
        reference: The path.
        profile: The time law.
        state: At the start, shape (STATE,), changed in place.
        memory: What the controller remembers, shape (MEMORY,), changed in place.
        given: Commands that were given before, in order, shape (k, COMMAND).
        begin: When it begins [s].
        until: It ends where the robot should have come so far along the path [m].
        period: Of the controller [s].
        substeps: Of the motion in a period.
        measured: Errors of the measured x, y and heading in every period, shape (n, 3).
        noise: Standard normal numbers, shape (n * substeps, 2).

    Returns:
        The track, as of ``move``, and what was noted in every period, both as long as the drive;
        the number of periods, -1 if it was not over after n.
    """
    n, before = measured.shape[0], given.shape[0]
    track, notes = np.empty((n * substeps, ROW)), np.zeros((n, NOTES))
    commands = np.empty((before + n, COMMAND))
    for k in range(before):
        for i in range(COMMAND):
            commands[k, i] = given[k, i]
    pose, note = np.zeros(STATE), np.zeros(NOTES)
    end = profile.time[profile.time.shape[0] - 1]
    note[PLACE] = -math.inf
    for tick in range(n):
        time, count = begin + tick * period, before + tick
        if time - memory[LATE] >= end or note[PLACE] >= until:
            return track, notes, tick
        for k in range(3):
            pose[k] = state[k] + measured[tick, k]
        pose[ALONG], pose[ACROSS] = state[ALONG], state[ACROSS]
        decide_into(
            model, reference, profile, memory, pose, time, 0.0, period, commands, count, note
        )
        for k in range(NOTES):
            notes[tick, k] = note[k]
        commands[count, GIVEN_AT], commands[count, TO_ALONG] = time, note[NOTED_ALONG]
        commands[count, TO_ACROSS], commands[count, TO_TURN] = note[NOTED_ACROSS], note[NOTED_TURN]
        move_into(
            model, state, time, period / substeps, tick * substeps, (tick + 1) * substeps, commands,
            count + 1, noise, track,
        )  # fmt: skip
    return track, notes, -1


@kernel
def deviations(model: DriveModel, reference: ReferencePath, notes: Floats, track: Floats) -> Floats:
    """How far beside, turned from and behind its path a robot really was.

    Args:
        model: Its drive.
        reference: The path.
        notes: Of every period, shape (m, NOTES).
        track: Of every step, shape (n, ROW).

    Returns:
        Distance along the path, distance from the path, positive to the left, heading error,
        distance behind where it should be, and 1 where it should stand, shape (n, 5).
    """
    out = np.zeros((track.shape[0], 5))
    k = -1
    s, low = notes[0, PLACE], notes[0, LOW]
    for i in range(track.shape[0]):
        time, x, y = track[i, ROW_TIME], track[i, ROW_X], track[i, ROW_Y]
        while k + 1 < notes.shape[0] and notes[k + 1, TIME] <= time + 1e-9:
            k += 1
        should, rests = notes[0, PLACE], True
        if k >= 0:
            should = notes[k, PLACE] + notes[k, SPEED] * (time - notes[k, TIME])
            rests = notes[k, REST] > 0.0
        high = should
        if not rests:
            low = notes[k, LOW] + PAST_CORNER_M
            high = max(notes[k, HIGH] - 1e-9, low)
            should = min(should, high)
        s = nearest_on(reference, clip(should, s - 0.5, s + 0.5), x, y, low, high)
        px, py, _, _ = on_reference(reference, s)
        aside, tangent = beside(reference, s, x, y)
        out[i, 0] = s
        out[i, 1] = math.copysign(math.hypot(x - px, y - py), aside)
        out[i, 2] = heading_error(track[i, ROW_HEADING], wanted_heading(model, tangent))
        out[i, 3], out[i, 4] = should - s, 1.0 if rests else 0.0
    return out
