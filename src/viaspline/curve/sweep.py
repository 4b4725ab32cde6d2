"""Where a body has been along a curve, for pictures: outlines and what it sweeps over."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from viaspline.curve.bending import SMOOTH_JUMP_RAD, corner_angles
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.world.outline import outline

MAX_POSES = 200_000


def footprints_along(curve: PiecewiseCubic, footprint: ArrayLike, spacing: float) -> Floats:
    """Outlines of a body at equal distances along a curve, both ends among them.

    Args:
        curve: A curve of two dimensions or more; its ground track counts.
        footprint: The body, x forward and y left, (k, 2) [m]; see ``viaspline.world.outline``.
        spacing: Largest distance from one to the next along the curve [m].

    Returns:
        Corners [m], (n, k, 2).

    Raises:
        GeometryError: See ``sample`` and ``outline``.

    Example:
        >>> curve = PiecewiseCubic([[(0, 0), (0, 1), (0, 2), (0, 3)]])
        >>> footprints_along(curve, [(-1, -1), (2, 0), (-1, 1)], 3.0).round(6)[1]
        array([[ 1.,  2.],
               [ 0.,  5.],
               [-1.,  2.]])
    """
    u, _, points = curve.sample(spacing)
    return placed(outline(footprint), points[:, :2], np.asarray(curve.heading(u)))


def swept_parts(
    curve: PiecewiseCubic,
    footprint: ArrayLike | None = None,
    tolerance: float = 0.02,
    *,
    radius: float = 0.0,
) -> NDArray[np.object_]:
    """What a body covers along a curve, turns on the spot among it: a little too much, never less.

    Polygons that together are all of it; their union takes far longer than they do. The body, or
    its edges if it is not convex, are joined from pose to pose; poses stand so close that what lies
    beyond the hull of two neighbours is less than half the tolerance, by which the hulls are grown.

    Args:
        curve: A curve of two dimensions or more; its ground track counts.
        footprint: The body, x forward and y left, (k, 2) [m]; none is a point.
        tolerance: How much too far out the outline may lie [m].
        radius: A disc that the body is grown by, or the body itself [m].

    Returns:
        Shapely polygons, shape (n,).

    Raises:
        GeometryError: When tolerance or radius make no sense, or so small a tolerance takes more
            than 200,000 poses; and see ``outline``.

    Example:
        >>> curve = PiecewiseCubic([[(0, 0), (1, 0), (2, 0), (3, 0)]])
        >>> parts = swept_parts(curve, [(-1, -1), (1, -1), (1, 1), (-1, 1)], 0.01)
        >>> bool(10.0 <= shapely.union_all(parts).area < 10.2)
        True
    """
    if not (tolerance > 0.0 and math.isfinite(tolerance)) or not radius >= 0.0:
        raise GeometryError(f"tolerance {tolerance} has to be above 0, radius {radius} 0 or more")
    if footprint is None:
        at, _ = _poses(curve, 0.0, 0.5 * tolerance)
        line = shapely.LineString(at)
        around = line.buffer(radius + 0.5 * tolerance, quad_segs=_segments(radius, tolerance))
        return np.array([around], object)
    body = outline(footprint)
    reach = float(np.hypot(body[:, 0], body[:, 1]).max())
    at, heading = _poses(curve, reach, 0.5 * tolerance)
    convex = shapely.Polygon(body).convex_hull.area <= shapely.Polygon(body).area * (1 + 1e-9)
    edges = np.stack((body, np.roll(body, -1, axis=0)), axis=1)
    hulls: list[Any] = [shapely.polygons(placed(body, at[:1], heading[:1]))]
    for part in [body] if convex else edges:  # nothing is covered that no edge has swept over
        corners = placed(part, at, heading)
        pairs = np.concatenate((corners[:-1], corners[1:]), axis=1)
        hulls.append(shapely.convex_hull(shapely.multipoints(pairs)))
    grown = radius + 0.5 * tolerance
    # each by itself: the union of slivers, edges that slide along themselves, would lose parts
    return shapely.buffer(np.concatenate(hulls), grown, quad_segs=_segments(radius, tolerance))


def _segments(radius: float, tolerance: float) -> int:
    """Segments of a quarter circle, so that its chords stay outside of what they stand for."""
    sag = 0.25 * tolerance / (radius + 0.5 * tolerance)
    return max(4, math.ceil(math.pi / (4.0 * math.acos(max(1.0 - sag, 0.0)))))


def placed(body: Floats, at: Floats, heading: Floats) -> Floats:
    """Corners (k, 2) of a body in poses, at (n, 2) [m] and heading (n,) [rad]: (n, k, 2)."""
    c, s = np.cos(heading)[:, None], np.sin(heading)[:, None]
    x, y = body[:, 0], body[:, 1]
    return np.stack((c * x - s * y, s * x + c * y), axis=-1) + at[:, None, :]


def _poses(curve: PiecewiseCubic, reach: float, tolerance: float) -> tuple[Floats, Floats]:
    """Places (n, 2) and headings (n,): between neighbours hulls miss less than half the tolerance.

    Halved until neither the middle of the path nor the turn between neighbours is too far off.
    """
    u = _first_parameters(curve, tolerance)
    widest = 2.0 * math.acos(max(1.0 - 0.25 * tolerance / max(reach, tolerance), 0.0))
    while True:
        at = curve.evaluate(u)[:, :2]
        heading = np.unwrap(np.asarray(curve.heading(u)))
        middle = curve.evaluate(0.5 * (u[:-1] + u[1:]))[:, :2]
        off = np.hypot(*(middle - 0.5 * (at[:-1] + at[1:])).T)
        turn = np.abs(np.diff(heading))
        joint = u[1:] == np.round(u[1:])  # the heading there is that of the next span
        coarse = (off > 0.25 * tolerance) | ((turn > widest) & ~joint)
        coarse |= joint & (np.hypot(*np.diff(at, axis=0).T) > 0.25 * tolerance) & (turn > widest)
        coarse &= np.diff(u) > 1e-9
        if not coarse.any():
            break
        if len(u) > MAX_POSES:
            raise GeometryError(f"a tolerance of {tolerance} takes more than {MAX_POSES} poses")
        u = np.sort(np.concatenate((u, 0.5 * (u[:-1] + u[1:])[coarse])))
    return _with_turns(curve, at, heading, widest)


def _first_parameters(curve: PiecewiseCubic, tolerance: float) -> Floats:
    """Where poses stand at first: eight to a span, fewer to one that is as short as a tolerance."""
    edges = np.diff(np.asarray(curve.spans)[:, :, :2], axis=1)
    longest = np.hypot(edges[..., 0], edges[..., 1]).sum(axis=1)
    counts = np.clip(np.ceil(longest / tolerance), 1, 8).astype(int)
    whole = [k + np.arange(count) / count for k, count in enumerate(counts.tolist())]
    first, last = curve.domain
    return np.append(first + np.concatenate(whole), last)


def _with_turns(
    curve: PiecewiseCubic, at: Floats, heading: Floats, widest: float
) -> tuple[Floats, Floats]:
    """Poses with more between neighbours that turn too far: the turns on the spot."""
    turn = np.diff(heading)
    turn[np.abs(turn) > math.pi - 1e-6] = math.tau  # back: either way round
    steps = np.maximum(1, np.ceil(np.abs(turn) / widest - 1e-9).astype(int))
    first = np.repeat(np.arange(len(steps)), steps)
    share = np.concatenate([np.arange(1, n + 1) / n for n in steps])
    places = np.vstack((at[:1], at[first] + share[:, None] * np.diff(at, axis=0)[first]))
    headings = np.append(heading[0], heading[first] + share * turn[first])
    if curve.closed and corner_angles(curve)[-1] > SMOOTH_JUMP_RAD:
        over = math.remainder(heading[0] - heading[-1], math.tau)
        spin = np.linspace(0.0, 1.0, max(2, math.ceil(abs(over) / widest) + 1))
        places = np.vstack((np.repeat(at[:1], len(spin), axis=0), places))
        headings = np.append(heading[0] - over + spin * over, headings)
    return places, headings
