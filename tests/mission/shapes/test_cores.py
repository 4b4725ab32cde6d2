"""Many cores at once beside one after the other."""

from __future__ import annotations

import shapely

from viaspline.mission.shapes.cores import cores_of
from viaspline.mission.shapes.rounded_ring import RoundedRing

SQUARE = ((0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0))
HOLES = (((1.0, 1.0), (2.0, 1.0), (2.0, 2.0)), ((5.0, 5.0), (6.0, 5.0), (6.0, 6.0)))


def test_rings_of_every_kind_keep_their_places_in_the_row() -> None:
    rings = [
        RoundedRing([SQUARE, *HOLES]),
        RoundedRing([[(3.0, 4.0)]], 2.0),
        RoundedRing([[(0.0, 0.0), (4.0, 1.0)]], 0.5),
        RoundedRing([SQUARE[:3]], 0.25),
        RoundedRing([[(7.0, 7.0)]], 1.0),
        RoundedRing([SQUARE, HOLES[0]]),
    ]
    cores = cores_of(iter(rings))
    assert cores.radii.tolist() == [ring.radius for ring in rings]
    for core, ring in zip(cores.geometries, rings, strict=True):
        assert shapely.equals(core, ring.core())


def test_of_no_rings_there_are_no_cores() -> None:
    assert cores_of([]).geometries.shape == (0,)
    assert cores_of([]).radii.shape == (0,)
