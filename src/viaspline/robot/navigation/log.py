"""What has happened in one step of a drive: it is handed out, and not kept.

``Logbook`` puts the logs of many steps together.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from viaspline.curve.path import Path
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.run import Event, Replan, Visit


@dataclass(frozen=True)
class Log:
    """All that is noted in one step; nothing of it is asked again under way.

    Attributes:
        events: What happened, in order.
        replans: Every new path, in order.
        served: Points of the route that were passed: their indices and how that was.
        skipped: Points of the route that were given up: their indices and the reason.
        compute_times: How long each search for a new path took, by the clock on the wall [s].
        driven: What was driven and is no part of the path any more, in order.
    """

    events: tuple[Event, ...] = ()
    replans: tuple[Replan, ...] = ()
    served: tuple[tuple[int, Visit], ...] = ()
    skipped: tuple[tuple[int, str], ...] = ()
    compute_times: tuple[float, ...] = ()
    driven: tuple[Path, ...] = ()

    def with_events(self, *events: Event) -> Log:
        """The log with these events at its end."""
        return replace(self, events=self.events + events)

    def with_visit(self, index: int, visit: Visit) -> Log:
        """The log with a point of the route that has been passed."""
        return replace(self, served=(*self.served, (index, visit)))

    def with_decision(self, decision: Decision, compute_time: float) -> Log:
        """The log with what was decided, and how long that took [s]."""
        replans = () if decision.replan is None else (decision.replan,)
        times = (compute_time,) if decision.searched else ()
        return replace(
            self,
            events=self.events + decision.events,
            replans=self.replans + replans,
            skipped=self.skipped + decision.skipped,
            compute_times=self.compute_times + times,
        )

    def with_driven(self, part: Path) -> Log:
        """The log with a part of the path that lies behind for good."""
        return replace(self, driven=(*self.driven, part))

    def with_skipped(self, index: int, reason: str) -> Log:
        """The log with a point of the route that is given up."""
        return replace(self, skipped=(*self.skipped, (index, reason)))
