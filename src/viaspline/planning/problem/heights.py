"""Heights for a curve that was laid on the ground."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

RAMP: Final = 0.25
"""Part of a leg over which a climb sets in, and over which it ends."""

STEEPEST: Final = 2.0
"""Times as steep as a leg beside it in the mean a curve is at a via point, at most: with such ramps
it is monotone up to that."""

UPRIGHT: Final = 5.0
"""Times as high as it is long on the ground a leg is nearly upright."""

SAME_JOINT: Final = 1e-3
"""Part of a span: a place that is no farther from its end is at its end."""


def climbs_upright(places: Floats) -> bool:
    """Whether a leg climbs or descends much farther than it goes on over the ground.

    Args:
        places: The via points [m], shape (v, 2 + e).

    >>> climbs_upright(np.array([[0.0, 0, 0], [9, 0, 9]])), climbs_upright(np.array([[0.0, 0]]))
    (False, False)
    >>> climbs_upright(np.array([[0.0, 0, 0], [9, 0, 9], [9, 0, 10]]))
    True
    """
    steps = np.diff(places, axis=0)
    on, up = (np.linalg.norm(part, axis=1) for part in (steps[:, :2], steps[:, 2:]))
    return bool((up > UPRIGHT * on).any())


def with_heights(
    spans: Floats, joints: NDArray[np.int64], heights: Floats, closed: bool
) -> tuple[Floats, NDArray[np.int64]]:
    """Spans with further coordinates that run smoothly from via point to via point.

    Between via points they rise or fall without overshoot over the distance on the ground: as steep
    at a via point as Fritsch and Carlson's monotone cubics, but without curvature there, so that
    that doesn't jump. A leg that climbs has a joint where that has set in and one where it ends.

    Args:
        spans: On the ground [m], shape (m, 4, 2).
        joints: The span that begins at each via point, m at the end, shape (v,).
        heights: The other coordinates of each via point [m], shape (v, e).
        closed: Whether the last via point is the first, and the curve goes on there.

    Returns:
        Spans, shape (l, 4, 2 + e), l >= m; and which of them begin where each of the given ones
        did, l at the end, shape (m + 1,).
    """
    if heights.shape[1] == 0:
        return spans, np.arange(len(spans) + 1)
    ground = PiecewiseCubic(spans)
    via_distances = np.asarray(ground.distance(joints.astype(float)))
    climbs = (np.diff(heights, axis=0) != 0.0).any(axis=1)
    ground, begins = _cut(ground, [
        a + part * (b - a)
        for (a, b), climbs_there in zip(pairwise(via_distances.tolist()), climbs, strict=True)
        if climbs_there
        for part in (RAMP, 1.0 - RAMP)
    ])  # fmt: skip
    spans = ground.spans
    along = np.asarray(ground.distance(np.arange(len(spans) + 1.0)))
    along[begins[joints]] = via_distances  # but for rounding
    profile = _profile(via_distances, heights, _via_slopes(via_distances, heights, closed))
    at, slope = profile(along), profile(along, 1)
    first = np.linalg.norm(spans[:, 1] - spans[:, 0], axis=1)[:, None]
    last = np.linalg.norm(spans[:, 3] - spans[:, 2], axis=1)[:, None]
    rows = (at[:-1], at[:-1] + first * slope[:-1], at[1:] - last * slope[1:], at[1:])
    return np.concatenate((spans, np.stack(rows, axis=1)), axis=2), begins


def _cut(curve: PiecewiseCubic, distances: list[float]) -> tuple[PiecewiseCubic, NDArray[np.int64]]:
    """A curve with joints at some distances [m], and where each of its spans begins then, (m + 1,).

    Args:
        curve: Of m spans.
        distances: In order.
    """
    spans = np.arange(len(curve.spans) + 1)
    if not distances:
        return curve, spans
    u = np.asarray(curve.parameter(distances))
    cuts = u[np.abs(u - np.rint(u)) > SAME_JOINT]
    ends = [0.0, *cuts.tolist(), curve.domain[1]]
    parts = [curve.section(first, last).spans for first, last in pairwise(ends)]
    return PiecewiseCubic(np.concatenate(parts)), spans + np.searchsorted(cuts, spans)


def _profile(via_distances: Floats, heights: Floats, slopes: Floats) -> PPoly:
    """Heights over the distance on the ground, with slopes at the via points.

    On a leg the second derivative is 0 at both ends and runs straight to what it is at the end of
    the first ramp and at the beginning of the last one: so that it meets height and slope at its
    end.
    """
    from scipy.interpolate import PPoly

    lengths = np.diff(via_distances)[:, None]
    mean = np.diff(heights, axis=0) / lengths
    over, by = mean - slopes[:-1], slopes[1:] - slopes[:-1]
    area = 0.5 * (1.0 - RAMP) * lengths
    set_in, end = (3.0 * over - by) / area, (2.0 * by - 3.0 * over) / area
    none = np.zeros_like(mean)
    bends = np.stack((none, set_in, end, none))
    parts = np.array([0.0, RAMP, 1.0 - RAMP, 1.0])
    at, slope = heights[:-1], slopes[:-1]
    pieces = []
    for k, part in enumerate(np.diff(parts)):
        width, first, last = part * lengths, bends[k], bends[k + 1]
        pieces.append(np.stack(((last - first) / (6.0 * width), 0.5 * first, slope, at)))
        at = at + width * (slope + width * (2.0 * first + last) / 6.0)
        slope = slope + 0.5 * width * (first + last)
    knots = (via_distances[:-1, None] + parts[:-1] * lengths).ravel()
    coefficients = np.stack(pieces, axis=2).reshape(4, -1, heights.shape[1])
    return PPoly(coefficients, np.append(knots, via_distances[-1]))


def _via_slopes(via_distances: Floats, heights: Floats, closed: bool) -> Floats:
    """How steep the profile is at the via points, (v, e)."""
    from scipy.interpolate import PchipInterpolator

    steps = np.diff(via_distances)
    if closed:  # with the last leg once more before the first, and the first after the last
        steps = np.concatenate((steps[-1:], steps, steps[:1]))
        heights = np.concatenate((heights[-2:-1], heights, heights[1:2]))
    along = np.concatenate(([0.0], np.cumsum(steps)))
    slopes = np.asarray(PchipInterpolator(along, heights)(along, 1))
    most = STEEPEST * np.abs(np.diff(heights, axis=0) / steps[:, None])
    limits = np.concatenate((most[:1], np.minimum(most[1:], most[:-1]), most[-1:]))
    slopes = np.clip(slopes, -limits, limits)
    return slopes[1:-1] if closed else slopes
