"""Why robots aren't served among patrols that never end, and among what moves.

The reasons are known from their timing, and nothing is tried.

Tested through ``fleet/patrols/test_timed_patrols``.
"""

from __future__ import annotations

from viaspline.fleet.not_served import NotServed
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.unserved.blocked_stretch import blocked_stretches


def unserved_beside(timed: TimedFleet) -> list[NotServed]:
    """What is told of each robot that has a path and no law, in their order.

    Args:
        timed: What came of timing.
    """
    return [_told(timed, robot, other) for robot, other in sorted(timed.timing.blocked.items())]


def _told(timed: TimedFleet, robot: int, other: int) -> NotServed:
    """Who is in a robot's way, where, and what may help."""
    name, its = (timed.ways.courses.names[k] for k in (robot, other))
    reason, remedy = timed.reasons.get(robot) or _in_the_way(timed, name, its, other)
    stretches = [] if robot == other else blocked_stretches(timed, robot, other)
    where = stretches[0].ends[0] if stretches else timed.ways.members[robot].mission.route.start.at
    obstacles = () if robot == other else (its,)
    return NotServed(name, "gave up", reason, remedy, obstacles, tuple(where))


def _in_the_way(timed: TimedFleet, name: str, its: str, other: int) -> tuple[str, str]:
    """The reason and the remedy where timing alone says that there is no time."""
    if timed.ways.members[other].mission.route.is_patrol:
        return (
            f"'{name}' finds no time between the laps of '{its}', which never end",
            f"say how many laps '{its}' drives (laps), or move a point of '{name}' off its way",
        )
    return (
        f"it can't be timed along its path: '{its}' is in its way",
        f"give '{its}' another start, goal or priority, or let it leave",
    )
