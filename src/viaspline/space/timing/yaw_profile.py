"""Which way a body in space faces along its path.

The heading is linear between the nodes of a profile. That is what is flown, so its rate is known
exactly.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.presentable.compared_by_value import ComparedByValue

NODES_PER_SPAN: Final = 24

SAME_PLACE_M: Final = 1e-9

LEAST_TURN: Final = 1e-3
"""What turns by less [rad] from one span to the next goes on straight."""

UPRIGHT: Final = 1e-6
"""Where the level part of the unit tangent is smaller, the heading is the one before."""


@dataclass(frozen=True, eq=False)
class YawProfile(ComparedByValue):
    """Headings along a path.

    Attributes:
        distances: Of the nodes along the path [m], not decreasing, shape (n,); two nodes at one
            place are a turn on the spot.
        headings: There [rad], anticlockwise from x, going on beyond pi, shape (n,).
    """

    distances: Floats
    headings: Floats

    def at(self, distances: ArrayLike) -> Floats:
        """Headings at distances along the path [m]: [rad], shape of the distances."""
        return np.asarray(np.interp(np.asarray(distances, float), self.distances, self.headings))

    @property
    def turns(self) -> tuple[tuple[float, float], ...]:
        """Turns on the spot: where [m] and by how much [rad]."""
        jumps = np.flatnonzero(np.diff(self.distances) == 0.0)
        by = np.diff(self.headings)[jumps]
        places = zip(self.distances[jumps].tolist(), by.tolist(), strict=True)
        return tuple((at, turn) for at, turn in places if turn != 0.0)


@dataclass(frozen=True)
class FacingAlong:
    """The body faces where it goes; on an upright leg where it went before."""

    def headings(self, places: Floats, ways: Floats) -> Floats:
        """Of places [m], (n, 3), and unit tangents, (n, 3): [rad], (n,)."""
        return _held(ways[:, :2], UPRIGHT)


@dataclass(frozen=True)
class FacingPlace:
    """The body faces a place.

    Attributes:
        x: [m].
        y: [m].
    """

    x: float
    y: float

    def headings(self, places: Floats, ways: Floats) -> Floats:
        """Of places [m], (n, 3), and unit tangents, (n, 3): [rad], (n,)."""
        return _held(np.array([self.x, self.y]) - places[:, :2], SAME_PLACE_M)


@dataclass(frozen=True)
class FacingFixed:
    """The body keeps one heading.

    Attributes:
        heading: [rad].
    """

    heading: float

    def headings(self, places: Floats, ways: Floats) -> Floats:
        """Of places [m], (n, 3), and unit tangents, (n, 3): [rad], (n,)."""
        return np.full(len(places), self.heading)


Facing = FacingAlong | FacingPlace | FacingFixed


def _held(ways: Floats, least: float) -> Floats:
    """Headings of ways in plan (n, 2): [rad], (n,); of those no longer than ``least`` the last one.

    At the beginning that is the first one there is, and 0 where there is none.
    """
    known = np.hypot(ways[:, 0], ways[:, 1]) > least
    if not known.any():
        return np.zeros(len(ways))
    last = np.maximum.accumulate(np.where(known, np.arange(len(ways)), -1))
    taken = np.where(last < 0, int(np.argmax(known)), last)
    return np.asarray(np.arctan2(ways[taken, 1], ways[taken, 0]))


def yaw_profile(
    path: Path, facing: Facing, looks: Sequence[tuple[int, tuple[float, float]]] = ()
) -> YawProfile:
    """The headings along a path.

    At a via point from which something is looked at, the body faces that; on its way from the via
    point before and to the one after, it turns there and back evenly with the distance.

    Args:
        path: In space.
        facing: What it does where nothing is looked at.
        looks: Which of the path's via points of the route look at what: their places among them,
            and x, y [m].

    >>> from viaspline.curve.path import PathVia
    >>> line = [[0, 0, 5], [3, 0, 5], [6, 0, 5], [9, 0, 5]]
    >>> ends = [PathVia("start", (0, 0, 5), "user", 0.0, index=0),
    ...         PathVia("goal", (9, 0, 5), "user", 1.0, index=1)]
    >>> profile = yaw_profile(Path([line], ends), FacingAlong(), [(1, (9.0, 4.0))])
    >>> profile.at([0.0, 4.5, 9.0]).round(3)
    array([0.   , 0.785, 1.571])
    """
    count = len(path.spans)
    shares = np.linspace(0.0, 1.0, NODES_PER_SPAN + 1)
    u = np.arange(float(count))[:, None] + shares
    places = path.evaluate(u.ravel())
    ways = _tangents(path.spans, shares)
    at = np.asarray(path.distance(u.ravel()))
    headings = _going_on(facing.headings(places, ways))
    stops = path.stops
    for index, (x, y) in looks:
        via, here = stops[index]
        toward = float(FacingPlace(x, y).headings(np.asarray([via.at]), ways[:1])[0])
        first = round(via.u) * (NODES_PER_SPAN + 1)  # of the nodes behind the via point
        if index > 0:
            share = _between(at[:first], stops[index - 1][1], here)
            headings = _looking(headings, slice(0, first), share, first - 1, toward)
        if index + 1 < len(stops):
            share = 1.0 - _between(at[first:], here, stops[index + 1][1])
            headings = _looking(headings, slice(first, None), share, first, toward)
        if 0 < first < len(at):  # it stands as it looks, even where its path turns back
            headings[first:] += _whole_turns(headings[first - 1] - headings[first])
    return _without_rounding(at, headings)


def _going_on(headings: Floats) -> Floats:
    """Headings [rad] that go on beyond pi; most paths never turn that way."""
    steps = np.abs(np.diff(headings))
    return headings if steps.max(initial=0.0) < math.pi else np.unwrap(headings)


def _looking(headings: Floats, part: slice, share: Floats, here: int, toward: float) -> Floats:
    """Headings turned by their shares of what is left at a node to face something [rad]."""
    turned = headings.copy()
    turned[part] += math.remainder(toward - headings[here], 2.0 * math.pi) * share
    return turned


def _whole_turns(angle: float) -> float:
    """The whole turns that are nearest to an angle [rad]."""
    return 2.0 * math.pi * round(angle / (2.0 * math.pi))


def _without_rounding(at: Floats, headings: Floats) -> YawProfile:
    """A profile that turns on the spot only where the curve has a corner.

    Where a span begins, its first node is its predecessor's last, but for the rounding of either.
    """
    at = np.maximum.accumulate(at)
    starts = np.flatnonzero(np.diff(at) <= SAME_PLACE_M) + 1
    jumps = np.abs(headings[starts] - headings[starts - 1])
    smooth = starts[jumps <= LEAST_TURN]
    at[starts] = at[starts - 1]
    keep = np.ones(len(at), bool)
    keep[smooth] = False
    return YawProfile(at[keep], headings[keep])


def _tangents(spans: Floats, shares: Floats) -> Floats:
    """Unit tangents of spans (m, 4, 3) at shares of each, (n,): (m * n, 3); at ends from within."""
    sides = np.diff(spans, axis=1)[:, :, None]
    w = np.clip(shares, 1e-9, 1.0 - 1e-9)[:, None]
    ways = (1 - w) ** 2 * sides[:, 0] + 2 * w * (1 - w) * sides[:, 1] + w * w * sides[:, 2]
    sizes = np.linalg.norm(ways, axis=2)[:, :, None]
    unit = np.divide(ways, sizes, out=np.zeros_like(ways), where=sizes > 0.0)
    return np.asarray(unit.reshape(-1, 3))


def _between(at: Floats, first: float, last: float) -> Floats:
    """0 up to a first place, 1 from a last one on, linear between."""
    if last <= first:
        return np.where(at < last, 0.0, 1.0)
    return np.asarray(np.clip((at - first) / (last - first), 0.0, 1.0))
