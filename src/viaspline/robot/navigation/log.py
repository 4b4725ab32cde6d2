"""What has happened on a drive."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from viaspline.curve.path import PathVia
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.run import Event, Replan, Visit


@dataclass(frozen=True)
class Log:
    """All that is noted of a drive; nothing of it is asked again under way.

    Attributes:
        events: What happened, in order.
        replans: Every new path, in order.
        served: Points of the route that were passed: their indices and how that was.
        skipped: Points of the route that were given up: their indices and the reason.
        compute_times: How long each search for a new path took, by the clock on the wall [s].
    """

    events: tuple[Event, ...] = ()
    replans: tuple[Replan, ...] = ()
    served: tuple[tuple[int, Visit], ...] = ()
    skipped: tuple[tuple[int, str], ...] = ()
    compute_times: tuple[float, ...] = ()

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

    def visits(self, points: Iterable[PathVia], reason: str) -> tuple[Visit, ...]:
        """How each point of the route was served: by order along the path, not by nearness.

        Args:
            points: The user's via points of the path that was planned at first; a closed route's
                start comes twice.
            reason: Why those that were neither passed nor given up count as failed.
        """
        served, skipped = dict(self.served), dict(self.skipped)
        by_index = {via.index: via for via in points}
        visits = []
        for index, via in sorted(by_index.items(), key=lambda item: item[0] or 0):
            assert index is not None
            if index in served:
                visits.append(served[index])
            elif index in skipped:
                visits.append(Visit(via.name, via.at, "skipped", None, None, skipped[index]))
            else:
                visits.append(Visit(via.name, via.at, "failed", None, None, reason))
        return tuple(visits)
