"""A path as a controller looks at it: points close together, with headings that run on."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.control_law import PAST_CORNER_M
from viaspline.kernels.tracking.reference_path import ReferencePath
from viaspline.machine.turns_on_spot import beside_cusps_of, cusps_of

MAX_SPACING_M, MAX_TURN_RAD = 0.25, 0.03
"""From one point to the next at most, and turning between them [m], [rad]."""

MIN_POINTS, MAX_POINTS = 2, 400
"""On a span."""

BEFORE_END = 1e-9
"""A heading at the end of a span is looked up so far before it, in the span's parameter."""

CUSP_CURVATURE_PER_M = 100.0
"""Curvatures beyond this are those of a cusp [1/m]."""


def reference_path_of(path: PiecewiseCubic) -> ReferencePath:
    """The points of a path in the plane.

    Between them a place is interpolated by the cubic through both with their headings: within a
    tenth of a millimetre of the path. Where the heading jumps, at corners and cusps, there are two.

    Raises:
        GeometryError: When the path is not in the plane.

    Example:
        >>> reference = reference_path_of(PiecewiseCubic([[[0, 0], [1, 0], [2, 0], [3, 0]]]))
        >>> round(float(reference.distance[-1]), 9), float(reference.heading[-1])
        (3.0, 0.0)
    """
    if path.dimension != 2:
        raise GeometryError(
            "a drive needs a route in the plane: leave out the heights, or robot.drive and "
            "robot.localization"
        )
    counts = _counts(path.spans)
    k = np.repeat(np.arange(len(counts)), counts)
    first = np.repeat(np.cumsum(counts) - counts, counts)
    w = (np.arange(len(k)) - first) / (np.repeat(counts, counts) - 1.0)
    u: Floats = np.asarray(k + w, dtype=np.float64)
    inside: Floats = np.where(w >= 1.0, k + (1.0 - BEFORE_END), u)
    u, inside = _with_cusps(path, u, inside)
    places = path.evaluate(u)
    heading = np.asarray(path.heading(inside))
    curvature = np.nan_to_num(np.asarray(path.curvature(inside)), posinf=0.0, neginf=0.0)
    turns = np.remainder(np.diff(heading) + np.pi, 2.0 * np.pi) - np.pi
    return ReferencePath(
        np.maximum.accumulate(np.asarray(path.distance(u))),
        places[:, 0].copy(),
        places[:, 1].copy(),
        heading[0] + np.concatenate(([0.0], np.cumsum(turns))),
        np.clip(curvature, -CUSP_CURVATURE_PER_M, CUSP_CURVATURE_PER_M),
    )


def heading_after(reference: ReferencePath, distance: float) -> float:
    """The heading to which a controller turns a robot that stands [rad]; behind a corner there.

    Args:
        reference: What is followed.
        distance: Where the robot stands along it [m].

    Example:
        >>> right, up = [[0, 0], [1, 0], [2, 0], [3, 0]], [[3, 0], [3, 1], [3, 2], [3, 3]]
        >>> reference = reference_path_of(PiecewiseCubic([right, up]))
        >>> [round(heading_after(reference, at), 3) for at in (2.9, 3.0)]
        [0.0, 1.571]
    """
    return float(np.interp(distance + PAST_CORNER_M, reference.distance, reference.heading))


def _with_cusps(path: PiecewiseCubic, u: Floats, inside: Floats) -> tuple[Floats, Floats]:
    """Parameters of places and of their headings, with two places at every cusp in a span."""
    back = cusps_of(path)
    if not back.size:
        return u, inside
    apart = beside_cusps_of(path, back)
    turns = np.abs(u[:, None] - back) < apart
    u, inside = u[~turns.any(axis=1)], inside[~turns.any(axis=1)]
    at = np.searchsorted(u, np.repeat(back, 2))
    beside = np.column_stack((back - apart, back + apart)).ravel()
    return np.insert(u, at, np.repeat(back, 2)), np.insert(inside, at, beside)


def _counts(spans: Floats) -> NDArray[np.int64]:
    """How many points each span needs, (m,)."""
    legs = np.diff(spans, axis=1)
    length = np.linalg.norm(legs, axis=2).sum(axis=1)
    angles = np.arctan2(legs[..., 1], legs[..., 0])
    turned = np.abs(np.remainder(np.diff(angles, axis=1) + np.pi, 2 * np.pi) - np.pi).sum(axis=1)
    # a span may turn most of its angle within a small part of it
    needed = np.where(
        length > 0.0, np.maximum(length / MAX_SPACING_M, 2.0 * turned / MAX_TURN_RAD), 0.0
    )
    return np.clip(np.ceil(needed).astype(np.int64) + 2, MIN_POINTS, MAX_POINTS)
