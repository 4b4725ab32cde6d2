"""How near a path comes to the true world, told by shapely: no kernel of the package is asked."""

from __future__ import annotations

import numpy as np
import shapely
from problems import Problem

CHORD_ERROR_M = 1e-5
"""Between a path's cubics and the chords that stand for them [m]."""


def chords(spans: np.ndarray) -> np.ndarray:
    """Bézier control polygons (m, 4, 2) as lines of short chords, shape (m,)."""
    bends = np.linalg.norm(np.diff(spans, 2, axis=1), axis=2).max(axis=1)
    pieces = np.ceil(np.sqrt(6.0 * bends / (8.0 * CHORD_ERROR_M))).astype(int) + 1
    return np.array(
        [shapely.linestrings(_evaluated(*span)) for span in zip(spans, pieces, strict=True)], object
    )


def _evaluated(span: np.ndarray, pieces: int) -> np.ndarray:
    u = np.linspace(0.0, 1.0, pieces + 1)[:, None]
    weights = (1 - u) ** 3, 3 * u * (1 - u) ** 2, 3 * u * u * (1 - u), u**3
    return sum(w * p for w, p in zip(weights, span, strict=True))


def least_room(spans: np.ndarray, problem: Problem) -> float:
    """Distance of a path from the world, as far as twice what is required [m]."""
    flat = np.ascontiguousarray(np.asarray(spans)[:, :, :2])
    return float(problem.solids.room(chords(flat), 2.0 * problem.required + 1e-3).min())


def ends_missed(spans: np.ndarray, problem: Problem) -> float:
    """How far the path's ends lie from start and goal, the farther one [m]."""
    ends = np.asarray(spans)[[0, -1], [0, 3], :2]
    return float(np.linalg.norm(ends - [problem.start, problem.goal], axis=1).max())
