"""A polygonal body at a door, along a wall, on the spot: worked out by hand."""

import math
from typing import Any

import numpy as np
import pytest

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.certificate import PROOF_SLACK_M, PROOF_TOLERANCE_M, certify
from viaspline.curve.footprint_conflicts import body_conflicts
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

LONG = np.array([(-2, -0.5), (2, -0.5), (2, 0.5), (-2, 0.5)], float)


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (float(x), float(y)), "radius": float(radius)})


def box(x0: float, y0: float, x1: float, y1: float) -> Obstacle:
    return Obstacle(polygon=[(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def straight(*points: Any) -> CardinalSpline:
    return CardinalSpline(points, tension=1.0)


def test_a_long_vehicle_goes_through_a_door_that_its_circle_would_not_pass() -> None:
    world = World([box(9, 0.7, 9.2, 20), box(9, -20, 9.2, -0.7)])
    aisle = straight((0, 0), (20, 0))
    found = certify(aisle, world, 0.2, footprint=LONG)
    assert found.holds
    assert found.clearance == pytest.approx(0.2, abs=PROOF_SLACK_M)
    assert not certify(aisle, world, 0.2, radius=math.hypot(2, 0.5)).holds
    assert not certify(aisle, world, 0.2 + 3e-6, footprint=LONG).holds
    assert (body_conflicts(world.packed, np.array(aisle.spans), LONG, 0.2 - 1e-6) == -1).all()
    assert (body_conflicts(world.packed, np.array(aisle.spans), LONG, 0.21) != -1).all()


def test_a_pebble_that_stands_inside_of_the_body_is_found() -> None:
    for pebble in (disc(1.5, 0.2, 1e-3), box(1.5, 0.2, 1.501, 0.201)):
        world = World([pebble])
        found = certify(straight((0, 0), (0.3, 0)), world, 0.0, footprint=LONG)
        assert found.clearance < 0.0
        assert not found.holds
        assert found.obstacle == "obstacle 1"
        assert (
            body_conflicts(
                world.packed, np.array([[(0.0, 0), (0.1, 0), (0.2, 0), (0.3, 0)]]), LONG, 0.0
            )
            == 0
        ).all()
        assert world.body_distance((0, 0), 0.0, LONG) == 0.0
    speck = np.zeros((9, 9), bool)
    speck[4, 4] = True
    world = World([Obstacle(grid=Grid(speck, 0.01, (1.5, 0.2, 0.3)))])
    assert not certify(straight((0, 0), (0.3, 0)), world, 0.0, footprint=LONG).holds
    assert world.body_distance((0, 0), 0.0, LONG) == 0.0


def test_a_turn_on_the_spot_sweeps_what_neither_pose_touches() -> None:
    corner = straight((0, 0), (10, 0), (10, 10))
    post = disc(10 + 1.5 * math.cos(0.785), 1.5 * math.sin(0.785), 0.1)  # between the two poses
    free = disc(10 - 1.5 * math.cos(0.785), -1.5 * math.sin(0.785) - 0.9, 0.1)
    world = World([post])
    heading = np.array([0.0, math.pi / 2])
    stands = world.body_distance([(10, 0), (10, 0)], heading, LONG)
    assert (stands > 0.3).all()
    found = certify(corner, world, 0.0, footprint=LONG)
    assert found.clearance < 0.0
    assert found.tightest_at == pytest.approx((10, 0))
    assert body_conflicts(world.packed, np.array(corner.spans), LONG, 0.0).tolist() == [-1, 0]
    assert certify(corner, World([free]), 0.0, footprint=LONG).holds


def test_the_seam_of_a_closed_polyline_is_a_turn_on_the_spot() -> None:
    ring = [(0, 0), (20, 0), (20, 20), (0, 20)]
    closed = CardinalSpline(ring, tension=1.0, closed=True)
    post = disc(1.5 * math.cos(0.785), -1.5 * math.sin(0.785), 0.1)
    found = certify(closed, World([post]), 0.0, footprint=LONG)
    assert found.clearance < 0.0
    assert found.tightest_u in (0.0, 4.0)
    again = PiecewiseCubic(closed.spans)
    assert certify(again, World([post]), 0.0, footprint=LONG).holds


def test_where_a_curve_turns_back_both_ways_round_are_proven() -> None:
    there_and_back = straight((0, 0), (10, 0), (0, 0.0))
    for y in (1.5, -1.5):
        assert not certify(there_and_back, World([disc(10, y, 0.1)]), 0.0, footprint=LONG).holds
    cusp = PiecewiseCubic([[(0, 0), (10, 10), (0, 10), (10, 0)]])
    top = cusp.evaluate(0.5)
    for angle in np.linspace(0, 6, 12):
        x, y = top + 1.9 * np.array([math.cos(angle), math.sin(angle)])
        assert not certify(cusp, World([disc(x, y, 0.05)]), 0.0, footprint=LONG).holds


def test_a_body_along_a_wall_at_exactly_what_is_required_holds() -> None:
    world = World([box(-500, 1, 1500, 9), box(-500, -9, 1500, -1)])
    curve = CardinalSpline([(x, 0) for x in range(0, 1001, 50)])
    assert certify(curve, world, 0.5, footprint=LONG).holds
    assert certify(curve, world, 0.3, footprint=LONG, radius=0.2).holds
    assert not certify(curve, world, 0.5 + 3e-6, footprint=LONG).holds


def test_a_body_round_a_pillar_at_a_constant_distance_is_proven_to_a_millimetre() -> None:
    angle = np.linspace(0, 1.5 * math.pi, 40)
    curve = CardinalSpline(np.column_stack((10 * np.cos(angle), 10 * np.sin(angle))))
    found = certify(curve, World([disc(0, 0, 8)]), 1.0, footprint=LONG)
    # the ends bend the curve; between them the middle of the side is nearest
    assert found.clearance == pytest.approx(1.5, abs=0.02)


def test_an_empty_world_leaves_infinite_clearance() -> None:
    found = certify(straight((0, 0), (1, 0)), World(), 5.0, footprint=LONG)
    assert math.isinf(found.clearance)
    assert found.obstacle is None
    assert found.contact is None
    assert np.isinf(World().body_distance((0, 0), 0.0, LONG))


def test_a_curve_that_is_a_single_point_is_proven_for_every_heading() -> None:
    curve = PiecewiseCubic(np.ones((1, 4, 2)))
    found = certify(curve, World([disc(1, 6, 1)]), 1.0, footprint=LONG)
    assert found.clearance == pytest.approx(4 - math.hypot(2, 0.5), abs=PROOF_TOLERANCE_M)


def test_a_curve_in_space_counts_by_its_ground_track() -> None:
    track = CardinalSpline([(0, 0), (10, 5), (20, 0)])
    lifted = CardinalSpline([(0, 0, 3), (10, 5, 9), (20, 0, 1)])
    world = World([disc(10, 9, 1)])
    on_ground = certify(track, world, 1.0, footprint=LONG)
    assert certify(lifted, world, 1.0, footprint=LONG).clearance == on_ground.clearance


@pytest.mark.parametrize(
    ("footprint", "message"),
    [
        ([(0, 0), (1, 0)], "2 corners"),
        ([(1, -1), (3, -1), (3, 1), (1, 1)], "does not contain its reference point"),
        ([(0, -1), (3, -1), (3, 1), (0, 1)], "lies on its edge"),
        ([(-1, -1), (1, 1), (1, -1), (-1, 1)], "crosses itself"),
        ([(-1, 0), (0, 0), (1, 0)], "no area"),
        ([(-1, -1), (1, math.nan), (1, 1)], "finite"),
        ([1, 2, 3], "shape"),
    ],
)
def test_a_footprint_that_is_no_body_is_refused(footprint: Any, message: str) -> None:
    with pytest.raises(GeometryError, match=message):
        certify(straight((0, 0), (1, 0)), World(), 1.0, footprint=footprint)
    with pytest.raises(GeometryError, match=message):
        World().body_distance((0, 0), 0.0, footprint)


def test_headings_have_to_go_with_the_positions() -> None:
    world = World([disc(9, 0, 1)])
    with pytest.raises(GeometryError, match="headings"):
        world.body_distance([(0, 0), (1, 0)], [0.0], LONG)
    with pytest.raises(GeometryError, match="headings"):
        world.body_distance((0, 0), math.nan, LONG)
    assert world.body_distance([(0, 0), (1, 0)], 0.0, LONG).tolist() == [6.0, 5.0]
