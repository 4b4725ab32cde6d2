import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.integrate import quad

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.jit import kernel
from viaspline.kernels.turning import clothoid
from viaspline.kernels.turning.needed_turns import needed_turns
from viaspline.kernels.turning.settled_lines import (
    FINE,
    HEADING,
    KEPT,
    LEFT_OUT,
    RADIUS,
    RESTLESS,
    SIDE,
    X,
    Y,
)
from viaspline.kernels.turning.turn_sequence import turn_sequence
from viaspline.kernels.turning.turn_spans import turn_sequence_length, turn_sequence_spans

RHO = 4.0


@kernel
def along_ramp(sharpness, distance):
    return clothoid.along_ramp(sharpness, distance)


def bends_through(points, kept=0.0, side=0.0, ends=(math.nan, math.nan), sides=(0.0, 0.0)):
    rows = np.zeros((len(points), 6))
    rows[:, [X, Y]] = points
    rows[:, KEPT], rows[:, SIDE], rows[:, HEADING] = kept, side, math.nan
    rows[[0, -1], HEADING], rows[[0, -1], SIDE] = ends, sides
    rows[[0, -1], KEPT] = 0.0
    return rows


def swung(bends, closed=False, rho=RHO, ramp=RHO):
    bends = bends.copy()
    bends[:, RADIUS] = rho
    *found, state, _ = turn_sequence(bends, closed, ramp / rho)
    if state != FINE:
        return None
    lines, turns, apexes, ramps = found
    spans, begins = turn_sequence_spans(bends, closed, lines, turns, apexes, ramps)
    length = turn_sequence_length(bends, closed, lines, turns, apexes, ramps)
    return PiecewiseCubic(spans, closed=closed), begins, length


@pytest.mark.parametrize("sharpness", [-0.3, 0.0, 0.05, 0.4])
@pytest.mark.parametrize("distance", [0.1, 1.0, 2.0])
def test_a_ramp_is_the_integral_of_its_heading(sharpness, distance):
    x, y = along_ramp(sharpness, distance)
    assert x == pytest.approx(quad(lambda s: math.cos(sharpness * s * s / 2), 0, distance)[0])
    assert y == pytest.approx(quad(lambda s: math.sin(sharpness * s * s / 2), 0, distance)[0])


@pytest.mark.long_without_jit
@pytest.mark.parametrize("closed", [False, True])
def test_random_swings_pass_their_points_without_jumps_or_sharper_turns(closed):
    rng = np.random.default_rng(7)
    served = 0
    for _ in range(60):
        points = rng.uniform(0, 200, (int(rng.integers(3, 10)), 2))
        found = swung(bends_through(points), closed)
        if found is None:
            continue
        served += 1
        curve, begins, length = found
        ends = np.vstack((points, points[:1])) if closed else points
        assert np.abs(curve.evaluate(begins.astype(float)) - ends).max() < 1e-8
        assert curve.max_curvature()[0] * RHO < 1.003
        assert curve.curvature_jumps().max() < 1e-6
        heading = np.unwrap(curve.heading(np.linspace(0, len(curve.spans), 4001)))
        assert np.abs(np.diff(heading)[:-1]).max() < 0.3
        assert curve.length == pytest.approx(length, rel=1e-5)
    assert served > 50


@pytest.mark.parametrize("start", [-3.0, 0.0, 1.5])
@pytest.mark.parametrize("goal", [-2.0, 0.4])
@pytest.mark.parametrize("sides", [(1, 1), (1, -1), (-1, 1), (-1, -1)])
def test_given_headings_are_taken_over_at_both_ends_to_either_side(start, goal, sides):
    bends = bends_through([(0, 0), (50, 10)], ends=(start, goal), sides=sides)
    curve, _, _ = swung(bends)
    end = curve.domain[1]
    assert math.remainder(curve.heading(0.0) - start, math.tau) == pytest.approx(0.0, abs=1e-9)
    assert math.remainder(curve.heading(end) - goal, math.tau) == pytest.approx(0.0, abs=1e-9)
    assert curve.evaluate(0.0) == pytest.approx([0, 0], abs=1e-8)
    assert curve.evaluate(end) == pytest.approx([50, 10], abs=1e-8)
    assert curve.max_curvature()[0] * RHO < 1.003
    assert abs(curve.curvature(0.0)) + abs(curve.curvature(end)) < 1e-9


def test_a_turn_stays_outside_of_what_it_goes_round():
    bends = bends_through([(0, 0), (30, 2), (60, -20)], kept=np.array([0, 3.0, 0]), side=-1.0)
    bends[[0, -1], SIDE] = 0.0
    curve, _, _ = swung(bends)
    gaps = np.linalg.norm(curve.evaluate(np.linspace(*curve.domain, 5001)) - [30, 2], axis=1)
    assert gaps.min() == pytest.approx(3.0, abs=1e-3)
    assert gaps.min() > 3.0 - 1e-4


@given(
    turn=st.floats(0.02, 3.9), before=st.floats(0.03, 5.0), after=st.floats(0.03, 5.0),
    side=st.sampled_from((-1.0, 1.0)),
)  # fmt: skip
@example(turn=0.109, before=0.46, after=0.11, side=-1.0)  # the goal is close beside what is wide
def test_a_turn_goes_no_farther_round_than_the_taut_way(turn, before, after, side):
    """The way touches a circle of 1 m, goes along it by so much and leaves it."""
    touched = np.array([0.0, -side])
    left = side * np.array([math.sin(side * turn), -math.cos(side * turn)])
    goal = left + after * np.array([math.cos(side * turn), math.sin(side * turn)])
    rows = bends_through([touched - (before, 0.0), (0.0, 0.0), goal])
    rows[1, KEPT], rows[1, SIDE], rows[:, RADIUS] = 1.0, side, 0.05
    kept, _, turns, *_, state, _ = needed_turns(rows, False, 1.0)
    assert (len(kept), state) == (3, FINE)
    assert side * turns[1] == pytest.approx(turn, abs=0.1)


def test_there_and_back_again_swings_out_to_a_turn_of_less_than_half_a_circle():
    curve, begins, _ = swung(bends_through([(0, 0), (50, 0), (0, 0)]))
    assert curve.evaluate(float(begins[1])) == pytest.approx([50, 0])
    assert 100 < curve.length < 106


@pytest.mark.parametrize("away", [12.0, 2.2])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_out_from_an_obstacle_and_back_round_it_is_turned_by_the_lesser_way(side, away):
    """Between middles it turns by just half a turn, of which rounding tells the side.

    Found by transformed_fleets.py (2 320): half of such rounds had a loop, the mirrored ones none.
    """
    bends = bends_through([(30, 1), (away, 0), (0, 0), (away, 0), (30, -1)])
    bends[[1, 3], KEPT], bends[[1, 3], SIDE] = 2.0, -side
    bends[:, Y] *= -side
    bends[:, RADIUS] = 0.1
    left, _, turns, *_, state, _ = needed_turns(bends, False, 1.0)
    assert state == FINE
    at = left.tolist().index(2)
    assert -side * turns[at] == pytest.approx(math.pi - 2.0 * math.asin(2.0 / away), abs=0.1)


@pytest.mark.parametrize("bend", [[(30, 0), (30, 1)], [(30, 0), (31, 4), (28, 4)]])
def test_points_that_are_too_close_for_the_circle_are_refused(bend):
    points = [(0, 0), *bend, (0, 1)]
    assert swung(bends_through(points)) is None
    assert swung(bends_through(points), rho=0.1, ramp=0.1) is not None


def test_a_bend_that_only_wide_turns_come_near_is_not_left_out():
    """The taut way goes by the third bend, but not the line between turns of 4 m."""
    rows = bends_through(
        [(77.2, 66.2), (98.62, 86.42), (108.59, 92.89), (129.36, 110.49), (169.12, 158.25)],
        kept=[0.0, 2.001, 2.002, 7.959, 0.0], side=[0.0, 1.0, -1.0, -1.0, 0.0],
    )  # fmt: skip
    curve, _, _ = swung(rows)
    points = curve.evaluate(np.linspace(*curve.domain, 20_001))
    without, _, _ = swung(np.delete(rows, 2, axis=0))
    beside = without.evaluate(np.linspace(*without.domain, 20_001))
    assert np.linalg.norm(beside - rows[2, :2], axis=1).min() < 2.0
    for x, y, kept, *_ in rows[1:-1]:
        assert np.hypot(points[:, 0] - x, points[:, 1] - y).min() == pytest.approx(kept, abs=1e-4)


def test_a_bend_that_the_others_make_needless_is_left_out():
    rows = bends_through(
        [(0, 0), (20, 10), (30, 30), (60, 0)], kept=[0, 3, 3, 0], side=[0.0, -1.0, 1.0, 0.0]
    )
    rows[:, RADIUS] = RHO
    *_, state, tight = turn_sequence(rows, False, 1.0)
    assert (state, list(tight)) == (LEFT_OUT, [2])


@pytest.mark.parametrize("radius", [0.4954, 0.8])
def test_an_s_between_two_corners_of_cells_settles(radius):
    """With ramps as long as its radius each turn has an arc in one round and none in the next."""
    rows = bends_through(
        [(0, 0), (1, -3), (2, -4), (3, -6)], kept=[0, 0.3313, 0.3313, 0], side=[0.0, 1.0, -1.0, 0.0]
    )
    curve, _, length = swung(rows, rho=radius, ramp=radius)
    points = curve.evaluate(np.linspace(*curve.domain, 20_001))
    for x, y, kept, *_ in rows[1:-1]:
        assert np.hypot(points[:, 0] - x, points[:, 1] - y).min() == pytest.approx(kept, abs=1e-4)
    assert curve.max_curvature()[0] * radius < 1.003
    assert curve.curvature_jumps().max() < 1e-6
    assert curve.length == pytest.approx(length, rel=1e-5)


def test_random_slaloms_round_corners_of_cells_settle_or_have_no_room():
    rng = np.random.default_rng(11)
    steps = rng.integers(1, 4, (200, 6, 2)) * np.array([1, -1])
    served = 0
    for corners in np.cumsum(steps, axis=1).astype(float):
        into, out = np.diff(corners, axis=0)[:-1], np.diff(corners, axis=0)[1:]
        side = np.sign(into[:, 0] * out[:, 1] - into[:, 1] * out[:, 0])
        rows = bends_through(corners, kept=[0, *(0.33 * np.abs(side)), 0], side=[0.0, *side, 0.0])
        rows[:, RADIUS] = 0.4954
        *_, state, tight = turn_sequence(rows, False, 1.0)
        assert state != RESTLESS
        assert (tight.size > 0) == (state != FINE)
        served += state == FINE
    assert served > 50


def random_row(seed, closed):
    """Bends of a zigzag, some of them so close that those about them make them needless."""
    random = np.random.default_rng(seed)
    count = int(random.integers(4, 60))
    points = np.column_stack(
        (np.cumsum(random.uniform(2, 12, count)), random.uniform(-6, 6, count))
    )
    if closed:
        angles = np.sort(random.uniform(0, math.tau, count))
        points = 30 * np.column_stack((np.cos(angles), np.sin(angles))) + random.normal(
            0, 1, (count, 2)
        )
    steps = np.diff(np.vstack((points[-1], points, points[0])), axis=0)
    turns = steps[:-1, 0] * steps[1:, 1] - steps[:-1, 1] * steps[1:, 0]
    rows = bends_through(points, kept=random.uniform(0.1, 1.5, count), side=np.sign(turns))
    if closed:
        rows[[0, -1], SIDE] = np.sign(turns)[[0, -1]]
    rows[:, RADIUS] = random.uniform(0.5, 3.0)
    return rows


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("seed", range(30))
def test_bends_that_are_left_are_laid_as_they_are_without_those_that_go(seed, closed):
    rows = random_row(seed, closed)
    left, lines, turns, apexes, ramps, state, tight = needed_turns(rows, closed, 1.0)
    its_lines, its_turns, its_apexes, its_ramps, its_state, its_tight = turn_sequence(
        rows[left], closed, 1.0
    )
    assert (state, tight.tolist()) == (its_state, its_tight.tolist())
    assert state != LEFT_OUT
    if state == FINE:
        assert np.exp(1j * lines) == pytest.approx(np.exp(1j * its_lines), abs=1e-9)
        assert turns == pytest.approx(its_turns, abs=1e-9)
        assert apexes == pytest.approx(its_apexes, abs=1e-9)
        assert ramps == pytest.approx(its_ramps, rel=1e-12)


@pytest.mark.long_without_jit
def test_rows_without_bends_that_go_are_among_the_random_ones_and_others():
    sizes = [(random_row(seed, False), seed) for seed in range(30)]
    gone = [len(rows) - len(needed_turns(rows, False, 1.0)[0]) for rows, _ in sizes]
    assert min(gone) == 0 < max(gone)


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("seed", range(20))
def test_far_from_the_origin_turns_settle_as_they_do_near_it(seed, closed):
    """As in UTM."""
    rows, origin = random_row(seed, closed), np.array([5e5, 5.2e6])
    far = rows.copy()
    far[:, [X, Y]] += origin
    left, _, turns, apexes, _, state, _ = needed_turns(rows, closed, 1.0)
    its_left, _, its_turns, its_apexes, _, its_state, _ = needed_turns(far, closed, 1.0)
    assert (state, left.tolist()) == (its_state, its_left.tolist())
    if state == FINE:
        assert its_turns == pytest.approx(turns, abs=1e-6)
        assert its_apexes - origin == pytest.approx(apexes, abs=1e-6)
