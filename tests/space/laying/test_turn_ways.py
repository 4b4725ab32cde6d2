"""Directions of turns at via points."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.arrays import Floats
from viaspline.space.laying.laid_route import CurveShape, RouteLegs
from viaspline.space.laying.turn_ways import across_turn, head_of, other_ways

UPRIGHT = np.array([0.0, 0, 1])


def bent_route(seed: int) -> RouteLegs:
    rng = np.random.default_rng(seed)
    vias = rng.uniform(0, 40, (3, 3))
    return RouteLegs.left_to_the_spline(vias, np.full((3, 3), np.nan), CurveShape(np.zeros(2)))


def unit(way: Floats) -> Floats:
    return np.asarray(way / np.linalg.norm(way))


@given(seed=st.integers(0, 10_000))
def test_across_is_as_far_from_the_way_in_as_from_the_way_out(seed: int) -> None:
    back, on = np.random.default_rng(seed).normal(size=(2, 3))
    way = across_turn(back, on)
    assert abs(np.linalg.norm(way) - 1.0) < 1e-9
    assert abs(way @ unit(-back) - way @ unit(on)) < 1e-6


@given(seed=st.integers(0, 10_000))
def test_each_other_way_is_a_unit_vector_and_another_one(seed: int) -> None:
    legs = bent_route(seed)
    away = unit(np.random.default_rng(seed + 1).normal(size=3))
    own = unit(legs.vias[2] - legs.vias[0])
    ways = [own, *other_ways(legs, 1, own, away)]
    assert np.allclose(np.linalg.norm(ways, axis=1), 1.0)
    apart = np.linalg.norm(np.array(ways)[:, None] - np.array(ways), axis=2)
    assert (apart + 9.0 * np.eye(len(ways)) > 1e-4).all()


@given(seed=st.integers(0, 10_000))
def test_one_is_along_what_is_near_and_one_is_level(seed: int) -> None:
    legs = bent_route(seed)
    away = unit(np.random.default_rng(seed + 1).normal(size=3))
    ways = np.array(list(other_ways(legs, 1, unit(legs.vias[2] - legs.vias[0]), away)))
    assert np.abs(ways @ away).min() < 1e-9
    assert np.abs(ways @ UPRIGHT).min() < 1e-9


def test_a_leg_goes_straight_on_along_its_direction_and_only_where_it_has_one() -> None:
    legs = bent_route(7)
    assert np.array_equal(head_of(legs, 0, 0, 2.0), legs.vias[:1])
    legs.given[0] = (1.0, 0.0, 0.0)
    via, end = head_of(legs, 0, 0, 2.0)
    assert np.array_equal(via, legs.vias[0])
    assert np.allclose(unit(end - via), [1, 0, 0])
