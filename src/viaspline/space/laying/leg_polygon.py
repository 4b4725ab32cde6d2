"""The polyline of a leg that is laid round something, from via point to via point.

A leg leaves its first via point along a direction and meets its last one along another, each for a
short straight stub, so that what comes before and after joins it without a jump of direction or
curvature. In between it turns at detour via points. A corner is moved outward by as much as its
rounding cuts off, so the curve passes (nearly) through the taut way's corner, on the outside of it:
a detour via point is where the curve is in the middle of that. So is a via point that has a turn.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.space.corner_polygon import corner_polygon
from viaspline.space.laying.corner_rounding import rounded
from viaspline.space.laying.via_turns import no_turns, turn_from, turn_to

GENTLER: Final = 100.0
"""Than the turn at a via point itself is what is left to turn behind it, if there is room."""

STRAIGHT: Final = 2e-6
"""What is left to turn there by less than that [rad] isn't: bends of micrometres are noise."""


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
    """

    points: Floats
    directions: Floats
    radii: Floats
    turns: Floats = field(default_factory=lambda: no_turns(2, 3))

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
        turned = ~np.isnan(self.turns[:, -1])
        if not turned.any():
            polygon, reaches = corner_polygon(self.points, self.directions, self.radii)
            return rounded(polygon, reaches)
        begun, ended, between = self._after_turns(turned)
        polygon, reaches = corner_polygon(*between)
        if turned[0] and _turn(polygon[:3]) < STRAIGHT:
            between[1][0] = np.nan
        if turned[1] and _turn(polygon[-3:]) < STRAIGHT:
            between[1][1] = np.nan
        if np.isnan(between[1][turned]).any():
            polygon, reaches = corner_polygon(*between)
        return np.concatenate((begun, rounded(polygon, reaches), ended))

    def _after_turns(self, turned: Flags) -> tuple[Floats, Floats, tuple[Floats, Floats, Floats]]:
        """What the leg has of turns at both its ends, and what is between.

        Args:
            turned: At which of its ends it has one, (2,).
        """
        points, directions, radii = self.points.copy(), self.directions.copy(), self.radii.copy()
        begun = ended = np.empty((0, 4, points.shape[1]))
        if turned[0]:
            span = turn_from(self.points[0], self.turns[0], self.points[1], float(radii[0]))
            begun, points[0], directions[0] = span[None], span[3], _way(span[2], span[3])
            radii[0] *= GENTLER
        if turned[1]:
            span = turn_to(self.points[-1], self.turns[1], self.points[-2], float(radii[-1]))
            ended, points[-1], directions[1] = span[None], span[0], _way(span[0], span[1])
            radii[-1] *= GENTLER
        return begun, ended, (points, directions, radii)


def _turn(points: Floats) -> float:
    """By how much a way through three places turns at the second one [rad], nearly, if little."""
    into, out = _way(points[0], points[1]), _way(points[1], points[2])
    return float(np.linalg.norm(out - into))


def _way(first: Floats, last: Floats) -> Floats:
    """The direction from one place to another."""
    return np.asarray((last - first) / np.linalg.norm(last - first))


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
