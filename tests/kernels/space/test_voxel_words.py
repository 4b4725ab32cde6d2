import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.jit import kernel
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.voxel_words import is_blocked
from viaspline.maps.voxels import Voxels
from viaspline.world.space.spatial_world import SpatialWorld

seeds = st.integers(0, 100_000)


@kernel
def looked_up(space: PackedSpace, cells: np.ndarray) -> np.ndarray:
    found = np.empty(cells.shape[0], np.bool_)
    for k in range(cells.shape[0]):
        found[k] = is_blocked(space, 0, cells[k, 0], cells[k, 1], cells[k, 2])
    return found


def free_level(space: PackedSpace, cell: list[int]) -> int:
    """The coarsest level on which all that shares a cell with a free cube is free."""
    level = 0
    for across, up, deep, first in space.voxel_levels[: space.voxel_starts[1]].tolist():
        i, j, k = (c >> 2 * (level + 1) for c in cell)
        if not (i < across and j < up and k < deep):
            break
        if space.voxel_words[first + i + across * (j + up * k)] != 0:
            break
        level += 1
    return level


@given(seeds)
def test_every_cube_is_what_it_was_and_cells_are_free_where_all_of_theirs_are(seed: int) -> None:
    rng = np.random.default_rng(seed)
    cubes = rng.random(tuple(rng.integers(1, 22, 3).tolist())) < rng.choice([0.0, 0.003, 0.2])
    cells = np.argwhere(np.ones(cubes.shape, bool))
    if len(cells) > 300:
        cells = cells[rng.choice(len(cells), 300, replace=False)]
    space = SpatialWorld.of([Voxels(cubes, 1.0)]).packed
    found = looked_up(space, cells)
    assert (found == cubes[tuple(cells.T)]).all()
    for cell in cells[~found].tolist():
        level = free_level(space, cell)
        if level > 0:
            size = 4**level
            low = [c // size * size for c in cell]
            assert not cubes[tuple(slice(c, c + size) for c in low)].any()
        if max(cubes.shape) > 4 ** (level + 1):
            size = 4 ** (level + 1)
            low = [c // size * size for c in cell]
            assert cubes[tuple(slice(c, c + size) for c in low)].any()


def test_beyond_the_block_nothing_is_blocked() -> None:
    space = SpatialWorld.of([Voxels(np.ones((3, 3, 3), bool), 1.0)]).packed
    cells = np.array([[-1, 0, 0], [3, 0, 0], [0, 0, 4], [2, 2, 2]])
    assert looked_up(space, cells).tolist() == [False, False, False, True]


def test_a_cube_takes_a_bit_and_the_levels_above_it_little_more() -> None:
    cubes = np.zeros((128, 128, 128), bool)
    packed = SpatialWorld.of([Voxels(cubes, 1.0)]).packed
    assert packed.voxel_words.nbytes * 8 < 1.02 * cubes.size


def test_worlds_of_the_same_voxels_share_their_words() -> None:
    voxels = Voxels(np.ones((9, 9, 9), bool), 1.0)
    one, other = SpatialWorld.of([voxels]), SpatialWorld.of([voxels], bounds=(0, 0, 5, 5))
    assert one.packed.voxel_words is other.packed.voxel_words
