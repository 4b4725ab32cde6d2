"""Rectangles and portals of random lattices, against what they are said to be."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import ndimage

from viaspline.kernels.arrays import Bytes
from viaspline.kernels.routing.navmesh.rectangles import (
    BOTTOM,
    FIRST_ABOVE,
    FIRST_BELOW,
    HEIGHT,
    LEFT,
    OVER,
    PIECE,
    RIGHT,
    TOP,
    TURN_LEFT,
    TURN_RIGHT,
    UNDER,
    mesh_of,
)

shapes = st.tuples(st.integers(1, 12), st.integers(1, 12))
lattices = arrays(np.uint8, shapes, elements=st.sampled_from([0, 0, 1]))


@given(lattices)
def test_rectangles_cover_every_free_cell_once(blocked: Bytes) -> None:
    covered = np.zeros(blocked.shape, int)
    for box in mesh_of(blocked).rectangles:
        covered[box[BOTTOM] : box[TOP], box[LEFT] : box[RIGHT]] += 1
    np.testing.assert_array_equal(covered, blocked == 0)


@given(lattices)
def test_rectangles_have_walls_to_their_sides(blocked: Bytes) -> None:
    walled = np.pad(blocked, 1, constant_values=1)
    for box in mesh_of(blocked).rectangles:
        rows = slice(box[BOTTOM] + 1, box[TOP] + 1)
        assert walled[rows, box[LEFT]].all()
        assert walled[rows, box[RIGHT] + 1].all()


@given(lattices)
def test_portals_are_just_the_borders_that_rectangles_share(blocked: Bytes) -> None:
    mesh = mesh_of(blocked)
    shared = set()
    for i, low in enumerate(mesh.rectangles):
        for j, high in enumerate(mesh.rectangles):
            left, right = max(low[LEFT], high[LEFT]), min(low[RIGHT], high[RIGHT])
            if low[TOP] == high[BOTTOM] and left < right:
                shared.add((left, right, low[TOP], i, j))
    assert {tuple(portal[:TURN_LEFT]) for portal in mesh.portals} == shared
    assert len(mesh.portals) == len(shared)


@given(lattices)
def test_paths_can_turn_where_one_rectangle_goes_on_beyond_a_portal(blocked: Bytes) -> None:
    walled = np.pad(blocked, 1, constant_values=1)
    for portal in mesh_of(blocked).portals:
        y, left, right = portal[HEIGHT] + 1, portal[LEFT] + 1, portal[RIGHT] + 1
        assert portal[TURN_LEFT] == (not walled[y - 1 : y + 1, left - 1].all())
        assert portal[TURN_RIGHT] == (not walled[y - 1 : y + 1, right].all())


@given(lattices)
def test_doors_are_a_rectangles_portals_from_left_to_right(blocked: Bytes) -> None:
    mesh = mesh_of(blocked)
    for r, doors in enumerate(mesh.doors):
        for first, end in ((FIRST_BELOW, OVER), (FIRST_ABOVE, UNDER)):
            own = np.flatnonzero(mesh.portals[:, end] == r)
            np.testing.assert_array_equal(np.arange(*doors[first : first + 2]), own)
            assert (np.diff(mesh.portals[own, LEFT]) > 0).all()


@given(lattices)
def test_pieces_are_what_hangs_together_by_the_sides_of_cells(blocked: Bytes) -> None:
    labels, count = ndimage.label(blocked == 0)
    boxes = mesh_of(blocked).rectangles
    pairs = {(labels[box[BOTTOM], box[LEFT]], box[PIECE]) for box in boxes}
    assert len(pairs) == count == len(set(boxes[:, PIECE]))


@pytest.mark.parametrize("shape", [(0, 0), (0, 3), (3, 0), (1, 1), (600, 1), (1, 600)])
def test_lattices_may_have_any_shape(shape: tuple[int, int]) -> None:
    mesh = mesh_of(np.zeros(shape, np.uint8))
    assert len(mesh.rectangles) == (0 not in shape)


def test_many_rectangles_have_room() -> None:
    board = np.indices((60, 60)).sum(axis=0).astype(np.uint8) % 2
    mesh = mesh_of(board)
    assert len(mesh.rectangles) == 1800
    assert len(mesh.portals) == 0
    comb = np.zeros((1, 2000), np.uint8)
    comb[0, ::2] = 1
    mesh = mesh_of(np.vstack((comb, 0 * comb, comb)))
    assert len(mesh.portals) == 2000
