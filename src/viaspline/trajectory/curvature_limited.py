"""The time law under limits that are a largest speed at every place: exact, arc by arc.

Tested through ``trajectory/test_retime``.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing.arc_caps import bend_caps
from viaspline.kernels.timing.stretches import cut_in_stretches
from viaspline.kernels.timing.two_pass import two_pass_profile
from viaspline.trajectory.coupled import Profile, Stage
from viaspline.trajectory.limits import Limits

CAP_RATIO = 1.1
"""Largest ratio of what two places within one arc of the profile allow for v²."""


class Cubic(Protocol):
    """What the time law needs of a piecewise cubic.

    Without limits of the speed in bends the length is enough; the rest is not asked for.
    """

    @property
    def spans(self) -> Floats:
        """Bézier control polygons [m], shape (m, 4, d)."""

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter; the spans share it equally."""

    @property
    def length(self) -> float:
        """Length [m]."""

    def distance(self, u: ArrayLike) -> Floats | float:
        """Distance along the curve [m]."""


def bend_profile(path: Cubic, limits: Limits, stage: Stage) -> Profile:
    """The fastest v² under limits of the speed, along the path and in bends.

    v² is bounded from above on every arc of the path by ``max_speed`` and by what bends allow with
    the arc's proven largest curvature. A pass from the end and one from the start take off what
    braking and speeding up don't allow.

    Args:
        path: What is driven.
        limits: Those of speed, acceleration, braking, across the path, and yaw rate.
        stage: What is asked.
    """
    line, caps, rests = stretches_of(path, limits, stage)
    points, squares, over, missed = two_pass_profile(
        line, caps, rests, limits.max_accel, limits.brake, stage.first**2, stage.last**2
    )
    return Profile(points, squares, float(over), float(missed))


def stretches_of(
    path: Cubic, limits: Limits, stage: Stage
) -> tuple[Floats, Floats, NDArray[np.bool_]]:
    """Ends of the stretches from start to end, the largest v² on each, and where to rest."""
    start, square = stage.start, stage.top**2
    edges = [place for part in stage.slow for place in (part.start, part.end)]
    places = np.array(sorted({start, stage.end, *stage.stops, *edges}))
    lateral, turning = limits.max_lateral_accel, limits.max_yaw_rate
    if lateral is None and turning is None:
        arcs, arc_caps = places[[0, -1]], np.array((square,))
        corners = np.zeros(2, np.bool_)
    else:
        joints = np.asarray(path.distance(np.linspace(*path.domain, len(path.spans) + 1)))
        first = max(int(np.searchsorted(joints, start, side="right")) - 1, 0)
        arcs, arc_caps, corners = bend_caps(
            np.array(path.spans[first:]), joints[first:],  # writable: numba compiles for one kind
            np.inf if lateral is None else lateral, np.inf if turning is None else turning,
            max(limits.max_accel, limits.brake), square,
            CAP_RATIO if turning is None else np.sqrt(CAP_RATIO),
        )  # fmt: skip
    slow = [(part.start, part.end, part.speed**2) for part in stage.slow]
    return cut_in_stretches(
        arcs, arc_caps, corners, places, np.array(sorted(stage.stops), np.float64),
        np.array(slow, np.float64).reshape(-1, 3),
    )  # fmt: skip
