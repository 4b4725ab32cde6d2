"""Lines and turns round rows of bends, to either side of headings that are given."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.planning.turning.bend_row import DETOUR, HEADING, Bends, bend
from viaspline.planning.turning.turn_path import (
    WOUND_RAD,
    TurnPath,
    turn_path_on_sides,
    turn_path_round,
    turned_otherwise,
    with_sides,
)

RADII = (0.05, 0.3, 1.0)  # of turns, that have room before what comes first [m]


def row(off: float, kept: float, side: float, ends: tuple[float, float]) -> Bends:
    """From (0, 0) past a circle 8 m ahead, to whose tangent a heading is turned, and on."""
    middle = (8.0, off)
    rows = np.array([bend(0, 0), bend(*middle, kept, side), bend(16.0, off - 3.0 * side)])
    line = math.atan2(off, 8.0) - math.asin(side * kept / math.hypot(*middle))
    rows[0, HEADING], rows[-1, HEADING] = line + ends[0], ends[1]
    return Bends.free(rows, np.array([0, DETOUR, 1]))


@pytest.mark.parametrize("radius", RADII)
@settings(max_examples=60, deadline=None)
@given(
    st.floats(-2.0, 2.0), st.floats(0.05, 2.0), st.sampled_from([-1.0, 1.0]),
    st.floats(-0.4, 0.4), st.one_of(st.just(math.nan), st.floats(-3.0, 3.0)),
)  # fmt: skip
@example(off=0.25, kept=0.243, side=-1.0, turned=0.005, comes=math.nan)
@example(off=0.25, kept=0.243, side=-1.0, turned=-0.005, comes=math.nan)
@example(off=0.0, kept=0.5, side=1.0, turned=0.0, comes=math.nan)
def test_a_heading_that_is_nearly_that_of_its_line_is_not_left_by_a_whole_turn(
    radius: float, off: float, kept: float, side: float, turned: float, comes: float
) -> None:
    found = turn_path_round(row(off, kept, side, (turned, comes)).turning(radius))
    assert isinstance(found, TurnPath)
    assert abs(found.turns[0]) < 1.0
    leaves = found.spans[0, 1] - found.spans[0, 0]
    heading = float(found.bends.rows[0, HEADING])
    assert math.remainder(math.atan2(leaves[1], leaves[0]) - heading, math.tau) == pytest.approx(
        0.0, abs=1e-9
    )


@settings(max_examples=60, deadline=None)
@given(
    st.floats(-2.0, 2.0), st.sampled_from([-1.0, 1.0]),
    st.floats(-math.pi, math.pi), st.floats(-math.pi, math.pi),
)  # fmt: skip
def test_no_heading_is_left_by_more_than_a_whole_turn_to_whichever_side(
    off: float, side: float, leaves: float, comes: float
) -> None:
    bends = row(off, 0.6, side, (leaves, comes)).turning(0.5)
    for sided in with_sides(bends):
        found = turn_path_on_sides(sided)
        assert isinstance(found, TurnPath)
        assert np.abs(found.turns[[0, -1]]).max() < math.tau


def test_a_heading_may_be_left_to_both_sides() -> None:
    bends = row(0.0, 0.5, 1.0, (1.0, math.nan)).turning(0.5)
    paths = [turn_path_on_sides(sided) for sided in with_sides(bends)]
    assert len(paths) == 2
    assert {math.copysign(1.0, path.turns[0]) for path in paths if isinstance(path, TurnPath)} == {
        -1.0, 1.0,
    }  # fmt: skip


@pytest.mark.parametrize("closed", [False, True])
def test_where_it_goes_back_as_it_came_a_via_point_is_left_to_both_sides(closed: bool) -> None:
    rows = np.array([bend(0, 0), bend(9, 1), bend(0, 0)][: 2 if closed else 3])
    bends = Bends(rows, np.arange(len(rows)), np.full(len(rows), math.inf), closed).turning(0.5)
    laid = [turn_path_on_sides(sided) for sided in with_sides(bends)]
    assert len(laid) == (9 if closed else 3)
    turns = {math.copysign(1.0, one.turns[1]) for one in laid if isinstance(one, TurnPath)}
    assert turns == {-1.0, 1.0}
    lengths = [one.length for one in laid if isinstance(one, TurnPath)]
    assert min(lengths) == pytest.approx(lengths[0], rel=1e-9)


@settings(max_examples=40, deadline=None)
@given(st.floats(2.55, 3.05), st.sampled_from([-1.0, 1.0]), st.floats(0.2, 1.5))
def test_where_it_all_but_goes_back_a_via_point_may_be_left_the_longer_way_round(
    turn: float, side: float, radius: float
) -> None:
    away = np.array([9.0, 0.0]) + 9.0 * np.array([math.cos(turn), side * math.sin(turn)])
    rows = np.array([bend(0, 0), bend(9, 0), bend(*away)])
    bends = Bends.free(rows, np.arange(3)).turning(radius)
    assert [sided is bends for sided in with_sides(bends)] == [True]
    (other,) = turned_otherwise(bends, None)
    lesser, longer = (turn_path_on_sides(row) for row in (bends, other))
    assert isinstance(lesser, TurnPath)
    assert isinstance(longer, TurnPath)
    assert lesser.turns[1] * side > 0.0
    assert longer.turns[1] * side < 0.0
    assert abs(longer.turns[1]) > math.pi
    assert not list(turned_otherwise(bends, longer))  # its side is set
    is_wound = abs(lesser.turns[1]) > WOUND_RAD
    assert len(list(turned_otherwise(bends, lesser))) == is_wound
