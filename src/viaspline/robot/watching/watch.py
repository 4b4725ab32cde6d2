"""What is remembered from step to step to tell whether the model fits the machine.

Tested through ``robot/watching/test_model_watch``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from viaspline.curve.path import Path
from viaspline.robot.state import RobotState


class TrailMark(NamedTuple):
    """Where a robot was at a time [s], and where its commands should have brought it.

    Attributes:
        time: [s].
        place: Distance along all that is driven [m].
        meant: What it should have driven by its commands, since it set off [m].
    """

    time: float
    place: float
    meant: float


class Excuse(NamedTuple):
    """A robot that was set beside its path: that dies out, and says nothing of its drive.

    Attributes:
        off: How far beside the path it was then [m].
        place: There, along all that is driven [m].
        over: The distance over which a deviation dies out [m].
        floor: It comes no nearer to anything than this on its way back [m].
        path: It comes back to this one.
        brakes: Whether it can't come back, and brakes to go on from where it stands.
    """

    off: float
    place: float
    over: float
    floor: float = 0.0
    path: Path | None = None
    brakes: bool = False

    def left_at(self, place: float) -> float:
        """How far beside its path it may still be at a later place along it [m].

        >>> Excuse(0.5, 10.0, over=1.0).left_at(10.0), round(Excuse(0.5, 10, 1).left_at(20.0), 4)
        (0.5, 0.0002)
        """
        gone = max(place - self.place, 0.0) / self.over
        return self.off * (1.0 + gone) * math.exp(-gone)


@dataclass(frozen=True)
class Watch:
    """The last steps of a robot, as far as they tell something of its model.

    Attributes:
        time: Of the last step, by the caller's clock [s]; -inf before the first.
        measured: What was measured last, as it was handed in; None before the first step.
        at: When that was measured [s].
        moved_at: When the position was last another than in the step before [s].
        scanned_at: When the last scan was taken that showed anything [s]; -inf before the first.
        given: When the last commands were given [s], and their speeds [m/s].
        speed: Which the robot should have by them [m/s].
        meant: What it should have driven by them since it set off [m].
        place: Where it is along all that is driven, as measured [m].
        off: How far any point of its body is beside its path, as measured [m].
        trail: Marks of the last seconds, in order.
        behind: For how long its time law has waited for it, in all [s].
        excuse: What it may be beside its path because it was set there, if it was.
        renewals: How often what is kept for the tracking error was renewed.
        told: What holds and was told of already, with the figure of then.
        held: Why it is held still; None if it isn't.
    """

    time: float = -math.inf
    measured: RobotState | None = None
    at: float = -math.inf
    moved_at: float = -math.inf
    scanned_at: float = -math.inf
    given: tuple[tuple[float, float], ...] = ()
    speed: float = 0.0
    meant: float = 0.0
    place: float = 0.0
    off: float = 0.0
    trail: tuple[TrailMark, ...] = ()
    behind: float = 0.0
    excuse: Excuse | None = None
    renewals: int = 0
    told: Mapping[str, float] = field(default_factory=dict)
    held: str | None = None

    def having_told(self, what: str, figure: float = 0.0) -> Watch:
        """It when something was told of, with its figure."""
        return replace(self, told={**self.told, what: figure})

    def without_telling(self, what: str) -> Watch:
        """It when something is over, so that it is told of when it comes again."""
        if what not in self.told:
            return self
        return replace(self, told={k: v for k, v in self.told.items() if k != what})

    def having_given(self, time: float, speed: float, remembered: float) -> Watch:
        """It when a command was given.

        Args:
            time: When [s].
            speed: Which it asks for [m/s].
            remembered: For how long commands are remembered [s].
        """
        if math.isinf(remembered):
            return self
        kept = tuple(one for one in self.given if one[0] >= time - remembered)
        last = self.given[len(self.given) - len(kept) - 1 : len(self.given) - len(kept)]
        return replace(self, given=(*last, *kept, (time, speed)))

    def command_at(self, time: float) -> float:
        """The speed of the last command that was given before a time [m/s]."""
        for given_at, speed in reversed(self.given):
            if given_at <= time:
                return speed
        return 0.0
