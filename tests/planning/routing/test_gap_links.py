"""Convex pieces: all that bounds the free space, with the gaps between them."""

import numpy as np
import pytest
import shapely

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.routing.gap_links import ConvexPieces, links_among, links_between
from viaspline.world.world import World

DISC = Obstacle(circle={"center": (0, 0), "radius": 2})
CAPSULE = Obstacle(capsule={"from": (5, -3), "to": (5, 3), "radius": 0.5})
HOOK = Obstacle(polygon=[(0, 5), (6, 5), (6, 9), (5, 9), (5, 6), (0, 6)])


def test_what_is_convex_is_one_piece_and_what_is_not_is_its_edges() -> None:
    square = Obstacle(polygon=[(8, 8), (9, 8), (9, 9), (8, 9)])
    pieces = ConvexPieces.of(World([DISC, CAPSULE, HOOK, square]))
    assert np.bincount(pieces.owners).tolist() == [1, 1, 6, 1]
    assert pieces.radii.tolist() == [2, 0.5, *[0] * 7]


def test_the_edges_of_bounds_fences_and_corridors_are_pieces() -> None:
    ring = [(-9, -9), (9, -9), (0, 9)]
    world = World([DISC], bounds=(-10, -10, 10, 10), fences=[ring], corridor=[ring])
    owners = ConvexPieces.of(world).owners.tolist()
    assert owners == [0, *[-2] * 4, *[-3] * 3, *[-4] * 3]
    assert [world.name(k) for k in (-2, -3, -4)] == ["bounds", "fence 1", "corridor"]


def test_gaps_are_as_wide_as_between_the_surfaces_and_no_other_is_told() -> None:
    pieces = ConvexPieces.of(World([DISC, CAPSULE, HOOK]))
    links = links_among(pieces, 2.6)
    for (a, b), width in zip(links.pairs, links.widths, strict=True):
        shapes = [shapely.buffer(pieces.cores[k], pieces.radii[k] + 1e-9, quad_segs=256)
                  for k in (a, b)]  # fmt: skip
        assert max(width, 0.0) == pytest.approx(shapely.distance(*shapes), abs=1e-4)
    assert {(0, 1), (1, 2)} <= {tuple(pair) for pair in links.pairs.tolist()}
    assert links.widths.max() < 2.6


def test_gaps_between_two_groups_are_those_within_their_union() -> None:
    both = ConvexPieces.of(World([DISC, CAPSULE]))
    groups = (ConvexPieces.of(World([DISC])), ConvexPieces.of(World([CAPSULE])))
    between, among = links_between(*groups, 3.0), links_among(both, 3.0)
    assert between.pairs.tolist() == [[0, 0]]
    assert between.widths == pytest.approx(among.widths)
    assert between.feet == pytest.approx(among.feet)


def test_an_empty_world_has_none() -> None:
    assert len(links_among(ConvexPieces.of(World()), 1.0).widths) == 0
