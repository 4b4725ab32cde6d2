"""How near segments pass cubes, against samples and scipy."""

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel
from viaspline.kernels.space.routing.voxel_block import VoxelBlock, voxel_block
from viaspline.kernels.space.routing.voxel_segment import (
    cube_on_segment,
    keeps_limits,
    segment_is_free,
)

coordinates = st.floats(-4.0, 5.0)
places = st.tuples(coordinates, coordinates, coordinates)
SIDE = 12


@kernel
def nearest_on(p: Floats, d: Floats) -> tuple[float, float]:
    return cube_on_segment(p[0], p[1], p[2], d[0], d[1], d[2], 0.0, 1.0)


@kernel
def voxels_allow(block: VoxelBlock, first: Floats, last: Floats, radius: float) -> bool:
    if not keeps_limits(block, first[0], first[1], first[2]):
        return False
    if not keeps_limits(block, last[0], last[1], last[2]):
        return False
    size = 1.0 / block.frame[3]
    return segment_is_free(
        block,
        (first[0] - block.frame[0]) * size,
        (first[1] - block.frame[1]) * size,
        (first[2] - block.frame[2]) * size,
        (last[0] - first[0]) * size,
        (last[1] - first[1]) * size,
        (last[2] - first[2]) * size,
        radius * size,
    )


def gap(place: Floats) -> float:
    return float(np.linalg.norm(place - np.clip(place, 0.0, 1.0)))


@given(places, places)
@example((2.0, 0.5, 0.5), (2.0, 0.5, 0.5))
@example((-1.0, -1.0, -1.0), (2.0, 2.0, 2.0))
@example((-1.0, 2.0, 0.5), (2.0, 2.0, 0.5))
def test_the_nearest_place_of_a_segment_is_found(
    first: tuple[float, float, float], last: tuple[float, float, float]
) -> None:
    p, d = np.array(first), np.array(last) - first
    square, t = nearest_on(p, d)
    assert abs(np.sqrt(square) - gap(p + t * d)) < 1e-12
    best = minimize_scalar(lambda s: gap(p + s * d), bounds=(0, 1), options={"xatol": 1e-10})
    assert np.sqrt(square) <= min(best.fun, gap(p), gap(p + d)) + 1e-9


@given(st.integers(0, 2**32), st.sampled_from([0.3, 0.45, 0.5, 0.9, 2.3]), st.floats(0.001, 0.2))
def test_a_segment_is_allowed_just_where_every_place_of_it_is(
    seed: int, radius: float, share: float
) -> None:
    rng = np.random.default_rng(seed)
    blocked = rng.random((SIDE, SIDE, SIDE)) < share
    limits = np.array([-3.0] * 3 + [SIDE + 3.0] * 3)
    block = voxel_block(blocked, 1.0, (0.0, 0.0, 0.0), limits)
    first, last = rng.uniform(-2.5, SIDE + 2.5, (2, 3))
    corners = np.argwhere(blocked).astype(float)
    samples = first + np.linspace(0, 1, 400)[:, None] * (last - first)
    nearest = np.inf
    if len(corners):
        off = samples[:, None] - np.clip(samples[:, None], corners, corners + 1.0)
        nearest = float(np.linalg.norm(off, axis=2).min())
    step = float(np.linalg.norm(last - first)) / 399
    if voxels_allow(block, first, last, radius):
        assert nearest >= radius - 1e-9
    else:
        assert nearest - 0.5 * step < radius


@given(st.integers(0, 2**32))
def test_cubes_of_another_size_elsewhere_are_measured_alike(seed: int) -> None:
    rng = np.random.default_rng(seed)
    blocked = rng.random((6, 7, 8)) < 0.1
    wide = np.array([-np.inf] * 3 + [np.inf] * 3)
    origin = (10.0, -20.0, 3.0)
    block = voxel_block(blocked, 1.0, (0.0, 0.0, 0.0), wide)
    other = voxel_block(blocked, 0.25, origin, wide)
    first, last = rng.uniform(-1, 8, (2, 3))
    assert voxels_allow(block, first, last, 0.4) == voxels_allow(
        other, np.array(origin) + 0.25 * first, np.array(origin) + 0.25 * last, 0.1
    )


def test_a_place_beyond_the_limits_is_not_allowed() -> None:
    block = voxel_block(np.zeros((4, 4, 4), bool), 1.0, (0, 0, 0), np.array([0.5] * 3 + [3.5] * 3))
    assert voxels_allow(block, np.full(3, 0.5), np.full(3, 3.5), 0.5)
    assert not voxels_allow(block, np.full(3, 0.5), np.full(3, 3.6), 0.5)
