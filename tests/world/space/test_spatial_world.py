import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.certificate import PROOF_TOLERANCE_M, certify
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.kernels.clearance.disc import conflicts
from viaspline.maps.terrain import Terrain
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism, RoundedSegment
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld

Floats = NDArray[np.float64]
Oracle = Callable[..., Floats]
Made = Callable[[np.random.Generator, int], dict[str, Any]]
seeds = st.integers(0, 100_000)
TOWER = Prism(RoundedRing([[(20.0, 0.0)]], 3.0), 0.0, 40.0)
CABLE = RoundedSegment((0.0, 6.0, 20.0), (200.0, 6.0, 20.0), 0.05)


def world_of(made: dict[str, Any]) -> SpatialWorld:
    rest = {key: value for key, value in made.items() if key not in ("solids", "core")}
    radius, half = made["core"]
    return SpatialWorld.of(made["solids"], core_radius=radius, core_half_height=half, **rest)


def random_curve(rng: np.random.Generator) -> PiecewiseCubic:
    points = rng.uniform((-5, -5, 0), (50, 50, 40), (rng.integers(2, 5), 3))
    if rng.random() < 0.3:
        points[:, 2] = points[0, 2]  # level
    elif rng.random() < 0.2:
        points[:, :2] = points[0, :2]  # upright
    return CardinalSpline(points, slack=float(rng.choice([0.0, 0.2, 0.5, 1.0])))


def least_of(curve: PiecewiseCubic, distance: Callable[[Floats], Floats], count: int) -> float:
    """The least distance of many places, and of more about the least of these."""
    end = float(len(curve.spans))
    u = np.linspace(0, end, count)
    width = u[1]
    best = math.inf
    for fine in (0, 1, 2, 3, 4):
        values = distance(np.asarray(curve.evaluate(u)))
        best = min(best, float(values.min()))
        near = u[np.argsort(values)[: 3 if fine == 0 else 1]]
        u = (near[:, None] + np.linspace(-width, width, 21)).clip(0, end).ravel()
        width *= 0.1
    return best


@given(seeds)
def test_the_bound_is_proven_and_within_a_millimetre(
    space_oracle: Oracle, random_space: Made, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    made = random_space(rng, 6)
    curve, radius = random_curve(rng), rng.uniform(0, 1)
    certificate = certify(curve, world_of(made), 0.5, radius=radius)
    least = least_of(curve, lambda places: space_oracle(places, **made), 801)
    if not math.isfinite(least):
        assert certificate.clearance == math.inf
        return
    if least > 0:
        assert certificate.clearance + radius <= least + 1e-8
        assert certificate.clearance + radius >= least - PROOF_TOLERANCE_M - 1e-8
    assert certificate.holds == (certificate.clearance >= 0.5 - 1e-6)
    assert not certificate.holds or least - radius >= 0.5 - 1e-6 - 1e-8


def test_of_a_thousand_random_curves_none_is_nearer_than_proven(random_space: Made) -> None:
    rng = np.random.default_rng(11)
    clear = 0
    for _ in range(1000):
        world, curve = world_of(random_space(rng, 5)), random_curve(rng)
        found = certify(curve, world, 0.5)
        least = least_of(curve, world.distance, 401)
        assert found.clearance <= least + 1e-8 or math.isinf(least)
        if 0 < least < math.inf:
            clear += 1
            assert found.clearance >= least - PROOF_TOLERANCE_M - 1e-8
    assert clear > 300


def test_a_certificate_holds_at_every_millimetre(random_space: Made) -> None:
    rng = np.random.default_rng(12)
    for _ in range(4):
        world, curve = world_of(random_space(rng, 9)), random_curve(rng)
        u = np.linspace(0, len(curve.spans), int(1000 * curve.length))
        distance = world.distance(np.asarray(curve.evaluate(u)))
        assert certify(curve, world, 0.5).clearance <= distance.min() + 1e-9


@given(seeds)
def test_spans_are_in_conflict_where_they_come_too_close(random_space: Made, seed: int) -> None:
    rng = np.random.default_rng(seed)
    world, curve = world_of(random_space(rng, 6)), random_curve(rng)
    index, w = conflicts(world.packed, np.array(curve.spans), 1.0)
    for span, (i, where) in enumerate(zip(index, w, strict=True)):
        alone = PiecewiseCubic(curve.spans[span : span + 1])
        least = least_of(alone, world.distance, 201)
        if i == -1:
            assert least >= 1.0 - 1e-8
        else:
            assert least < 1.0 + 1e-5
            assert world.distance(np.asarray(alone.evaluate(where))) < 1.0 + 1e-5


def test_a_curve_along_a_cable_is_proven_by_its_chords() -> None:
    world = SpatialWorld.of([CABLE], ["cable"])
    curve = CardinalSpline([(0, 0, 20), (100, 0, 20), (200, 0, 20)])
    found = certify(curve, world, 5.0, radius=0.9)
    assert found.clearance == pytest.approx(5.05, abs=1e-3)
    assert found.obstacle == "cable"
    assert found.holds


def test_a_body_of_some_height_passes_over_what_a_ball_of_its_radius_would_touch() -> None:
    curve = CardinalSpline([(0, 0, 41), (40, 0, 41)])
    flat = SpatialWorld.of([TOWER], core_radius=2.0, core_half_height=0.3)
    assert certify(curve, flat, 0.5).clearance == pytest.approx(0.7, abs=1e-3)
    assert certify(curve, SpatialWorld.of([TOWER]), 0.5, radius=2.0).clearance == pytest.approx(
        -1.0, abs=1e-3
    )


def test_what_is_nearest_has_a_name() -> None:
    world = SpatialWorld.of(
        [TOWER], ["tower"], ground=0.0, bounds=(-50, -50, 50, 50),
        fences=[[[(-49, -49), (49, -49), (49, 49), (-49, 49)]]],
    )  # fmt: skip
    places = [(25, 0, 20), (0, 0, 2), (48.5, 0, 30), (60, 0, 30)]
    _, index = world.nearest(places)
    assert [world.name(int(i)) for i in index] == ["tower", "ground", "fence 1", "fence 1"]
    assert world.name(-2) == "bounds"
    assert world.name(-1) == "nothing"
    assert SpatialWorld.of([TOWER]).name(0) == "obstacle 1"


def test_the_terrain_under_places_is_told() -> None:
    world = SpatialWorld.of(ground=Terrain([[0.0, 1.0], [0.0, 1.0]], cell=10.0))
    np.testing.assert_allclose(world.ground_at([(5, 5, 80), (20, 5, 80)]), [0.5, np.nan])
    assert world.ground_at((5.0, 5.0)) == 0.5
    assert SpatialWorld.of().ground_at((5.0, 5.0)) == -math.inf


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: SpatialWorld.of([5]), "solids"),  # type: ignore[list-item]
        (lambda: SpatialWorld.of([TOWER], []), "names"),
        (lambda: SpatialWorld.of(ground=math.nan), "ground"),
        (lambda: SpatialWorld.of(bounds=(1, 0, 0, 5)), "bounds"),
        (lambda: SpatialWorld.of(core_radius=-1.0), "core_radius"),
        (lambda: SpatialWorld.of(nodata="high"), "nodata"),  # type: ignore[arg-type]
        (lambda: SpatialWorld.of(band=HeightBand(least_above_ground=5.0)), "ground"),
        (lambda: SpatialWorld.of().distance((0, 0)), "places"),
        (lambda: SpatialWorld.of().distance((0, 0, math.nan)), "places"),
        (lambda: SpatialWorld.of().ground_at(5.0), "places"),
        (lambda: HeightBand(lowest=5.0, highest=5.0), "lowest"),
        (lambda: certify(CardinalSpline([(0, 0), (1, 0)]), SpatialWorld.of(), 1.0), "heights"),
        (
            lambda: certify(
                CardinalSpline([(0, 0, 0), (1, 0, 0)]), SpatialWorld.of(), 1.0,
                footprint=[(-1, -1), (1, -1), (0, 1)],
            ),
            "footprint",
        ),
    ],
)  # fmt: skip
def test_what_makes_no_world_in_space_is_refused(make: Callable[[], Any], said: str) -> None:
    with pytest.raises(GeometryError, match=said):
        make()


def test_a_second_library_finds_the_same_distances() -> None:
    coal = pytest.importorskip("coal")
    rng = np.random.default_rng(3)

    def apart(shape: Any, middle: Any, body: Any, place: Any, turn: Any = None) -> float:
        frames = []
        for at, rotation in ((middle, turn), (place, None)):
            frame = coal.Transform3s.Identity()
            frame.setTranslation(np.asarray(at, float))
            if rotation is not None:
                frame.setRotation(rotation)
            frames.append(frame)
        request, result = coal.DistanceRequest(), coal.DistanceResult()
        return float(coal.distance(shape, frames[0], body, frames[1], request, result))

    for _ in range(60):
        place, (x, y, z) = rng.uniform(-15, 15, 3), rng.uniform(-3, 3, 3)
        w, d, h = rng.uniform(0.5, 4, 3)
        ring = RoundedRing([[(x - w, y - d), (x + w, y - d), (x + w, y + d), (x - w, y + d)]])
        radius, half = rng.uniform(0.1, 1, 2)
        body = coal.Cylinder(radius, 2 * half)
        line, length = rng.normal(0, 1, 3), rng.uniform(1, 9)
        line /= np.linalg.norm(line)
        across = np.linalg.svd(line[None])[2][1]
        turn = np.column_stack((across, np.cross(line, across), line))
        first, last = (x, y, z) - 0.5 * length * line, (x, y, z) + 0.5 * length * line
        cases = [
            (Prism(ring, z - h, z + h), coal.Box(2 * w, 2 * d, 2 * h), None),
            (Prism(RoundedRing([[(x, y)]], w), z - h, z + h), coal.Cylinder(w, 2 * h), None),
            (RoundedSegment((x, y, z), (x, y, z), w), coal.Sphere(w), None),
            (RoundedSegment(tuple(first), tuple(last), 0.4), coal.Capsule(0.4, length), turn),
        ]
        for solid, shape, rotation in cases:
            world = SpatialWorld.of([solid], core_radius=radius, core_half_height=half)
            expected = apart(shape, (x, y, z), body, place, rotation)
            if expected > 0:
                assert float(world.distance(place)) == pytest.approx(expected, abs=1e-4)
