import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.certificate import PROOF_SLACK_M, PROOF_TOLERANCE_M, certify
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

Oracle = Callable[..., Any]
Floats = NDArray[np.float64]
seeds = st.integers(0, 100_000)


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (float(x), float(y)), "radius": float(radius)})


def random_world(rng: np.random.Generator) -> tuple[list[Obstacle], dict[str, Any]]:
    obstacles = []
    for _ in range(rng.integers(0, 12)):
        x, y, size = *rng.uniform(0, 100, 2), 10.0 ** rng.uniform(-1, 1)
        if rng.random() < 0.5:
            obstacles.append(disc(x, y, size))
        else:
            angle = np.sort(rng.uniform(0, 2 * np.pi, 5) + np.arange(5) * 1e-2)
            reach = size * rng.uniform(0.5, 2, 5)
            ring = np.column_stack((x + reach * np.cos(angle), y + reach * np.sin(angle)))
            obstacles.append(Obstacle(polygon=ring))
    if rng.random() < 0.4:
        blocked = rng.random(rng.integers(1, 20, 2)) < rng.choice([0.05, 0.3, 0.9])
        blocked[0, 0] = True
        place = (*rng.uniform(0, 80, 2).tolist(), float(rng.choice([0.0, 0.4, -1.9])))
        obstacles.append(Obstacle(grid=Grid(blocked, float(rng.choice([0.1, 1.0, 4.0])), place)))
    frame: dict[str, Any] = {}
    if not obstacles or rng.random() < 0.5:
        frame["bounds"] = (-20.0, -10.0, 120.0, 130.0)
    if rng.random() < 0.4:
        frame["fences"] = [[(-40, -40), (160, -50), (90, 60), (150, 170), (-60, 150)]]
    return obstacles, frame


def bezier(spans: Any, w: Floats) -> Floats:
    """Points of all spans at local parameters, by Bernstein polynomials: (m, len(w), d)."""
    basis = np.array([(1 - w) ** 3, 3 * w * (1 - w) ** 2, 3 * w**2 * (1 - w), w**3])
    return np.einsum("kw,mkd->mwd", basis, np.asarray(spans))


def true_minimum(curve: PiecewiseCubic, distance: Callable[[Floats], Floats]) -> float:
    """An upper bound of the smallest distance, refined round the least samples of a dense scan."""
    w = np.linspace(0, 1, 401)
    values = distance(bezier(curve.spans, w)[:, :, :2].reshape(-1, 2)).reshape(-1, w.size)
    best = values.min()
    for flat in np.argsort(values, axis=None)[:5]:
        span, k = np.unravel_index(flat, values.shape)
        low, high = w[max(k - 1, 0)], w[min(k + 1, w.size - 1)]
        for _ in range(4):
            fine = np.linspace(low, high, 101)
            near = distance(bezier(curve.spans[span : span + 1], fine)[0, :, :2])
            j = int(near.argmin())
            best = min(best, near[j])
            low, high = fine[max(j - 1, 0)], fine[min(j + 1, 100)]
    return float(best)


def random_curve(rng: np.random.Generator, dimension: int = 2) -> PiecewiseCubic:
    points = rng.uniform(0, 100, (rng.integers(2, 7), dimension))
    return CardinalSpline(
        points,
        slack=float(rng.choice([0.0, 0.2, 0.5, 1.0, 1.5])),
        knots=str(rng.choice(["uniform", "centripetal", "chordal"])),  # type: ignore[arg-type]
    )


@given(seeds)
def test_the_bound_is_proven_and_within_a_millimetre(shapely_distance: Oracle, seed: int) -> None:
    rng = np.random.default_rng(seed)
    obstacles, frame = random_world(rng)
    curve = random_curve(rng)
    radius, required = rng.uniform(0, 2, 2)
    certificate = certify(curve, World(obstacles, **frame), required, radius=radius)
    least = true_minimum(curve, lambda xy: shapely_distance(xy, obstacles, **frame))
    assert certificate.clearance + radius <= least + 1e-9
    assert certificate.clearance + radius >= least - PROOF_TOLERANCE_M - 1e-9
    assert certificate.holds == (certificate.clearance >= required - PROOF_SLACK_M)
    # nothing that truly keeps its distance is refused, nothing that doesn't passes
    assert certificate.holds or least - radius < required - 0.4 * PROOF_SLACK_M
    assert not certificate.holds or least - radius >= required - PROOF_SLACK_M - 1e-9


@given(seeds)
def test_the_tightest_place_is_where_it_says(shapely_distance: Oracle, seed: int) -> None:
    rng = np.random.default_rng(seed)
    obstacles, frame = random_world(rng)
    curve = random_curve(rng)
    certificate = certify(curve, World(obstacles, **frame), 0.5)
    at = np.asarray(certificate.tightest_at)
    there = float(shapely_distance([at], obstacles, **frame)[0])
    assert certificate.clearance == pytest.approx(there, abs=PROOF_TOLERANCE_M + 1e-9)
    assert certificate.clearance <= there + 1e-9
    np.testing.assert_allclose(curve.evaluate(certificate.tightest_u), at, atol=1e-9)
    np.testing.assert_allclose(curve.at_distance(certificate.tightest_distance), at, atol=1e-5)
    assert certificate.obstacle is not None


@given(seeds)
def test_a_curve_in_space_counts_by_its_ground_track(seed: int) -> None:
    rng = np.random.default_rng(seed)
    obstacles, frame = random_world(rng)
    world, curve = World(obstacles, **frame), random_curve(rng, 3)
    track = PiecewiseCubic(curve.spans[:, :, :2])
    in_space, on_ground = certify(curve, world, 1.0), certify(track, world, 1.0)
    assert in_space.clearance == on_ground.clearance
    assert in_space.tightest_at[:2] == pytest.approx(on_ground.tightest_at)
    assert len(in_space.tightest_at) == 3


def straight(*points: Any) -> CardinalSpline:
    return CardinalSpline(points, tension=1.0)


def test_a_curve_that_touches_what_is_required_holds() -> None:
    world = World([disc(5, 3, 1)])
    certificate = certify(straight((0, 0), (10, 0)), world, 1.5, radius=0.5)
    assert certificate.holds
    assert certificate.clearance == pytest.approx(1.5, abs=PROOF_SLACK_M)
    assert not certify(straight((0, 0), (10, 0)), world, 1.5 + 3e-6, radius=0.5).holds


def test_a_curve_along_a_wall_at_exactly_what_is_required_holds() -> None:
    world = World([Obstacle(polygon=[(-500, 1), (1500, 1), (1500, 9), (-500, 9)])])
    curve = CardinalSpline([(x, 0) for x in range(0, 1001, 50)])
    assert certify(curve, world, 0.5, radius=0.5).holds
    assert certify(curve, world, 0.0, radius=1.0).holds


def test_a_curve_that_only_touches_an_obstacle_holds_for_nothing_required() -> None:
    certificate = certify(straight((0, 0), (7, 0), (10, 0)), World([disc(5, 3, 3)]), 0.0)
    assert certificate.holds
    assert certificate.clearance == pytest.approx(0.0, abs=PROOF_SLACK_M)


def test_a_curve_through_an_obstacle_has_the_depth_as_its_clearance() -> None:
    inside = certify(straight((0, 0), (10, 0)), World([disc(5, 1, 3)]), 0.5)
    assert inside.clearance == pytest.approx(-2.0, abs=PROOF_TOLERANCE_M)
    assert not inside.holds
    square = Obstacle(polygon=[(2, -1), (8, -1), (8, 3), (2, 3)])
    deep = certify(straight((0, 0), (10, 0)), World([square]), 0.5)
    assert deep.clearance == pytest.approx(-1.0, abs=PROOF_TOLERANCE_M)
    assert deep.obstacle == "obstacle 1"


def test_a_wall_thinner_than_any_sample_is_not_stepped_over() -> None:
    wall = Obstacle(polygon=[(5, -1), (5 + 1e-7, -1), (5 + 1e-7, 1), (5, 1)])
    certificate = certify(straight((0, 0), (11, 0)), World([wall]), 0.0)
    assert certificate.clearance <= 0.0
    assert not certify(straight((0, 0), (11, 0)), World([wall]), 1e-3).holds


def test_a_wall_of_cells_thinner_than_any_sample_is_not_stepped_over() -> None:
    wall = np.zeros((4000, 9), bool)
    wall[:, 4] = True
    world = World([Obstacle(grid=Grid(wall, 1e-3, (5.0, -2.0, 0.0)))])
    certificate = certify(straight((0, 0), (11, 0)), world, 0.0)
    assert -1e-3 <= certificate.clearance <= -0.4e-3
    assert not certificate.holds


def test_a_curve_along_a_staircase_of_cells_at_exactly_what_is_required_holds() -> None:
    stairs = np.tri(200, 200, -1, dtype=bool)  # its corners lie on the diagonal
    world = World([Obstacle(grid=Grid(stairs, 0.5))])
    aside = np.array([1.0, -1.0]) / math.sqrt(2)
    ends = np.array([(-5.0, -5.0), (30.0, 30.0), (105.0, 105.0)]) + aside
    assert certify(CardinalSpline(ends), world, 1.0).holds
    assert certify(CardinalSpline(ends), world, 1.0).clearance == pytest.approx(
        1.0, abs=PROOF_SLACK_M
    )
    assert not certify(CardinalSpline(ends), world, 1.0 + 3e-6).holds


def test_what_is_nearest_on_a_map_is_called_by_the_file_of_the_map() -> None:
    grid = Grid(np.ones((2, 2), bool), 1.0, (4.0, 1.0, 0.0), "depot.yaml")
    certificate = certify(straight((0, 0), (10, 0)), World([Obstacle(grid=grid)]), 0.5)
    assert certificate.obstacle == "map 'depot.yaml'"
    assert certificate.clearance == pytest.approx(1.0, abs=PROOF_TOLERANCE_M)


def test_an_empty_world_leaves_infinite_clearance() -> None:
    certificate = certify(straight((0, 0), (1, 0)), World(), 5.0)
    assert math.isinf(certificate.clearance)
    assert certificate.holds
    assert certificate.obstacle is None


def test_a_curve_outside_the_bounds_does_not_hold() -> None:
    certificate = certify(straight((1, 1), (20, 1)), World(bounds=(0, 0, 10, 10)), 0.0)
    assert certificate.clearance == pytest.approx(-10.0, abs=PROOF_TOLERANCE_M)
    assert certificate.obstacle == "bounds"
    assert certificate.tightest_at == (20.0, 1.0)


def test_a_span_that_is_a_single_point_has_the_clearance_of_that_point() -> None:
    curve = PiecewiseCubic(np.ones((1, 4, 2)))
    assert certify(curve, World([disc(4, 5, 2)]), 1.0).clearance == pytest.approx(3.0)
    assert not certify(curve, World([disc(1, 1, 2)]), 0.0).holds


@pytest.mark.parametrize("shift", [1e3, 1e6])
def test_a_million_metres_away_the_proof_holds_to_a_micrometre(shift: float) -> None:
    curve = CardinalSpline(np.array([(0, 0), (40, 10), (90, -10), (130, 30)]) + shift)
    world = World([disc(shift + 60, shift + 14, 3), disc(shift + 100, shift - 20, 3)])
    near = CardinalSpline([(0, 0), (40, 10), (90, -10), (130, 30)])
    oracle = true_minimum(
        near,
        lambda xy: (
            np.minimum(
                np.hypot(xy[:, 0] - 60, xy[:, 1] - 14), np.hypot(xy[:, 0] - 100, xy[:, 1] + 20)
            )
            - 3
        ),
    )
    certificate = certify(curve, world, 1.0)
    assert oracle - PROOF_TOLERANCE_M - 1e-6 <= certificate.clearance <= oracle + 1e-6
    assert certify(curve, world, oracle - 1e-6).holds
    assert not certify(curve, world, oracle + 4e-6).holds


def test_a_span_of_a_thousand_kilometres_is_proven_beside_a_pebble() -> None:
    certificate = certify(straight((0, 0), (1e6, 0)), World([disc(654_321, 1.5, 0.5)]), 1.0)
    assert certificate.holds
    assert certificate.clearance == pytest.approx(1.0, abs=PROOF_TOLERANCE_M)


def test_kilometres_inside_of_something_are_refused_in_bounded_time() -> None:
    wall = Obstacle(polygon=[(-1e7, -5), (1e7, -5), (1e7, 5), (-1e7, 5)])
    certificate = certify(straight((0, 0), (1e6, 0)), World([wall]), 0.0)
    assert -30.0 < certificate.clearance <= -5.0
    assert not certificate.holds


def test_a_dimension_without_a_plane_is_refused() -> None:
    with pytest.raises(GeometryError, match="dimension 1"):
        certify(CardinalSpline([[0.0], [1.0]]), World(), 1.0)


@pytest.mark.parametrize(("clearance", "radius"), [(math.nan, 0), (math.inf, 0), (0, math.nan)])
def test_numbers_that_are_not_finite_are_refused(clearance: float, radius: float) -> None:
    with pytest.raises(GeometryError, match="finite"):
        certify(straight((0, 0), (1, 0)), World(), clearance, radius=radius)


def test_a_radius_below_nothing_is_refused() -> None:
    with pytest.raises(GeometryError, match="radius is -1"):
        certify(straight((0, 0), (1, 0)), World(), 1.0, radius=-1)
