import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.jit import kernel
from viaspline.kernels.turning import connect, curvature_ramp
from viaspline.kernels.turning.segment_chain import chain_spans, merged
from viaspline.kernels.turning.settled_lines import FINE, HEADING, RADIUS, SIDE
from viaspline.kernels.turning.turn_sequence import turn_sequence
from viaspline.kernels.turning.turn_spans import turn_sequence_length

RHO, RAMP = 4.0, 1.5
angles = st.floats(-math.pi, math.pi)
places = st.floats(-40, 40)
sides = st.sampled_from([1.0, -1.0])


@kernel
def connection(x, y, start, goal, s1, s2, rho, ramp, segments):
    return connect.connection(x, y, start, goal, s1, s2, rho, ramp, segments)


@kernel
def along_bend(first, last, length, s):
    return curvature_ramp.along_bend(first, last, length, s)


def connected(x, y, start, goal, s1, s2, ramp=RAMP):
    segments = np.empty((connect.MAX_SEGMENTS, 3))
    count, length = connection(x, y, start, goal, s1, s2, RHO, ramp, segments)
    return segments[:count], length


def driven(start, segments):
    x, y, heading = start
    for first, last, length in segments:
        dx, dy, turn = along_bend(first, last, length, length)
        c, s = math.cos(heading), math.sin(heading)
        x, y, heading = x + c * dx - s * dy, y + s * dx + c * dy, heading + turn
    return x, y, heading


@pytest.mark.long_without_jit
@settings(max_examples=300, deadline=None)
@given(places, places, angles, angles, sides, sides)
def test_it_hits_the_pose_without_jumps_of_curvature(x, y, start, goal, s1, s2):
    segments, length = connected(x, y, start, goal, s1, s2)
    assume(len(segments))
    end = driven((0, 0, start), segments)
    assert end[:2] == pytest.approx((x, y), abs=1e-8)
    assert math.remainder(end[2] - goal, math.tau) == pytest.approx(0.0, abs=1e-9)
    assert (np.abs(segments[:, :2]) * RHO <= 1 + 1e-9).all()
    assert np.append(segments[:, 0], 0.0) == pytest.approx(np.append(0.0, segments[:, 1]))
    assert segments[:, 2].sum() == pytest.approx(length)
    assert length >= math.hypot(x, y) - 1e-9


@pytest.mark.long_without_jit
@settings(max_examples=100, deadline=None)
@given(angles, st.floats(24, 60), angles, angles)
def test_far_apart_the_best_is_no_longer_than_the_best_swing_of_two_bends(way, gap, start, goal):
    x, y = gap * math.cos(way), gap * math.sin(way)
    lengths, swings = [], []
    for s1, s2 in [(1, 1), (1, -1), (-1, 1), (-1, -1)]:
        lengths.append(connected(x, y, start, goal, s1, s2)[1])
        bends = np.zeros((2, 6))
        bends[1, :2] = x, y
        bends[:, HEADING], bends[:, SIDE], bends[:, RADIUS] = (start, goal), (s1, s2), RHO
        *found, state, _ = turn_sequence(bends, False, RAMP / RHO)
        if state == FINE:
            swings.append(turn_sequence_length(bends, False, *found))
    assert min(lengths) <= min(swings, default=math.inf) + 1e-6
    assert min(lengths) < math.inf


@pytest.mark.parametrize("s1", [1.0, -1.0])
def test_a_free_heading_comes_straight(s1):
    segments, _ = connected(20, 7, 0.4, math.nan, s1, 1.0)
    assert segments[-1, :2] == pytest.approx((0, 0))
    assert driven((0, 0, 0.4), segments)[:2] == pytest.approx((20, 7), abs=1e-9)


@pytest.mark.long_without_jit
@settings(max_examples=100, deadline=None)
@given(places, places, angles, angles, sides, sides)
def test_its_spans_have_continuous_curvature_below_that_of_the_circle(x, y, start, goal, s1, s2):
    segments, length = connected(x, y, start, goal, s1, s2)
    assume(len(segments))
    ends = np.array([0, 0, start]), np.array([x, y, goal])
    curve = PiecewiseCubic(chain_spans(*ends, merged(segments, RHO)))
    assert curve.evaluate(curve.domain[1]) == pytest.approx((x, y), abs=1e-12)
    assert curve.length == pytest.approx(length, rel=1e-5)
    assert curve.max_curvature()[0] * RHO < 1.003
    assert curve.curvature_jumps().max(initial=0.0) * RHO < 1e-6
    assert curve.heading(0.0) == pytest.approx(start, abs=1e-8)
    assert math.remainder(curve.heading(curve.domain[1]) - goal, math.tau) == pytest.approx(
        0.0, abs=1e-9
    )


def test_a_merged_chain_has_as_few_segments_as_it_can():
    ramp = [[0, 0.1, 0.5], [0.1, 0.2, 0.5], [0.2, 0.2, 1], [0.2, 0.2, 0], [0.2, 0.2, 2]]
    whole = merged(np.array(ramp), 5.0)
    assert whole == pytest.approx(np.array([[0, 0.2, 1], [0.2, 0.2, 3]]))
