"""A mission with a tension stated in it, whatever it said itself.

Tested through ``test_advice``.
"""

from __future__ import annotations

from typing import TypeAlias

from viaspline.mission.model import Mission

StatedTension: TypeAlias = float | tuple[float, ...] | None
"""One for all spans, or one for each; None: none is stated."""


def with_tension(mission: Mission, tension: StatedTension) -> Mission:
    """A mission with another tension.

    >>> slack = Mission.model_validate({"route": {"goal": [9, 0], "start": [0, 0]},
    ...                                 "spline": {"slack": 0.45}})
    >>> spline = with_tension(slack, 0.2).spline
    >>> spline.tension, spline.slack
    (0.2, None)
    """
    spline = mission.spline.model_copy(update={"tension": tension, "slack": None})
    return mission.model_copy(update={"spline": spline})
