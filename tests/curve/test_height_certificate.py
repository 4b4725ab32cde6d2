import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.height_certificate import HEIGHT_TOLERANCE_M, certify_heights
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.maps.terrain import Terrain
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld

seeds = st.integers(0, 100_000)


def random_terrain(rng: np.random.Generator) -> Terrain:
    y, x = np.indices(tuple(rng.integers(30, 90, 2).tolist()))
    bend = rng.uniform(0.02, 0.5, 4)
    nodes = 9 * np.sin(bend[0] * x + bend[1] * y) + 4 * np.sin(bend[2] * x - bend[3] * y)
    return Terrain(nodes + rng.normal(0, rng.choice([0.0, 0.5]), x.shape), 2.0, (-10.0, -10.0))


def random_curve(rng: np.random.Generator, terrain: Terrain, *, follows: bool) -> PiecewiseCubic:
    x0, y0, x1, y1 = terrain.extent
    points = rng.uniform((x0 + 9, y0 + 9), (x1 - 9, y1 - 9), (rng.integers(2, 5), 2))
    points = points[0] + 0.4 * (points - points[0])
    heights = terrain.height_at(points) + 12 if follows else rng.uniform(10, 40, len(points))
    return CardinalSpline(np.column_stack((points, heights)))


@given(seeds, st.booleans())
def test_heights_above_ground_are_proven_and_within_five_centimetres(
    seed: int, follows: bool
) -> None:
    rng = np.random.default_rng(seed)
    terrain = random_terrain(rng)
    curve = random_curve(rng, terrain, follows=follows)
    found = certify_heights(curve, SpatialWorld.of(ground=terrain))
    places = np.asarray(curve.evaluate(np.linspace(0, len(curve.spans), 20_001)))
    heights = places[:, 2] - terrain.height_at(places[:, :2])
    least, most = found.least_above_ground, found.greatest_above_ground
    assert heights.min() - HEIGHT_TOLERANCE_M - 0.01 <= least.height <= heights.min() + 1e-9
    assert heights.max() + HEIGHT_TOLERANCE_M + 0.01 >= most.height >= heights.max() - 1e-9
    for bound in (least, most):
        there = bound.at[2] - terrain.height_at(bound.at[:2])
        assert there == pytest.approx(bound.height, abs=HEIGHT_TOLERANCE_M + 1e-9)
        np.testing.assert_allclose(curve.evaluate(bound.u), bound.at, atol=1e-9)


@given(seeds)
def test_the_lowest_and_the_highest_place_are_exact(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.uniform(0, 50, (rng.integers(2, 7), 3))
    if seed % 5 == 0:
        points[:, 2] = 7.0
    curve = CardinalSpline(points, slack=float(rng.choice([0.0, 0.5, 1.0])))
    found = certify_heights(curve, SpatialWorld.of())
    heights = np.asarray(curve.evaluate(np.linspace(0, len(curve.spans), 20_001)))[:, 2]
    assert found.least.height == pytest.approx(heights.min(), abs=1e-5)
    assert found.least.height <= heights.min() + 1e-12
    assert found.greatest.height == pytest.approx(heights.max(), abs=1e-5)
    assert found.greatest.height >= heights.max() - 1e-12
    assert found.least.at[2] == pytest.approx(found.least.height, abs=1e-9)


@given(seeds, st.floats(-30, 30))
def test_the_band_holds_where_every_place_keeps_it(seed: int, limit: float) -> None:
    rng = np.random.default_rng(seed)
    terrain = random_terrain(rng)
    curve = random_curve(rng, terrain, follows=True)
    places = np.asarray(curve.evaluate(np.linspace(0, len(curve.spans), 5001)))
    least = (places[:, 2] - terrain.height_at(places[:, :2])).min()
    band = HeightBand(least_above_ground=least + limit * 0.01)
    found = certify_heights(curve, SpatialWorld.of(ground=terrain, band=band))
    assert found.tightest == "least_above_ground"
    assert not found.holds or limit <= 1e-3
    assert found.holds or limit > -1.0


def test_margins_are_told_of_every_limit_that_there_is() -> None:
    band = HeightBand(lowest=5.0, highest=50.0, most_above_ground=30.0)
    curve = CardinalSpline([(0, 0, 20), (100, 0, 45)], tension=1.0)
    found = certify_heights(curve, SpatialWorld.of(ground=10.0, band=band))
    assert found.margins == pytest.approx({"lowest": 15, "highest": 5, "most_above_ground": -5})
    assert found.tightest == "most_above_ground"
    assert found.tightest_at is not None
    assert found.tightest_at.at == pytest.approx((100, 0, 45))
    assert not found.holds


def test_a_curve_that_flies_along_its_limit_keeps_it() -> None:
    band = HeightBand(lowest=20.0, least_above_ground=20.0)
    curve = CardinalSpline([(0, 0, 20), (33, 7, 20), (100, 0, 20)])
    world = SpatialWorld.of(ground=Terrain(np.zeros((50, 60)), 3.0, (-20.0, -20.0)), band=band)
    assert certify_heights(curve, world).holds


def test_without_limits_nothing_is_tight() -> None:
    found = certify_heights(CardinalSpline([(0, 0, 20), (9, 0, 20)]), SpatialWorld.of())
    assert found.holds
    assert found.tightest is None
    assert found.tightest_at is None
    assert found.least_above_ground.height == math.inf
    assert found.greatest_above_ground.height == math.inf


@pytest.mark.parametrize(("nodata", "least"), [("blocked", -math.inf), ("free", 20.0)])
@pytest.mark.parametrize("hole", [True, False])
def test_ground_that_is_not_known_counts_as_the_mission_says(
    nodata: Any, least: float, hole: bool
) -> None:
    nodes = np.zeros((20, 20))
    if hole:
        nodes[10, 10] = np.nan
    end = 18.0 if hole else 40.0  # over the hole, or over the edge
    world = SpatialWorld.of(ground=Terrain(nodes, 1.0), nodata=nodata)
    found = certify_heights(CardinalSpline([(1, 9.5, 20), (end, 10.5, 20)]), world)
    assert found.least_above_ground.height == pytest.approx(least)
    assert found.greatest_above_ground.height == pytest.approx(20.0)


def test_beside_a_hole_in_the_terrain_heights_are_known() -> None:
    nodes = np.zeros((20, 20))
    nodes[10, 10] = np.nan
    world = SpatialWorld.of(ground=Terrain(nodes, 1.0))
    found = certify_heights(CardinalSpline([(1, 8.99, 20), (18, 8.99, 20)]), world)
    assert found.least_above_ground.height == pytest.approx(20.0)


def test_an_upright_curve_is_over_one_place() -> None:
    world = SpatialWorld.of(ground=Terrain(np.eye(9), 1.0))
    found = certify_heights(CardinalSpline([(4, 4, 2), (4, 4, 30)]), world)
    assert found.least_above_ground.height == pytest.approx(1.0, abs=HEIGHT_TOLERANCE_M)
    assert found.greatest_above_ground.height == pytest.approx(29.0, abs=HEIGHT_TOLERANCE_M)


def test_a_curve_in_the_plane_has_no_heights() -> None:
    with pytest.raises(GeometryError, match="dimension 2"):
        certify_heights(CardinalSpline([(0, 0), (1, 0)]), SpatialWorld.of())
    with pytest.raises(GeometryError, match="world"):
        certify_heights(CardinalSpline([(0, 0, 0), (1, 0, 0)]), 5)  # type: ignore[arg-type]
