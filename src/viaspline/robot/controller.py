"""The controller of a robot with a drive: what it remembers from step to step.

Tested through ``robot/simulation/test_machine_drive``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking import control_law
from viaspline.kernels.tracking.drive_model import Machine
from viaspline.kernels.tracking.drive_motion import STATE, V
from viaspline.kernels.tracking.reference_path import ReferencePath
from viaspline.kernels.tracking.reference_timing import SpeedProfile
from viaspline.machine.reference import reference_path_of
from viaspline.machine.trial_drive import speed_profile_of
from viaspline.robot.state import RobotState
from viaspline.trajectory.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
class Controller:
    """The controller at one moment; a new one for every step.

    It lives ahead of the clock by the delay of the drive: what is decided now happens then.

    Attributes:
        machine: What it drives.
        period: From one step to the next, as planned [s].
        path: What is followed.
        reference: The path as points, for kernels.
        trajectory: When the robot is to be where.
        profile: The trajectory for kernels.
        memory: Of the control kernel, shape (MEMORY,).
        given: The commands of the last steps, as far back as some are still on their way: time,
            speed and turn of each, shape (k, 3).
        note: What was noted in the last step, shape (NOTES,).
    """

    machine: Machine
    period: float
    path: Path
    reference: ReferencePath
    trajectory: Trajectory
    profile: SpeedProfile
    memory: Floats
    given: Floats
    note: Floats

    @classmethod
    def of(cls, machine: Machine, period: float, path: Path, trajectory: Trajectory) -> Controller:
        """A controller that has not given any command yet."""
        memory, note = np.zeros(control_law.MEMORY), np.zeros(control_law.NOTES)
        memory[control_law.THEN] = -math.inf
        reference, profile = reference_path_of(path), speed_profile_of(trajectory)
        return cls(
            machine, period, path, reference, trajectory, profile, memory, np.empty((0, 3)), note
        )

    @property
    def ahead(self) -> float:
        """So much later than now a command takes effect [s]."""
        return self.machine.delay

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

    def step(self, state: RobotState, time: float) -> Controller:
        """The controller after it has decided what to do, by what was measured at a time [s].

        Where it is too far behind, ``late`` says for how long its clock has to wait.
        """
        memory, pose = self.memory.copy(), np.zeros(STATE)
        if math.isinf(memory[control_law.THEN]):
            memory[control_law.THEN], memory[control_law.PACE] = time, state.speed
        period = time - memory[control_law.THEN] if len(self.given) else self.period
        pose[: V + 1] = (*state.position[:2], state.heading, state.speed)
        note = control_law.decide(
            self.machine, self.reference, self.profile, memory, pose, time, max(period, 0.0),
            self.given[:, 0].copy(), self.given[:, 1].copy(), self.given[:, 2].copy(),
        )  # fmt: skip
        return replace(self, memory=memory, note=note)

    @property
    def late(self) -> float:
        """How long the clock has to wait [s], after a step."""
        return float(self.memory[control_law.LATE])

    @property
    def command(self) -> tuple[float, float]:
        """Speed [m/s] and turn of the last step, as its machine's."""
        return float(self.note[control_law.TO_SPEED]), float(self.note[control_law.TO_TURN])

    def gave(self, time: float) -> Controller:
        """The controller when its command was given at a time [s]; its clock has waited."""
        memory = self.memory.copy()
        memory[control_law.LATE] = 0.0
        on_their_way = self.given[:, 0] >= time - self.ahead - 2.0 * self.period
        on_their_way[:-1] |= on_their_way[1:]  # the one before them acts until they do
        given = np.vstack((self.given[on_their_way & (self.given[:, 0] < time)],
                           (time, *self.command)))  # fmt: skip
        return replace(self, memory=memory, given=given)
