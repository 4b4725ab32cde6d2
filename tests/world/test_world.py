import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from viaspline.mission.model import Mission
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

Oracle = Callable[..., Any]
SQUARE = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]
POCKET = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (7.0, 10.0), (7.0, 3.0), (3.0, 3.0), (3.0, 10.0),
          (0.0, 10.0)]  # fmt: skip


def disc(x: float, y: float, radius: float, **more: Any) -> Obstacle:
    return Obstacle(circle=Circle(center=(float(x), float(y)), radius=float(radius)), **more)


def star(rng: np.random.Generator, x: float, y: float, size: float, corners: int) -> Obstacle:
    """A star-shaped polygon, often concave, in either direction, now and then with a hole."""
    angle = np.sort(rng.uniform(0, 2 * np.pi, corners)) + np.linspace(0, 1e-3, corners)
    gaps = np.diff(np.r_[angle, angle[0] + 2 * np.pi])
    if gaps.max() > 0.9 * np.pi:
        angle = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    reach = size * rng.uniform(0.4, 1.0, corners)
    outer = np.column_stack((x + reach * np.cos(angle), y + reach * np.sin(angle)))
    holes = []
    if rng.random() < 0.4:
        # any point of the hole is nearer to the middle than the nearest edge
        room = shapely.Polygon(outer).boundary.distance(shapely.Point(x, y))
        inner = np.array([(x, y)]) + 0.5 * room * np.array([(1, 0), (0, 1), (-1, -0.5)])
        holes.append(tuple(map(tuple, inner.tolist()))[:: rng.choice([1, -1])])
    ring = tuple(map(tuple, outer.tolist()))[:: rng.choice([1, -1])]
    return Obstacle(polygon=ring, holes=tuple(holes))


def random_obstacles(seed: int, count: int, size: float = 100.0) -> list[Obstacle]:
    rng = np.random.default_rng(seed)
    made = []
    for _ in range(count):
        x, y = rng.uniform(0, size, 2)
        if rng.random() < 0.5:
            made.append(disc(x, y, rng.uniform(0.1, 8)))
        else:
            made.append(star(rng, x, y, rng.uniform(0.5, 10), int(rng.integers(3, 40))))
    return made


def random_frame(seed: int) -> dict[str, Any]:
    rng = np.random.default_rng(seed + 1)
    frame: dict[str, Any] = {}
    if rng.random() < 0.6:
        frame["bounds"] = (-5.0, -8.0, 104.0, 110.0)
    if rng.random() < 0.6:
        fence = star(rng, 50, 50, 90, int(rng.integers(3, 12)))
        frame["fences"] = [fence.polygon]
    return frame


seeds = st.integers(0, 10_000)
counts = st.sampled_from([0, 1, 2, 3, 7, 30, 120])


@given(seeds, counts)
def test_the_signed_distance_is_exact(shapely_distance: Oracle, seed: int, count: int) -> None:
    obstacles, frame = random_obstacles(seed, count), random_frame(seed)
    xy = np.random.default_rng(seed + 2).uniform(-30, 130, (200, 2))
    found = World(obstacles, **frame).distance(xy)
    np.testing.assert_allclose(found, shapely_distance(xy, obstacles, **frame), atol=1e-9)


@given(seeds, counts)
def test_the_signed_distance_is_lipschitz(seed: int, count: int) -> None:
    world = World(random_obstacles(seed, count), **random_frame(seed))
    rng = np.random.default_rng(seed + 3)
    here = rng.uniform(-30, 130, (200, 2))
    there = here + rng.normal(0, 1, (200, 2)) * 10.0 ** rng.uniform(-6, 2, (200, 1))
    first, second = world.distance(here), world.distance(there)
    if np.isfinite(first).all():
        assert (np.abs(first - second) <= np.linalg.norm(here - there, axis=1) + 1e-9).all()


@given(seeds, counts.filter(bool))
def test_the_index_names_an_obstacle_that_is_really_nearest(
    shapely_distance: Oracle, seed: int, count: int
) -> None:
    obstacles, frame = random_obstacles(seed, count), random_frame(seed)
    world = World(obstacles, **frame)
    xy = np.random.default_rng(seed + 2).uniform(-30, 130, (60, 2))
    distance, index = world.nearest(xy)
    for point, found, i in zip(xy, distance, index.tolist(), strict=True):
        if i >= 0:
            alone = shapely_distance([point], [obstacles[i]])[0]
        elif i == -2:
            alone = shapely_distance([point], bounds=frame["bounds"])[0]
        else:
            alone = shapely_distance([point], fences=[frame["fences"][-3 - i]])[0]
        assert alone == pytest.approx(found, abs=1e-9)
        assert isinstance(world.name(i), str)


@given(seeds, st.lists(st.integers(0, 9), min_size=1, max_size=12))
def test_adding_obstacles_again_and_again_equals_building_anew(
    seed: int, portions: list[int]
) -> None:
    obstacles, frame = random_obstacles(seed, sum(portions)), random_frame(seed)
    grown, done = World(**frame), 0
    for portion in portions:
        grown = grown.with_obstacles(obstacles[done : done + portion])
        done += portion
    anew = World(obstacles, **frame)
    xy = np.random.default_rng(seed).uniform(-30, 130, (200, 2))
    np.testing.assert_array_equal(grown.distance(xy), anew.distance(xy))
    assert grown.groups(2.0) == anew.groups(2.0)
    assert grown.obstacles == anew.obstacles
    assert len(grown) == len(obstacles)
    for i in range(len(obstacles)):
        np.testing.assert_array_equal(grown.distances_to(i, xy), anew.distances_to(i, xy))


@given(seeds, st.integers(0, 20), st.integers(0, 5))
def test_discs_as_arrays_make_the_same_world(seed: int, count: int, before: int) -> None:
    rng = np.random.default_rng(seed)
    rows = np.column_stack((rng.uniform(0, 30, (count, 2)), rng.uniform(0.01, 2.0, count)))
    discs = tuple(disc(x, y, radius) for x, y, radius in rows.tolist())
    world = World(random_obstacles(seed, before), **random_frame(seed))
    one, other = world.with_obstacles(discs), world.with_discs(discs, rows)
    assert one.obstacles == other.obstacles
    for mine, its in zip(one.packed, other.packed, strict=True):
        assert mine.dtype == its.dtype
        np.testing.assert_array_equal(mine, its)


def test_a_world_knows_its_discs_and_who_asks_for_a_side() -> None:
    post = Obstacle(capsule={"from": (0, 0), "to": (1, 0), "radius": 1}, never_pass_on="left")
    world = World([post, disc(5, 5, 2)]).with_obstacles([disc(9, 9, 1, pass_on="left")])
    assert world.discs.tolist() == [[5, 5, 2], [9, 9, 1]]
    assert world.sided.tolist() == [0, 2]
    assert world.with_side(1, "right").sided.tolist() == [0, 1, 2]
    assert world.with_discs((disc(1, 1, 1),), np.ones((1, 3))).sided.tolist() == [0, 2]


def test_a_thousand_obstacles_seen_one_by_one_are_no_problem() -> None:
    obstacles = random_obstacles(5, 1000)
    world = World(bounds=(0, 0, 100, 100))
    for obstacle in obstacles:
        world = world.with_obstacles([obstacle])
    xy = np.random.default_rng(0).uniform(0, 100, (100, 2))
    anew = World(obstacles, bounds=(0, 0, 100, 100))
    np.testing.assert_array_equal(world.distance(xy), anew.distance(xy))


def test_the_world_that_is_added_to_stays_as_it_was() -> None:
    world = World([disc(0, 0, 1)])
    world.with_obstacles([disc(5, 0, 1)])
    assert len(world) == 1
    assert world.distance((5, 0)) == 4.0


def test_ten_thousand_circles_agree_with_brute_force() -> None:
    rng = np.random.default_rng(3)
    centres = rng.uniform(0, 1000, (10_000, 2))
    world = World([disc(x, y, 1.5) for x, y in centres])
    xy = rng.uniform(-100, 1100, (5000, 2))
    distance, index = world.nearest(xy)
    expected, nearest = cKDTree(centres).query(xy)
    np.testing.assert_allclose(distance, expected - 1.5, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(centres[index] - xy, axis=1), expected)
    assert (index == nearest).mean() > 0.99


def test_ten_thousand_circles_of_all_sizes_agree_with_brute_force() -> None:
    rng = np.random.default_rng(4)
    centres = rng.uniform(0, 1000, (10_000, 2))
    radii = 10.0 ** rng.uniform(-3, 1.5, 10_000)
    world = World([disc(*centre, r) for centre, r in zip(centres, radii, strict=True)])
    xy = rng.uniform(-100, 1100, (200, 2))
    gaps = np.linalg.norm(xy[:, None] - centres, axis=2) - radii
    np.testing.assert_allclose(world.distance(xy), gaps.min(axis=1), atol=1e-9)


@pytest.mark.slow
def test_fifty_thousand_circles_build_and_answer() -> None:
    rng = np.random.default_rng(5)
    centres = rng.uniform(0, 5_000, (50_000, 2))
    obstacles = [
        Obstacle.model_construct(circle=Circle.model_construct(center=(x, y), radius=1.0))
        for x, y in centres.tolist()
    ]
    world = World(obstacles)
    xy = rng.uniform(0, 5_000, (20_000, 2))
    expected, _ = cKDTree(centres).query(xy)
    np.testing.assert_allclose(world.distance(xy), expected - 1.0, atol=1e-9)
    assert sum(map(len, world.groups(0.01))) == 50_000


@given(seeds, st.sampled_from([0, 1, 2, 5, 30]), st.floats(0.0, 8.0))
def test_groups_are_the_connected_components_of_narrow_gaps(
    seed: int, count: int, width: float
) -> None:
    obstacles = random_obstacles(seed, count)
    shapes = []
    radii = np.zeros(count)
    for i, obstacle in enumerate(obstacles):
        if obstacle.circle is not None:
            shapes.append(shapely.Point(obstacle.circle.center))
            radii[i] = obstacle.circle.radius
        else:
            shapes.append(shapely.Polygon(obstacle.polygon, obstacle.holes))
    gaps = np.array([[a.distance(b) for b in shapes] for a in shapes]).reshape(count, count)
    gaps = gaps - radii[:, None] - radii[None, :]
    if (np.abs(gaps - width) < 1e-6).any():
        return  # the question is a matter of rounding
    _, labels = connected_components(coo_matrix(gaps < width), directed=False)
    expected = sorted(tuple(np.flatnonzero(labels == k).tolist()) for k in set(labels.tolist()))
    assert sorted(World(obstacles).groups(width)) == expected


def test_obstacles_inside_a_hole_are_a_group_of_their_own() -> None:
    ring = Obstacle(polygon=SQUARE, holes=([(1.0, 1.0), (9.0, 1.0), (9.0, 9.0), (1.0, 9.0)],))
    assert World([ring, disc(5, 5, 1)]).groups(2.0) == ((0,), (1,))
    assert World([ring, disc(5, 5, 1)]).groups(3.1) == ((0, 1),)


def test_a_circle_swallowed_by_a_polygon_belongs_to_it() -> None:
    polygon = Obstacle(polygon=SQUARE)
    inner = Obstacle(polygon=[(4.0, 4.0), (6.0, 4.0), (5.0, 6.0)])
    assert World([polygon, disc(5, 5, 0.1), inner]).groups(0.1) == ((0, 1, 2),)


@pytest.mark.parametrize("ring", [POCKET, POCKET[::-1]])
def test_a_pocket_is_free_space(ring: list[tuple[float, float]]) -> None:
    world = World([Obstacle(polygon=ring)])
    np.testing.assert_allclose(
        world.distance([(5, 8), (5, 3), (5, 2), (1.5, 9), (5, 12)]), [2, 0, -1, -1, math.sqrt(8)]
    )


def test_vertices_that_repeat_change_nothing() -> None:
    twice = [vertex for vertex in POCKET for _ in range(2)]
    xy = np.random.default_rng(1).uniform(-5, 15, (100, 2))
    plain, doubled = World([Obstacle(polygon=POCKET)]), World([Obstacle(polygon=twice)])
    np.testing.assert_array_equal(plain.distance(xy), doubled.distance(xy))


def test_the_distance_outside_the_bounds_is_negative_and_exact() -> None:
    world = World(bounds=(0, 0, 10, 4))
    np.testing.assert_allclose(
        world.distance([(5, 2), (5, 1), (0, 2), (13, 8), (-2, 2)]), [2, 1, 0, -5, -2]
    )
    assert world.nearest((5, 2))[1] == -2
    assert world.name(-2) == "bounds"


def test_fences_count_from_one_in_names() -> None:
    world = World(fences=[SQUARE, [(-50, -50), (50, -50), (0, 80)]])
    distance, index = world.nearest([(5, 9), (-1, -1)])
    np.testing.assert_allclose(distance, [1, -math.sqrt(2)])
    assert [world.name(i) for i in index] == ["fence 1", "fence 1"]


def test_obstacles_are_called_by_their_places_in_the_list_of_what_is_known() -> None:
    cart = {"circle": {"center": [1, 1], "radius": 1},
            "motion": {"from": [1, 1], "velocity_mps": [1, 0]}}  # fmt: skip
    posts = [{"circle": {"center": [x, 9], "radius": 1}} for x in (20, 40)]
    mission = Mission(world={"known": [cart, *posts]}, route={"start": [0, 0], "goal": [60, 0]})
    world = World.known(mission).with_obstacles([disc(60, 9, 1)])
    assert world.names == ("obstacle 2", "obstacle 3", "obstacle 4")


def test_an_empty_world_is_infinitely_far_away() -> None:
    world = World()
    distance, index = world.nearest([(0, 0), (1e9, 1e9)])
    assert np.isinf(distance).all()
    assert (index == -1).all()
    assert world.groups(5.0) == ()
    assert len(world.with_obstacles([])) == 0


def test_a_third_coordinate_plays_no_part() -> None:
    world = World([disc(0, 0, 1)])
    assert world.distance((3, 4, 1e6)) == 4.0


def test_points_may_come_in_any_shape_that_ends_in_a_point() -> None:
    world = World([disc(0, 0, 1)])
    assert world.distance((3, 4)).shape == ()
    assert world.distance(np.zeros((0, 2))).shape == (0,)
    assert world.distance(np.zeros((3, 5, 2))).shape == (3, 5)


def test_the_known_world_lacks_what_is_unseen() -> None:
    mission = Mission.model_validate(
        {
            "world": {
                "bounds": [0, 0, 50, 50],
                "known": [{"name": "tank", "circle": {"center": [25, 25], "radius": 2}}],
                "unseen": [{"circle": {"center": [40, 40], "radius": 2}}],
            },
            "robot": {"sensor": {"range_m": 10}},
            "route": {"start": [5, 5], "goal": [45, 5]},
        }
    )
    assert World.known(mission).names == ("tank",)
    assert World.everything(mission).names == ("tank", "obstacle 2")
    assert "bounds=(0.0, 0.0, 50.0, 50.0)" in repr(World.everything(mission))


def test_a_million_metres_away_the_distance_keeps_its_micrometre(shapely_distance: Oracle) -> None:
    shift = 1e6
    near = random_obstacles(11, 20)
    far = [
        disc(o.circle.center[0] + shift, o.circle.center[1] + shift, o.circle.radius)
        if o.circle is not None
        else Obstacle(
            polygon=[(x + shift, y + shift) for x, y in o.polygon or ()],
            holes=tuple([(x + shift, y + shift) for x, y in hole] for hole in o.holes),
        )
        for o in near
    ]
    xy = np.random.default_rng(2).uniform(0, 100, (200, 2))
    np.testing.assert_allclose(
        World(far).distance(xy + shift), shapely_distance(xy, near), atol=1e-6
    )


@given(seed=st.integers(0, 10**6), cuts=st.lists(st.integers(0, 150), max_size=6))
@settings(max_examples=15, deadline=None)
def test_a_world_is_the_same_bytes_however_many_of_its_obstacles_came_at_once(
    seed: int, cuts: list[int]
) -> None:
    base, *rest = (random_obstacles(seed, 1), *([o] for o in random_obstacles(seed + 1, 150)))
    new = [one for (one,) in rest]
    at_once = World(base).with_obstacles(new)
    world = World(base)
    for first, last in pairwise(sorted({0, *cuts, 150})):
        world = world.with_obstacles(new[first:last])
    assert all(
        one.tobytes() == other.tobytes()
        for one, other in zip(world.packed, at_once.packed, strict=True)
    )


def test_obstacles_that_come_one_by_one_are_as_near_as_those_that_were_there() -> None:
    obstacles = random_obstacles(7, 300)
    points = np.random.default_rng(7).uniform(-10, 110, (200, 2))
    world = World(obstacles[:20])
    for k in range(20, 300):
        world = world.with_obstacles([obstacles[k]])
        if k % 40 == 0:
            together = World(obstacles[: k + 1])
            assert np.array_equal(world.distance(points), together.distance(points))
            assert world.groups(1.0) == together.groups(1.0)
    nodes = world.packed.leaf.size
    assert nodes <= 2 * len(world)  # no root for each that came


@given(seed=st.integers(0, 10**6), x=st.floats(0, 80), y=st.floats(0, 80), size=st.floats(1, 40))
@settings(max_examples=20, deadline=None)
def test_what_is_near_to_a_box_is_as_far_from_places_in_it_as_it_was(
    seed: int, x: float, y: float, size: float
) -> None:
    world = World(random_obstacles(seed, 60), bounds=(-50, -50, 150, 150))
    near = world.near((x, y, x + size, y + size))
    points = np.random.default_rng(seed).uniform((x, y), (x + size, y + size), (50, 2))
    inside = world.distance(points)
    assert np.all(near.distance(points) >= inside)
    touched = inside <= 0.0
    assert np.array_equal(near.distance(points)[touched], inside[touched])
    assert set(near.names) <= set(world.names)
    assert near.bounds is None


def test_bounds_that_reach_into_a_box_stay() -> None:
    world = World([disc(5, 5, 1)], bounds=(0, 0, 20, 20))
    assert world.near((-1, 2, 8, 8)).bounds == world.bounds
    assert world.near((2, 2, 8, 25)).bounds == world.bounds
    assert len(world.near((10, 10, 12, 12))) == 0


@given(seed=st.integers(0, 10**6), discs=st.integers(0, 40))
@settings(max_examples=15, deadline=None)
def test_what_is_near_stands_where_it_stood_whatever_it_is_packed_as(
    seed: int, discs: int, shapely_distance: Oracle
) -> None:
    rng = np.random.default_rng(seed)
    rows = np.column_stack((rng.uniform(0, 100, (discs, 2)), rng.uniform(0.1, 3, discs)))
    sided = disc(50, 50, 1, name="buoy", pass_on="left")
    world = World((*random_obstacles(seed, 12), sided)).with_obstacles(disc(*row) for row in rows)
    x0, y0 = rng.uniform(0, 60, 2).tolist()
    near = world.near((x0, y0, x0 + 35.0, y0 + 35.0))
    assert set(near.names) <= set(world.names)
    assert [near.name(i) for i in near.sided] == (["buoy"] if "buoy" in near.names else [])
    xy = rng.uniform(0, 100, (200, 2))
    expected = shapely_distance(xy, near.obstacles) if len(near) else np.full(200, np.inf)
    np.testing.assert_allclose(near.distance(xy), expected, atol=1e-9)
