from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.kernels.jit import kernel
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.space_distance import space_distances, space_segment
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism, RoundedSegment
from viaspline.world.space.spatial_world import SpatialWorld

Floats = NDArray[np.float64]
Oracle = Callable[..., Floats]
Made = Callable[[np.random.Generator, int], dict[str, Any]]
seeds = st.integers(0, 100_000)
HOUSE = Prism(
    RoundedRing(
        [[(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)],
         [(2.0, 2.0), (2.0, 6.0), (6.0, 6.0), (6.0, 2.0)]]
    ), 0.0, 10.0,
)  # fmt: skip


@kernel
def space_segments(
    space: PackedSpace, chords: Floats, limit: float
) -> tuple[Floats, NDArray[np.int64]]:
    count = chords.shape[0]
    distance = np.empty(count)
    index = np.empty(count, np.int64)
    for k in range(count):
        c = chords[k]
        distance[k], index[k] = space_segment(space, c[0], c[1], c[2], c[3], c[4], c[5], limit)
    return distance, index


def world_of(made: dict[str, Any]) -> SpatialWorld:
    rest = {key: value for key, value in made.items() if key not in ("solids", "core")}
    radius, half = made["core"]
    return SpatialWorld.of(made["solids"], core_radius=radius, core_half_height=half, **rest)


def chords_in(rng: np.random.Generator, count: int) -> Floats:
    """Chords of all lengths, upright and level ones and single places among them."""
    first = rng.uniform(-12, 52, (count, 3))
    step = rng.normal(0, 1, (count, 3)) * 10.0 ** rng.uniform(-2, 1.5, (count, 1))
    step[0], step[1, :2], step[2, 2] = 0.0, 0.0, 0.0
    return np.column_stack((first, first + step))


def least_along(chords: Floats, distance: Callable[[Floats], Floats]) -> Floats:
    """The least distance along each chord: of many places, and of more about the least of these."""
    t = np.linspace(0, 1, 201) * np.ones((len(chords), 1))
    best = np.full(len(chords), np.inf)
    for fine in (0, 1, 2, 3, 4, 5):
        places = chords[:, None, :3] + t[..., None] * (chords[:, None, 3:] - chords[:, None, :3])
        values = distance(places.reshape(-1, 3)).reshape(t.shape)
        best = np.minimum(best, values.min(axis=1))
        least = np.argsort(values, axis=1)[:, : 1 if fine else 4]
        near = np.take_along_axis(t, least, axis=1)
        width = 0.01 * 0.1**fine
        t = (near[:, :, None] + np.linspace(-width, width, 21)).clip(0, 1).reshape(len(chords), -1)
    return best


@given(seeds)
def test_a_place_is_as_far_as_independent_formulas_say(
    space_oracle: Oracle, random_space: Made, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    made = random_space(rng, 6)
    places = rng.uniform(-12, 52, (60, 3))
    found, _ = space_distances(world_of(made).packed, places)
    expected = space_oracle(places, **made)
    outside = expected > 0
    np.testing.assert_allclose(found[outside], expected[outside], rtol=0, atol=2e-9)
    # lines with a core say no more of depth than that they are touched
    assert (found[~outside] <= 1e-9).all()
    if made["core"] == (0.0, 0.0):
        np.testing.assert_allclose(found[~outside], expected[~outside], rtol=0, atol=2e-9)


@given(seeds)
def test_a_chord_is_never_farther_than_its_places_and_no_nearer(
    space_oracle: Oracle, random_space: Made, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    made = random_space(rng, 5)
    chords = chords_in(rng, 8)
    found, _ = space_segments(world_of(made).packed, chords, np.inf)
    least = least_along(chords, lambda places: space_oracle(places, **made))
    apart = least > 0
    lengths = np.linalg.norm(chords[:, 3:] - chords[:, :3], axis=1)
    assert (found <= least + 2e-9)[apart].all()
    assert (found >= least - 1e-6 * (1.0 + lengths))[apart].all()
    assert (found[~apart] <= 1e-9).all()


@given(seeds, st.floats(0, 20))
def test_what_is_beyond_the_limit_is_the_limit(random_space: Made, seed: int, far: float) -> None:
    rng = np.random.default_rng(seed)
    space = world_of(random_space(rng, 6)).packed
    chords = chords_in(rng, 20)
    every, which = space_segments(space, chords, np.inf)
    within, found = space_segments(space, chords, far)
    near = every < far
    np.testing.assert_allclose(within[near & (every > 0)], every[near & (every > 0)], atol=2e-9)
    assert (within[~near] == far).all()
    assert (found[~near] == -1).all()
    assert (found[near & (every < far - 1e-9)] != -1).all()
    assert (which[every < np.inf] != -1).all()


@given(seeds)
def test_the_index_is_that_of_what_is_nearest(random_space: Made, seed: int) -> None:
    rng = np.random.default_rng(seed)
    made = {**random_space(rng, 40), "core": (0.3, 0.2)}
    world = world_of(made)
    places = rng.uniform(-12, 52, (30, 3))
    distance, index = space_distances(world.packed, places)
    for place, one, i in zip(places, distance, index, strict=True):
        if 0 <= i < len(made["solids"]):
            alone = world_of({"solids": [made["solids"][i]], "core": made["core"]})
            assert alone.distance(place) == pytest.approx(one, abs=2e-9)


@given(seeds)
def test_the_distance_changes_by_no_more_than_the_way(random_space: Made, seed: int) -> None:
    rng = np.random.default_rng(seed)
    space = world_of(random_space(rng, 8)).packed
    places = rng.uniform(-12, 52, (80, 3))
    beside = places + rng.normal(0, 1, (80, 3)) * 10.0 ** rng.uniform(-3, 1, (80, 1))
    first, second = space_distances(space, places)[0], space_distances(space, beside)[0]
    known = np.isfinite(first)
    change = np.abs(first[known] - second[known])
    assert (change <= np.linalg.norm(beside - places, axis=1)[known] + 3e-9).all()


@pytest.mark.parametrize(
    ("chord", "distance"),
    [
        ([4, 4, 1, 4, 4, 9], 2.0),  # upright in the yard
        ([4, 4, 1, 4, 4, 30], 2.0),  # out of it
        ([-5, 4, 12, 20, 4, 12], 2.0),  # level above the roof
        ([-5, 4, 12, 20, 4, 5], 0.0),  # through the roof
        ([1, 1, 13, 1, 1, 11], 1.0),  # down onto the roof
        ([3.5, 3.5, 14, 3.5, 3.5, 12.5], np.hypot(1.5, 2.5)),  # down into the yard
        ([-3, 4, -4, -3, 4, 5], 3.0),  # beside a wall
        ([-3, -4, 14, -3, -4, 14], np.sqrt(9 + 16 + 16)),  # one place off a corner
    ],
)
def test_chords_about_a_house_with_a_yard(chord: list[float], distance: float) -> None:
    world = SpatialWorld.of([HOUSE])
    found, _ = space_segments(world.packed, np.array([chord], float), np.inf)
    assert found[0] == pytest.approx(distance, abs=1e-9)


def test_lines_that_cross_in_plan_are_as_far_as_their_heights() -> None:
    cable = RoundedSegment((0.0, 0.0, 10.0), (10.0, 0.0, 10.0), 0.1)
    world = SpatialWorld.of([cable], core_radius=0.5, core_half_height=0.25)
    chords = np.array([[5, -5, 7, 5, 5, 7], [5, -5, 10, 5, 5, 10], [2, 1, 12, 8, 1, 12.0]])
    found, _ = space_segments(world.packed, chords, np.inf)
    expected = [2.65, -0.1, np.hypot(0.5, 1.75) - 0.1]
    np.testing.assert_allclose(found, expected, atol=1e-9)


@pytest.mark.parametrize("spread", [0.0, 1e-7, 3e-6, 1e-5, 1e-3, 0.1])
@pytest.mark.parametrize("core", [(0.0, 0.0), (0.5, 0.25)])
def test_long_lines_that_hardly_cross_are_no_farther_than_where_they_do(
    spread: float, core: tuple[float, float]
) -> None:
    here = np.array([12_345.678, 987.65, 43.21])
    cable = RoundedSegment(tuple(here), tuple(here + np.array([1000.0, 0.0, 0.0])), 0.1)
    world = SpatialWorld.of([cable], core_radius=core[0], core_half_height=core[1])
    ends = (here + np.array([(0.0, -spread, 7.0), (1000.0, spread, 7.0)])).ravel()
    found, _ = space_segments(world.packed, ends[None], np.inf)
    assert 6.9 - core[1] - 1e-5 < found[0] <= 6.9 - core[1] + 1e-9


def test_an_empty_world_is_infinitely_far() -> None:
    space = SpatialWorld.of([]).packed
    assert space_distances(space, np.zeros((1, 3))) == (np.inf, -1)
    assert space_segments(space, np.ones((1, 6)), np.inf) == (np.inf, -1)


def test_among_thousands_of_solids_the_nearest_is_found(space_oracle: Oracle) -> None:
    rng = np.random.default_rng(5)
    middles = rng.uniform(0, 300, (3000, 3))
    balls = [RoundedSegment(tuple(m), tuple(m), 1.0) for m in middles.tolist()]
    world = SpatialWorld.of(balls)
    places = rng.uniform(0, 300, (20, 3))
    expected = np.linalg.norm(places[:, None] - middles, axis=2).min(axis=1) - 1.0
    np.testing.assert_allclose(world.distance(places), expected, atol=1e-12)


def test_large_blocks_of_voxels_are_searched_on_every_level() -> None:
    rng = np.random.default_rng(6)
    cubes = np.zeros((150, 90, 70), bool)
    blocked = rng.integers(0, (150, 90, 70), (12, 3))
    cubes[tuple(blocked.T)] = True
    world = SpatialWorld.of([Voxels(cubes, 0.5, (1.0, 2.0, 3.0))])
    places = rng.uniform(0, 80, (30, 3))
    low = blocked * 0.5 + (1.0, 2.0, 3.0)
    gap = np.maximum(np.maximum(low - places[:, None], places[:, None] - low - 0.5), 0)
    np.testing.assert_allclose(
        world.distance(places), np.linalg.norm(gap, axis=2).min(axis=1), atol=1e-9
    )


def test_ground_of_many_levels_is_searched_on_each(space_oracle: Oracle) -> None:
    rng = np.random.default_rng(7)
    ground = Terrain(rng.uniform(0, 9, (70, 90)).cumsum(axis=1) * 0.1, 1.0)
    places = rng.uniform((-5, -5, 0), (95, 75, 60), (40, 3))
    world = SpatialWorld.of([], ground=ground, nodata="free")
    expected = space_oracle(places, ground=ground, nodata="free")
    np.testing.assert_allclose(world.distance(places), expected, atol=1e-9)
