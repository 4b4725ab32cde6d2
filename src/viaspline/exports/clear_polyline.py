"""From a proven path to straight lines that are proven as well: few of them, near to it.

Lines inside of a bend are nearer to what the path leads round. Where they don't keep what is
required, their corners are moved away from what is near, as far as the stated error lets them;
where that isn't enough, the lines are made shorter.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.exports.chord_bound import chord_bound, chord_bounds
from viaspline.exports.corner_cut import corner_strays
from viaspline.exports.line_proof import LineProof, LineProver
from viaspline.exports.sparse_vertices import sparse_parameters
from viaspline.kernels.arrays import Flags, Floats, Ints

EXPORT_SLACK_M: Final = 2e-5
"""What the lines may lack of the required clearance: the digits of a file are not endless [m]."""

_MARGIN_M: Final = 2e-6
"""By which corners are moved farther than they have to be [m]."""

_ROW: Final = 32
"""So many lines are proven at once."""

_MAX_MOVES: Final = 16
_MAX_ROUNDS: Final = 10
_STARTS: Final = ((1.0, 1.0), (0.5, 1.0), (0.25, 1.0), (0.1, 1.0), (0.1, 0.0))
"""Of the stated error, what lines are cut with, and how far their corners may be moved then.

A polygonal body turns with its lines: where these are short, a corner that is moved swings it
about, and in a gap that is as wide as it has to be only lines that end on the path itself hold.
"""

_SHORTEST_M: Final = 2e-4
"""Lines shorter than this aren't cut any more: a body of half a metre turns with them by the slack
and no more, where it bends like itself."""


@dataclass(frozen=True, eq=False)
class ClearPolyline:
    """Straight lines along a path.

    Attributes:
        parameters: Of the places of the path that the corners stand for, shape (n,).
        points: The corners [m], shape (n, d).
        chord_error: A proven bound of the distance between lines and path, either way [m].
        proofs: What is proven of each line.
        strays: How far beside each line the vehicle may get about it [m], shape (n - 1,).
        required: Free space that the body has to keep [m].
    """

    parameters: Floats
    points: Floats
    chord_error: float
    proofs: tuple[LineProof, ...]
    strays: Floats
    required: float

    @property
    def clearances(self) -> Floats:
        """What is proven of each line and of a vehicle that cuts its corners [m], (n - 1,)."""
        return np.array([proof.clearance for proof in self.proofs]) - self.strays

    @property
    def holds(self) -> bool:
        """Whether everything keeps what is required."""
        return bool((self.clearances >= self.required - EXPORT_SLACK_M).all())


@dataclass(eq=False)
class _Cutting:
    """What is cut into lines, and how."""

    path: PiecewiseCubic
    prover: LineProver
    chord_error: float
    acceptance: float
    fixed: Floats
    breaks: Floats
    known: dict[bytes, LineProof]

    def bounds(self, u: Floats, points: Floats) -> Floats:
        """The chord error of each line [m], shape (n - 1,)."""
        return chord_bounds(self.path, u, points)

    def judged(self, u: Floats, points: Floats) -> _Judged:
        """What is proven of lines."""
        strays = corner_strays(points, self.acceptance, self.prover.outer)
        distances = np.asarray(self.path.distance(u))
        middles = 0.5 * (distances[:-1] + distances[1:])
        enough = self.prover.required + _MARGIN_M
        proofs: list[LineProof] = []
        # Where no corners are cut many lines are far from everything: rows are proven at once.
        size = 1 if self.acceptance > 0.0 else _ROW
        for first, last in _rows(self.prover.part_at(middles), size):
            whole = self._proof(points, first, last, middles)
            if whole.clearance - float(strays[first:last].max()) >= enough or last == first + 1:
                proofs += [whole] * (last - first)
            else:
                proofs += [self._proof(points, k, k + 1, middles) for k in range(first, last)]
        cleared = np.array([proof.clearance for proof in proofs]) - strays
        return _Judged(tuple(proofs), strays, enough - cleared)

    def _proof(self, points: Floats, first: int, last: int, middles: Floats) -> LineProof:
        """What is proven of the lines from the first one to before the last one."""
        turns = self.prover.footprint is not None  # at the end of the last one
        corners = points[first : last + (2 if turns else 1)]
        key = corners.tobytes() + np.float64(middles[first]).tobytes()
        if key not in self.known:
            self.known[key] = self.prover.proof(corners, float(middles[first]))
        return self.known[key]

    def whole(self, u: Floats, points: Floats) -> ClearPolyline:
        """Lines with all that is proven of them."""
        found = self.judged(u, points)
        error = float(self.bounds(u, points).max())
        required = self.prover.required
        return ClearPolyline(u, points, error, found.proofs, found.strays, required)


def _rows(parts: Ints, size: int) -> Iterator[tuple[int, int]]:
    """Lines in rows of no more than so many, all in one part of the path: from, and to before."""
    first = 0
    for k in range(1, len(parts) + 1):
        if k == len(parts) or k - first == size or parts[k] != parts[first]:
            yield first, k
            first = k


class _Judged(NamedTuple):
    """What is proven of lines, and what each of them lacks [m]."""

    proofs: tuple[LineProof, ...]
    strays: Floats
    lacks: Floats


def polyline_proof(
    path: PiecewiseCubic, prover: LineProver, u: Floats, points: Floats, acceptance: float
) -> ClearPolyline:
    """What is proven of given lines.

    Args:
        path: The path that they stand for.
        prover: What it is proven against.
        u: Parameters of the path that the corners stand for, shape (n,).
        points: The corners [m], shape (n, d).
        acceptance: How near to a corner the vehicle turns to the next one [m].
    """
    return _Cutting(path, prover, 0.0, acceptance, u, u, {}).whole(u, points)


def clear_polyline(
    path: PiecewiseCubic,
    prover: LineProver,
    fixed: Floats,
    breaks: Floats,
    *,
    chord_error: float,
    acceptance: float,
    may_join: Callable[[float, float], bool],
    most: int,
    known: dict[bytes, LineProof],
) -> ClearPolyline:
    """Straight lines along a path that keep what is required, if such are found.

    Args:
        path: The proven path.
        prover: What it is proven against.
        fixed: Parameters of places that the lines have to run through, the ends among them.
        breaks: Parameters where lines end, which may be moved away from the path.
        chord_error: How far from the path they may be [m].
        acceptance: How near to a corner the vehicle turns to the next one [m].
        may_join: What else is asked of each line, by its parameters.
        most: So many corners at most.
        known: What was proven of lines before; it is added to.

    Returns:
        The lines; if they don't hold, the last ones that were tried.
    """
    cutting = _Cutting(path, prover, chord_error, acceptance, fixed, breaks, known)
    for start, moves in _STARTS:
        farthest = moves * chord_error
        found, is_whole = _cut(cutting, start * chord_error, farthest, may_join, most)
        if is_whole or len(found.points) > most:
            break
    return found


def _cut(
    cutting: _Cutting, error: float, farthest: float, may_join: Callable[[float, float], bool],
    most: int,
) -> tuple[ClearPolyline, bool]:  # fmt: skip
    """Lines that are cut with an error, and with less of it where they don't hold.

    Their corners are moved by no more than ``farthest`` [m].
    """

    def near(error: float) -> Callable[[float, float], bool]:
        def allowed(a: float, b: float) -> bool:
            return may_join(a, b) and chord_bound(cutting.path, a, b) <= error

        return allowed

    u = np.array(sparse_parameters(_ends(cutting), near(error)))
    errors = np.full(len(u) - 1, error)
    for _ in range(_MAX_ROUNDS):
        found = _moved(cutting, u, farthest)
        failing = _failing(cutting, found)
        if not failing.any():
            return found, True
        lengths = np.linalg.norm(np.diff(found.points, axis=0), axis=1)
        # Of lines shorter than two radii nothing is known but that radius.
        if len(u) > most or lengths[failing].min() < max(4.0 * cutting.acceptance, _SHORTEST_M):
            break
        parts, kept = [u[:1]], []
        for i, fails in enumerate(failing.tolist()):
            error, ends = float(errors[i]), u[i : i + 2].tolist()
            if fails:
                error *= 0.5
                inner = sparse_parameters(ends, near(error))
                ends = inner if len(inner) > 2 else [ends[0], 0.5 * sum(ends), ends[1]]
            parts.append(np.array(ends[1:]))
            kept += [error] * (len(ends) - 1)
        u, errors = np.concatenate(parts), np.array(kept)
    return found, False


def _ends(cutting: _Cutting) -> list[float]:
    """Parameters where lines end whatever else: no two of them at one place."""
    found = np.union1d(cutting.fixed, cutting.breaks)
    nearest = np.abs(found[:, None] - cutting.fixed[None, :]).min(axis=1)
    return [u for u, apart in zip(found.tolist(), nearest.tolist(), strict=True)
            if apart == 0.0 or apart > 1e-6]  # fmt: skip


def _failing(cutting: _Cutting, found: ClearPolyline) -> Flags:
    """Which lines don't hold."""
    lacks = found.clearances < found.required - 0.25 * EXPORT_SLACK_M
    bounds = cutting.bounds(found.parameters, found.points)
    return np.asarray(lacks | (bounds > cutting.chord_error))


def _moved(cutting: _Cutting, u: Floats, farthest: float) -> ClearPolyline:
    """The lines between places of the path, their corners moved away from what is too near."""
    own = np.asarray(cutting.path.evaluate(u))
    free = ~np.isin(u, cutting.fixed)
    limit = (1.0 - 1e-9) * farthest
    points = own.copy()
    for _ in range(_MAX_MOVES):
        found = cutting.judged(u, points)
        if not (found.lacks > 0.5 * _MARGIN_M).any():
            break
        moved: Floats = points - own + _shifts(found.proofs, found.lacks, free)
        sizes = np.linalg.norm(moved, axis=1)
        moved *= np.divide(limit, sizes, out=np.ones(len(sizes)), where=sizes > limit)[:, None]
        if np.abs(own + moved - points).max() < 1e-9:
            break
        points = own + moved
    return cutting.whole(u, points)


def _shifts(proofs: tuple[LineProof, ...], lacks: Floats, free: Flags) -> Floats:
    """By how much corners are moved so that lines get what they lack [m], shape (n, d)."""
    shifts = np.zeros((len(free), len(proofs[0].at)))
    for i, (proof, lack) in enumerate(zip(proofs, lacks.tolist(), strict=True)):
        if lack <= 0.0 or proof.away is None or not np.isfinite(lack):
            continue
        weights = {i: 1.0 - proof.part, i + 1: proof.part}
        movable = {k: weight for k, weight in weights.items() if free[k] and weight > 0.05}
        total = sum(weight * weight for weight in movable.values())
        for k, weight in movable.items():
            # The least moves of the two corners that move the place between them by what it lacks.
            wanted = lack * weight / total
            got = float(shifts[k] @ proof.away)
            shifts[k] += max(wanted - got, 0.0) * proof.away
    return shifts
