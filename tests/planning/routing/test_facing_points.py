"""Orders past points that face a direction, against all orders by a rule of the test's own."""

from __future__ import annotations

import math
from itertools import pairwise, permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.arrays import Floats
from viaspline.planning.routing.facing_points import FacingPoints
from viaspline.planning.routing.least_order import last_stop, round_of, shortest_order

seeds = st.integers(0, 100_000)


def some_points(seed: int, vias: int, *, goal: bool) -> FacingPoints:
    """A start, via points of which most face somewhere, and perhaps a goal."""
    rng = np.random.default_rng(seed)
    count = 1 + vias + goal
    angles = rng.uniform(-math.pi, math.pi, count)
    ways = np.column_stack([np.cos(angles), np.sin(angles)])
    ways[rng.random(count) < 0.3] = 0.0
    ways[[0, -1] if goal else [0]] = 0.0
    return FacingPoints(rng.uniform(0, 100, (count, 2)), ways)


def lengths_of(facing: FacingPoints) -> Floats:
    return np.asarray(np.linalg.norm(facing.places[:, None] - facing.places[None], axis=-1))


def backwards(facing: FacingPoints, stops: tuple[int, ...], *, ends: bool) -> int:
    """How many points are come to from ahead and left behind, told by angles."""
    wrong = 0
    for k in range(1, len(stops) - 1 if ends else len(stops)):
        way = complex(*facing.ways[stops[k]])
        here = complex(*facing.places[stops[k]])
        if way == 0:
            continue
        came = complex(*facing.places[stops[k - 1]]) - here
        leads = [-came if k + 1 == len(stops) else complex(*facing.places[stops[k + 1]]) - here]
        turned = [abs(np.angle(to / way)) for to in (-came, *leads)]
        wrong += min(turned) > math.pi / 2
    return wrong


@settings(max_examples=60)
@given(seeds, st.integers(1, 5), st.sampled_from(["goal", "closed", "open"]))
def test_of_few_orders_the_shortest_that_passes_fewest_points_backwards_is_taken(
    seed: int, vias: int, kind: str
) -> None:
    facing = some_points(seed, vias, goal=kind == "goal")
    lengths = lengths_of(facing)
    last = last_stop(len(lengths), vias, closed=kind == "closed")

    def rank(order: tuple[int, ...]) -> tuple[int, float]:
        stops = round_of(order, last)
        length = sum(float(lengths[a, b]) for a, b in pairwise(stops))
        return backwards(facing, stops, ends=last is not None), length

    found = rank(shortest_order(lengths, vias, last, facing))
    best = min(rank(order) for order in permutations(range(vias)))
    assert found == pytest.approx(best)


@settings(max_examples=5)
@given(seeds, st.integers(10, 24), st.booleans())
def test_among_many_points_none_is_passed_backwards(seed: int, vias: int, goal: bool) -> None:
    facing = some_points(seed, vias, goal=goal)
    last = last_stop(len(facing.places), vias, closed=False)
    lengths = lengths_of(facing)
    order = shortest_order(lengths, vias, last, facing)
    assert sorted(order) == list(range(vias))
    assert backwards(facing, round_of(order, last), ends=last is not None) == 0
    longest = sum(float(lengths[a, b]) for a, b in pairwise(round_of(order, last)))
    free = shortest_order(lengths, vias, last)
    assert longest < 2.5 * sum(float(lengths[a, b]) for a, b in pairwise(round_of(free, last)))


def test_an_order_without_facing_points_is_as_short_as_ever() -> None:
    facing = some_points(5, 20, goal=True)
    nowhere = FacingPoints(facing.places, np.zeros_like(facing.ways))
    lengths = lengths_of(facing)
    assert shortest_order(lengths, 20, 21, nowhere) == shortest_order(lengths, 20, 21)
