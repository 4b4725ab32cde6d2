"""A body as a few discs: what a search looks at instead of its outline.

Tested through ``planning/turning/hybrid_astar/test_pose_search``.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import shapely

from viaspline.kernels.arrays import Floats

Corners = tuple[tuple[float, float], ...]

QUARTER_CORNERS = 32  # of a quarter of a disc, as it is reckoned to cover
MAX_AREA_LEFT = 1e-9  # that may be left over, as a share of the body's


@lru_cache(maxsize=32)
def covering_discs(footprint: Corners, overhang: float) -> Floats:
    """Discs that cover a polygon and jut out of it by no more than ``overhang``.

    Greedy: of many discs, the one that covers most of the outline that is left; then whatever is
    left inside.

    Args:
        footprint: Corners about the reference point [m].
        overhang: [m].

    Returns:
        x, y, radius [m], the greatest first, (n, 3); read-only.
    """
    body = shapely.Polygon(footprint)
    shapely.prepare(body)
    centers = _centers(body, overhang)
    radii = np.asarray(shapely.distance(shapely.points(centers), body.exterior)) + overhang
    outline = shapely.get_coordinates(shapely.segmentize(body.exterior, overhang))
    discs = [(*centers[k], radii[k]) for k in _greedy(centers, radii - 0.02 * overhang, outline)]
    rest = body.difference(shapely.union_all([_disc(disc) for disc in discs]))
    while rest.area > MAX_AREA_LEFT * body.area:
        largest = max(shapely.get_parts(rest), key=lambda part: part.area)
        x, y = shapely.get_coordinates(largest.representative_point())[0]
        radius = shapely.distance(shapely.Point(x, y), body.exterior) + overhang
        discs.append((x, y, radius))
        rest = rest.difference(_disc(discs[-1]))
    found = np.array(sorted(discs, key=lambda disc: -disc[2]))
    found.flags.writeable = False
    return found


def _greedy(centers: Floats, radii: Floats, points: Floats) -> list[int]:
    """The discs that cover some points, each the one that covers most of those that are left."""
    from scipy.sparse import csr_array
    from scipy.spatial import cKDTree

    inside = cKDTree(points).query_ball_point(centers, np.maximum(radii, 0.0))
    counts = np.array([len(one) for one in inside])
    ends = np.concatenate(([0], np.cumsum(counts)))
    columns = np.concatenate(inside).astype(np.int64)
    covers = csr_array((np.ones(len(columns)), columns, ends), (len(centers), len(points)))
    covered_by = covers.tocsc()
    chosen: list[int] = []
    left = np.ones(len(points), bool)
    while counts.max() > 0:
        chosen.append(int(counts.argmax()))
        own = columns[ends[chosen[-1]] : ends[chosen[-1] + 1]]
        new = own[left[own]]
        left[new] = False
        counts = counts - covered_by[:, new].sum(axis=1).astype(np.int64)
    return chosen


def _disc(disc: tuple[float, float, float]) -> shapely.Polygon:
    """A polygon inside of a disc."""
    return shapely.Point(disc[:2]).buffer(disc[2], quad_segs=QUARTER_CORNERS)


def _centers(body: shapely.Polygon, overhang: float) -> Floats:
    """Where the middles of discs may be: on the outline moved inwards by ever more, (n, 2)."""
    found = []
    inset = 0.5 * overhang
    while True:
        inner = body.buffer(-inset, join_style="mitre")
        if inner.is_empty:
            break
        spacing = math.sqrt(2.0 * overhang * (inset + overhang)) / 2.0
        found.append(shapely.get_coordinates(shapely.segmentize(inner, spacing)))
        inset *= 1.3
    axis = shapely.maximum_inscribed_circle(body, tolerance=0.1 * overhang)
    depth = axis.length
    thin = body.buffer(-0.98 * depth, join_style="mitre")
    if not thin.is_empty:
        spacing = math.sqrt(2.0 * overhang * depth) / 6.0
        found.append(shapely.get_coordinates(shapely.segmentize(thin, spacing)))
    return np.unique(np.concatenate(found), axis=0)
