"""Strings pulled taut on cases worked out by hand, and against a visibility graph."""

import heapq
import itertools
import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.kernels.routing.string_pulling.pull import pulled_taut
from viaspline.kernels.routing.tangent_arcs import SIDE, TURN, taut_length
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.routing.lattices import lattices
from viaspline.world.world import World

Floats = NDArray[np.float64]
RHO = 1.0
STEPS = np.array([math.pi / 6, math.pi / 32, math.pi / 200])
OFF = np.array([1e-3, 1e-4, -2.5e-7])  # beyond what is required, as a router tries it
seeds = st.integers(0, 2**32)


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (float(x), float(y)), "radius": float(radius)})


def square(x: float, y: float, side: float) -> Obstacle:
    return Obstacle(polygon=[(x, y), (x + side, y), (x + side, y + side), (x, y + side)])


def pulled(world: World, guide: Any, rho: float = RHO, side: float = 1.0) -> Any:
    places = np.array(guide, float)
    w = np.linspace(0, 1, 200)[:, None]
    along = np.vstack([a + w * (b - a) for a, b in itertools.pairwise(places)])
    kept = 0.999 * min(float(world.distance(along).min()), rho + 2e-3)
    return pulled_taut(world.packed, places, kept, rho + OFF, rho - 5e-7, side, STEPS)


def length(bends: Floats) -> float:
    return float(taut_length(np.empty((0, 8)), bends))


def wound_guide(turns: float, radius: float) -> Floats:
    """From (-9, 0) so many turns clockwise round the origin, and off to 9 m from it again."""
    lean = math.acos(radius / 9)
    angle = math.pi - lean - np.linspace(0, math.tau * turns - 2 * lean, 60)
    ring = radius * np.column_stack((np.cos(angle), np.sin(angle)))
    last = math.pi - math.tau * turns
    return np.vstack(([-9.0, 0.0], ring, [9 * math.cos(last), 9 * math.sin(last)]))


@pytest.mark.parametrize("guide", [[(0, 0), (9, 0)], [(0, 0), (2, 3), (4, -3), (9, 0)]])
def test_in_an_empty_world_a_string_is_straight(guide: Any) -> None:
    bends, corners, _ = pulled(World([]), guide)
    assert len(bends) == 2
    np.testing.assert_array_equal(corners[:, X : Y + 1], [(0, 0), (9, 0)])


@pytest.mark.parametrize("guide", [[(3, 3), (3, 3)], [(3, 3), (5, 5), (3, 3)]])
def test_a_string_to_where_it_begins_has_no_length(guide: Any) -> None:
    bends, corners, _ = pulled(World([disc(0, 0, 1)]), guide)
    assert len(bends) == len(corners) == 2
    assert length(bends) == 0.0


def test_a_string_that_is_widened_past_two_discs_that_overlap_comes_to_rest() -> None:
    hub = [(14.833, 14.954), (14.788, 15.263), (14.351, 15.229), (14.193, 14.699),
           (14.705, 14.599), (14.807, 14.676)]  # fmt: skip
    stone = [(15.149, 19.938), (14.781, 20.217), (14.479, 19.867), (14.319, 19.705),
             (14.596, 19.394), (14.866, 19.442)]  # fmt: skip
    discs = disc(15.88635, 17.20836, 0.72649), disc(15.85134, 17.37575, 0.7608)
    guide = [(14.94, 13.77), (15.3, 14.47), (15.3, 16.23), (15.18, 16.24), (14.7, 17.05),
             (14.6, 17.2), (14.6, 18.81), (14.2, 19.1), (13.89, 19.4), (13.89, 20.27)]  # fmt: skip
    world = World([Obstacle(polygon=hub), *discs, Obstacle(polygon=stone)])
    bends, corners, _ = pulled(world, guide, rho=0.48478, side=0.117)
    assert len(bends) == 7  # none where it gets stuck
    line = shapely.LineString(corners[:, X : Y + 1])
    for one in discs:
        assert line.distance(shapely.Point(one.circle.center)) >= one.circle.radius + 0.484779


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_string_lies_on_the_side_of_its_guide(side: float) -> None:
    guide = [(-13, 0), (-4, 6 * side), (0, 6 * side), (4, 6 * side), (13, 0)]
    bends, corners, _ = pulled(World([disc(0, 0, 4)]), guide)
    assert bends[1, SIDE] == -side
    assert length(bends) == pytest.approx(24 + 10 * math.asin(5 / 13), abs=2e-3)
    assert (np.hypot(corners[:, X], corners[:, Y]) >= 5.0).all()


def test_places_on_a_straight_piece_of_the_guide_make_no_difference() -> None:
    bent = [(-9, 0), (-3, 6), (3, 6), (9, 0)]
    w = np.linspace(0, 1, 7)[:-1, None]
    a, b = np.array(bent[:-1], float), np.array(bent[1:], float)
    fine = np.vstack([*(p + w * (q - p) for p, q in zip(a, b, strict=True)), bent[-1]])
    world = World([square(-2, -4, 4)])
    np.testing.assert_allclose(pulled(world, bent)[0], pulled(world, fine)[0], atol=1e-12)


@pytest.mark.parametrize("turns", [0.5, 1.0, 2.5, 3.25])
@pytest.mark.parametrize("radius", [0.5, 3.0])
def test_a_guide_may_turn_round_the_same_disc_many_times(turns: float, radius: float) -> None:
    guide = wound_guide(turns, radius + 1.2)
    bends, _, _ = pulled(World([disc(0, 0, radius)]), guide, side=0.5)
    turned = math.tau * turns - 2 * math.acos((radius + 1.001) / 9)
    assert bends[1:-1, TURN].sum() == pytest.approx(turned)
    tangents = 2 * math.sqrt(81 - (radius + 1.001) ** 2)
    assert length(bends) == pytest.approx(tangents + (radius + 1.001) * turned)


def test_corners_of_polygons_and_grids_are_turned_alike() -> None:
    guide = [(-7, 1), (-4, 4), (4, 4), (7, 1)]
    drawn = pulled(World([square(-2, -2, 4)]), guide)[0]
    grid = Grid(np.ones((4, 4), bool), 1.0, (-2.0, -2.0, 0.0))
    mapped = pulled(World([Obstacle(grid=grid)]), guide)[0]
    assert len(drawn) == 4
    np.testing.assert_allclose(mapped, drawn, atol=1e-9)


def test_a_fence_is_turned_at_its_inner_corners() -> None:
    fence = [(0, 0), (60, 0), (60, 20), (20, 20), (20, 60), (0, 60)]
    bends, corners, _ = pulled(World(fences=[fence]), [(10, 55), (18, 18), (55, 10)])
    assert len(bends) == 3
    assert (np.hypot(corners[1:-1, X] - 20, corners[1:-1, Y] - 20) >= 1.0).all()


@pytest.mark.parametrize("spare", [2e-4, 1e-2])
def test_a_gap_that_is_wide_enough_is_passed(spare: float) -> None:
    reach = 4 + 1 + spare
    world = World([disc(0, reach, 4), disc(0, -reach, 4)])
    bends, _, _ = pulled(world, [(-20, 3), (-5, 0), (5, 0), (20, -3)])
    assert len(bends) == 4


def test_of_a_gap_that_is_too_narrow_the_two_obstacles_are_told() -> None:
    world = World([disc(0, 4.9, 4), disc(1, -4.9, 4)])
    bends, corners, stuck = pulled(world, [(-20, 9), (0, 0), (1, 0), (20, -9)])
    assert len(bends) == len(corners) == 0
    assert stuck[0, 4] == -1.0
    assert {tuple(stuck[0, :2]), tuple(stuck[0, 2:4])} == {(0.0, 4.9), (1.0, -4.9)}


@pytest.mark.parametrize("spare", [-1e-3, 6e-4, 5e-3])
def test_a_gap_too_narrow_for_one_margin_is_passed_with_a_smaller_one(spare: float) -> None:
    edge = 0.01 + 2.0 * RHO + spare
    wall = Obstacle(polygon=[(-3, edge), (3, edge), (3, edge + 4), (-3, edge + 4)])
    middle = 0.5 * (0.01 + edge)
    guide = [(-9, 6), (-5, 6), (-5, middle), (0, middle), (3, middle), (9, -5)]
    bends, _, stuck = pulled(World([wall, disc(0, 0, 0.01)]), guide, side=0.5)
    assert (len(bends) > 0) == (spare > 0.0)
    assert len(bends) or stuck[0, 4] == -1.0


def test_of_a_gap_beside_a_straight_wall_a_place_on_that_is_told() -> None:
    wall = Obstacle(polygon=[(-30, 0.9), (30, 0.9), (30, 3), (-30, 3)])
    bends, _, stuck = pulled(World([wall, disc(0, -2.0, 1.0)]), [(-9, -0.04), (9, -0.04)])
    assert len(bends) == 0
    assert stuck[0, 4] == -1.0
    np.testing.assert_allclose(stuck[0, :2], (0, -2))
    assert stuck[0, 3] == pytest.approx(0.9, abs=1e-4)
    assert math.hypot(*(stuck[0, 2:4] - stuck[0, :2])) - 1.0 < 2.0


@pytest.mark.parametrize("goal", [(0.0, 5.0), (0.0, -5.0), (9.0, 8.5)])
def test_places_at_just_the_distance_that_is_required_can_be_left(goal: Any) -> None:
    over = [(-5, 0), (-5, 5), (0, 7), goal]
    guide = over if goal[1] >= 0 else [(-5, 0), (-5, -5), goal]
    bends, corners, _ = pulled(World([disc(0, 0, 4)]), guide, side=2.0)
    assert len(bends) == 3
    pieces = zip(corners[:-1, X : Y + 1], corners[1:, X : Y + 1], strict=True)
    origin = shapely.Point(0, 0)
    assert min(shapely.LineString(piece).distance(origin) for piece in pieces) >= 5 - 1e-6


def random_world(rng: np.random.Generator) -> tuple[World, list[Any]]:
    """A world of discs, polygons, a turned grid and perhaps a fence, and the same as shapes."""
    made: list[Obstacle] = []
    shapes: list[Any] = []
    for _ in range(int(rng.integers(0, 6))):
        x, y = rng.uniform(2, 28, 2)
        if rng.random() < 0.5:
            radius = float(rng.uniform(0.2, 3))
            made.append(disc(x, y, radius))
            shapes.append((shapely.Point(x, y), radius))
        else:
            angle = np.linspace(0, 2 * np.pi, 5, endpoint=False) + rng.uniform(0, 0.9, 5)
            reach = rng.uniform(0.5, 4, 5)
            ring = np.column_stack((x + reach * np.cos(angle), y + reach * np.sin(angle)))
            made.append(Obstacle(polygon=ring))
            shapes.append((shapely.Polygon(ring), 0.0))
    if rng.random() < 0.4:
        blocked = rng.random((4, 5)) < 0.4
        yaw = float(rng.choice([0.0, 0.5]))
        made.append(Obstacle(grid=Grid(blocked, 1.9, (8.0, 6.0, yaw))))
        cells = [shapely.box(c, r, c + 1, r + 1) for r, c in np.argwhere(blocked)]
        drawn = shapely.affinity.scale(shapely.union_all(cells), 1.9, 1.9, origin=(0, 0))
        turned = shapely.affinity.rotate(drawn, yaw, (0, 0), use_radians=True)
        shapes.append((shapely.affinity.translate(turned, 8, 6), 0.0))
    fences: list[Any] = []
    if rng.random() < 0.3:
        fences = [((-3, -3), (33, -3), (33, 33), (15, float(rng.uniform(8, 30))), (-3, 33))]
        frame = shapely.box(-50, -50, 80, 80)
        shapes.append((frame.difference(shapely.Polygon(fences[0])), 0.0))
    return World(made, fences=fences), shapes


def visibility_length(shapes: list[Any], start: Any, goal: Any, more: float, cut: float) -> float:
    """Shortest way round shapes grown by ``more``, as many-gons scaled by ``cut``, by Dijkstra."""
    grown = [
        shape.buffer((radius + more) * (cut if radius else 1.0) + (cut - 1.0), quad_segs=12)
        for shape, radius in shapes
    ]
    union = shapely.union_all(grown)
    parts = getattr(union, "geoms", [union])
    rings = [
        ring for part in parts if not part.is_empty for ring in (part.exterior, *part.interiors)
    ]
    nodes = np.array([start, goal, *(xy for ring in rings for xy in ring.coords[:-1])])
    pairs = np.array(list(itertools.combinations(range(len(nodes)), 2)))
    solid = union.buffer(-1e-7)
    shapely.prepare(solid)
    free = ~shapely.intersects(solid, shapely.linestrings(nodes[pairs]))
    gaps = np.full((len(nodes), len(nodes)), np.inf)
    i, j = pairs[free].T
    gaps[i, j] = gaps[j, i] = np.hypot(*(nodes[i] - nodes[j]).T)
    best = np.full(len(nodes), np.inf)
    queue = [(0.0, 0)]
    while queue:
        far, here = heapq.heappop(queue)
        if far >= best[here]:
            continue
        best[here] = far
        for other in np.flatnonzero(far + gaps[here] < best):
            heapq.heappush(queue, (far + gaps[here, other], int(other)))
    return float(best[1])


@pytest.mark.long_without_jit
@settings(max_examples=10)
@given(seeds)
def test_strings_of_guides_through_lattices_are_the_shortest_ways(seed: int) -> None:
    rng = np.random.default_rng(seed)
    world, shapes = random_world(rng)
    places = rng.uniform(0, 30, (60, 2))
    distance = world.distance(places)
    ends = places[distance > RHO + 0.01][:2]
    if len(ends) < 2:
        return
    lattice = next(iter(lattices(world, RHO, RHO - 5e-7, ends)))
    guide = lattice.guide(*ends)
    if guide is None:
        return
    bends, corners, _ = pulled(world, guide, side=lattice.side)
    if len(bends) == 0:
        return
    route = shapely.LineString(corners[:, X : Y + 1])
    for shape, radius in shapes:
        assert route.distance(shape) - radius >= RHO - 1e-6
    assert length(bends) <= route.length + 1e-9
    # an arc's many-gon lies inside of it by a part of 1 - cos(pi / 48) < 0.0022
    assert length(bends) >= visibility_length(shapes, ends[0], ends[1], RHO, 1.0) - 1e-6
    assert (
        length(bends)
        <= 1.002 * visibility_length(shapes, ends[0], ends[1], RHO + 0.01, 1.01) + 0.02
    )
