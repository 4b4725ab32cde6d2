"""The bottleneck of the ways between two places, held against shapely."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.routing.bottleneck import Bottleneck, bottleneck_between
from viaspline.world.world import World

BOUNDS = (0.0, 0.0, 12.0, 12.0)
HAIR_M = 2e-3


def between(world: World, start, goal, reach: float) -> Bottleneck | None:
    return bottleneck_between(world, np.array(start, float), np.array(goal, float), reach)


def core_of(obstacle: Obstacle) -> tuple[shapely.Geometry, float]:
    if obstacle.grid is not None:
        rows, columns = np.nonzero(obstacle.grid.blocked)
        return shapely.union_all(shapely.box(columns, rows, columns + 1, rows + 1)), 0.0
    assert obstacle.ring is not None
    return obstacle.ring.core(), obstacle.ring.radius


def is_joined(world: World, start, goal, required: float) -> bool:
    """Whether a robot that needs so much room gets from start to goal, by shapely."""
    grown = [core.buffer(radius + required, quad_segs=64) for core, radius in
             map(core_of, world.obstacles)]  # fmt: skip
    x0, y0, x1, y1 = BOUNDS
    inside = shapely.box(x0 + required, y0 + required, x1 - required, y1 - required)
    parts = shapely.get_parts(inside.difference(shapely.union_all(grown)))
    ends = shapely.points([start, goal])
    return bool(np.logical_and(*(shapely.covers(parts, end) for end in ends)).any())


def random_world(seed: int, kind: str) -> World:
    random = np.random.default_rng(seed)
    if kind == "cells":
        grid = Grid(random.random((12, 12)) < 0.2, 1.0)
        return World([Obstacle(grid=grid)], bounds=BOUNDS)
    known = []
    for _ in range(int(random.integers(3, 14))):
        x, y = random.uniform(0, 12, 2)
        length, angle = random.uniform(1, 6), random.uniform(0, math.tau)
        dx, dy = length * math.cos(angle), length * math.sin(angle)
        if kind == "discs":
            known.append(Obstacle(circle={"center": (x, y), "radius": 0.3 * length}))
        elif kind == "walls":
            line = {"from": (x, y), "to": (x + dx, y + dy), "radius": 0.02}
            known.append(Obstacle(capsule=line))
        else:  # a corner of two walls, not convex
            a, b = np.array([dx, dy]), 0.6 * np.array([-dy, dx])
            ring = np.array([x, y]) + np.stack(
                (0 * a, a, a + 0.1 * b, 0.1 * (a + b), 0.1 * a + b, b)
            )
            known.append(Obstacle(polygon=ring.tolist()))
    return World(known, bounds=BOUNDS)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10**6), st.sampled_from(["cells", "discs", "walls", "corners"]),
       st.floats(0.2, 1.2))  # fmt: skip
@example(0, "cells", 0.7)
@example(1, "walls", 0.9)
def test_ways_are_as_wide_as_the_bottleneck_and_no_wider(
    seed: int, kind: str, required: float
) -> None:
    world = random_world(seed, kind)
    places = np.random.default_rng(seed + 1).uniform(0, 12, (60, 2))
    places = places[world.distance(places) > required + 0.01]
    assume(len(places) >= 2)
    start, goal = places[:2]
    gap = between(world, start, goal, 2.0 * required)
    if gap is None:
        assert is_joined(world, start, goal, required - HAIR_M)
        return
    half = 0.5 * gap.width
    assert not is_joined(world, start, goal, half + HAIR_M)
    if gap.is_shut:
        return
    assert half <= HAIR_M or is_joined(world, start, goal, half - HAIR_M)
    room, nearest = world.nearest(gap.at)
    assert room == pytest.approx(half, abs=1e-6)
    assert int(nearest) in gap.owners or room == pytest.approx(
        min(core.distance(shapely.Point(gap.at)) - r for core, r in map(core_of, world.obstacles))
    )


def test_a_gap_of_a_tenth_of_a_millimetre_is_one() -> None:
    walls = [Obstacle(capsule={"from": (6, -1), "to": (6, 5.9), "radius": 0.1}),
             Obstacle(capsule={"from": (6, 6.1001), "to": (6, 13), "radius": 0.1})]  # fmt: skip
    gap = between(World(walls, bounds=BOUNDS), (2, 2), (9, 9), 1.0)
    assert gap is not None
    assert gap.width == pytest.approx(1e-4)
    assert gap.at == pytest.approx((6.0, 6.0), abs=1e-4)
    assert gap.owners == (0, 1)


def test_what_shuts_a_place_off_is_told_and_nothing_else() -> None:
    box = [(4, 4), (8, 4), (8, 8), (4, 8)]
    walls = [
        Obstacle(capsule={"from": a, "to": b, "radius": 0.1})
        for a, b in zip(box, box[1:] + box[:1], strict=True)
    ]
    aside = Obstacle(capsule={"from": (8, 8), "to": (10, 10), "radius": 0.1})
    gap = between(World([aside, *walls], bounds=BOUNDS), (2, 2), (6, 6), 1.0)
    assert gap is not None
    assert gap.is_shut
    assert set(gap.owners) == {1, 2, 3, 4}


@pytest.mark.parametrize("yaw", [0.0, 0.3])
def test_gaps_between_a_map_and_what_else_there_is_are_found(yaw: float) -> None:
    grid = Grid(np.ones((1, 5), bool), 1.0, (0.0, 6.0, yaw))
    other = Grid(np.ones((2, 20), bool), 0.5, (5.4, 6.0, yaw))
    world = World([Obstacle(grid=grid), Obstacle(grid=other)], bounds=(-1, 0, 15, 13))
    gap = between(world, (2, 2), (2, 11), 2.5)
    assert gap is not None
    assert float(world.distance(gap.at)) == pytest.approx(0.5 * gap.width)
    assert 0.0 < gap.width < 1.5
    assert (gap.owners[0] == -2 and gap.owners[1] >= 0) or gap.owners == (0, 1)


def test_where_one_is_there_is_no_bottleneck() -> None:
    world = random_world(0, "walls")
    assert between(world, (6, 6), (6, 6), 1.0) is None
