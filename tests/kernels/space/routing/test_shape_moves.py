"""What solids answer to a search: planes that keep a way clear, and cells that could be free."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.routing import shape_moves as shape_moves
from viaspline.kernels.space.routing.could_be_free import APART, are_apart
from viaspline.kernels.space.routing.route_protocol import OFFSET, PlaceLattice, touched
from viaspline.kernels.space.routing.way_checks import way_is_free
from viaspline.maps.grid import Grid
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import GridPrism, Prism, RoundedSegment, Solid
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld

NO_GATES = np.empty((0, 8))
BOX = [[(-2.0, -1.0), (2.0, -1.0), (2.0, 1.0), (-2.0, 1.0)]]
NOTCHED = [[(-3.0, -3.0), (3.0, -3.0), (3.0, 3.0), (0.5, 3.0), (0.5, 0.0), (-3.0, 0.0)]]


@kernel
def planes_about(
    space: PackedSpace, first: Floats, last: Floats, radius: float, reach: float, planes: Floats
) -> int:
    d = last - first
    return touched(space, first[0], first[1], first[2], d[0], d[1], d[2], radius, reach, planes, 0)


def solids() -> list[Solid]:
    cubes = np.zeros((3, 3, 3), bool)
    cubes[1, :, 0] = cubes[1, 1, :] = True
    return [
        Prism(RoundedRing([[(0.0, 0.0)]], 2.0), -1.0, 3.0),
        Prism(RoundedRing(BOX, 0.5), -2.0, 2.0),
        RoundedSegment((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 2.0),
        RoundedSegment((-3.0, 0.0, -1.0), (3.0, 1.0, 2.0), 0.5),
        Voxels(cubes, 1.0, (-1.5, -1.5, -1.5)),
        Prism(RoundedRing(NOTCHED), -2.0, 2.0),
        GridPrism(Grid([[True, False, True]], 1.5, (-2.0, -1.0, 0.3)), -1.0, 2.0),
    ]


@given(st.integers(0, 2**32), st.sampled_from(range(7)), st.booleans())
def test_of_what_a_way_touches_a_plane_stands_between(seed: int, which: int, ball: bool) -> None:
    core = (0.0, 0.0) if ball else (0.4, 0.2)
    world = SpatialWorld.of([solids()[which]], core_radius=core[0], core_half_height=core[1])
    rng = np.random.default_rng(seed)
    first, last = rng.uniform(-6, 6, (2, 3))
    samples = first + np.linspace(0, 1, 300)[:, None] * (last - first)
    distance = world.distance(samples)
    radius = float(distance.min()) - 0.05
    if radius <= 0.05:
        return
    planes = np.empty((32, 5))
    count = planes_about(world.packed, first, last, radius, 0.2, planes)
    real = planes[:count][np.isfinite(planes[:count, OFFSET])]
    assert len(real) > 0
    nearest = samples[int(distance.argmin())]
    beyond = real[:, :3] @ nearest - real[:, OFFSET]
    assert beyond.min() >= -1e-6  # the way is on the free side
    assert beyond.min() <= 0.06  # and as near to a plane as to what stands behind it
    if which < 4:  # what is beyond the plane of something convex keeps the radius from it
        places = rng.uniform(-6, 6, (200, 3))
        side = (places @ real[:, :3].T - real[:, OFFSET]).max(axis=1) >= 0.0
        assert (world.distance(places[side]) >= radius - 1e-4).all()


@settings(max_examples=30)
@given(st.integers(0, 2**32))
def test_a_free_way_keeps_the_distance_and_the_heights_at_every_place(seed: int) -> None:
    rng = np.random.default_rng(seed)
    terrain = Terrain(rng.uniform(0, 3, (6, 6)), cell=4.0, origin=(-10.0, -10.0))
    band = HeightBand(highest=9.0, least_above_ground=0.5, most_above_ground=8.0)
    world = SpatialWorld.of(
        solids()[:4], ground=terrain, bounds=(-9, -9, 9, 9), core_radius=0.2, band=band
    )
    first, last = rng.uniform((-9, -9, 2), (9, 9, 9), (2, 3))
    if way_is_free(world.packed, NO_GATES, np.array([first, last]), 0.3):
        samples = first + np.linspace(0, 1, 200)[:, None] * (last - first)
        assert (world.distance(samples) >= 0.3 - 1e-9).all()
        above = samples[:, 2] - terrain.height_at(samples[:, :2])
        assert (above >= 0.5 - 0.2).all()
        assert (samples[:, 2] <= 9.0).all()


@pytest.mark.long_without_jit
def test_a_ball_in_a_closed_box_is_apart_from_the_world() -> None:
    walls = [
        Prism(RoundedRing([[(x0, y0), (x1, y0), (x1, y1), (x0, y1)]]), low, high)
        for x0, y0, x1, y1, low, high in (
            (-5, -5, 5, 5, -1, 0), (-5, -5, 5, 5, 5, 6), (-5, -5, -4, 5, 0, 5),
            (4, -5, 5, 5, 0, 5), (-5, -5, 5, -4, 0, 5), (-5, 4, 5, 5, 0, 5),
        )
    ]  # fmt: skip
    lattice = PlaceLattice(np.array([-12.0, -12.0, -12.0, 0.5]), np.array([49, 49, 49]))
    inside, outside = np.array([0.0, 0.0, 2.5]), np.array([10.0, 0.0, 2.5])
    world = SpatialWorld.of(walls)
    assert are_apart(world.packed, lattice, inside, outside, 0.5, 10**6) == (APART, 0)
    opened = SpatialWorld.of(walls[:-1])
    assert are_apart(opened.packed, lattice, inside, outside, 0.5, 10**6)[0] != APART


@settings(max_examples=40)
@given(seed=st.integers(0, 10_000))
def test_a_free_way_keeps_its_height_over_cliffs_as_well(seed: int) -> None:
    """Ground bends over lines of nodes; between two looks half a cell apart a cliff was missed."""
    rng = np.random.default_rng(seed)
    hills = np.tile(np.cumsum(rng.choice([0.0, 0.0, 12.0, -12.0], 12)), (12, 1))
    ground = Terrain(hills if seed % 2 else hills.T.copy(), 5.0)
    band = HeightBand(least_above_ground=15.0)
    world = SpatialWorld.of([], ground=ground, band=band)
    ends = rng.uniform((1, 1, 0), (54, 54, 1), (2, 3))
    ends[:, 2] += np.asarray(ground.height_at(ends[:, :2])) + 15.0
    places = ends[0] + np.linspace(0.0, 1.0, 4001)[:, None] * (ends[1] - ends[0])
    least = (places[:, 2] - np.asarray(ground.height_at(places[:, :2]))).min()
    if way_is_free(world.packed, NO_GATES, ends, 0.1):
        assert least >= 15.0 - 1e-9
    else:  # clearance counts from the highest corner of each patch
        assert least < 15.0 + 1e-2 or world.distance(places).min() < 0.11
