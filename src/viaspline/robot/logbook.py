"""What a drive's steps have handed out, put together by whoever wants to keep it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.curve.path import SEAM, Path
from viaspline.handed_in import check_kind
from viaspline.robot.navigation.log import Log
from viaspline.robot.navigation.schedule import vias_after
from viaspline.robot.navigator import Navigator
from viaspline.robot.run import Event, Replan, Visit


class Logbook:
    """Keeps what happened on a drive, from its first step on.

    A navigator keeps nothing of the past: what happened in a step is in ``nav.events`` and the like
    until the next one. A logbook that notes every step has it all.

    Example:
        >>> from viaspline.mission.model import Mission
        >>> nav = Navigator(Mission.model_validate({"route": {"start": [0, 0], "goal": [5, 0]}}))
        >>> book = Logbook()
        >>> for time in (0.0, 3.0, 6.0, 9.0):
        ...     _, nav = nav.step(nav.reference(time), sensed=[], time=time)
        ...     book.note(nav)
        >>> [event.kind for event in book.events]
        ['started', 'reached']
    """

    def __init__(self) -> None:
        self._events: list[Event] = []
        self._replans: list[Replan] = []
        self._compute_times: list[float] = []
        self._served: dict[int, Visit] = {}
        self._skipped: dict[int, str] = {}
        self._driven: list[Path] = []

    def note(self, nav: Navigator) -> None:
        """Note what happened in a navigator's last step."""
        check_kind("nav", nav, Navigator, "give the navigator that a step returns")
        log: Log = nav.log
        self._events += log.events
        self._replans += log.replans
        self._compute_times += log.compute_times
        self._served.update(log.served)
        self._skipped.update(log.skipped)
        self._driven += log.driven

    @property
    def events(self) -> tuple[Event, ...]:
        """Everything that happened, in order."""
        return tuple(self._events)

    @property
    def replans(self) -> tuple[Replan, ...]:
        """Every new path, in order."""
        return tuple(self._replans)

    @property
    def compute_times(self) -> tuple[float, ...]:
        """How long each search for a new path took, by the clock on the wall [s]."""
        return tuple(self._compute_times)

    def visits(self, nav: Navigator) -> tuple[Visit, ...]:
        """How each point of the route was served: by order along the path, not by nearness.

        A closed route's start comes twice, and again with every lap.

        Args:
            nav: The navigator of the last step; it says why points count as failed.
        """
        reason = nav.reason or "the robot has not come so far"
        visits = []
        for via, _ in vias_after(nav.plan.path, -1):
            assert via.index is not None
            if via.index in self._served:
                visits.append(self._served[via.index])
            elif via.index in self._skipped:
                why = self._skipped[via.index]
                visits.append(Visit(via.name, via.at, "skipped", None, None, why))
            else:
                visits.append(Visit(via.name, via.at, "failed", None, None, reason))
        return tuple(visits)

    def path(self, nav: Navigator) -> Path:
        """The path from the start of the drive on, what was driven and what lies ahead.

        Args:
            nav: The navigator of the last step.
        """
        parts = [*self._driven, nav.path]
        starts = np.cumsum([0, *(len(part.spans) for part in parts)])
        vias = [
            replace(via, u=via.u + float(start))
            for part, start in zip(parts, starts, strict=False)
            for via in part.vias
            if via.name != SEAM
        ]
        return Path(np.concatenate([part.spans for part in parts]), vias)
