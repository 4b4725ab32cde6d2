"""The polyline of a leg that is laid round something, from via point to via point.

A leg leaves its first via point along a direction and meets its last one along another, each for a
short straight stub, so that what comes before and after joins it without a jump of direction or
curvature. In between it turns at detour via points. A corner is moved outward by as much as its
rounding cuts off, so the curve passes (nearly) through the taut way's corner, on the outside of it:
a detour via point is where the curve is in the middle of that. So is a via point that has a turn.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.corner_polygon import corner_polygon
from viaspline.kernels.space.turned_leg import turned_leg
from viaspline.space.laying.corner_rounding import rounded
from viaspline.space.laying.via_turns import aside_radius, no_turns


@dataclass(frozen=True, eq=False)
class LegPolygon:
    """What one leg is laid through.

    Attributes:
        points: First via point, detour via points and last via point [m], shape (k + 2, d).
        directions: Of the curve at the first and the last, unit vectors, shape (2, d); a row of NaN
            where it is free.
        radii: How gently to turn at the first via point, the detours and the last one: radii of
            curvature to be had if there is room [m], shape (k + 2,).
        turns: At the first and the last via point, in place of a direction; see ``via_turns``,
            (2, 2 d + 3), a row of NaN where there is none.
        close: How close its turns at the first and the last via point may be, where a wide one
            would be a loop [m], (2,); see ``aside_radius``. NaN: as wide as is wanted.
    """

    points: Floats
    directions: Floats
    radii: Floats
    turns: Floats = field(default_factory=lambda: no_turns(2, 3))
    close: Floats = field(default_factory=lambda: np.full(2, np.nan))

    def spans(self) -> tuple[Floats, Floats]:
        """The leg's curve.

        Returns:
            (spans, joints): Bézier control polygons [m], (m, 4, d), and at which of their joints
            the detour via points lie, shape (k,).

        >>> square = np.array([[0.0, 0, 0], [10, 0, 0], [10, 10, 0]])
        >>> leg = LegPolygon(square, np.full((2, 3), np.nan), np.full(3, 2.0))
        >>> spans, joints = leg.spans()
        >>> spans[int(joints[0]), 0].round(3) + 0.0
        array([10.,  0.,  0.])
        """
        return _with_joints(self.curve(), self.points[1:-1])

    def curve(self) -> Floats:
        """The leg's curve alone: Bézier control polygons [m], (m, 4, d)."""
        radii = self._radii()
        if not np.isnan(self.turns[:, -1]).all():
            spans: Floats = turned_leg(self.points, self.directions, radii, self.turns)
            return spans
        polygon, reaches = corner_polygon(self.points, self.directions, radii)
        return rounded(polygon, reaches)

    def _radii(self) -> Floats:
        """How gently it turns: closer where it would go round in a loop, (k + 2,) [m]."""
        if np.isnan(self.close).all():
            return self.radii
        radii = self.radii.copy()
        for end, sign, beside in ((0, 1.0, 1), (-1, -1.0, -2)):
            if not np.isnan(self.close[end]):
                way, apart = sign * self.directions[end], self.points[beside] - self.points[end]
                radii[end] = aside_radius(way, apart, float(radii[end]), float(self.close[end]))
        return radii


def _with_joints(spans: Floats, places: Floats) -> tuple[Floats, Floats]:
    """The spans, and at which of their joints they come nearest to places, in order."""
    joints = np.zeros(len(places))
    last = 0
    for k, place in enumerate(places):
        ends = spans[last:, 3] - place
        last += int(np.argmin((ends * ends).sum(axis=1))) + 1
        joints[k] = last
        last = min(last, len(spans) - 1)
    return spans, joints
