"""How a drive ended: its events and visits as they were in the end.

Tested through ``robot/replanning/test_decide`` and ``robot/simulation/test_exact_drive``.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.robot.logbook import Logbook
from viaspline.robot.navigator import Navigator
from viaspline.robot.run import Event, Visit


def outcome(
    nav: Navigator, book: Logbook, end: float, touched: Event | None, overdue: str | None
) -> tuple[str | None, tuple[Event, ...], tuple[Visit, ...]]:
    """Why the goal was not reached, the events in order, and the visits."""
    reason = overdue or nav.reason
    events, visits = book.events, book.visits(nav)
    if touched is not None:
        reason = f"the robot touched '{touched.data['name']}'"
        events = (*(e for e in events if e.time <= end), touched)
    if reason is not None:
        visits = tuple(_because(visit, reason) for visit in visits)
    return reason, tuple(sorted(events, key=lambda event: event.time)), visits


def _because(visit: Visit, reason: str) -> Visit:
    return replace(visit, reason=reason) if visit.status == "failed" else visit
