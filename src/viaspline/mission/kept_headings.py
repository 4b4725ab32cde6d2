"""Which headings at the ends of a route the path can't keep."""

from __future__ import annotations

from viaspline.caller_warning import warn_caller
from viaspline.mission.mission_parts import MissionParts


def warn_of_headings(mission: MissionParts) -> None:
    """Say which headings aren't kept: lines (tension 1) have their own, where nothing is turned.

    With a turning circle the path is made of turns, and in a corridor of a line of its own.
    """
    is_turned = mission.robot.turn_radius is not None or mission.route.corridor is not None
    slack = _slack_at_ends(mission)
    if mission.is_spatial or is_turned or slack is None:
        return
    ends = (("start", mission.route.start), ("goal", mission.route.goal))
    for (name, end), of_span in zip(ends, slack, strict=True):
        if end is not None and end.heading_deg is not None and of_span == 0.0:
            words = (
                f"route.{name}.heading_deg isn't kept, as tension 1 (slack 0) makes lines: give "
                "a tension below 1, or robot.min_turn_radius_m"
            )
            warn_caller(words)


def _slack_at_ends(mission: MissionParts) -> tuple[float, float] | None:
    """Slack of the first and the last span; None where nobody gave it."""
    spline = mission.spline
    given = spline.tension if spline.slack is None else spline.slack
    if given is None or isinstance(given, str):
        return None
    first, last = (given, given) if isinstance(given, float | int) else (given[0], given[-1])
    if spline.slack is None:
        first, last = (1.0 - first) / 2.0, (1.0 - last) / 2.0
    return first, last
