"""What a navigator hands on from step to step.

Tested through ``robot/test_navigator``.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.log import Log
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.watching.watch import Watch


@dataclass(frozen=True)
class NavigationState:
    """A robot's drive at one moment; a new one for every step.

    Attributes:
        progress: How far the robot has come.
        knowledge: What it knows of the world.
        schedule: What it means to do from now on.
        log: What has happened.
        work: What the last step has spent on its search for a new path [s of the reference
            machine].
        watch: What tells whether the model fits the machine.
    """

    progress: Progress
    knowledge: Knowledge
    schedule: Schedule
    log: Log
    work: float = 0.0
    watch: Watch = field(default_factory=Watch)
