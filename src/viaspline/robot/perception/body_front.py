"""Where beams have to have been for a polygonal body to move on: on all that it newly covers.

Tested through ``robot/perception/test_belief``.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats, Ints

Footprint = tuple[tuple[float, float], ...]


class BodyRim(NamedTuple):
    """Points just outside of a body's outline, in the robot's frame.

    Attributes:
        points: [m], (m, 2).
        normals: Away from the body, (m, 2).
    """

    points: Floats
    normals: Floats


class BodyMotion(NamedTuple):
    """Poses of a body on its way, close together.

    Attributes:
        poses: x, y [m], heading [rad], (n, 3).
        moves: How far it moves ahead [m] and turns [rad] to get into each, (n, 2).
        owners: To which of the places each leads, (n,).
    """

    poses: Floats
    moves: Floats
    owners: Ints


@lru_cache(maxsize=64)
def body_rim(footprint: Footprint, margin: float, gap: float) -> BodyRim:
    """Points about a body's outline.

    Args:
        footprint: The body's corners [m].
        margin: So far outside of it [m].
        gap: From point to point, at most [m].

    Example:
        >>> rim = body_rim(((-1, -1), (1, -1), (1, 1), (-1, 1)), 0.5, 3.0)
        >>> rim.points[:2].tolist(), rim.normals[:2].tolist()
        ([[-1.0, -1.5], [1.0, -1.5]], [[0.0, -1.0], [0.0, -1.0]])
    """
    corners = np.array(footprint, np.float64)
    ends = np.roll(corners, -1, axis=0)
    area = float((corners[:, 0] * ends[:, 1] - corners[:, 1] * ends[:, 0]).sum())
    points, normals = [], []
    for start, end in zip(corners, ends, strict=True):
        along = end - start
        length = math.hypot(*along)
        normal = math.copysign(1.0, area) * np.array((along[1], -along[0])) / length
        share = np.linspace(0.0, 1.0, 1 + max(1, math.ceil(length / gap)))[:, None]
        points.append(start + share * along + margin * normal)
        normals.append(np.broadcast_to(normal, (len(share), 2)))
    return BodyRim(np.concatenate(points), np.concatenate(normals))


def body_motion(path: Path, start: float, along: Floats, reach: float, gap: float) -> BodyMotion:
    """The poses of a body from one place of its path to others, in which it turns little.

    Args:
        path: Its heading is that of its tangent; at a corner it turns on the spot.
        start: Where it is [m].
        along: Distances along the path [m], in order, (n,).
        reach: Of the body about its reference point [m].
        gap: Farther than this no point of it gets by turning from pose to pose [m].
    """
    u = np.asarray(path.parameter(np.append(start, along)))
    places, headings = np.asarray(path.evaluate(u))[:, :2], np.asarray(path.heading(u))
    turns = np.diff(headings)
    turns = np.remainder(turns + math.pi, math.tau) - math.pi
    parts = np.maximum(np.ceil(np.abs(turns) * reach / gap).astype(np.int64), 1)
    owners = np.repeat(np.arange(len(along)), parts)
    nth = np.arange(len(owners)) - np.repeat(np.cumsum(parts) - parts, parts) + 1
    share = nth / parts[owners]
    steps = np.diff(places, axis=0)
    poses = np.empty((len(owners), 3))
    poses[:, :2] = places[:-1][owners] + share[:, None] * steps[owners]
    poses[:, 2] = headings[:-1][owners] + share * turns[owners]
    moves = np.column_stack((np.hypot(*steps.T), turns))[owners]
    return BodyMotion(poses, np.ascontiguousarray(moves), owners)
