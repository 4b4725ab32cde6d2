"""Where the robot may be, beside what shapely says of obstacles that are grown."""

from __future__ import annotations

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.mission.freespace import FreeSpace
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.rounded_ring import Loop, RoundedRing


class Rounded(Obstacle):
    """An obstacle that is some rounded ring."""

    loop: tuple[tuple[float, float], ...]
    grown: float

    @property
    def ring(self) -> RoundedRing:
        loop: Loop = self.loop
        return RoundedRing((loop,), self.grown)


CIRCLE = Obstacle(circle=Circle(center=(10.0, 10.0), radius=3.0))
PIERCED = Obstacle(
    polygon=((20, 0), (40, 0), (40, 20), (20, 20)), holes=(((25, 5), (35, 5), (35, 15), (25, 15)),)
)
HEDGE = Rounded(loop=((0.0, 30.0), (20.0, 40.0)), grown=1.5)
CUSHION = Rounded(loop=((30.0, 30.0), (45.0, 30.0), (40.0, 45.0)), grown=2.0)
OBSTACLES = (CIRCLE, PIERCED, HEDGE, CUSHION)
AREAS = [ring.outline(400) for item in OBSTACLES if (ring := item.ring) is not None]

places = st.tuples(st.floats(-5, 50), st.floats(-5, 50))


@settings(deadline=None, max_examples=200)
@given(place=places, margin=st.floats(0.1, 5))
def test_the_nearest_obstacle_is_told_with_its_signed_distance(
    place: tuple[float, float], margin: float
) -> None:
    here = shapely.Point(place)
    signed = [
        -area.boundary.distance(here) if area.covers(here) else area.distance(here)
        for area in AREAS
    ]
    nearest = min(range(len(signed)), key=signed.__getitem__)
    found = list(FreeSpace(None, (), OBSTACLES, margin).near_obstacles([place]))
    if abs(signed[nearest] - margin) < 1e-3:
        return
    assert bool(found) == (signed[nearest] < margin)
    for point, obstacle, distance in found:
        assert point == 0
        assert distance == pytest.approx(signed[obstacle], abs=1e-4)
        assert distance <= signed[nearest] + 1e-4


@settings(deadline=None, max_examples=50)
@given(place=places)
def test_the_place_that_is_proposed_is_clear_of_everything(place: tuple[float, float]) -> None:
    space = FreeSpace((-5.0, -5.0, 50.0, 50.0), (), OBSTACLES, 1.0)
    found = space.nearest(place)
    assert found is not None
    assert not list(space.near_obstacles([found]))
    assert not list(space.near_bounds([found]))
    assert min(area.distance(shapely.Point(found)) for area in AREAS) >= 1.0 - 1e-4
