"""Routes in space: clear at every sample, as short as can be known, refused where none is."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism, RoundedSegment, Solid
from viaspline.planning.problem.method import Found, GaveUp, Refusal
from viaspline.space.routing.pass_gates import SIDE_BITS, PassSide, gate
from viaspline.space.routing.search_room import SearchRoom
from viaspline.space.routing.shut_sides import is_shut
from viaspline.space.routing.side_seeds import seeds
from viaspline.space.routing.space_router import SpaceRouter
from viaspline.space.routing.taut_route import TautRoute
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld

SPEEDS = (10.0, 2.5, 1.5)


def block(x: float, y: float, a: float, b: float, low: float, high: float) -> Prism:
    return Prism(
        RoundedRing([[(x - a, y - b), (x + a, y - b), (x + a, y + b), (x - a, y + b)]]), low, high
    )


def router(solids: list[Solid], **kept: object) -> SpaceRouter:
    band = HeightBand(lowest=1.0, highest=60.0)
    world = SpatialWorld.of(solids, ground=0.0, bounds=(-50, -50, 50, 50), band=band, **kept)
    return SpaceRouter(SearchRoom.of_world(world))


def town(rng: np.random.Generator) -> list[Solid]:
    found: list[Solid] = []
    for _ in range(8):
        x, y = rng.uniform(-35, 35, 2)
        a, b = rng.uniform(3, 9, 2)
        found.append(block(x, y, a, b, 0.0, float(rng.uniform(5, 70))))
        place = tuple(rng.uniform((-40, -40, 5), (40, 40, 50)).tolist())
        found.append(RoundedSegment(place, place, float(rng.uniform(1, 5))))
    return found


def clearance_by_samples(world: SpatialWorld, route: TautRoute) -> float:
    shares = np.linspace(0.0, 1.0, 60)[:, None]
    parts = zip(route.points[:-1], route.points[1:], strict=True)
    return min(float(world.distance(a + shares * (b - a)).min()) for a, b in parts)


@settings(max_examples=30)
@given(st.integers(0, 2**32), st.booleans())
def test_a_route_is_clear_at_every_sample_and_the_same_again(seed: int, timed: bool) -> None:
    rng = np.random.default_rng(seed)
    band = HeightBand(lowest=1.0, highest=60.0)
    world = SpatialWorld.of(
        town(rng), ground=0.0, bounds=(-50, -50, 50, 50), band=band, core_radius=0.3,
        core_half_height=0.2,
    )  # fmt: skip
    start, goal = rng.uniform((-49, -49, 2), (49, 49, 59), (2, 3))
    norm = SPEEDS if timed else (0.0, 0.0, 0.0)
    room = SearchRoom.of_world(world)
    outcome = SpaceRouter(room).find(start, goal, 0.5, norm)
    if isinstance(outcome, Refusal):
        assert world.distance([start, goal]).min() < 0.5
        return
    assert isinstance(outcome, Found)
    route = outcome.value
    assert clearance_by_samples(world, route) >= route.clearance - 1e-6
    assert route.clearance >= 0.5
    assert route.points[:, 2].min() >= 1.0
    assert route.points[:, 2].max() <= 60.0
    np.testing.assert_array_equal(route.points[[0, -1]], [start, goal])
    if not timed:
        assert outcome.cost == pytest.approx(route.length)
    again = SpaceRouter(room).find(start, goal, 0.5, norm)
    assert again.value.points.tobytes() == route.points.tobytes()


def test_a_fast_route_is_faster_than_the_short_one_and_longer() -> None:
    flight = router([block(0, 0, 2, 20, 0, 12)])
    ends = (-20.0, 0.0, 2.0), (20.0, 0.0, 2.0)
    short, fast = flight.find(*ends, 1.0), flight.find(*ends, 1.0, SPEEDS)
    assert short.value.length < fast.value.length
    d = np.diff(short.value.points, axis=0)
    level, up = np.hypot(d[:, 0], d[:, 1]) / 10.0, np.where(d[:, 2] > 0, 2.5, -1.5)
    assert fast.cost < np.maximum(level, d[:, 2] / up).sum()


def test_a_route_among_voxels_is_shorter_than_any_along_their_neighbours() -> None:
    cubes = np.zeros((20, 20, 20), bool)
    cubes[10, :, :15] = True
    alone = Voxels(cubes, 2.0, (5.0, 0.0, 0.0))
    world = SpatialWorld.of([alone], bounds=(5, 0, 45, 40), band=HeightBand(0.9, 39.1))
    room = SearchRoom.of_world(world).knowing(world, [alone])
    outcome = SpaceRouter(room).find((10.0, 21.0, 3.0), (42.0, 21.0, 3.0), 0.9)
    assert isinstance(outcome, Found)
    steps = 2 * (2 * (7 * math.sqrt(2) + 7) + 2)  # 14 up and 14 down, 8 over and 8 back
    assert outcome.value.length < steps
    assert len(outcome.value.points) < 12


def test_voxels_among_other_solids_are_searched_cube_by_cube() -> None:
    cubes = np.ones((9, 9, 9), bool)
    cubes[:, 4, 4] = False
    flight = router([Voxels(cubes, 1.0, (-4.5, -4.5, 10.5)), block(0, 0, 2, 50, 0, 9)])
    outcome = flight.find((-8.0, 0.0, 15.0), (8.0, 0.0, 15.2), 0.3)
    assert isinstance(outcome, Found)
    assert np.abs(outcome.value.points[:, 1]).max() < 0.3


def test_an_end_that_is_too_near_is_refused_with_what_is_there() -> None:
    outcome = router([block(0, 0, 5, 5, 0, 9)]).find((-20, 0, 5), (0, 5.4, 5), 0.5)
    assert isinstance(outcome, Refusal)
    assert outcome.obstacle == 0
    assert outcome.where == (0.0, 5.4, 5.0)
    assert "goal keeps 0.4 m" in outcome.reason
    low = router([]).find((0, 0, 0.9), (9, 0, 5), 0.5)
    assert isinstance(low, Refusal)
    assert "heights" in low.reason


def test_an_end_that_is_shut_in_is_refused() -> None:
    ring = [[(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)]]
    hole = [[(-4.0, -4.0), (-4.0, 4.0), (4.0, 4.0), (4.0, -4.0)]]
    yard = Prism(RoundedRing([*ring, *hole]), 0.0, 70.0)
    outcome = router([yard]).find((0, 0, 5), (20, 0, 5), 0.5)
    assert isinstance(outcome, Refusal)
    assert "start is shut in" in outcome.reason
    low = Prism(RoundedRing([*ring, *hole]), 0.0, 40.0)
    assert isinstance(router([low]).find((0, 0, 5), (20, 0, 5), 0.5), Found)


def test_what_is_too_fine_to_be_seen_is_given_up_with_the_resolution() -> None:
    slit = [block(0, 25.001, 1, 25, 0, 70), block(0, -25.001, 1, 25, 0, 70)]
    flight = router(slit)
    outcome = flight.find((-9.0, 3.0, 5.0), (9.0, -3.0, 5.0), 0.0005)
    assert isinstance(outcome, GaveUp | Found)
    if isinstance(outcome, GaveUp):
        assert outcome.resolution > 0.0
        assert f"{outcome.resolution:.3g} m" in outcome.reason


@pytest.mark.parametrize("side", ["left", "right", "over", "under"])
def test_a_leg_passes_on_the_side_that_is_asked(side: PassSide) -> None:
    solid = block(0, 0, 4, 6, 20, 30)
    ends = (-30.0, 0.0, 25.0), (30.0, 0.0, 25.0)
    outcome = router([solid]).find(*ends, 1.0, gates=gate(solid, *ends, [side]))
    assert isinstance(outcome, Found)
    points = outcome.value.points
    y, z = (float(np.interp(0.0, points[:, 0], points[:, axis])) for axis in (1, 2))
    assert {"left": y > 6, "right": y < -6, "over": z > 30, "under": z < 20}[side]


def test_seeds_lie_on_four_sides_and_the_cheapest_is_the_route() -> None:
    solid = block(0, 1, 4, 6, 20, 30)
    flight = router([solid])
    ends = (-30.0, 0.0, 26.0), (30.0, 0.0, 26.0)
    found = seeds(flight, solid, *ends, 1.0)
    assert {seed.side for seed in found} == {"left", "right", "over", "under"}
    costs = [seed.route.cost for seed in found]
    assert costs == sorted(costs)
    assert costs[0] == pytest.approx(flight.find(*ends, 1.0).cost, rel=1e-3)


def test_a_side_that_there_is_not_has_no_seed() -> None:
    solid = block(0, 0, 4, 6, 0, 70)
    ends = (-30.0, 0.0, 26.0), (30.0, 0.0, 26.0)
    found = seeds(router([solid]), solid, *ends, 1.0)
    assert {seed.side for seed in found} == {"left", "right"}


@settings(max_examples=12)
@example(seed=0)
@given(st.integers(0, 2**32))
def test_a_side_that_is_known_to_be_shut_has_no_way_through_the_lattice(seed: int) -> None:
    rng = np.random.default_rng(seed)
    low = float(rng.choice([0.0, 1.5, 12.0]))
    x, y = rng.uniform(-25, 25), rng.choice([-1.0, 1.0]) * rng.uniform(0, 42)
    solid = block(x, y, *rng.uniform(3, 9, 2), low, low + float(rng.choice([20.0, 47.0, 60.0])))
    flight = router([solid])
    ends = (-48.0, float(rng.uniform(-40, 40)), 30.0), (48.0, float(rng.uniform(-40, 40)), 30.0)
    for side in SIDE_BITS:
        row = gate(solid, *ends, [side])
        if is_shut(flight.room, solid, row[0], ends, 1.0):
            assert not isinstance(flight.quick.find(*ends, 1.0, gates=row), Found)


def test_what_stands_on_the_ground_or_by_the_bounds_is_known_to_be_shut_there() -> None:
    ends = (-48.0, 0.0, 30.0), (48.0, 0.0, 30.0)

    def shut(solid: Solid) -> set[str]:
        room = router([solid]).room
        rows = {side: gate(solid, *ends, [side])[0] for side in SIDE_BITS}
        return {side for side, row in rows.items() if is_shut(room, solid, row, ends, 1.0)}

    assert shut(block(0, 0, 5, 5, 0, 40)) == {"under"}
    assert shut(block(0, 43, 5, 6, 0, 40)) == {"under", "left"}
    assert shut(block(0, -43, 5, 6, 0, 59.5)) == {"under", "over", "right"}
    assert shut(block(0, 0, 5, 49.5, 3, 40)) == {"left", "right"}
    # A ball fills no rectangle, and voxels may be open within.
    assert shut(RoundedSegment((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), 9.0)) == set()
    assert shut(Voxels(np.ones((2, 2, 2), bool), 20.0, (-20.0, -20.0, 0.0))) == set()
    # From beside a solid on along it a way needn't pass it at all.
    solid = block(0, 0, 5, 5, 0, 40)
    beside = (10.0, -9.0, 30.0), (48.0, 0.0, 30.0)
    row = gate(solid, *beside, ["under"])[0]
    assert not is_shut(router([solid]).room, solid, row, beside, 1.0)


def test_the_route_that_is_known_is_the_seed_of_its_own_side() -> None:
    solid = block(0, 1, 4, 6, 20, 30)
    flight = router([solid])
    ends = (-30.0, 0.0, 26.0), (30.0, 0.0, 26.0)
    known = flight.find(*ends, 1.0).value
    found = seeds(flight, solid, *ends, 1.0, known=known)
    assert {seed.side for seed in found} == {"left", "right", "over", "under"}
    assert [seed.side for seed in found if seed.route is known] == [found[0].side]


def test_a_router_up_to_a_cost_finds_what_costs_no_more() -> None:
    solid = block(0, 0, 2, 40, 0, 55)
    flight = router([solid])
    ends = (-20.0, 0.0, 5.0), (20.0, 0.0, 5.0)
    cost = flight.find(*ends, 1.0).cost
    again = flight.up_to(cost).quick.find(*ends, 1.0)
    assert isinstance(again, Found)
    assert again.cost == cost
    assert isinstance(flight.up_to(0.5 * cost).quick.find(*ends, 1.0), GaveUp)


@settings(max_examples=10)
@given(st.integers(0, 2**32))
def test_what_is_only_told_of_is_found_too_and_costs_no_less(seed: int) -> None:
    rng = np.random.default_rng(seed)
    solids = town(rng)
    flight = router(solids)
    ends = rng.uniform((-49, -49, 2), (-40, 49, 59)), rng.uniform((40, -49, 2), (49, 49, 59))
    best, told = flight.find(*ends, 0.5), flight.best_up_to(0.0).find(*ends, 0.5)
    assert type(told) is type(best)
    if isinstance(best, Found):
        assert told.cost >= best.cost
        assert clearance_by_samples(SpatialWorld.of(solids, ground=0.0), told.value) >= 0.5 - 1e-6
    same = flight.best_up_to(1e9).find(*ends, 0.5)
    assert not isinstance(best, Found) or same.value.points.tobytes() == best.value.points.tobytes()


def test_a_way_is_pulled_only_if_it_is_free() -> None:
    flight = router([block(0, 0, 2, 20, 0, 12)])
    way = np.array([[-20.0, 0.0, 2.0], [0.0, 0.0, 30.0], [20.0, 0.0, 2.0]])
    route = flight.pulled(way, 1.0)
    assert route.length < np.linalg.norm(np.diff(way, axis=0), axis=1).sum()
    with pytest.raises(GeometryError, match="isn't free"):
        flight.pulled(way[::2], 1.0)


@pytest.mark.parametrize(
    ("start", "required", "norm"),
    [
        ((0, 0), 1.0, SPEEDS),
        ((0, 0, math.nan), 1.0, SPEEDS),
        ("here", 1.0, SPEEDS),
        ((0, 0, 5), -1.0, SPEEDS),
        ((0, 0, 5), math.inf, SPEEDS),
        ((0, 0, 5), 1.0, (1.0, 0.0, 1.0)),
        ((0, 0, 5), 1.0, (1.0,)),
    ],
)
def test_junk_is_refused_by_name(start: object, required: float, norm: object) -> None:
    with pytest.raises(GeometryError, match=r"start|required|norm"):
        router([]).find(start, (1, 1, 5), required, norm)  # type: ignore[arg-type]


@pytest.mark.parametrize("seed", [107, 154, 193, 224])
def test_something_far_outside_makes_no_route_dearer(seed: int) -> None:
    """Its lattice was one of all that there is, with steps as long as the town."""
    rng = np.random.default_rng(seed)
    solids = town(rng)
    start, goal = rng.uniform((-49, -49, 2), (49, 49, 59), (2, 3))
    far = RoundedSegment((3000.0, -2000.0, 20.0), (3000.0, -2000.0, 20.0), 4.0)
    costs = []
    for solids_of_all in (solids, [*solids, far]):
        world = SpatialWorld.of(
            solids_of_all, ground=0.0, band=HeightBand(lowest=1.0, highest=60.0),
            core_radius=0.3, core_half_height=0.2,
        )  # fmt: skip
        outcome = SpaceRouter(SearchRoom.of_world(world)).find(start, goal, 0.5, SPEEDS)
        assert isinstance(outcome, Found)
        costs.append(outcome.cost)
    assert costs[1] <= 1.0025 * costs[0]
