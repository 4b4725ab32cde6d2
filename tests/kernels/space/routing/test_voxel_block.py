"""Voxels in words of bits, against the arrays that they came from."""

import os

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import ndimage

from viaspline.kernels.arrays import Flags
from viaspline.kernels.space.routing.voxel_block import voxel_block

LIMITS = np.array([-np.inf] * 3 + [np.inf] * 3)
shapes = st.tuples(st.integers(1, 19), st.integers(1, 13), st.integers(1, 10))
cubes = shapes.flatmap(
    lambda shape: st.tuples(st.just(shape), st.lists(st.integers(0, 10**6), max_size=4))
)


def blocked_from(shape: tuple[int, int, int], places: list[int]) -> Flags:
    blocked = np.zeros(shape, bool)
    for place in places:
        blocked.flat[place % blocked.size] = True
    return blocked


@settings(max_examples=30)
@given(arrays(bool, st.tuples(st.integers(1, 9), st.integers(1, 9), st.integers(1, 9))))
def test_every_cube_has_its_bit(blocked: Flags) -> None:
    block = voxel_block(blocked, 0.5, (0.0, 0.0, 0.0), LIMITS)
    unpacked = np.zeros(blocked.shape, bool)
    for i, j, k in np.ndindex(blocked.shape):
        word = int(block.words[i // 4, j // 4, k // 4])
        unpacked[i, j, k] = word >> (16 * (i % 4) + 4 * (j % 4) + k % 4) & 1
    np.testing.assert_array_equal(unpacked, blocked)


@settings(max_examples=30)
@given(cubes)
def test_a_skip_is_the_chessboard_distance_of_the_next_word_that_is_not_free(
    drawn: tuple[tuple[int, int, int], list[int]],
) -> None:
    blocked = blocked_from(*drawn)
    block = voxel_block(blocked, 1.0, (0.0, 0.0, 0.0), LIMITS)
    free = block.words == 0
    if free.all():
        assert (block.skips == 255).all()
    else:
        expected = ndimage.distance_transform_cdt(free, "chessboard")
        np.testing.assert_array_equal(block.skips, expected)


@pytest.mark.skipif(os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="a minute without the JIT")
def test_eighty_eight_million_cubes_take_fewer_than_fifteen_million_bytes() -> None:
    blocked = np.zeros((1000, 440, 200), bool)
    blocked[::50, 3, 7] = True
    block = voxel_block(blocked, 1.0, (0.0, 0.0, 0.0), LIMITS)
    assert block.words.nbytes + block.skips.nbytes < 15_000_000
