import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.space.timing.climb_speeds import climb_speeds

TOP, UP, DOWN = 10.0, 2.5, 1.5


def allowed(way: np.ndarray) -> np.ndarray:
    """The largest speed along directions, limit by limit."""
    rise = way[:, 2] / np.linalg.norm(way, axis=1)
    with np.errstate(divide="ignore"):
        return np.minimum(TOP, np.where(rise > 0, UP / rise, np.where(rise < 0, -DOWN / rise, TOP)))


@given(seed=st.integers(0, 10_000), flat=st.booleans())
def test_no_place_is_faster_than_climb_and_descent_allow_and_few_are_much_slower(
    seed: int, flat: bool
) -> None:
    rng = np.random.default_rng(seed)
    vias = rng.uniform(0, 100, (int(rng.integers(2, 7)), 3)) * (1, 1, 0.2 if flat else 1)
    path = CardinalSpline(vias, knots="chordal", tangents="continuous")
    slow = climb_speeds(path, TOP, UP, DOWN)
    u = np.sort(rng.uniform(*path.domain, 3000))
    at, best = path.distance(u), allowed(path.evaluate(u, 1))
    speed = np.full(len(u), TOP)
    for part in slow:
        speed[(at >= part.start) & (at <= part.end)] = part.speed
        assert part.start < part.end
    assert np.all(speed <= best * (1 + 1e-9))
    assert np.median(speed / best) > 0.97


def test_a_level_path_and_one_without_limits_are_slowed_nowhere() -> None:
    level = CardinalSpline([(0, 0, 5), (10, 4, 5), (20, 0, 5)], knots="chordal")
    assert climb_speeds(level, TOP, UP, DOWN) == ()
    steep = CardinalSpline([(0, 0, 5), (10, 4, 50)])
    assert climb_speeds(steep, TOP, None, None) == ()


def test_an_upright_leg_climbs_as_fast_as_it_may_and_sinks_as_fast_as_it_may() -> None:
    up = [[0, 0, 0], [0, 0, 4], [0, 0, 8], [0, 0, 12]]
    down = [[0, 0, 12], [0, 0, 8], [0, 0, 4], [0, 0, 0]]
    slow = climb_speeds(PiecewiseCubic([up, down]), TOP, UP, DOWN)
    assert [(part.start, part.end, part.speed) for part in slow] == [(0, 12, UP), (12, 24, DOWN)]


def test_directions_whose_level_parts_cancel_out_are_taken_as_upright() -> None:
    turn = PiecewiseCubic([[[0, 0, 0], [5, 0, 1], [5, 0.1, 2], [0, 0.1, 3]]])
    u = np.linspace(0, 1, 2001)
    best = allowed(turn.evaluate(u, 1))
    at = turn.distance(u)
    for part in climb_speeds(turn, TOP, UP, DOWN):
        inside = (at > part.start) & (at < part.end)
        assert np.all(best[inside] >= part.speed - 1e-9)
