from dataclasses import replace
from itertools import count

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.space.laying.clear_route import Check, StuckLegError, clear_route
from viaspline.space.laying.laid_route import CurveShape, RouteLegs, lay_route

KEPT = 1.0


def balls(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.uniform(10, 90, (6, 3)), rng.uniform(2, 6, 6)


def sampled(centers: np.ndarray, radii: np.ndarray) -> Check:
    def check(leg: int, spans: np.ndarray) -> np.ndarray | None:
        curve = PiecewiseCubic(spans)
        places = curve.evaluate(np.linspace(*curve.domain, 200 * len(spans)))
        room = (np.linalg.norm(places[:, None] - centers, axis=2) - radii).min(axis=1)
        worst = int(np.argmin(room))
        return None if room[worst] >= KEPT else places[worst]

    return check


def over(centers: np.ndarray, radii: np.ndarray, vias: np.ndarray) -> object:
    """High above everything: a way that is clear, if not a short one."""
    top = float((centers[:, 2] + radii).max()) + KEPT + 0.5

    def lead_round(leg: int, laid: np.ndarray) -> np.ndarray:
        ends = vias[leg : leg + 2].copy()
        ends[:, 2] = top
        return ends

    return lead_round


@settings(max_examples=30)
@given(seed=st.integers(0, 10_000))
def test_a_route_is_led_round_what_is_in_the_way_of_it_and_only_there(seed: int) -> None:
    centers, radii = balls(seed)
    rng = np.random.default_rng(seed + 1)
    vias = rng.uniform(0, 100, (4, 3))
    far = np.linalg.norm(vias[:, None] - centers, axis=2) - radii
    # Nothing above a via point either: the way over has to be there.
    upright = np.linalg.norm(vias[:, None, :2] - centers[:, :2], axis=2) - radii
    if min(far.min(), upright.min()) < KEPT + 0.5:
        return
    check = sampled(centers, radii)
    start = RouteLegs.left_to_the_spline(vias, np.full((4, 3), np.nan), CurveShape(np.zeros(3)))
    found = clear_route(start, check, over(centers, radii, vias), 5.0)  # type: ignore[arg-type]
    assert check(0, found.laid.spans) is None
    assert np.array_equal(
        np.concatenate((found.laid.spans[:, 0], found.laid.spans[-1:, 3]))[found.laid.joints], vias
    )


def test_a_leg_that_is_clear_stays_the_spline() -> None:
    vias = np.array([[0.0, 0, 5], [20, 0, 5], [40, 0, 5], [60, 0, 5]])
    center, radius = np.array([[50.0, 0.5, 5]]), np.array([3.0])
    start = RouteLegs.left_to_the_spline(vias, np.full((4, 3), np.nan), CurveShape(np.zeros(3)))
    found = clear_route(
        start, sampled(center, radius), lambda leg, laid: np.array([[50.0, -4.6, 5]]), 8.0
    )
    assert [inner is None for inner in found.legs.inner] == [True, True, False]


def test_corners_are_tightened_where_they_come_too_near_and_nowhere_else() -> None:
    vias = np.array([[0.0, 0, 5], [60, 0, 5]])
    inner = np.array([[15.0, 12, 5], [45, -12, 5]])
    center, radius = np.array([[49.2, -12.5, 5]]), np.array([2.0])
    start = RouteLegs.left_to_the_spline(vias, np.full((2, 3), np.nan), CurveShape(np.zeros(1)))
    led = start.led_round(0, inner, 30.0)
    found = clear_route(led, sampled(center, radius), lambda leg, laid: inner, 30.0)
    radii = found.legs.radii[0]
    assert radii[1] == 30.0
    assert radii[2] < 30.0


def test_only_the_corner_that_is_why_stays_tight() -> None:
    """Of both corners beside a place that fails, one has nothing to do with it."""
    vias = np.array([[0.0, 0, 5], [60, 0, 5]])
    inner = np.array([[15.0, 12, 5], [45, 12, 5]])
    center, radius = np.array([[30.0, 9.4, 5], [40.0, 14.4, 5]]), np.array([1.5, 1.0])
    start = RouteLegs.left_to_the_spline(vias, np.full((2, 3), np.nan), CurveShape(np.zeros(1)))
    check = sampled(center, radius)
    found = clear_route(start.led_round(0, inner, 30.0), check, lambda leg, laid: inner, 30.0)
    radii = found.legs.radii[0]
    assert check(0, found.laid.spans) is None
    for corner in np.flatnonzero(radii < 30.0).tolist():
        wide = radii.copy()
        wide[corner] *= 1.5
        wider = replace(found.legs, radii=(wide, *found.legs.radii[1:]))
        assert check(0, lay_route(wider).spans) is not None


def test_a_leg_whose_taut_way_is_not_clear_is_stuck_and_says_which_one() -> None:
    vias = np.array([[0.0, 0, 5], [60, 0, 5]])
    start = RouteLegs.left_to_the_spline(vias, np.full((2, 3), np.nan), CurveShape(np.zeros(1)))
    calls = count()

    def never(leg: int, spans: np.ndarray) -> np.ndarray:
        next(calls)
        return np.array([30.0, 0, 5])

    with pytest.raises(StuckLegError) as stuck:
        clear_route(start, never, lambda leg, laid: np.array([[30.0, 9, 5]]), 5.0)
    assert stuck.value.leg == 0
    assert next(calls) < 200


def test_what_passed_of_a_leg_that_goes_back_and_was_tightened_is_what_is_laid() -> None:
    vias = np.array([[30.0, 0, 5], [40, 0, 5], [0, 40, 5]])
    shape = CurveShape(np.zeros(2))
    start = RouteLegs.left_to_the_spline(vias, np.full((3, 3), np.nan), shape, close=0.5)
    led = start.led_round(1, np.array([[42.0, 24, 5]]), 12.0)
    passed = []

    def check(leg: int, spans: np.ndarray) -> np.ndarray | None:
        swings_out = spans[:, :, 0].max() > 43.5
        if leg == 1 and swings_out:
            return vias[1]
        passed.append((leg, spans))
        return None

    found = clear_route(led, check, lambda leg, laid: laid[:0, 0], 12.0)
    assert found.legs.radii[1].min() < 12.0
    for leg in (0, 1):
        laid = found.laid.leg(leg)
        assert any(its == leg and np.array_equal(spans, laid) for its, spans in passed)
