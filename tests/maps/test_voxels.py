import copy
import pickle

import numpy as np
import pytest

from viaspline.errors import GeometryError
from viaspline.maps.voxels import Voxels


def test_voxels_that_block_the_same_cubes_are_equal_whatever_file_they_came_from() -> None:
    cubes = np.zeros((2, 3, 4), bool)
    cubes[1, 2, 3] = True
    one = Voxels(cubes, 0.5, source="plant.bt")
    for other in (
        Voxels(cubes.astype(int), 0.5),
        copy.deepcopy(one),
        pickle.loads(pickle.dumps(one)),
    ):
        assert one == other
        assert hash(one) == hash(other)
    assert one != Voxels(cubes, 0.5, (0, 0, 1))
    assert one != Voxels(cubes[::-1], 0.5)


def test_the_array_of_voxels_can_be_written_to_without_changing_them() -> None:
    cubes = np.zeros((2, 2, 2), bool)
    voxels = Voxels(cubes, 1.0)
    cubes[0, 0, 0] = True
    assert not voxels.blocked.any()
    assert "0 blocked" in repr(voxels)


@pytest.mark.parametrize(
    ("cubes", "cell", "origin", "words"),
    [
        (np.zeros((2, 2)), 1.0, (0, 0, 0), "shape"),
        (np.zeros((0, 2, 2)), 1.0, (0, 0, 0), "shape"),
        (np.zeros((5000, 1, 1)), 1.0, (0, 0, 0), "too many"),
        (np.zeros((1, 1, 1)), 0.0, (0, 0, 0), "cell"),
        (np.zeros((1, 1, 1)), np.nan, (0, 0, 0), "cell"),
        (np.zeros((1, 1, 1)), 1.0, (0, 0), "origin"),
        (np.zeros((1, 1, 1)), 1.0, (0, 0, np.inf), "origin"),
    ],
)
def test_voxels_that_make_no_space_are_refused(
    cubes: object, cell: float, origin: tuple[float, ...], words: str
) -> None:
    with pytest.raises(GeometryError, match=words):
        Voxels(cubes, cell, origin)  # type: ignore[arg-type]
