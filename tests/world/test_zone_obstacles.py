"""Zones as obstacles: what keeps from those stays outside of these, against shapely."""

from __future__ import annotations

import math

import numpy as np
import shapely
from hypothesis import assume, example, given
from hypothesis import strategies as st

from viaspline.mission.world_spec import SpeedZone
from viaspline.world.world import World
from viaspline.world.zone_obstacles import zone_obstacles


def star(seed: int, corners: int, thin: float) -> list[tuple[float, float]]:
    """A ring round the origin, some of its corners drawn in."""
    rng = np.random.default_rng(seed)
    angles = np.sort(rng.uniform(0.0, math.tau, corners))
    radii = rng.uniform(thin, 1.0, corners) * 10.0
    return [(r * math.cos(a), r * math.sin(a)) for a, r in zip(angles, radii, strict=True)]


@given(
    st.integers(0, 10_000), st.integers(3, 9), st.sampled_from((0.05, 0.4, 0.9)),
    st.sampled_from((1e-3, 0.3, 1.0, 4.0)),
)  # fmt: skip
@example(3, 5, 0.05, 1.0)
def test_what_keeps_from_the_obstacles_of_a_zone_is_outside_of_it(
    seed: int, corners: int, thin: float, required: float
) -> None:
    ring = star(seed, corners, thin)
    area = shapely.Polygon(ring)
    assume(area.is_valid and area.area > 0.01)
    world = World(zone_obstacles([SpeedZone(polygon=ring, max_speed_mps=0.5)], required))
    rng = np.random.default_rng(seed)
    places = rng.uniform(-16, 16, (400, 2))
    kept = world.distance(places) >= required + 1e-6
    inside = shapely.contains_xy(area, *places.T)
    assert not (kept & inside).any()
    far = shapely.distance(area, shapely.points(places)) >= required + 1e-6
    assert kept[far].all()


def test_a_square_is_drawn_in_so_that_its_corners_stay_out_of_reach() -> None:
    ring = [(0, 0), (10, 0), (10, 10), (0, 10)]
    [block] = zone_obstacles([SpeedZone(polygon=ring, max_speed_mps=0.5, name="lab")], 1.0)
    assert block.name == "speed zone 'lab'"
    assert block.polygon is not None
    inner = shapely.Polygon(block.polygon)
    assert inner.area < 80.0
    assert 0.98 < inner.distance(shapely.Point(0, 0)) < 1.0
    assert zone_obstacles([SpeedZone(polygon=ring, max_speed_mps=0.5)], 9.0)[0].polygon is not None
