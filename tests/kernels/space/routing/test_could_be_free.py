"""Proofs that two places are apart, against floods of voxels and fine samples."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage

from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.routing import shape_moves as shape_moves
from viaspline.kernels.space.routing.could_be_free import APART, TOGETHER, UNKNOWN, are_apart
from viaspline.kernels.space.routing.route_protocol import PlaceLattice
from viaspline.maps.voxels import Voxels
from viaspline.world.space.spatial_world import SpatialWorld


def packed_cubes(blocked: np.ndarray) -> PackedSpace:
    """Cubes of a metre from 0, 0, 0 on, and nothing else."""
    return SpatialWorld.of([Voxels(blocked, 1.0)]).packed


@given(st.integers(0, 2**32), st.sampled_from([0.2, 0.4, 0.6]))
def test_cubes_themselves_are_exact_cells(seed: int, share: float) -> None:
    rng = np.random.default_rng(seed)
    shape = tuple(rng.integers(1, 8, 3))
    blocked = rng.random(shape) < share
    first, last = rng.integers(0, shape), rng.integers(0, shape)
    blocked[tuple(first)] = blocked[tuple(last)] = False
    packed = packed_cubes(blocked)
    lattice = PlaceLattice(np.array([0.5, 0.5, 0.5, 1.0]), np.array(shape))
    rooms, _ = ndimage.label(~blocked)
    expected = TOGETHER if rooms[tuple(first)] == rooms[tuple(last)] else APART
    assert are_apart(packed, lattice, first + 0.5, last + 0.5, 0.45, 10**6)[0] == expected


@pytest.mark.long_without_jit
@settings(max_examples=40)
@given(st.integers(0, 2**32), st.sampled_from([0.3, 0.7, 1.2]), st.sampled_from([0.2, 0.4]))
def test_what_samples_connect_is_never_called_apart(seed: int, radius: float, step: float) -> None:
    rng = np.random.default_rng(seed)
    blocked = rng.random((5, 5, 5)) < 0.3
    packed = packed_cubes(blocked)
    fine = 0.2
    axis = np.arange(0.5 * fine, 5.0, fine)
    places = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)
    corners = np.argwhere(blocked).astype(float)
    off = places[..., None, :] - np.clip(places[..., None, :], corners, corners + 1.0)
    room = np.linalg.norm(off, axis=-1).min(axis=-1, initial=np.inf)
    free = room >= radius + 0.5 * fine  # then lines between neighbours are free as well
    rooms, count = ndimage.label(free)
    if count == 0:
        return
    members = np.argwhere(rooms == rng.integers(1, count + 1))
    first, last = places[tuple(rng.choice(members))], places[tuple(rng.choice(members))]
    cells = int(np.ceil(5.0 / step)) + 1
    lattice = PlaceLattice(np.array([0.0, 0.0, 0.0, step]), np.array([cells] * 3))
    assert are_apart(packed, lattice, first, last, radius, 10**6)[0] == TOGETHER


def shell() -> tuple[PackedSpace, PlaceLattice]:
    blocked = np.ones((7, 7, 7), bool)
    blocked[1:6, 1:6, 1:6] = False
    whole = np.zeros((31, 31, 31), bool)
    whole[12:19, 12:19, 12:19] = blocked
    return packed_cubes(whole), PlaceLattice(np.array([0.5, 0.5, 0.5, 1.0]), np.array([31] * 3))


def test_a_small_room_is_flooded_before_the_world_is() -> None:
    packed, lattice = shell()
    outside, inside = np.full(3, 2.5), np.full(3, 15.5)
    assert are_apart(packed, lattice, outside, inside, 0.45, 1000) == (APART, 1)
    assert are_apart(packed, lattice, inside, outside, 0.45, 1000) == (APART, 0)


def test_nothing_is_known_when_the_cells_are_spent() -> None:
    packed, lattice = shell()
    assert are_apart(packed, lattice, np.full(3, 2.5), np.full(3, 15.5), 0.45, 50)[0] == UNKNOWN


def test_nothing_is_known_of_places_outside_of_the_lattice() -> None:
    packed, lattice = shell()
    assert are_apart(packed, lattice, np.full(3, -9.0), np.full(3, 15.5), 0.45, 10**6)[0] == UNKNOWN
