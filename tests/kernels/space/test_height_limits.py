import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel
from viaspline.kernels.space.height_limits import heights_allowed
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.maps.terrain import Terrain
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld

SLOPE = Terrain([[0.0, 10.0], [0.0, 10.0]], cell=10.0)
PLACES = np.array([[0.0, 5.0], [5.0, 5.0], [10.0, 5.0], [12.0, 5.0]])


@kernel
def height_ranges(space: PackedSpace, places: Floats) -> Floats:
    found = np.empty((places.shape[0], 2))
    for k in range(places.shape[0]):
        found[k, 0], found[k, 1] = heights_allowed(space, places[k, 0], places[k, 1])
    return found


def test_limits_above_ground_follow_it_inside_of_those_of_height() -> None:
    band = HeightBand(lowest=7.0, highest=14.0, least_above_ground=5.0, most_above_ground=9.0)
    space = SpatialWorld.of(ground=SLOPE, band=band).packed
    expected = [[7, 9], [10, 14], [15, 14], [np.inf, -np.inf]]
    np.testing.assert_array_equal(height_ranges(space, PLACES), expected)


def test_over_unknown_ground_that_is_free_only_heights_limit() -> None:
    band = HeightBand(lowest=7.0, least_above_ground=5.0)
    space = SpatialWorld.of(ground=SLOPE, band=band, nodata="free").packed
    assert height_ranges(space, PLACES)[3].tolist() == [7.0, np.inf]


def test_without_limits_above_ground_none_is_asked_of_it() -> None:
    space = SpatialWorld.of(ground=SLOPE, band=HeightBand(highest=80.0)).packed
    assert (height_ranges(space, PLACES) == [-np.inf, 80.0]).all()


def test_flat_ground_counts_as_well() -> None:
    space = SpatialWorld.of(ground=3.0, band=HeightBand(most_above_ground=9.0)).packed
    assert (height_ranges(space, PLACES) == [-np.inf, 12.0]).all()
