"""What a way costs at least that passes solids on one side: never more than one that does."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.space.routing.side_gates import LEFT, OVER, RIGHT, UNDER
from viaspline.kernels.space.routing.travel_past import least_travel
from viaspline.kernels.space.routing.way_checks import way_cost

seeds = st.integers(0, 10_000)
LENGTH, TIME = np.zeros(3), np.array([10.0, 2.5, 1.5])


def random_gate(rng: np.random.Generator, side: int) -> np.ndarray:
    """A gate about the origin, 20 m to each side, from -10 to 30 m, on one side of which is way."""
    turn = rng.uniform(0.0, 2.0 * np.pi)
    return np.array([[0.0, 0.0, np.cos(turn), np.sin(turn), -20.0, 20.0, 10.0, side]])


def crossing(rng: np.random.Generator, gate: np.ndarray, side: int) -> np.ndarray:
    """A place of the gate's plane on that side."""
    along = {LEFT: rng.uniform(20, 60), RIGHT: rng.uniform(-60, -20)}.get(
        side, rng.uniform(-20, 20)
    )
    z = {OVER: rng.uniform(10, 60), UNDER: rng.uniform(-40, 10)}.get(side, rng.uniform(-40, 60))
    return np.array([-along * gate[0, 3], along * gate[0, 2], z])


@pytest.mark.parametrize("side", [LEFT, RIGHT, OVER, UNDER])
@pytest.mark.parametrize("norm", [LENGTH, TIME])
@given(seed=seeds)
def test_no_way_past_a_gate_costs_less(side: int, norm: np.ndarray, seed: int) -> None:
    rng = np.random.default_rng(seed)
    gate = random_gate(rng, side)
    ahead = np.array([gate[0, 2], gate[0, 3], 0.0])
    aside = np.array([-gate[0, 3], gate[0, 2], 0.0])
    ends = [
        sign * rng.uniform(1, 80) * ahead
        + rng.uniform(-50, 50) * aside
        + [0, 0, rng.uniform(0, 40)]
        for sign in (-1, 1)
    ]
    way = np.array([ends[0], crossing(rng, gate, side), ends[1]])
    for there, speeds in ((way, norm), (way[::-1].copy(), norm[[0, 2, 1]])):
        least = least_travel(gate, speeds, there[0], there[-1])
        assert least <= way_cost(speeds, there) * (1 + 1e-12)
        assert least >= way_cost(speeds, there[[0, -1]]) * (1 - 1e-12)


def test_over_a_roof_a_way_has_to_climb_and_to_sink() -> None:
    gate = np.array([[0.0, 0.0, 1.0, 0.0, -20.0, 20.0, 30.0, OVER]])
    start, goal = np.array([-50.0, 0, 5]), np.array([50.0, 0, 0])
    assert least_travel(gate, TIME, start, goal) == pytest.approx(25 / 2.5 + 30 / 1.5)
    assert least_travel(gate[:0], TIME, start, goal) == pytest.approx(np.hypot(100, 5) / 10)


def test_beside_a_wall_a_way_has_to_go_round_its_end() -> None:
    gate = np.array([[0.0, 0.0, 1.0, 0.0, -20.0, 20.0, 30.0, LEFT]])
    start, goal = np.array([-15.0, 0, 5]), np.array([15.0, 0, 5])
    assert least_travel(gate, LENGTH, start, goal) == pytest.approx(50.0)
