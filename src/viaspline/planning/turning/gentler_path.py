"""A path that bends less than lines and turns, where a part of the length buys that.

Tested through ``planning/methods/test_bent_gently``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import STRIP_S
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.gentle_strip import GENTLE_SHARE, gentle_strip
from viaspline.planning.turning.laid_turns import through_spans

LEAST_GENTLER = 0.02  # of the bending, that has to be saved
STRAIGHT = 1e-9  # bending times length, of what need not bend less
TIME_KNOWN = 1e-3  # of a driven time: it is known so well
SAME_WAY = 1.02  # length of a path over that of the shortest taut one, which it may go along
JUMP_RAD = 1e-6  # of a heading between spans, that is one
SAMPLES = np.array([0.1127016653792583, 0.5, 0.8872983346207417])  # Gauss-Legendre of 3 points
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0


def gentler_path(problem: DrivenProblem, laid: SplinePath) -> SplinePath | None:
    """A clear path on the same sides that bends less; None where there is none.

    That is for a disc whose path is chosen by time, and for no path that keeps to the lines
    between via points, has given headings, or comes back to its start.

    Args:
        problem: What is to be driven.
        laid: A path that serves it.
    """
    if not _may_be_bent(problem, laid):
        return None
    problem.requirements.spend(STRIP_S)
    flat, shortest = np.ascontiguousarray(laid.spans[:, :, :2]), problem.shortest_row.length
    length, before = laid.length, bending(flat)
    if before * length < STRAIGHT:
        return None
    taut = shortest if length <= SAME_WAY * shortest else length / (1.0 + GENTLE_SHARE)
    strip = gentle_strip(flat, laid.joints, problem.world, problem.requirements.required, taut)
    if strip is None or bending(strip.spans) > (1.0 - LEAST_GENTLER) * before:
        return None
    detours = strip.touches.tolist()
    found = through_spans(problem.sequence, strip.spans, strip.joints, detours)
    latest = (1.0 + GENTLE_SHARE + TIME_KNOWN) * problem.cost(laid)
    if not problem.is_drivable(strip.spans) or not problem.keeps_sides(found):
        return None
    return found if problem.cost(found) <= latest else None


def _may_be_bent(problem: DrivenProblem, laid: SplinePath) -> bool:
    needs, sequence = problem.requirements, problem.sequence
    if needs.footprint is not None or not needs.objective.is_time or needs.has_own_tension:
        return False
    has_headings = sequence.start_tangent is not None or sequence.end_tangent is not None
    if has_headings or sequence.closed or problem.keeps_lanes:
        return False
    along = laid.spans[1:, 1, :2] - laid.spans[1:, 0, :2]
    before = laid.spans[:-1, 3, :2] - laid.spans[:-1, 2, :2]
    across = before[:, 0] * along[:, 1] - before[:, 1] * along[:, 0]
    return bool((np.abs(np.arctan2(across, (before * along).sum(axis=1))) < JUMP_RAD).all())


def bending(spans: Floats) -> float:
    """The integral of the squared curvature along planar spans (m, 4, 2) [1/m].

    Example:
        >>> line = np.array([[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]])
        >>> bending(line)
        0.0
    """
    a, b, c = np.moveaxis(3.0 * np.diff(spans, axis=1), 1, 0)[..., None]
    w, v = SAMPLES, 1.0 - SAMPLES
    first = v * v * a + 2.0 * v * w * b + w * w * c
    second = 2.0 * (v * (b - a) + w * (c - b))
    speed = np.hypot(first[:, 0], first[:, 1])
    cross = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    return float((WEIGHTS * cross**2 / speed**5).sum())
