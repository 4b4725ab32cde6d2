"""The polyline of a leg that is laid round something, from via point to via point.

A leg leaves its first via point along a direction and meets its last one along another, each for a
short straight stub, so that what comes before and after joins it without a jump of direction or
curvature. In between it turns at detour via points. A corner is moved outward by as much as its
rounding cuts off, so the curve passes (nearly) through the taut way's corner, on the outside of it:
a detour via point is where the curve is in the middle of that.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.space.laying.corner_rounding import (
    SHARPEST_TURN,
    STRAIGHT,
    cut,
    reach_of_radius,
    rounded,
    turning,
)

STUB_SHARE = 0.4
"""Of the way to the next corner that the stub at a via point may take."""

LEAST_STUB = 1e-6
"""Of that way it always takes this much, so that a direction is kept however tight it gets."""

_SETTLING = 8
"""How often corners are moved outward by what their rounding cuts off, which that changes."""


@dataclass(frozen=True, eq=False)
class LegPolygon:
    """What one leg is laid through.

    Attributes:
        points: First via point, detour via points and last via point [m], shape (k + 2, d).
        directions: Of the curve at the first and the last, unit vectors, shape (2, d); a row of NaN
            where it is free.
        radii: How gently to turn at the first via point, the detours and the last one: radii of
            curvature to be had if there is room [m], shape (k + 2,).
    """

    points: Floats
    directions: Floats
    radii: Floats

    def tightened(self, corner: int, share: float) -> LegPolygon:
        """This leg, turning more tightly at one of its points."""
        radii = self.radii.copy()
        radii[corner] *= share
        return replace(self, radii=radii)

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
        middle = self.points[1:-1]
        corners = middle
        for _ in range(_SETTLING if len(middle) else 0):
            polygon, reaches, first = self._polygon(corners)
            turns = turning(polygon)[first : first + len(middle)]
            own = reaches[first : first + len(middle)]
            corners = middle + _outward(polygon, first, len(middle)) * _cuts(own, turns)[:, None]
        polygon, reaches, first = self._polygon(corners)
        spans = rounded(polygon, reaches)
        return _with_joints(spans, middle)

    def _polygon(self, corners: Floats) -> tuple[Floats, Floats, int]:
        """The polyline with its stubs, reaches of its corners, and where its detours begin."""
        parts, radii = [self.points[:1], corners, self.points[-1:]], [self.radii[1:-1]]
        first = 0
        for end in (0, 1):
            way = self.directions[end]
            if np.isnan(way).any():
                continue
            via = self.points[-end]
            beside = np.concatenate((corners, self.points[-1:] if end == 0 else self.points[:1]))
            apart = beside[0 if end == 0 else len(corners) - 1 if len(corners) else 0] - via
            stub = _stub(apart, way if end == 0 else -way, float(self.radii[-end]))
            place = (via + stub * (way if end == 0 else -way))[None]
            if end == 0:
                parts.insert(1, place)
                radii.insert(0, self.radii[:1])
                first = 1
            else:
                parts.insert(len(parts) - 1, place)
                radii.append(self.radii[-1:])
        polygon = np.concatenate(parts)
        wanted = np.concatenate(radii)
        return polygon, _reaches(polygon, wanted), first


def _stub(apart: Floats, way: Floats, radius: float) -> float:
    """How far to go straight from a via point [m], towards what lies apart from it."""
    distance = float(np.linalg.norm(apart))
    cosine = float(np.clip(apart @ way / distance, -1.0, 1.0)) if distance > 0.0 else 1.0
    turn = min(float(np.arccos(cosine)), SHARPEST_TURN)
    return min(STUB_SHARE * distance, max(reach_of_radius(radius, turn), LEAST_STUB * distance))


def _reaches(polygon: Floats, radii: Floats) -> Floats:
    """How far the rounding of each inner corner reaches [m], none into another one's."""
    if len(polygon) < 3:
        return np.empty(0)
    turns = turning(polygon)
    wanted = np.array(
        [
            reach_of_radius(radius, turn) if STRAIGHT < turn < SHARPEST_TURN else 0.0
            for radius, turn in zip(radii.tolist(), turns.tolist(), strict=True)
        ]
    )
    sides = np.linalg.norm(np.diff(polygon, axis=0), axis=1)
    both = np.concatenate(([0.0], wanted)) + np.concatenate((wanted, [0.0]))
    share = np.minimum(1.0, np.divide(sides, both, out=np.ones_like(sides), where=both > 0.0))
    return np.asarray(wanted * np.minimum(share[:-1], share[1:]))


def _cuts(reaches: Floats, turns: Floats) -> Floats:
    pairs = zip(reaches.tolist(), turns.tolist(), strict=True)
    return np.array([cut(reach, turn) for reach, turn in pairs])


def _outward(polygon: Floats, first: int, count: int) -> Floats:
    """Unit vectors at corners of a polyline, away from the side to which it turns."""
    ways = np.diff(polygon, axis=0)
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    out = ways[first : first + count] - ways[first + 1 : first + count + 1]
    lengths = np.linalg.norm(out, axis=1)[:, None]
    return np.asarray(np.divide(out, lengths, out=np.zeros_like(out), where=lengths > STRAIGHT))


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
