"""How each point of the route was served: by order along the path, not by nearness."""

from __future__ import annotations

from viaspline.robot.journey import NavigationState, points_after
from viaspline.robot.run import Visit


def visits_of(journey: NavigationState) -> tuple[Visit, ...]:
    """One visit for each point of the route, in order; a closed route's start comes twice.

    A point that has not been passed yet counts as failed, with the reason.
    """
    served, skipped = dict(journey.served), dict(journey.skipped)
    reason = journey.giving_up or "the robot has not come so far"
    points = {via.index: via for via, _ in points_after(journey.plan_path, -1)}
    visits = []
    for index, via in sorted(points.items(), key=lambda item: item[0] or 0):
        assert index is not None
        if index in served:
            visits.append(served[index])
        elif index in skipped:
            visits.append(Visit(via.name, via.at, "skipped", None, None, skipped[index]))
        else:
            visits.append(Visit(via.name, via.at, "failed", None, None, reason))
    return tuple(visits)
