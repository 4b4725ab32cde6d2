"""Turns at via points laid gently: radii measured on the curves by samples of the test's own."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.space.laying.clear_route import Check, ClearRoute, StuckLegError, clear_route
from viaspline.space.laying.gentle_turns import GentleTurns
from viaspline.space.laying.laid_route import CurveShape, RouteLegs
from viaspline.space.laying.via_turns import ROOMY

LEAST, GENTLE = 0.5, 20.0


def free(leg: int, spans: Floats) -> Floats | None:
    return None


def nothing_in_the_way(leg: int, laid: Floats) -> Floats:
    raise AssertionError("nothing stands here")


def nothing_near(place: Floats) -> Floats:
    return np.full(len(place), np.nan)


def straight(leg: int, way: Floats) -> Floats:
    return way[:0]


def turns(check: Check = free) -> GentleTurns[ClearRoute]:
    def lay(legs: RouteLegs, before: ClearRoute) -> ClearRoute:
        return clear_route(legs, check, nothing_in_the_way, GENTLE)

    return GentleTurns(
        LEAST, GENTLE, lay, lambda laid: Path(laid.spans, []).length, nothing_near, straight
    )


def spline(vias: Floats, given: Floats | None = None) -> ClearRoute:
    free_ways = np.full(vias.shape, np.nan)
    shape = CurveShape(np.zeros(len(vias) - 1))
    ways = free_ways if given is None else given
    legs = RouteLegs.left_to_the_spline(vias, ways, shape, ROOMY * LEAST)
    return clear_route(legs, free, nothing_in_the_way, GENTLE)


def sharpest(found: ClearRoute) -> float:
    """The smallest radius on a curve, by finite differences of close samples [m]."""
    w = np.linspace(0.0, 1.0, 401)[:, None]
    radii = []
    for a, b, c, d in found.laid.spans:
        first = 3 * ((1 - w) ** 2 * (b - a) + 2 * w * (1 - w) * (c - b) + w**2 * (d - c))
        second = 6 * ((1 - w) * (c - 2 * b + a) + w * (d - 2 * c + b))
        across = np.linalg.norm(np.cross(first, second), axis=1)
        speed = np.linalg.norm(first, axis=1)
        bent = across > 1e-9 * speed
        radii.append(float((speed[bent] ** 3 / across[bent]).min(initial=math.inf)))
    return min(radii)


def directions(found: ClearRoute) -> tuple[Floats, Floats]:
    """The directions at the joints, before them and after them."""
    spans = found.laid.spans
    before, after = spans[:-1, 3] - spans[:-1, 2], spans[1:, 1] - spans[1:, 0]
    sizes = np.linalg.norm(before, axis=1)[:, None], np.linalg.norm(after, axis=1)[:, None]
    return before / sizes[0], after / sizes[1]


@settings(max_examples=40)
@given(seed=st.integers(0, 10_000), count=st.integers(3, 6))
def test_among_far_via_points_no_turn_is_sharper_than_the_least_radius(
    seed: int, count: int
) -> None:
    rng = np.random.default_rng(seed)
    vias = np.cumsum(rng.uniform(-40, 40, (count, 3)) * [1, 1, 0.2], axis=0)
    if np.linalg.norm(np.diff(vias, axis=0), axis=1).min() < 12 * LEAST:
        return
    found = turns().of(spline(vias))
    assert sharpest(found) >= 0.99 * LEAST
    ends = np.concatenate((found.laid.spans[:, 0], found.laid.spans[-1:, 3]))
    assert np.array_equal(ends[found.laid.joints], vias)
    before, after = directions(found)
    assert np.abs(before - after).max() < 1e-4


@pytest.mark.parametrize("facing", [60.0, 120.0, 180.0, 235.0, 300.0])
def test_a_direction_that_leads_away_is_flown_by_an_arc_and_kept(facing: float) -> None:
    vias = np.array([[0.0, 0, 9], [30, 0, 9], [70, 0, 15]])
    way = np.array([math.cos(math.radians(facing)), math.sin(math.radians(facing)), 0.0])
    given_ways = np.full((3, 3), np.nan)
    given_ways[1] = way
    found = turns().of(spline(vias, given_ways))
    assert sharpest(found) >= 0.99 * LEAST
    joint = found.laid.joints[1]
    before, after = directions(found)
    assert before[joint - 1] == pytest.approx(way, abs=1e-9)
    assert after[joint - 1] == pytest.approx(way, abs=1e-9)
    assert Path(found.laid.spans, []).length < 90.0  # and not far beyond the via point


def test_a_hair_beside_straight_back_is_a_turn_as_wide_as_the_body_needs() -> None:
    """Exactly straight back the spline stands at the via point, and nothing is sharp."""
    sharp = spline(np.array([[0.0, 0, 9], [30, 0, 9], [0, 0.001, 9]]))
    assert sharpest(sharp) < 1e-3 * LEAST
    found = turns().of(sharp)
    assert sharpest(found) >= LEAST
    assert found.laid.spans[:, :, 0].max() < 30 + 4 * LEAST


def test_what_is_round_enough_stays_as_it_was() -> None:
    round_enough = spline(np.array([[0.0, 0, 9], [30, 10, 9], [60, 0, 9]]))
    assert turns().of(round_enough) is round_enough


def test_a_turn_that_would_cost_more_than_it_may_stays_as_it_was() -> None:
    sharp = spline(np.array([[0.0, 0, 9], [12, 0, 9], [3, 2, 9]]))
    least = Path(sharp.laid.spans, []).length
    bent = turns().of(sharp)
    assert sharpest(bent) >= LEAST
    assert 1.02 * least < Path(bent.laid.spans, []).length <= 1.2 * least
    assert replace(turns(), dearer=1.02).of(sharp) is sharp


def test_a_turn_for_which_there_is_no_room_stays_as_it_was() -> None:
    sharp = spline(np.array([[0.0, 0, 9], [30, 0, 9], [0, 1, 9]]))

    def narrow(leg: int, spans: Floats) -> Floats | None:
        raise StuckLegError(leg, spans[0, 0])

    assert sharpest(sharp) < LEAST
    assert turns(narrow).of(sharp) is sharp


def test_a_turn_that_is_hardly_too_sharp_gets_round_as_well() -> None:
    """By less than what a turn has to gain that stays too sharp: a flight was rough by 0.3 %."""
    found = spline(np.array([[0.0, 0, 9], [30, 0, 9], [40, 20, 9]]))
    least = sharpest(found) / 0.997
    bent = replace(turns(), least=least).of(found)
    assert sharpest(bent) >= 0.999 * least
