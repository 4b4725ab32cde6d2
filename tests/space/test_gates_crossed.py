from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism
from viaspline.space.gates_crossed import crossings, side_of, straight_crossings, wrong_side
from viaspline.space.laying.corner_rounding import straight_span
from viaspline.space.routing.pass_gates import SIDE_BITS, gate

MAST = Prism(RoundedRing([[(50.0, 0.0)]], 2.0), 0.0, 20.0)


@given(seed=st.integers(0, 10_000))
def test_every_crossing_of_a_gate_is_found_and_lies_on_it(seed: int) -> None:
    rng = np.random.default_rng(seed)
    curve = CardinalSpline(rng.uniform((0, -30, 0), (100, 30, 40), (5, 3)), knots="chordal")
    row = gate(MAST, (0, 0, 5), (100, 0, 5), ["left"])[0]
    found = list(crossings(np.asarray(curve.spans), row))
    places = curve.evaluate(np.linspace(*curve.domain, 20_001))
    changes = np.flatnonzero(np.diff(places[:, 0] > 50.0))
    assert len(found) >= len(changes)
    for k in changes.tolist():
        assert min(np.linalg.norm(place - places[k]) for place in found) < 0.1
    for place in found:
        assert abs(place[0] - 50.0) < 1e-5


def test_a_curve_on_a_side_that_is_not_allowed_is_told_with_the_place() -> None:
    row = gate(MAST, (0, 0, 5), (100, 0, 5), ["left", "over"])
    ways = {
        "left": [(0, 0, 5), (50, 9, 5), (100, 0, 5)],
        "right": [(0, 0, 5), (50, -9, 5), (100, 0, 5)],
        "over": [(0, 0, 5), (50, 0, 30), (100, 0, 5)],
        "under": [(0, 0, 5), (50, 0, -3), (100, 0, 5)],
    }
    for side, points in ways.items():
        spans = np.asarray(CardinalSpline(points).spans)
        place = wrong_side(spans, row)
        assert (place is None) == (side in ("left", "over"))
        crossing = next(crossings(spans, row[0]))
        assert side_of(row[0], crossing) == SIDE_BITS[side]  # type: ignore[index]


def test_a_curve_that_does_not_reach_a_gate_passes_it_on_no_side() -> None:
    spans = np.asarray(CardinalSpline([(0, 0, 5), (20, 0, 5)]).spans)
    assert wrong_side(spans, gate(MAST, (0, 0, 5), (100, 0, 5), ["left"])) is None


@given(seed=st.integers(0, 10_000))
def test_straight_lines_cross_a_gate_where_curves_along_them_do(seed: int) -> None:
    rng = np.random.default_rng(seed)
    places = rng.uniform((0, -30, 0), (100, 30, 40), (5, 3))
    row = gate(MAST, (0, 0, 5), (100, 0, 5), ["left"])[0]
    spans = np.array([straight_span(a, b) for a, b in pairwise(places)])
    found = list(straight_crossings(places, row))
    expected = list(crossings(spans, row))
    assert len(found) == len(expected)
    if found:
        np.testing.assert_allclose(found, expected, atol=1e-6)


def test_a_line_within_the_plane_of_a_gate_does_not_cross_it() -> None:
    row = gate(MAST, (0, 0, 5), (100, 0, 5), ["left"])[0]
    assert not list(straight_crossings(np.array([[50.0, -3, 5], [50, 9, 5]]), row))
