"""What planning a mission comes to, in a word, for tables of many."""

from __future__ import annotations

import viaspline as vs


def plan_outcome(mission: vs.Mission) -> str:
    """Whether it is planned, refused, or was given up."""
    try:
        vs.plan(mission)
    except vs.NoPathError:
        return "refused"
    except vs.GaveUpError:
        return "gave up"
    return "planned"
