import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.interpolate import (
    Akima1DInterpolator,
    BPoly,
    BSpline,
    CubicSpline,
    PPoly,
    make_interp_spline,
)

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.certificate import PROOF_TOLERANCE_M, certify
from viaspline.curve.provable_curve import CHORD_OFF_M, provable_curve
from viaspline.errors import GeometryError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.retime import retime
from viaspline.world.space.spatial_world import SpatialWorld
from viaspline.world.world import World

Floats = NDArray[np.float64]
seeds = st.integers(0, 100_000)
DENSE = 20_001


class Wave:
    """Sums of sines in each coordinate, which state their second derivatives from their sizes."""

    def __init__(self, rng: np.random.Generator, dimension: int) -> None:
        self.domain = (float(rng.uniform(-3, 0)), float(rng.uniform(1, 7)))
        self.sizes = rng.normal(size=(dimension, 3)) * [4.0, 2.0, 0.5]
        self.rates = rng.uniform(0.2, 6.0, 3)
        self.shifts = rng.uniform(0, math.tau, (dimension, 3))

    def evaluate(self, u: Any, derivative: int = 0) -> Floats:
        at = np.asarray(u, float)[..., None, None]
        turned = self.rates * at + self.shifts + derivative * math.pi / 2
        return np.asarray((self.sizes * self.rates**derivative * np.sin(turned)).sum(-1))

    def second_derivative_bound(self, u0: float, u1: float) -> float:
        return float(np.linalg.norm((np.abs(self.sizes) * self.rates**2).sum(-1)))


def planar_world(rng: np.random.Generator) -> World:
    return World(
        [
            Obstacle(circle={"center": tuple(rng.uniform(-9, 9, 2)), "radius": rng.uniform(0.1, 2)})
            for _ in range(rng.integers(1, 6))
        ]
    )


def spatial_world(rng: np.random.Generator) -> SpatialWorld:
    solids = [
        Prism(RoundedRing([[tuple(rng.uniform(-9, 9, 2))]], rng.uniform(0.1, 2)), -30.0, z)
        for z in rng.uniform(-5, 9, rng.integers(1, 5)).tolist()
    ]
    return SpatialWorld.of(solids)


def random_polynomials(rng: np.random.Generator, dimension: int, degree: int) -> Any:
    """A smooth spline, or polynomials that only meet, by either of their bases."""
    count = int(rng.integers(2, 7))
    kind = rng.integers(3)
    if kind == 0:
        x = np.cumsum(rng.uniform(0.1, 3.0, count + degree))
        points = np.cumsum(rng.normal(size=(len(x), dimension)) * 2.0, axis=0)
        return make_interp_spline(x, points, k=degree)
    ends = np.cumsum(rng.uniform(0.1, 3.0, count + 1))
    control = rng.normal(size=(degree + 1, count, dimension)) * 4.0
    control[0, 1:] = control[-1, :-1]
    pieces = BPoly(control, ends)
    return pieces if kind == 1 else PPoly.from_bernstein_basis(pieces)


def ends_of(curve: Any) -> tuple[float, float]:
    if isinstance(curve, BSpline):
        return float(curve.t[curve.k]), float(curve.t[-curve.k - 1])
    if hasattr(curve, "domain"):
        return curve.domain  # type: ignore[no-any-return]
    return float(curve.x[0]), float(curve.x[-1])


def dense_minimum(curve: Any, world: Any) -> float:
    u = np.linspace(*ends_of(curve), DENSE)
    points = curve.evaluate(u) if hasattr(curve, "evaluate") else curve(u)
    return float(world.distance(points).min())


def check(curve: Any, world: Any, off: float) -> None:
    """Never above what dense samples show, and not far below it."""
    certificate = certify(curve, world, 0.5)
    shown = dense_minimum(curve, world)
    assert certificate.clearance <= shown + 1e-12
    assert certificate.clearance >= shown - PROOF_TOLERANCE_M - off - 2e-3
    low, high = ends_of(curve)
    assert low <= certificate.tightest_u <= high
    at = (
        curve.evaluate(certificate.tightest_u)
        if hasattr(curve, "evaluate")
        else curve(certificate.tightest_u)
    )
    assert np.linalg.norm(at - certificate.tightest_at) <= off + 1e-9


@given(seed=seeds, degree=st.sampled_from([1, 3, 5, 7]), dimension=st.sampled_from([2, 3]))
@settings(max_examples=60, deadline=None)
def test_a_proof_of_polynomials_of_any_degree_holds_at_dense_samples(
    seed: int, degree: int, dimension: int
) -> None:
    rng = np.random.default_rng(seed)
    world = planar_world(rng) if dimension == 2 else spatial_world(rng)
    check(random_polynomials(rng, dimension, degree), world, 1e-6)


@given(seed=seeds, dimension=st.sampled_from([2, 3]))
@settings(max_examples=40, deadline=None)
def test_a_proof_of_a_curve_that_states_its_bends_holds_at_dense_samples(
    seed: int, dimension: int
) -> None:
    rng = np.random.default_rng(seed)
    world = planar_world(rng) if dimension == 2 else spatial_world(rng)
    check(Wave(rng, dimension), world, CHORD_OFF_M + 1e-6)


@given(seed=seeds, degree=st.sampled_from([1, 3, 5, 9]))
@settings(max_examples=60, deadline=None)
def test_cubics_are_as_near_to_the_curve_as_is_said(seed: int, degree: int) -> None:
    curve = random_polynomials(np.random.default_rng(seed), 2, degree)
    found = provable_curve(curve)
    u = np.linspace(0.0, len(found.cubics.spans), DENSE)
    own = np.interp(u, np.arange(len(found.joints)), found.joints)
    apart = np.linalg.norm(found.cubics.evaluate(u) - curve(own), axis=1)
    assert apart.max() <= found.off


@pytest.mark.parametrize(
    "make",
    [
        lambda: CubicSpline([0, 1, 2, 4], [(0, 0), (3, 1), (4, 5), (9, 5)]),
        lambda: Akima1DInterpolator([0, 1, 2, 4], [(0, 0), (3, 1), (4, 5), (9, 5)]),
        lambda: make_interp_spline(range(6), [(0, 0), (3, 1), (4, 5), (9, 5), (9, 9), (0, 9)], 5),
        lambda: BSpline(np.arange(9.0), np.random.default_rng(1).normal(size=(5, 2)), 3),
        lambda: Wave(np.random.default_rng(3), 2),
        lambda: CardinalSpline([(0, 0), (3, 1), (4, 5)]),
    ],
    ids=["cubics", "akima", "degree 5", "b-spline", "own", "cardinal"],
)
def test_what_is_certified_is_timed_as_well(make: Callable[[], Any]) -> None:
    curve = make()
    world = World([Obstacle(circle={"center": (2, 99), "radius": 1})])
    assert certify(curve, world, 0.1).clearance > 0.0
    law = retime(curve, Limits(max_speed=2, max_accel=1, max_lateral_accel=1))
    assert law.duration > 0.0


def test_cubics_of_scipy_are_proven_as_tightly_as_ours() -> None:
    line = CubicSpline([0, 1, 2], [(0, 0), (5, 0), (10, 0)])
    world = World([Obstacle(circle={"center": (5, 3), "radius": 1})])
    certificate = certify(line, world, 2.0)
    assert certificate.holds
    assert certificate.tightest_u == pytest.approx(1.0)
    assert certificate.tightest_distance == pytest.approx(5.0)
    body = [(-1, -0.5), (3, -0.5), (3, 0.5), (-1, 0.5)]
    assert certify(line, world, 1.0, footprint=body).clearance == pytest.approx(1.5, abs=2e-3)


class Known:
    domain = (0.0, 1.0)

    def evaluate(self, u: Any, derivative: int = 0) -> Floats:
        at = np.asarray(u, float)
        return np.stack((9 * at, np.sin(9 * at)), axis=-1)


class Liar(Known):
    def second_derivative_bound(self, u0: float, u1: float) -> float:
        return 0.01


class Nowhere(Known):
    def evaluate(self, u: Any, derivative: int = 0) -> Floats:
        return np.full((*np.shape(u), 2), np.nan)

    def second_derivative_bound(self, u0: float, u1: float) -> float:
        return 1.0


class Endless(Known):
    def second_derivative_bound(self, u0: float, u1: float) -> float:
        return math.inf


class Backwards(Known):
    domain = (1.0, 0.0)


@pytest.mark.parametrize(
    ("curve", "words"),
    [
        (Known(), "of which only values are known.*second_derivative_bound"),
        (Liar(), "isn't a bound: between"),
        (Nowhere(), "nowhere"),
        (Endless(), "is inf between"),
        (Backwards(), "give its two ends"),
        (object(), "has no domain"),
        (5, "has no domain"),
        (CubicSpline([0, 1, 2], [0, 1, 0]), "isn't a curve; give one with values"),
        (PPoly([[[1.0, 1.0], [0.0, 0.0]], [[0.0, 0.0], [9.0, 9.0]]], [0, 1, 2]), "jumps by"),
        (PPoly(np.zeros((4, 2, 2)), [2, 1, 0]), "don't increase"),
        (PPoly(np.full((2, 1, 2), np.nan), [0, 1]), "isn't finite"),
    ],
)
def test_what_cannot_be_proven_is_refused_in_words(curve: Any, words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        certify(curve, World(), 0.1)


def test_a_footprint_asks_for_the_tangents_of_cubics() -> None:
    body = [(-1, -0.5), (3, -0.5), (3, 0.5), (-1, 0.5)]
    with pytest.raises(GeometryError, match="give a piecewise cubic for a footprint"):
        certify(Wave(np.random.default_rng(3), 2), World(), 0.1, footprint=body)


def test_polynomials_that_bend_too_much_are_refused() -> None:
    wild = PPoly(np.array([[[1e300, 0.0]], *[[[0.0, 0.0]]] * 5]), [0.0, 1.0])
    with pytest.raises(GeometryError):
        certify(wild, World(), 0.1)
