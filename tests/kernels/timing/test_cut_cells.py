"""Cells of a curve, and what is known on them, against a dense sampling; small, for no JIT."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

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


MANY = 600
"""Cells, of which ordinary curves of a few metres never need so many."""


@given(
    seed=st.integers(0, 2**32 - 1), dimension=st.sampled_from([2, 3]), far=st.floats(-3.0, 6.0),
    small=st.floats(-20.0, -1.0), same=st.lists(st.booleans(), min_size=4, max_size=4),
    leads_on=st.booleans(),
)  # fmt: skip
def test_spans_of_hardly_any_length_are_few_cells(
    seed: int, dimension: int, far: float, small: float, same: list[bool], leads_on: bool
) -> None:
    rng = np.random.default_rng(seed)
    at = rng.normal(0, 10.0**far, dimension)
    off = 10.0**small * rng.normal(0, 1.0, (4, dimension))
    tiny = at + np.where(np.array(same)[:, None], 0.0, off)
    before = np.linspace(tiny[0] - 5.0 * np.eye(dimension)[0], tiny[0], 4)
    spans = np.array([before, tiny] if leads_on else [tiny])
    rows, cusps = cut_cells.cut_cells(spans, 2.0, 1e-3, 1.0, 4.0, 0.5, 10.0)
    assert len(rows) < MANY
    if leads_on:
        along = fill_cells(spans, rows, cusps)[0]
        assert along[-1] >= 5.0 - 1e-6


def test_a_span_that_is_nothing_but_rounding_has_no_cells() -> None:
    """A leg of no length, laid by a rule that rounds: its inner points were 7e-15 m off."""
    via = np.array([34.17, 48.64, 167.7])
    loop = np.array([via, via, via, via])
    loop[1:3, 1] = np.nextafter(48.64, 0.0)
    spans = np.array([np.linspace(via - [3.9, 4.2, -1.0], via, 4), loop])
    rows, cusps = cut_cells.cut_cells(spans, 2.0, 1e-3, 1.0, 4.0, 0.5, INF)
    assert set(rows[:, cut_cells.SPAN]) == {0.0}
    assert not cusps.any()
