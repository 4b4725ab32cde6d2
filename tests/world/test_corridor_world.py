"""The corridor as a bound of the world, beside shapely."""

from __future__ import annotations

import numpy as np
import shapely

from viaspline.curve.certificate import certify
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.strip import corridor_area
from viaspline.world.world import World

WAVES = np.linspace(0, 2 * np.pi, 48, endpoint=False)
RADII = 40 + 6 * np.sin(3 * WAVES)
ROWS = np.column_stack(
    (RADII * np.cos(WAVES), RADII * np.sin(WAVES), 4 + np.sin(WAVES), 3 + np.cos(WAVES))
)


def mission(**more: object) -> Mission:
    route = {"start": ROWS[0, :2].tolist(), "closed": True, "corridor": {"line": ROWS.tolist()}}
    return Mission.model_validate({"world": more, "route": route})


def test_distances_to_a_corridor_with_an_island_are_shapelys() -> None:
    asked = mission(fences=[[[-48, -48], [48, -48], [48, 48], [-48, 48]]])
    area = corridor_area(asked.route)
    assert area is not None
    world = World.known(asked)
    places = np.random.default_rng(1).uniform(-47, 47, (3000, 2))
    points = shapely.points(places)
    to_edge = shapely.distance(area.boundary, points)
    signed = np.where(area.contains(points), to_edge, -to_edge)
    fence = 48 - np.abs(places).max(axis=1)
    distance, index = world.nearest(places)
    np.testing.assert_allclose(distance, np.minimum(signed, fence), atol=1e-9)
    assert {world.name(i) for i in index.tolist()} == {"fence 1", "corridor"}


def test_a_certificate_against_the_island_names_the_corridor() -> None:
    world = World.known(mission())
    inside = RADII - 2.0
    ring = np.column_stack((inside * np.cos(WAVES), inside * np.sin(WAVES)))
    ring = np.vstack((ring, ring[:1]))
    third = np.diff(ring, axis=0)[:, None] * np.array([0, 1, 2, 3])[None, :, None] / 3
    proof = certify(PiecewiseCubic(ring[:-1, None] + third), world, 0.0)
    assert proof.obstacle == "corridor"
    exact = shapely.LineString(ring).distance(shapely.Polygon(world.corridor[1]))
    assert exact - 1e-3 <= proof.clearance <= exact + 1e-9


def test_what_the_sensor_finds_is_added_to_a_world_with_a_corridor() -> None:
    world = World.known(mission()).with_obstacles(
        [Obstacle(circle={"center": (40, 0), "radius": 1})]
    )
    assert world.corridor
    assert world.with_side(0, "left").corridor == world.corridor
    _, index = world.nearest([(40.0, 1.5), (0.0, 0.0)])
    assert [world.name(i) for i in index.tolist()] == ["obstacle 1", "corridor"]
