"""A robot that is timed already, as an obstacle that moves as it is known to.

Tested through ``fleet/laying/test_relay``.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.fleet.member_spec import Rest
from viaspline.mission.motion_spec import Motion
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import Plan

STEP_S: Final = 0.1
"""Between instants at which a robot is looked at [s]."""
OFF_M: Final = 0.03
"""How far from a robot its keyframes may be between them, at these instants [m]."""
GROWN_M: Final = 0.05
"""By how much more room it takes as an obstacle: for that, and for what is between instants [m]."""


def as_obstacle(name: str, plan: Plan, radius: float, rest: Rest) -> Obstacle:
    """A robot as a disc that moves by its plan, and stands before and after it.

    Args:
        name: The robot's.
        plan: With its law by the clock of the fleet.
        radius: Of the disc, before it is grown by what its keyframes are off [m].
        rest: Whether it stays at its goal.
    """
    times, places = _driven(plan)
    kept = _keyframes(times, places)
    frames = np.column_stack((times[kept], places[kept])).tolist()
    return Obstacle(
        name=name,
        circle=Circle(center=(0.0, 0.0), radius=max(radius, 0.0) + GROWN_M),
        motion=Motion(
            keyframes=frames, after="stay" if rest == "stay" else "vanish", before="stay"
        ),
    )


def _driven(plan: Plan) -> tuple[Floats, Floats]:
    """Instants [s], (n,), and where the robot is then [m], (n, 2)."""
    law = plan.trajectory
    steps = max(int(np.ceil(law.duration / STEP_S)), 1)
    times = np.linspace(law.start_time, law.end_time, steps + 1)
    places: Floats = np.asarray(plan.path.at_distance(law.distance_at(times)))[:, :2]
    return times, places


def _keyframes(times: Floats, places: Floats) -> Ints:
    """Instants between which the robot goes about evenly, the first and the last among them."""
    kept = {0, len(times) - 1}
    parts = [(0, len(times) - 1)]
    while parts:
        first, last = parts.pop()
        share = (times[first : last + 1] - times[first]) / (times[last] - times[first])
        even = places[first] + share[:, None] * (places[last] - places[first])
        off = np.hypot(*(places[first : last + 1] - even).T)
        worst = int(off.argmax())
        if off[worst] > OFF_M:
            kept.add(first + worst)
            parts += [(first, first + worst), (first + worst, last)]
    return np.array(sorted(kept), np.int64)
