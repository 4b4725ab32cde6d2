"""A step of a drive: what a navigator was given, and what it decided.

Tested through ``bags/test_replay``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.motion_sensor import MovingSighting
from viaspline.robot.state import Command, RobotState

Sensed: TypeAlias = Sequence[Obstacle | MovingSighting] | Scan
"""What is shown to a navigator: what is in sight, or a scan."""


@dataclass(frozen=True)
class DrivenStep:
    """One step.

    Attributes:
        time: [s].
        state: Where the robot was, as measured.
        sensed: What it was shown.
        command: What it was told to do.
        nav: The navigator after the step.
    """

    time: float
    state: RobotState
    sensed: Sensed
    command: Command
    nav: Navigator


StepWatcher: TypeAlias = Callable[[DrivenStep], None]
"""Hears of every step that is made."""


def unwatched(step: DrivenStep) -> None:
    """Hears of a step and does nothing."""
