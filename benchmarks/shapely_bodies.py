"""Bodies in poses and obstacles as shapely has them, which shares nothing with the planner."""

from __future__ import annotations

import numpy as np
import shapely

import viaspline as vs


def shape_of(obstacle: vs.Obstacle) -> shapely.Geometry:
    """A disc, as a polygon round it, or a polygon."""
    if obstacle.circle is None:
        return shapely.Polygon(obstacle.polygon)
    outside = obstacle.circle.radius / np.cos(np.pi / 512)
    return shapely.Point(obstacle.circle.center).buffer(outside, quad_segs=128)


def bodies_at(footprint, places, headings) -> np.ndarray:
    """A body (k, 2) in poses: its polygon at places (n, 2) [m] with headings (n,) [rad]."""
    x, y = np.array(footprint).T
    places, headings = np.asarray(places), np.asarray(headings)[:, None]
    c, s = np.cos(headings), np.sin(headings)
    corners = (places[:, :1] + c * x - s * y, places[:, 1:2] + s * x + c * y)
    return np.asarray(shapely.polygons(np.stack(corners, axis=-1)))
