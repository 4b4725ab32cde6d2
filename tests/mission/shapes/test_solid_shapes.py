"""What obstacles are in space, by shapely and by hand."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from viaspline.errors import GeometryError, MissionError
from viaspline.maps.grid import Grid
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.box import Box
from viaspline.mission.shapes.obstacle import SOLID_KINDS, Obstacle
from viaspline.mission.shapes.solids import GridPrism, Prism, RoundedSegment
from viaspline.world.world import World

CUBES = np.zeros((2, 3, 4), bool)


@given(
    x=st.floats(-50, 50), y=st.floats(-50, 50), a=st.floats(0.1, 9), b=st.floats(0.1, 9),
    yaw=st.floats(-720, 720),
)  # fmt: skip
def test_a_box_is_turned_about_its_middle(
    x: float, y: float, a: float, b: float, yaw: float
) -> None:
    box = Box(min=(x, y, 2), max=(x + a, y + b, 5), yaw_deg=yaw)
    solid = box.solid()
    straight = shapely.box(x, y, x + a, y + b)
    turned = shapely.affinity.rotate(straight, yaw, origin="center")
    assert solid.ring.outline().symmetric_difference(turned).area < 1e-9
    assert (solid.low, solid.high) == (2, 5)


def test_flat_shapes_are_prisms_between_their_heights() -> None:
    hall = Obstacle(polygon=[(0, 0), (9, 0), (9, 5)], height_m=(1, 35))
    solid = hall.solid()
    assert isinstance(solid, Prism)
    assert (solid.low, solid.high, solid.ring) == (1, 35, hall.ring)
    endless = Obstacle(circle={"center": (0, 0), "radius": 1}).solid()
    assert endless.box == (-1, -1, -math.inf, 1, 1, math.inf)
    hedge = Obstacle(capsule={"from": (0, 0), "to": (4, 0), "radius": 1}, height_m=(0, 2))
    assert hedge.solid().box == (-1, -1, 0, 5, 1, 2)


def test_a_capsule_of_three_numbers_is_a_line_in_space() -> None:
    cable = Obstacle(capsule={"from": (0, 0, 9), "to": (4, 0, 5), "radius": 0.5})
    assert cable.solid() == RoundedSegment((0, 0, 9), (4, 0, 5), 0.5)
    assert cable.ring is None
    mast = Obstacle(capsule={"from": (1, 2, 0), "to": (1, 2, 5), "radius": 0.5})
    assert mast.outline_in_plan is not None
    assert mast.outline_in_plan.is_disc


def test_maps_are_solids_over_all_heights_or_between_some() -> None:
    grid = Grid([[True, False]], 1.0)
    assert Obstacle(grid=grid).solid() == GridPrism(grid)
    assert Obstacle(grid=grid, height_m=(0, 3)).solid() == GridPrism(grid, 0, 3)
    voxels = Voxels(CUBES, 0.5, (1, 2, 3))
    assert Obstacle(voxels=voxels).solid() is voxels


def test_an_array_of_truth_values_is_cubes_of_a_metre() -> None:
    assert Obstacle(voxels=CUBES).voxels == Voxels(CUBES, 1.0)
    with pytest.raises(MissionError, match="voxels have shape"):
        Obstacle(voxels=np.zeros((3, 3), bool))
    with pytest.raises(MissionError, match="voxels: found a list"):
        Obstacle(voxels=[[[True]]])


def test_an_obstacle_without_a_shape_is_no_solid() -> None:
    with pytest.raises(GeometryError, match="no shape"):
        Obstacle().solid()


@pytest.mark.parametrize("key", SOLID_KINDS)
def test_a_flat_world_takes_no_solids(key: str) -> None:
    ball, box = {"center": (0, 0, 0), "radius": 1}, {"min": (0, 0, 0), "max": (1, 1, 1)}
    shape = {"ball": ball, "box": box}
    with pytest.raises(GeometryError, match="a World is flat"):
        World([Obstacle.model_validate({key: shape[key]})])


def test_the_side_that_is_left_in_the_plane_when_one_is_asked_for_or_forbidden() -> None:
    disc = {"center": (0, 0), "radius": 1}
    assert Obstacle(circle=disc, pass_on="over").forced_side is None
    assert Obstacle(circle=disc, never_pass_on="left").forced_side == "right"
