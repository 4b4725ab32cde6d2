"""Cells of a curve, and what is known on them, against a dense sampling; small, for no JIT."""

from __future__ import annotations

import numpy as np
import pytest

from viaspline.kernels.timing import cut_cells
from viaspline.kernels.timing.cell_frames import fill_cells

INF = np.inf


def laid(seed: int, dimension: int = 2) -> np.ndarray:
    rng = np.random.default_rng(seed)
    way = np.linspace(0, 9, 4)[:, None] * np.eye(dimension)[0]
    return (way + rng.normal(0, 1.0, (4, dimension)))[None]


def bernstein(c: np.ndarray, x: np.ndarray) -> np.ndarray:
    y = 1 - x
    return y * y * c[..., :1] + 2 * x * y * c[..., 1:2] + x * x * c[..., 2:]


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("dimension", [2, 3])
def test_tangent_and_curvature_are_as_near_as_it_is_said(seed: int, dimension: int) -> None:
    span = laid(seed, dimension)
    rows, cusps = cut_cells.cut_cells(span, 2.0, 1e-3, 1.0, 4.0, 0.5, INF)
    along, _, tangents, bends, rests = fill_cells(span, rows, cusps)
    assert not cusps.any()
    assert not rests.any()
    assert rows[0, cut_cells.FIRST] == 0.0
    assert rows[-1, cut_cells.LAST] == 1.0
    c = 3 * np.diff(span[0], axis=0)
    for k in range(0, len(rows), 3):
        u = np.linspace(rows[k, cut_cells.FIRST], rows[k, cut_cells.LAST], 201)[:, None]
        d1 = (1 - u) ** 2 * c[0] + 2 * u * (1 - u) * c[1] + u * u * c[2]
        d2 = 2 * ((1 - u) * (c[1] - c[0]) + u * (c[2] - c[1]))
        speed = np.linalg.norm(d1, axis=1, keepdims=True)
        tangent = d1 / speed
        bend = (d2 - (tangent * d2).sum(1, keepdims=True) * tangent) / speed**2
        s = np.concatenate(
            ([0], np.cumsum(0.5 * (speed[1:, 0] + speed[:-1, 0]) * np.diff(u[:, 0])))
        )
        assert s[-1] == pytest.approx(along[k + 1] - along[k], rel=1e-4)
        x = s / s[-1]
        slip = 1e-9
        off = np.abs(bernstein(tangents[k], x).T - tangent).max()
        assert off <= rows[k, cut_cells.MISS_T] + slip
        off = np.abs(bernstein(bends[k], x).T - bend).max()
        assert off <= rows[k, cut_cells.MISS_K] + 1e-4 * slip + 1e-6
