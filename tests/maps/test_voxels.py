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
        (np.zeros((1, 1, 1)), 1.0, (0, -1e10, 0), "within 1e"),
        (np.zeros((3, 1, 1)), 1e308, (0, 0, 0), "within 1e"),
        (np.zeros((1, 1, 1)), 1e-320, (0, 0, 0), "or more"),
        (np.broadcast_to(False, (4000, 4000, 4000)), 1.0, (0, 0, 0), "too many"),
        (np.full((1, 1, 1), np.nan), 1.0, (0, 0, 0), "nan, neither 0 nor 1"),
        (np.full((1, 1, 1), 0.3), 1.0, (0, 0, 0), "occupancy > 0.5"),
        (np.full((1, 1, 1), -1), 1.0, (0, 0, 0), "neither 0 nor 1"),
        (np.full((1, 1, 1), None), 1.0, (0, 0, 0), "type object"),
        (np.full((1, 1, 1), "False"), 1.0, (0, 0, 0), "type <U5"),
        (np.zeros((1, 1, 1), complex), 1.0, (0, 0, 0), "type complex"),
        (np.ma.masked_array([[[False]]], True), 1.0, (0, 0, 0), "masked"),
        ([[[1]], [[1, 0]]], 1.0, (0, 0, 0), "no array"),
    ],
)
def test_voxels_that_make_no_space_are_refused(
    cubes: object, cell: float, origin: tuple[float, ...], words: str
) -> None:
    with pytest.raises(GeometryError, match=words):
        Voxels(cubes, cell, origin)  # type: ignore[arg-type]
