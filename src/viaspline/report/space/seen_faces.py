"""Faces of solids as far as a picture in perspective shows them: cut at its box."""

from __future__ import annotations

from itertools import pairwise
from typing import Final

import numpy as np
import shapely

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.solids import RoundedSegment

Face = list[tuple[float, float, float]]
Box = tuple[Floats, Floats]

SIMPLIFIED_M: Final = 0.05
"""How far a wall may stand beside its outline [m]: nobody sees that."""

AROUND: Final = 16
"""Faces around a ball, and half as many from pole to pole."""


def prism_faces(shadow: shapely.Geometry, heights: tuple[float, float], shown: Box) -> list[Face]:
    """Walls and roof of a prism within a box; one that reaches beyond its top has no roof there.

    Args:
        shadow: The prism from above [m].
        heights: From where to where it reaches [m].
        shown: Lowest and highest corner of the box [m], shape (3,) each.

    Example:
        >>> box = (np.zeros(3), np.array([10.0, 10, 5]))
        >>> sides = prism_faces(shapely.box(8, 2, 30, 4), (0.0, 90.0), box)
        >>> len(sides), max(x for side in sides for x, _, _ in side)
        (4, 10.0)
    """
    low, high = max(heights[0], float(shown[0][2])), min(heights[1], float(shown[1][2]))
    if low >= high:
        return []
    seen = shapely.intersection(
        shapely.simplify(shadow, SIMPLIFIED_M), shapely.box(*shown[0][:2], *shown[1][:2])
    )
    faces: list[Face] = []
    for part in shapely.get_parts(seen).tolist():
        if part.geom_type != "Polygon" or part.is_empty:
            continue
        ring = [(float(x), float(y)) for x, y, *_ in part.exterior.coords]
        if heights[1] <= shown[1][2]:
            faces.append([(x, y, high) for x, y in ring])
        for (x0, y0), (x1, y1) in pairwise(ring):
            faces.append([(x0, y0, low), (x1, y1, low), (x1, y1, high), (x0, y0, high)])
    return faces


def ball_faces(ball: RoundedSegment) -> list[Face]:
    """Faces of a ball.

    Example:
        >>> faces = ball_faces(RoundedSegment((0.0, 0.0, 9.0), (0.0, 0.0, 9.0), 2.0))
        >>> len(faces), max(z for face in faces for _, _, z in face)
        (128, 11.0)
    """
    around = np.linspace(0.0, 2.0 * np.pi, AROUND + 1)
    up = np.linspace(-0.5 * np.pi, 0.5 * np.pi, AROUND // 2 + 1)
    wide = np.cos(up)[:, None]
    unit = np.stack(
        (wide * np.cos(around), wide * np.sin(around), np.sin(up)[:, None] + 0.0 * around), axis=-1
    )
    nodes = np.array(ball.first) + ball.radius * unit
    return [
        [tuple(nodes[at].tolist()) for at in ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j))]
        for i in range(AROUND // 2)
        for j in range(AROUND)
    ]


def segment_within(ends: Floats, shown: Box) -> Floats:
    """The part of a segment (2, 3) that lies within a box, shape (2, 3); (0, 3) where none does.

    Args:
        ends: Of the segment [m].
        shown: Lowest and highest corner of the box [m], shape (3,) each.

    Example:
        >>> box = (np.zeros(3), np.full(3, 10.0))
        >>> segment_within(np.array([[-5.0, 5, 5], [5, 5, 5]]), box)
        array([[0., 5., 5.],
               [5., 5., 5.]])
    """
    way = ends[1] - ends[0]
    enters, leaves = 0.0, 1.0
    for k in range(3):
        if way[k] == 0.0:
            if not shown[0][k] <= ends[0, k] <= shown[1][k]:
                return np.zeros((0, 3))
            continue
        shares = sorted(((shown[0][k] - ends[0, k]) / way[k], (shown[1][k] - ends[0, k]) / way[k]))
        enters, leaves = max(enters, shares[0]), min(leaves, shares[1])
    if enters > leaves:
        return np.zeros((0, 3))
    part: Floats = ends[0] + np.array([[enters], [leaves]]) * way
    return part
