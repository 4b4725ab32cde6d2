"""Where a run of spans is closest to the world, and which way off it is.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.tight_place import (
    ALONG_X,
    ALONG_Y,
    GAP,
    OFF_X,
    OFF_Y,
    U,
    X,
    Y,
    tight_place,
)
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import PUSH_S
from viaspline.world.world import World

SAMPLES_PER_SPAN = 9  # to find its tightest place
GRADIENT_STEP_M = 1e-6  # of the gradient of the distance
SPANS_AHEAD = 12  # after a run, on which the path may pass what the front touches


class TightestPlace(NamedTuple):
    """Where a curve is too close.

    Attributes:
        u: Its parameter.
        along: The direction of the curve there, a unit vector.
        wall: The surface of what it is too close to [m], (2,).
        into: From there to its inside, a unit vector.
        missing: By how much it is too close [m].
        kept: What the path has to keep from the surface [m].
    """

    u: float
    along: Floats
    wall: Floats
    into: Floats
    missing: float
    kept: float


def tightest_place(
    spans: Floats, run: NDArray[np.int64], world: World, requirements: Requirements
) -> TightestPlace:
    """The tightest place of a run of the spans of a curve, (m, 4, 2)."""
    requirements.spend(PUSH_S)
    first, last = int(run[0]), int(run[-1])
    if requirements.footprint is not None:
        found = proven(PiecewiseCubic(spans[first : last + 1]), world, requirements)
        if found.contact is not None:
            missing = requirements.least - found.clearance
            return _touched(spans, (first, last), found.contact, missing, world, requirements)
    at = tight_place(world.packed, spans[first : last + 1], SAMPLES_PER_SPAN, GRADIENT_STEP_M)
    gap, into = float(at[GAP]), -at[[OFF_X, OFF_Y]]
    return TightestPlace(
        first + float(at[U]), at[[ALONG_X, ALONG_Y]], at[[X, Y]] + gap * into, into,
        max(requirements.required - gap, 0.0), requirements.required,
    )  # fmt: skip


def _touched(
    spans: Floats, run: tuple[int, int], contact: tuple[float, float], missing: float,
    world: World, requirements: Requirements,
) -> TightestPlace:  # fmt: skip
    """The tightest place of a run on which a polygon touches something with its outline.

    Args:
        spans: Of the curve, (m, 4, 2).
        run: The first and the last of them that are too close.
        contact: The nearest place of the outline [m].
        missing: By how much it is too near [m].
        world: What it touches.
        requirements: The body, and what it keeps.
    """
    at = np.array(contact)
    gap, into = _gap_and_inside(world, at)
    wall = at + gap * into
    # the front may touch where the reference point is yet to come
    curve = PiecewiseCubic(spans[run[0] : run[1] + SPANS_AHEAD])
    beside = curve.project(wall)
    kept = max(beside.distance + 1.1 * missing, requirements.required)
    heading = float(curve.heading(beside.u))
    along = np.array([np.cos(heading), np.sin(heading)])
    return TightestPlace(run[0] + float(beside.u), along, wall, into, missing, kept)


def _gap_and_inside(world: World, place: Floats) -> tuple[float, Floats]:
    """The distance of a place (2,) from what is nearest [m], and a unit vector to there (2,)."""
    steps = place + GRADIENT_STEP_M * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])
    d = world.distance(steps)
    slope = np.array([d[2] - d[1], d[4] - d[3]])
    size = float(np.linalg.norm(slope))
    return float(d[0]), slope / size if size > 0.0 else np.array([-1.0, 0.0])
