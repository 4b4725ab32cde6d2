"""The controller of a robot with a drive: what it remembers from step to step."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking import control_law
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.kernels.tracking.drive_motion import (
    ACROSS,
    ALONG,
    COMMAND,
    GIVEN_AT,
    HEADING,
    STATE,
    TURN,
    predict,
)
from viaspline.kernels.tracking.reference_path import ReferencePath
from viaspline.kernels.tracking.reference_timing import SpeedProfile
from viaspline.machine.drive_ahead import DriveState
from viaspline.machine.pose_filter import PoseFilter
from viaspline.machine.reference import reference_path_of
from viaspline.machine.settling import stilling_command
from viaspline.machine.trial_drive import speed_profile_of, start_of
from viaspline.robot.state import RobotState
from viaspline.trajectory.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
class Controller:
    """The controller at one moment; a new one for every step.

    It lives ahead of the clock by the delay of the drive: what is decided now happens then.

    Attributes:
        model: The drive of the robot.
        period: From one step to the next, as planned [s].
        path: What is followed.
        reference: The path as points, for kernels.
        trajectory: When the robot is to be where.
        profile: The trajectory for kernels.
        memory: Of the control kernel, shape (MEMORY,).
        given: The commands of the last steps, as far back as some are still on their way, shape
            (k, COMMAND).
        note: What was noted in the last step, shape (NOTES,).
        pose_filter: How what is measured is weighed.
        believed: Where the robot was taken to be at the last step, by what it was commanded and
            what was measured, shape (STATE,); None before the first.
    """

    model: DriveModel
    period: float
    path: Path
    reference: ReferencePath
    trajectory: Trajectory
    profile: SpeedProfile
    memory: Floats
    given: Floats
    note: Floats
    pose_filter: PoseFilter
    believed: Floats | None = None

    @classmethod
    def of(
        cls,
        model: DriveModel,
        period: float,
        path: Path,
        trajectory: Trajectory,
        pose_filter: PoseFilter,
    ) -> Controller:
        """A controller that has not given any command yet."""
        memory, note = np.zeros(control_law.MEMORY), np.zeros(control_law.NOTES)
        memory[control_law.LAST_TIME] = -math.inf
        reference, profile = reference_path_of(path), speed_profile_of(trajectory)
        return cls(
            model,
            period,
            path,
            reference,
            trajectory,
            profile,
            memory,
            np.empty((0, COMMAND)),
            note,
            pose_filter,
        )

    @property
    def ahead(self) -> float:
        """So much later than now a command takes effect [s]."""
        return self.model.delay

    def on(self, path: Path, trajectory: Trajectory) -> Controller:
        """The controller on this path, by this trajectory."""
        controller = self
        if path is not controller.path:
            controller = replace(controller, path=path, reference=reference_path_of(path))
        if trajectory is not controller.trajectory:
            controller = replace(
                controller, trajectory=trajectory, profile=speed_profile_of(trajectory)
            )
        return controller

    def moved(self, by: float) -> Controller:
        """The controller of a path whose distances count from another place on [m]."""
        memory = self.memory.copy()
        memory[[control_law.AT, control_law.FLOOR]] += by
        return replace(self, memory=memory)

    def step(self, state: RobotState, time: float, wait: float = 0.0) -> Controller:
        """The controller after it has decided what to do, by what was measured at a time.

        Where it is too far behind, ``late`` says for how long its clock has to wait.

        Args:
            state: What was measured.
            time: Then [s].
            wait: So much later the command is given [s]; until then the last one holds.
        """
        memory, pose = self.memory.copy(), np.zeros(STATE)
        if math.isinf(memory[control_law.LAST_TIME]):
            memory[control_law.LAST_TIME], memory[control_law.LAST_SPEED] = time, state.speed
        period = time - memory[control_law.LAST_TIME] if len(self.given) else self.period
        pose[: HEADING + 1] = (*state.position[:2], state.heading)
        pose[ALONG], pose[ACROSS] = state.speed, state.speed_across
        believed = self._believed(pose, time)
        note = control_law.decide(
            self.model, self.reference, self.profile, memory, pose, time, wait,
            max(period, 0.0), self.given.copy(),
        )  # fmt: skip
        believed[TURN] = memory[control_law.LAST_TURN]
        return replace(self, memory=memory, note=note, believed=believed)

    def _believed(self, measured: Floats, time: float) -> Floats:
        """Where the robot is taken to be at a time [s], shape (STATE,)."""
        if self.believed is None:
            start = start_of(self.model, self.reference)
            return self.pose_filter.first(start, measured)
        last, pose = float(self.memory[control_law.LAST_TIME]), self.believed
        predicted = predict(self.model, pose, last, time, self.given.copy())
        return self.pose_filter.updated(predicted, measured)

    def staying_put(self) -> Controller:
        """The controller that brings the robot to a stand if its law rests, where it is.

        It turns as before.
        """
        if not self.note[control_law.REST] > 0.0 or self.believed is None:
            return self
        note, told_at = self.note.copy(), float(self.memory[control_law.LAST_TIME])
        then = float(note[control_law.TIME])
        pose = predict(self.model, self.believed, told_at, then, self.given.copy())
        for told, speed in (
            (control_law.NOTED_ALONG, ALONG), (control_law.NOTED_ACROSS, ACROSS),
        ):  # fmt: skip
            note[told] = stilling_command(self.model, float(pose[speed]), self.period)
        return replace(self, note=note)

    @property
    def state(self) -> DriveState:
        """The drive as it is after a step, to be tried out on other paths.

        Raises:
            AssertionError: Before the first step.
        """
        assert self.believed is not None
        memory = self.memory.copy()
        memory[control_law.LATE] = 0.0
        time = float(memory[control_law.LAST_TIME])
        return DriveState(self.believed, memory, self.given, time, self.period)

    @property
    def late(self) -> float:
        """How long the clock has to wait [s], after a step."""
        return float(self.memory[control_law.LATE])

    @property
    def command(self) -> tuple[float, float, float]:
        """Speed along and across the body [m/s] and turn of the last step, as its model's."""
        along, across, turn = self.note[
            [control_law.NOTED_ALONG, control_law.NOTED_ACROSS, control_law.NOTED_TURN]
        ].tolist()
        return along, across, turn

    def gave(self, time: float) -> Controller:
        """The controller when its command was given at a time [s]; its clock has waited."""
        memory = self.memory.copy()
        memory[control_law.LATE] = 0.0
        before = self.given[self.given[:, GIVEN_AT] < time]
        on_their_way = before[:, GIVEN_AT] >= time - self.ahead - 2.0 * self.period
        on_their_way[-1:] = True  # it acts until this one does, however long that took to find
        on_their_way[:-1] |= on_their_way[1:]  # and so does the one before the others
        given = np.vstack((before[on_their_way], (time, *self.command)))
        return replace(self, memory=memory, given=given)
