"""What a robot decides to do about what it has perceived.

Tested through ``robot/navigation/test_log``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.run import Event, Replan


@dataclass(frozen=True)
class Decision:
    """How a robot goes on, and what there is to note about it.

    Attributes:
        schedule: What it means to do from now on.
        events: What happened, in order.
        replan: The new path, if it goes over to one.
        skipped: Points of the route that it gives up for that, with their indices and the reason.
        searched: Whether a new path was looked for, in vain or not.
        work: What that has spent [s of the reference machine].
    """

    schedule: Schedule
    events: tuple[Event, ...] = ()
    replan: Replan | None = None
    skipped: tuple[tuple[int, str], ...] = ()
    searched: bool = False
    work: float = 0.0
