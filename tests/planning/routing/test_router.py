import heapq
import itertools
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage

from viaspline.kernels.world.corner_fans import X, Y
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.routing.route_problem import NO_BARRIERS, SearchSpace
from viaspline.planning.routing.router import Router
from viaspline.planning.routing.side_barrier import barriers_of
from viaspline.planning.routing.taut_path import TautPath
from viaspline.world.world import World

Oracle = Callable[..., Any]
seeds = st.integers(0, 100_000)
L_SHAPE = [(0, 0), (60, 0), (60, 20), (20, 20), (20, 60), (0, 60)]


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (float(x), float(y)), "radius": float(radius)})


def polygon(*ring: tuple[float, float]) -> Obstacle:
    return Obstacle(polygon=ring)


def taut_path(world: World, start: Any, goal: Any, required: float = 1.0) -> TautPath | None:
    places = np.array([start, goal], float)
    active = np.zeros(len(world), np.bool_)
    return Router(world, required, places).find(*places, NO_BARRIERS, active).value


def random_obstacles(rng: np.random.Generator, count: int, size: float) -> list[Obstacle]:
    made = []
    for _ in range(count):
        x, y = rng.uniform(0, size, 2)
        if rng.random() < 0.5:
            made.append(disc(x, y, rng.uniform(1, 0.12 * size)))
            continue
        corners = int(rng.integers(3, 8))
        angle = np.linspace(0, 2 * np.pi, corners, endpoint=False) + rng.uniform(0, 0.3, corners)
        reach = rng.uniform(0.03, 0.15, corners) * size
        ring = np.column_stack((x + reach * np.cos(angle), y + reach * np.sin(angle)))
        made.append(Obstacle(polygon=ring[:: rng.choice([1, -1])]))
    return made


def shape_of(obstacle: Obstacle, more: float, quarter: int) -> Any:
    if obstacle.circle is not None:
        point = shapely.Point(obstacle.circle.center)
        return point.buffer(obstacle.circle.radius + more, quad_segs=quarter)
    return shapely.Polygon(obstacle.polygon).buffer(more, quad_segs=quarter)


def visibility_length(
    obstacles: list[Obstacle], more: float, start: Any, goal: Any, quarter: int
) -> float:
    """Shortest way round obstacles inflated to many-cornered polygons, by Dijkstra."""
    union = shapely.union_all([shape_of(obstacle, more, quarter) for obstacle in obstacles])
    nodes = [tuple(start), tuple(goal)]
    for part in getattr(union, "geoms", [union]):
        if not part.is_empty:
            rings = [part.exterior, *part.interiors]
            nodes += [xy for ring in rings for xy in list(ring.coords)[:-1]]
    solid = union.buffer(-1e-7)
    shapely.prepare(solid)
    pairs = np.array(list(itertools.combinations(range(len(nodes)), 2)))
    places = np.array(nodes)
    free = ~shapely.intersects(solid, shapely.linestrings(places[pairs]))
    around: dict[int, list[tuple[int, float]]] = {k: [] for k in range(len(nodes))}
    for i, j in pairs[free].tolist():
        gap = float(np.hypot(*(places[i] - places[j])))
        around[i].append((j, gap))
        around[j].append((i, gap))
    best = {0: 0.0}
    queue = [(0.0, 0)]
    while queue:
        length, here = heapq.heappop(queue)
        if here == 1:
            return length
        if length > best[here]:
            continue
        for other, gap in around[here]:
            if length + gap < best.get(other, np.inf):
                best[other] = length + gap
                heapq.heappush(queue, (length + gap, other))
    return np.inf


def corner_length(found: TautPath) -> float:
    places = found.corners[:, X : Y + 1]
    return float(np.linalg.norm(np.diff(places, axis=0), axis=1).sum())


def clear_places(rng: np.random.Generator, distance: Callable[[Any], Any], size: float) -> Any:
    places = rng.uniform(0, size, (400, 2))
    free = places[distance(places) > 1.05]
    return free[:2] if len(free) > 1 else None


@settings(max_examples=25)
@given(seeds, st.integers(1, 7))
def test_the_way_is_as_short_as_the_visibility_graph_says(
    shapely_distance: Oracle, seed: int, count: int
) -> None:
    rng = np.random.default_rng(seed)
    obstacles = random_obstacles(rng, count, 50.0)
    ends = clear_places(rng, lambda xy: shapely_distance(xy, obstacles), 50.0)
    if ends is None:
        return
    found = taut_path(World(obstacles), *ends)
    # corners on the arcs cut them short, corners outside of them lead a little far round
    shortest = visibility_length(obstacles, 1.0, *ends, 8)
    if found is None:
        # only where the obstacles shut one end in, to within what separates the two models
        assert visibility_length(obstacles, 1.0 + 0.05, *ends, 8) == np.inf
        return
    assert found.length >= shortest - 1e-6
    longest = visibility_length(obstacles, 1.0 + 0.1, *ends, 8)
    assert found.length <= 1.007 * longest + 0.01
    assert found.length <= corner_length(found) + 1e-9


@pytest.mark.slow
@settings(max_examples=15)
@given(seeds, st.integers(1, 60))
def test_a_way_is_found_where_there_is_one_and_only_there(
    shapely_distance: Oracle, seed: int, count: int
) -> None:
    rng = np.random.default_rng(seed)
    obstacles, bounds = random_obstacles(rng, count, 60.0), (-2.0, -2.0, 62.0, 62.0)
    fences = [L_SHAPE] if rng.random() < 0.3 else []

    def distance(xy: Any) -> Any:
        return shapely_distance(xy, obstacles, bounds, fences)

    ends = clear_places(rng, distance, 60.0)
    if ends is None:
        return
    step = 0.4
    axis = np.arange(-2.0, 62.0 + step / 2, step)
    grid = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1)
    room = distance(grid.reshape(-1, 2)).reshape(axis.size, axis.size)
    cells = [tuple(np.round((end + 2.0) / step).astype(int)) for end in ends]
    found = taut_path(World(obstacles, bounds=bounds, fences=fences), *ends)
    slip = step * np.sqrt(0.5)
    wide, _ = ndimage.label(room >= 1.0 + 2 * slip + 0.01, np.ones((3, 3)))
    narrow, _ = ndimage.label(room >= 1.0 - slip, np.ones((3, 3)))
    if wide[cells[0]] and wide[cells[0]] == wide[cells[1]]:
        assert found is not None
    if narrow[cells[0]] != narrow[cells[1]]:
        assert found is None
    if found is not None:
        places = found.corners[:, X : Y + 1]
        w = np.linspace(0, 1, 200)[:, None]
        for a, b in itertools.pairwise(places):
            assert distance(a + w * (b - a)).min() >= 1.0 - 1e-6


def test_nothing_in_the_way_leaves_the_straight_line() -> None:
    found = taut_path(World([disc(5, 10, 2)]), (0, 0), (10, 0))
    assert found is not None
    assert found.is_direct
    assert found.length == 10.0


def test_the_way_round_a_circle_is_two_tangents_and_an_arc() -> None:
    found = taut_path(World([disc(0, 0, 4)]), (-13, 0), (13, 0), 1.0)
    assert found is not None
    angle = 2 * np.arcsin(5 / 13)
    assert found.length == pytest.approx(2 * 12 + 5 * angle, abs=2e-3)


def test_the_way_into_a_pocket_goes_in_at_its_mouth() -> None:
    pocket = polygon((0, 0), (20, 0), (20, 20), (15, 20), (15, 5), (5, 5), (5, 20), (0, 20))
    found = taut_path(World([pocket]), (10, -10), (10, 8))
    assert found is not None
    assert found.length > 40
    assert taut_path(World([pocket]), (10, -10), (10, 8), 5.1) is None


def test_a_gap_a_tenth_of_a_millimetre_wider_than_the_body_is_passed() -> None:
    for radius in (0.5, 10.0, 200.0):
        reach = radius + 1.0 + 0.5e-4
        world = World(
            [disc(0, reach, radius), disc(0, -reach, radius)], bounds=(-900, -reach, 900, reach)
        )
        found = taut_path(world, (-600, 0), (600, 0))
        assert found is not None
        assert found.length == pytest.approx(1200.0)
        off_line = taut_path(world, (-600, 30) if radius > 100 else (-600, 0.4), (600, -0.3))
        assert off_line is not None


def test_a_gap_a_tenth_of_a_millimetre_too_narrow_is_not() -> None:
    reach = 11.0 - 0.5e-4
    world = World([disc(0, reach, 10), disc(0, -reach, 10)], bounds=(-50, -reach, 50, reach))
    assert taut_path(world, (-30, 0), (30, 0)) is None


def test_a_gap_between_walls_may_be_as_narrow() -> None:
    walls = [
        polygon((0, 1 + 5e-5), (5, 1 + 5e-5), (5, 60), (0, 60)),
        polygon((0, -1 - 5e-5), (5, -1 - 5e-5), (5, -60), (0, -60)),
    ]
    found = taut_path(World(walls, bounds=(-60, -60, 60, 60)), (-30, 25), (30, -25))
    assert found is not None


@pytest.mark.parametrize("ring", [L_SHAPE, L_SHAPE[::-1], [*L_SHAPE, L_SHAPE[0]]])
def test_the_inner_corner_of_a_fence_is_turned_at(ring: list[tuple[float, float]]) -> None:
    found = taut_path(World(fences=[ring]), (10, 55), (55, 10))
    assert found is not None
    away = np.hypot(10, 35)  # of both ends from the inner corner (20, 20)
    between = 2 * np.pi - 2 * (np.arctan2(35, -10) - np.pi / 4)
    arc = between - 2 * np.arccos(1 / away)
    assert found.length == pytest.approx(2 * np.sqrt(away**2 - 1) + arc, abs=2e-3)


def test_nothing_leads_over_bounds_that_cut_the_only_way() -> None:
    wall = polygon((40, -10), (50, -10), (50, 110), (40, 110))
    assert taut_path(World([wall]), (10, 50), (90, 50)) is not None
    assert taut_path(World([wall], bounds=(0, 0, 100, 100)), (10, 50), (90, 50)) is None


def test_places_at_just_the_distance_that_is_required_can_be_left() -> None:
    found = taut_path(World([disc(0, 0, 4), disc(8, 8, 2)]), (-5, 0), (5, 0))
    assert found is not None
    assert found.length == pytest.approx(5 * np.pi, abs=1e-3)
    wall = polygon((-10, -5), (10, -5), (10, 0), (-10, 0))
    found = taut_path(World([wall]), (0, 1), (0, -6))
    assert found is not None
    assert found.length == pytest.approx(10 * 2 + np.pi + 5, abs=5e-3)


def test_overlapping_obstacles_are_gone_round_as_one() -> None:
    chain = [disc(0, y, 3) for y in range(-12, 13, 4)]
    found = taut_path(World(chain), (-20, 1), (20, 1))
    assert found is not None
    assert visibility_length(chain, 1.0, (-20, 1), (20, 1), 16) <= found.length + 1e-6
    assert found.length <= 1.002 * visibility_length(chain, 1.002, (-20, 1), (20, 1), 16) + 0.01


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(
    "obstacle",
    [
        disc(50, 3, 8),
        polygon((90, -2), (45, 12), (40, -9)),
        polygon((500, 300), (45, 12), (40, -9)),  # most of it lies beyond the goal
        polygon((-300, 60), (60, -8), (50, 20)),
    ],
)
def test_a_barrier_closes_one_side(obstacle: Obstacle, side: Any) -> None:
    world = World([obstacle])
    start, goal = np.array([0.0, 0.0]), np.array([100.0, 0.0])
    closed = barriers_of(world, 0, start, goal).closing(side)
    places = np.array([start, goal])
    found = Router(world, 1.0, places).find(start, goal, closed, np.zeros(1, np.bool_)).value
    other = barriers_of(world, 0, start, goal).closing("right" if side == "left" else "left")
    assert found is not None
    assert not found.crosses(closed)
    assert found.crosses(other)


def test_a_space_whose_lattices_were_begun_can_be_pickled_and_makes_the_same_again() -> None:
    space = SearchSpace(World([disc(10, 0, 3)]), 0.5, np.array([[0.0, 0.0], [20.0, 0.0]]))
    here = list(itertools.islice(space.ever_finer(), 2))
    there = list(itertools.islice(pickle.loads(pickle.dumps(space)).ever_finer(), 2))
    assert here
    assert len(here) == len(there)
    assert pickle.dumps(here[0]) == pickle.dumps(there[0])


def test_lattices_that_were_let_go_are_made_again_as_they_were() -> None:
    places = np.array([[-10.0, 0.0], [10.0, 0.0]])
    router = Router(World([disc(0, 0, 3)], bounds=(-20, -20, 20, 20)), 1.0, places)
    before = router.lattice.cells
    router.without_lattices()
    assert not router.has_lattice
    np.testing.assert_array_equal(router.lattice.cells, before)
    assert router.has_lattice


def test_a_router_among_made_lattices_shares_them() -> None:
    places = np.array([[-10.0, 0.0], [10.0, 0.0]])
    router = Router(World([disc(0, 0, 3)], bounds=(-20, -20, 20, 20)), 1.0, places)
    made = router.among_made
    assert not made.has_lattice
    assert router.lattice is made.lattice
    assert made.pulled is router.pulled
    router.without_lattices()
    assert not router.among_made.has_lattice
