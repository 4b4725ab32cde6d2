"""The free space between two bodies as a convex function of the offset between them.

The gap of two upright cylinders with margins is the distance of the offset from a cylinder that is
as wide and as high as both together, less both margins: a convex function that changes by no more
than the offset does. So its tangent at any offset bounds it from below everywhere.

Tested through ``space/meeting/test_spatial_crossings``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.fleet.packed_courses import PackedCourses


class BodyPair(NamedTuple):
    """Two bodies together; see `viaspline.mission.space.flying_body`.

    Attributes:
        radius: Of both cylinders [m].
        half_height: Of both [m].
        margin: Of both [m].
    """

    radius: float
    half_height: float
    margin: float

    @classmethod
    def of(cls, bodies: Floats, one: int, other: int) -> BodyPair:
        """Two of some bodies, (n, 3)."""
        return cls(*(bodies[one] + bodies[other]).tolist())

    @property
    def outermost(self) -> float:
        """Reference points that are farther apart [m] have no less than 0 between their bodies."""
        return float(np.hypot(self.radius, self.half_height)) + self.margin


def gaps_of(pair: BodyPair, offsets: Floats) -> Floats:
    """The gap at offsets [m], (n, 3): [m], (n,).

    >>> gaps_of(BodyPair(1.0, 0.5, 0.25), np.array([[4.0, 0, 0], [0, 0, 2.5]])).tolist()
    [2.75, 1.75]
    """
    level = np.maximum(np.hypot(offsets[:, 0], offsets[:, 1]) - pair.radius, 0.0)
    upright = np.maximum(np.abs(offsets[:, 2]) - pair.half_height, 0.0)
    return np.asarray(np.hypot(level, upright) - pair.margin)


def gap_slopes(pair: BodyPair, offsets: Floats) -> Floats:
    """How the gap grows with the offset: subgradients, (n, 3), none longer than 1.

    >>> gap_slopes(BodyPair(1.0, 0.5, 0.25), np.array([[4.0, 0, 0], [0, 0, -2.5], [0, 0, 0]]))
    array([[ 1.,  0.,  0.],
           [ 0.,  0., -1.],
           [ 0.,  0.,  0.]])
    """
    level = np.hypot(offsets[:, 0], offsets[:, 1])
    beyond = np.maximum(level - pair.radius, 0.0)
    over = np.maximum(np.abs(offsets[:, 2]) - pair.half_height, 0.0)
    size = np.hypot(beyond, over)
    some = np.where(size > 0.0, size, 1.0)
    share = beyond / some / np.where(level > 0.0, level, 1.0)
    up = over / some * np.sign(offsets[:, 2])
    return np.column_stack((share * offsets[:, 0], share * offsets[:, 1], up)) + 0.0


class SpatialCourses(NamedTuple):
    """What moves along courses in space, as kernels see them, and how large it is.

    Attributes:
        names: Of what moves.
        packed: The courses, with places of three columns. How far along them something is may be
            any number that grows while it moves.
        bodies: Upright cylinders, radius and half height, and what is kept about them [m], (n, 3).
        there: Whether it is there on its way from each node, (nodes,).
    """

    names: tuple[str, ...]
    packed: PackedCourses
    bodies: Floats
    there: Flags
