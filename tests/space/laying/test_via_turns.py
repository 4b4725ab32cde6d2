"""Turns through via points: exact, without jumps, and sooner than turns before and after them."""

from dataclasses import replace

import numpy as np
from hypothesis import assume, example, given
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.space.laying.laid_route import CurveShape, LaidRoute, RouteLegs, lay_route
from viaspline.space.laying.via_turns import via_turns
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.retime import retime

seeds = st.integers(0, 10_000)
WIDE, CLOSE = 62.5, 0.6
LIMITS = Limits(max_speed=10.0, max_accel=2.0, max_lateral_accel=2.0)


def led(vias: Floats, inner: list[Floats], wide: float = WIDE) -> RouteLegs:
    """A route all of whose legs are led round something."""
    legs = RouteLegs.left_to_the_spline(
        vias, np.full(vias.shape, np.nan), CurveShape(np.zeros(len(vias) - 1)), CLOSE
    )
    for leg, corners in enumerate(inner):
        legs = legs.led_round(leg, corners, wide)
    return legs


def random_route(seed: int) -> RouteLegs:
    rng = np.random.default_rng(seed)
    vias = np.cumsum(rng.normal(0, 100, (4, 3)) * [1, 1, 0.2], axis=0)
    inner = [
        vias[leg] + rng.uniform(0.3, 0.7) * (vias[leg + 1] - vias[leg]) + rng.normal(0, 20, (1, 3))
        for leg in range(3)
    ]
    corners = [one if rng.random() < 0.7 else one[:0] for one in inner]
    return led(vias, corners, float(rng.uniform(1, 80)))


def bend(span: Floats) -> Floats:
    """The curvature of a span where it begins, as a vector."""
    first, second = 3 * (span[1] - span[0]), 6 * (span[2] - 2 * span[1] + span[0])
    square = first @ first
    return (second - (second @ first) / square * first) / square


def duration(laid: LaidRoute) -> float:
    return retime(Path(laid.spans, []), LIMITS).duration


@given(seed=seeds)
@example(seed=3)
@example(seed=210)  # a corner that is moved to the other side of its turn
def test_a_via_point_is_passed_exactly_and_without_a_jump(seed: int) -> None:
    legs = random_route(seed)
    laid = lay_route(legs)
    for k in (1, 2):
        before, after = laid.spans[laid.joints[k] - 1], laid.spans[laid.joints[k]]
        assert np.array_equal(before[3], legs.vias[k])
        assert np.array_equal(after[0], legs.vias[k])
        into, out = before[3] - before[2], after[1] - after[0]
        size = np.linalg.norm(into) * np.linalg.norm(out)
        assert into @ out > (1 - 1e-9) * size
        gap = np.linalg.norm(bend(before[::-1]) - bend(after))
        assert gap < 1e-6 * (1.0 / CLOSE)


@given(seed=seeds)
def test_a_leg_has_no_corner_behind_its_turn(seed: int) -> None:
    spans = lay_route(random_route(seed)).spans
    into, out = spans[:-1, 3] - spans[:-1, 2], spans[1:, 1] - spans[1:, 0]
    sizes = np.linalg.norm(into, axis=1) * np.linalg.norm(out, axis=1)
    turned = (into * out).sum(axis=1) / sizes
    assert np.array_equal(spans[:-1, 3], spans[1:, 0])
    assume(turned.min() > 0.0)  # what turns right back at a corner isn't rounded
    assert turned.min() > 1 - 1e-8


@given(seed=seeds)
def test_a_turn_has_the_radius_that_is_told(seed: int) -> None:
    legs = random_route(seed)
    laid, turns = lay_route(legs), legs.turns
    for k in (1, 2):
        if not np.isnan(turns[k, -1]):
            assert np.isclose(np.linalg.norm(bend(laid.spans[laid.joints[k]])), 1 / turns[k, -3])


@given(seed=seeds, angle=st.floats(0.0, 170.0), length=st.floats(60.0, 500.0))
@example(seed=1, angle=165.0, length=400.0)
def test_in_the_open_a_turn_is_no_later_than_one_before_and_one_after_the_via_point(
    seed: int, angle: float, length: float
) -> None:
    turn = np.radians(angle)
    ways = np.array([[-1.0, 0, 0], [0, 0, 0], [np.cos(turn), np.sin(turn), 0]])
    turned, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    vias = length * ways @ turned
    none = np.empty((0, 3))
    legs = led(vias, [none, none])
    straight = legs.through(1, legs.ways[1])
    others = [
        duration(lay_route(replace(straight, radii=(np.array([r, r]), np.array([r, r])))))
        for r in (WIDE, 0.3 * WIDE, CLOSE)
    ]
    assert duration(lay_route(legs)) <= 1.005 * min(others)


def test_where_there_is_no_room_for_a_turn_that_is_close_there_is_none() -> None:
    back = np.array([[-4.0, 0, 0], [0, 0, 0], [-4, 0.1, 0]])
    none, free, wide = np.empty((0, 3)), np.full((3, 3), np.nan), np.full(2, 5.0)
    assert np.isnan(via_turns(back, [none, none], free, [wide, wide], CLOSE)).all()
    assert np.isnan(via_turns(back, [none, None], free, [wide, wide], 0.0)).all()


def test_legs_that_are_tightened_share_the_tighter_turn() -> None:
    legs = led(np.array([[-90.0, 0, 0], [0, 0, 0], [0, 90, 0]]), [np.empty((0, 3))] * 2, 20.0)
    close = replace(legs, radii=(legs.radii[0], np.array([3.0, 20.0])))
    assert close.turns[1, -3] < 3.0 < legs.turns[1, -3]
    laid = lay_route(close)
    before, after = laid.spans[laid.joints[1] - 1], laid.spans[laid.joints[1]]
    assert np.allclose(bend(before[::-1]), bend(after), atol=1e-9)


@given(seed=seeds, wide=st.floats(1.0, 60.0))
@example(seed=0, wide=20.0)
def test_a_way_round_to_one_side_never_bends_to_the_other(seed: int, wide: float) -> None:
    rng = np.random.default_rng(seed)
    at = np.cumsum(rng.uniform(0.3, 0.75, 7))
    places = 100.0 * np.column_stack([np.cos(at), np.sin(at), np.zeros(7)])
    spans = lay_route(led(places[::2], [places[k : k + 1] for k in (1, 3, 5)], wide)).spans
    ways = np.diff(spans, axis=1)
    ways = ways[np.linalg.norm(ways, axis=2) > 1e-6]
    turned = ways[:-1, 0] * ways[1:, 1] - ways[:-1, 1] * ways[1:, 0]
    sizes = np.linalg.norm(ways[:-1], axis=1) * np.linalg.norm(ways[1:], axis=1)
    assert (turned / sizes).min() > -0.03
