"""The path of a drive that was searched, without the jumps of its curvature.

A drive of even thrusts speeds up in another direction from one to the next, so the curve that it
leaves jumps in curvature there. What is driven is the cubic spline through places on that curve.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats

NEAR_M = 1e-3
"""Places that are nearer to each other are one [m]."""


class DrivePlace(NamedTuple):
    """A place on the curve of a drive.

    Attributes:
        at: [m], (2,).
        via: The number of the via point that it is; None: it is none.
        is_thrust: Whether a thrust begins there.
    """

    at: Floats
    via: int | None
    is_thrust: bool


def places_along(drives: Sequence[Floats], pieces: int) -> list[DrivePlace]:
    """Places on the curve of a drive over all legs, in order.

    Args:
        drives: The states over each leg, rows of time [s], x, y [m], vx, vy [m/s].
        pieces: Into so many parts of the same time each thrust is cut.
    """
    places = [DrivePlace(drives[0][0, 1:3], 0, True)]
    for leg, states in enumerate(drives):
        for first, last in pairwise(states):
            cuts = np.linspace(0.0, 1.0, pieces + 1)[1:]
            if first[3:] @ last[3:] < 0.0:  # it turns back
                cuts = np.sort(np.append(cuts, _slowest(first, last)))
            places += [
                DrivePlace(at, None, w == 1.0)
                for w, at in zip(cuts, _cubic(first, last, cuts), strict=True)
            ]
        places[-1] = DrivePlace(drives[leg][-1, 1:3], leg + 1, True)
    return _apart(places)


def _cubic(first: Floats, last: Floats, w: Floats) -> Floats:
    """Places of the cubic between two states, at shares of its time [m], (n, 2)."""
    lasts, rest = last[0] - first[0], 1.0 - w[:, None]
    p, q = first[1:3], last[1:3]
    near, far = p + first[3:] * lasts / 3.0, q - last[3:] * lasts / 3.0
    share = w[:, None]
    found: Floats = (
        rest**3 * p + 3.0 * rest**2 * share * near + 3.0 * rest * share**2 * far + share**3 * q
    )
    return found


def _slowest(first: Floats, last: Floats) -> float:
    """Where the cubic between two states that turns back is slowest, as a share of its time."""
    w = np.linspace(0.0, 1.0, 65)
    speeds = np.hypot(*np.diff(_cubic(first, last, w), axis=0).T)
    return float(w[np.argmin(speeds)] + 0.5 / 64)


def _apart(places: list[DrivePlace]) -> list[DrivePlace]:
    """The places without those that are too near to another; via points stay."""
    kept: list[DrivePlace] = places[:1]
    for place in places[1:]:
        while place.via is not None and kept[-1].via is None and _is_near(place, kept[-1]):
            kept.pop()
        if place.via is not None or not _is_near(place, kept[-1]):
            kept.append(place)
    return kept


def _is_near(one: DrivePlace, other: DrivePlace) -> bool:
    return bool(np.abs(one.at - other.at).max() <= NEAR_M)


def smooth_spans(places: Floats) -> Floats:
    """Bézier control polygons through places, (n - 1, 4, 2), as smooth as cubics can be.

    Where the way turns by more than a right angle it turns on the spot; in between it is the cubic
    spline by the places' distances with no curvature at its ends, so that direction and curvature
    are continuous.

    Args:
        places: [m], (n, 2), n >= 2, none twice behind each other.
    """
    steps = np.diff(places, axis=0)
    back = np.flatnonzero((steps[1:] * steps[:-1]).sum(axis=1) < 0.0) + 1
    ends = [0, *back.tolist(), len(places) - 1]
    return np.concatenate([_spline(places[a : b + 1]) for a, b in pairwise(ends)])


def _spline(places: Floats) -> Floats:
    """The natural cubic spline through places by their distances, as control polygons."""
    steps = np.diff(places, axis=0)
    wide = np.hypot(*steps.T)[:, None]
    slopes = steps / wide
    count = len(places)
    matrix = np.zeros((count, count))
    inner = np.arange(1, count - 1)
    matrix[inner, inner - 1], matrix[inner, inner + 1] = wide[1:, 0], wide[:-1, 0]
    matrix[inner, inner] = 2.0 * (wide[1:, 0] + wide[:-1, 0])
    matrix[0, :2], matrix[-1, -2:] = (2.0, 1.0), (1.0, 2.0)
    right = np.empty((count, 2))
    right[0], right[-1] = 3.0 * slopes[0], 3.0 * slopes[-1]
    right[1:-1] = 3.0 * (wide[1:] * slopes[:-1] + wide[:-1] * slopes[1:])
    tangents = np.linalg.solve(matrix, right)
    p, q = places[:-1], places[1:]
    return np.stack([p, p + tangents[:-1] * wide / 3.0, q - tangents[1:] * wide / 3.0, q], axis=1)
