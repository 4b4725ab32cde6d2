import numpy as np
import pytest
import splines
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.interpolate import BSpline

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError

KNOTS = ["uniform", "centripetal", "chordal"]
ALPHA = {"uniform": 0.0, "centripetal": 0.5, "chordal": 1.0}
RULES = ["cardinal", "continuous"]
UNEVEN = [(0, 0), (1, 0.2), (1.01, 0.25), (60, 30), (60.5, 31), (20, 50)]


def random_points(count=9, dimension=2, seed=1):
    return np.random.default_rng(seed).uniform(-10, 10, (count, dimension))


@st.composite
def vias(draw, least=2):
    """Points in 1 to 4 dimensions, no two in a row nearer than 0.01."""
    dimension = draw(st.integers(1, 4))
    count = draw(st.integers(least, 9))
    steps = draw(
        st.lists(
            st.lists(st.integers(-3000, 3000), min_size=dimension, max_size=dimension).filter(any),
            min_size=count,
            max_size=count,
        )
    )
    return np.cumsum(np.array(steps, dtype=float) * 0.01, axis=0)


families = st.fixed_dictionaries(
    {
        "tension": st.floats(-1, 0.99),
        "knots": st.sampled_from(KNOTS),
        "tangents": st.sampled_from(RULES),
        "closed": st.booleans(),
    }
)


def basis(u, s):
    """The paper's basis functions C0 to C3."""
    return np.array(
        [
            -s * u**3 + 2 * s * u**2 - s * u,
            (2 - s) * u**3 + (s - 3) * u**2 + 1,
            (s - 2) * u**3 + (3 - 2 * s) * u**2 + s * u,
            s * u**3 - s * u**2,
        ]
    )


@pytest.mark.parametrize("tension", [-1.0, -0.3, 0.0, 0.1, 1.0])
def test_uniform_knots_are_the_papers_matrix_with_repeated_end_points(tension):
    points = random_points()
    control = np.concatenate((points[:1], points, points[-1:]))
    spline = CardinalSpline(points, tension)
    for k in range(len(points) - 1):
        for w in np.linspace(0, 1, 7):
            expected = basis(w, (1 - tension) / 2) @ control[k : k + 4]
            assert spline.evaluate(min(k + w, k + 1)) == pytest.approx(expected, abs=1e-12)


def test_tension_per_span_scales_the_tangents_of_that_span_alone():
    points = random_points(5)
    tension = [0.0, 0.5, -1.0, 1.0]
    spline = CardinalSpline(points, tension)
    for k, t in enumerate(tension):
        assert np.array_equal(spline.spans[k], CardinalSpline(points, t).spans[k])
    assert spline.tension == pytest.approx(tension)
    assert spline.slack == pytest.approx((1 - np.array(tension)) / 2)


def test_slack_is_the_other_name_of_tension():
    points = random_points()
    assert np.array_equal(
        CardinalSpline(points, slack=0.35).spans, CardinalSpline(points, 0.3).spans
    )


def test_slack_zero_is_the_polyline_and_one_half_catmull_rom():
    points = random_points()
    polyline = CardinalSpline(points, slack=0.0)
    assert polyline.length == pytest.approx(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
    assert np.array_equal(CardinalSpline(points, slack=0.5).spans, CardinalSpline(points).spans)


@pytest.mark.parametrize("knots", KNOTS)
@pytest.mark.parametrize("points", [random_points(), random_points(6, 3), np.array(UNEVEN, float)])
def test_interior_spans_are_those_of_the_splines_package(knots, points):
    peer = splines.CatmullRom(points, alpha=ALPHA[knots])
    ours = CardinalSpline(points, knots=knots)
    assert ours.knots == pytest.approx(np.array(peer.grid))
    for k in range(1, len(points) - 2):
        for w in (0.0, 0.2, 0.7):
            t = peer.grid[k] + w * (peer.grid[k + 1] - peer.grid[k])
            assert ours.evaluate(k + w) == pytest.approx(peer.evaluate(t), abs=1e-9)


@pytest.mark.parametrize("knots", KNOTS)
def test_a_closed_curve_is_that_of_the_splines_package(knots):
    points = random_points(7)
    peer = splines.CatmullRom(points, alpha=ALPHA[knots], endconditions="closed")
    ours = CardinalSpline(points, knots=knots, closed=True)
    for u in np.linspace(0, 6.99, 40):
        k = int(u)
        t = peer.grid[k] + (u - k) * (peer.grid[k + 1] - peer.grid[k])
        assert ours.evaluate(u) == pytest.approx(peer.evaluate(t), abs=1e-9)


@pytest.mark.parametrize("knots", KNOTS)
def test_tension_is_that_of_kochanek_and_bartels(knots):
    points = random_points()
    peer = splines.KochanekBartels(points, tcb=(0.4, 0, 0), alpha=ALPHA[knots])
    ours = CardinalSpline(points, 0.4, knots=knots)
    for k in range(1, len(points) - 2):
        t = 0.7 * peer.grid[k] + 0.3 * peer.grid[k + 1]
        assert ours.evaluate(k + 0.3) == pytest.approx(peer.evaluate(t), abs=1e-9)


@pytest.mark.parametrize("knots", KNOTS)
@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("tension", [-0.5, 0.0, 0.7])
def test_continuous_curvature_is_the_cubic_b_spline_with_those_ends(knots, closed, tension):
    """scipy's cubic on thirds of each span, by position and two derivatives at both ends."""
    points = random_points()
    kwargs = {"knots": knots, "closed": closed, "tension": tension}
    ours = CardinalSpline(points, tangents="continuous", **kwargs)
    paper = CardinalSpline(points, **kwargs)
    through = np.concatenate((points, points[:1])) if closed else points
    h = np.diff(paper.knots)
    gain = 1.0 - tension
    for k in range(len(h)):
        velocity = [paper.evaluate(k, 1), 3 * (paper.spans[k, 3] - paper.spans[k, 2])]
        bends = []
        for i in (k, k + 1):
            if not closed and i in (0, len(points) - 1):
                bends.append(np.zeros(2))
                continue
            before, after = h[i - 1], h[i % len(h)]
            slopes = [(points[i % len(points)] - points[i - 1]) / before]
            slopes.append((through[(i + 1) % len(points)] - points[i % len(points)]) / after)
            bends.append(2 * (slopes[1] - slopes[0]) / (before + after) * (gain * h[k]) ** 2)
        knot = np.r_[np.zeros(4), 1 / 3, 2 / 3, np.ones(4)]
        rows = [BSpline(knot, np.eye(6), 3)(w, d) for w in (0, 1) for d in (0, 1, 2)]
        wanted = [through[k], velocity[0], bends[0], through[k + 1], velocity[1], bends[1]]
        peer = BSpline(knot, np.linalg.solve(rows, wanted), 3)
        w = np.linspace(0, 1, 31)
        assert np.abs(ours.evaluate(3 * (k + w)) - peer(w)).max() < 1e-9


@pytest.mark.parametrize("tension", [-0.5, 0.0, 0.5, 0.99])
def test_curvature_at_a_via_point_is_the_parabolas_at_every_tension(tension):
    points = random_points(3)
    spline = CardinalSpline(points, tension, knots="chordal", tangents="continuous")
    t = np.r_[0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
    parabola = np.polyfit(t, points, 2)
    first, second = 2 * parabola[0] * t[1] + parabola[1], 2 * parabola[0]
    expected = (first[0] * second[1] - first[1] * second[0]) / np.linalg.norm(first) ** 3
    assert spline.curvature(3.0) == pytest.approx(expected)
    assert spline.curvature(np.nextafter(3.0, 0.0)) == pytest.approx(expected)


def test_two_points_closed_with_continuous_curvature_go_there_and_back():
    spline = CardinalSpline([(0, 0), (4, 0)], closed=True, tangents="continuous")
    assert np.abs(spline.evaluate(np.linspace(0, 6, 19))[:, 1]).max() == 0.0


@settings(deadline=None)
@given(points=vias(least=3), family=families)
@example(np.array(UNEVEN), {"tension": 0.9, "knots": "chordal", "tangents": "", "closed": True})
def test_curvature_does_not_jump_with_the_continuous_rule(points, family):
    """The jump of P'' at a via points along P': so curvature is continuous, whatever the speed."""
    family = family | {"tangents": "continuous"}
    spline = CardinalSpline(points, **family)
    count = len(spline.spans)
    for k in range(0 if family["closed"] else 1, count):
        before, after = spline.spans[k - 1], spline.spans[k]
        h0, h1 = np.diff(spline.knots)[[k - 1, k]]
        if min(h0, h1) == 0.0:
            continue  # closed on a point that equals the first one
        velocity = 3 * (after[1] - after[0]) / h1
        assert velocity == pytest.approx(3 * (before[3] - before[2]) / h0, abs=1e-7)
        left = 6 * (before[3] - 2 * before[2] + before[1]) / h0**2
        right = 6 * (after[2] - 2 * after[1] + after[0]) / h1**2
        jump = right - left
        size = np.linalg.norm(velocity)
        scale = np.abs(left).max() + np.abs(right).max()
        across = np.linalg.norm(np.outer(jump, velocity) - np.outer(velocity, jump))
        assert across <= 1e-7 * scale * size + 1e-9


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("knots", KNOTS)
@pytest.mark.parametrize("tension", [-1.0, 0.0, 0.5])
def test_the_reported_jump_is_zero_for_the_continuous_rule_and_not_for_the_papers(
    closed, knots, tension
):
    points = random_points(8, 2, 5)
    kwargs = {"tension": tension, "knots": knots, "closed": closed}
    smooth = CardinalSpline(points, tangents="continuous", **kwargs)
    assert smooth.curvature_jumps().max() < 1e-9 * max(1.0, smooth.max_curvature()[0])
    assert CardinalSpline(points, **kwargs).curvature_jumps().max() > 1e-2


def test_tension_per_span_keeps_curvature_continuous_too():
    points = random_points(7, 3)
    tension = np.linspace(-1, 0.9, 6)
    spline = CardinalSpline(points, tension, tangents="continuous", knots="chordal")
    assert spline.curvature_jumps().max() < 1e-9 * spline.max_curvature()[0]


@settings(deadline=None)
@given(points=vias(), family=families)
def test_the_curve_passes_through_every_via_point_exactly(points, family):
    spline = CardinalSpline(points, **family)
    assert np.array_equal(spline.evaluate(spline.via_parameters), points)
    if family["closed"]:
        assert np.array_equal(spline.evaluate(spline.domain[1]), points[0])


@settings(deadline=None)
@given(points=vias(least=7), family=families, moved=st.integers(0, 6))
def test_moving_one_point_leaves_far_spans_bit_identical(points, family, moved):
    family = family | {"closed": False}
    other = points.copy()
    other[moved] += 0.125
    one, two = CardinalSpline(points, **family).spans, CardinalSpline(other, **family).spans
    pieces = len(one) // (len(points) - 1)
    spans = np.arange(len(one)) // pieces
    far = (spans > moved + 1) | (spans < moved - 2)
    assert np.array_equal(one[far], two[far])


@settings(deadline=None)
@given(points=vias(), family=families, angle=st.floats(-3, 3), size=st.floats(0.1, 10))
def test_turning_and_scaling_the_points_turns_and_scales_the_curve(points, family, angle, size):
    if points.shape[1] < 2:
        return
    turn = np.eye(points.shape[1])
    turn[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    moved = size * points @ turn.T + 3.0
    expected = size * CardinalSpline(points, **family).spans @ turn.T + 3.0
    assert np.abs(CardinalSpline(moved, **family).spans - expected).max() < 1e-7


@settings(deadline=None)
@given(points=vias(), family=families)
def test_points_in_reverse_give_the_same_curve_in_reverse(points, family):
    forward = CardinalSpline(points, **family)
    backward = CardinalSpline(points[::-1], **family)
    back = backward.spans[::-1, ::-1]
    if family["closed"]:
        back = np.roll(back, -len(back) // len(points), axis=0)
    assert np.abs(forward.spans - back).max() < 1e-8


@pytest.mark.parametrize("rule", RULES)
def test_a_closed_curve_has_no_seam(rule):
    points = random_points(6)
    one = CardinalSpline(points, closed=True, knots="chordal", tangents=rule)
    other = CardinalSpline(np.roll(points, -2, axis=0), closed=True, knots="chordal", tangents=rule)
    end = one.domain[1]
    assert np.abs(np.roll(one.spans, -round(end / 3), axis=0) - other.spans).max() < 1e-12
    assert one.evaluate(end + 1.25) == pytest.approx(one.evaluate(1.25))
    assert one.evaluate(-0.5) == pytest.approx(one.evaluate(end - 0.5))
    assert one.tangent(end) == pytest.approx(one.tangent(0.0))


@pytest.mark.parametrize("knots", KNOTS)
@pytest.mark.parametrize("rule", RULES)
def test_headings_point_the_ends(knots, rule):
    points = random_points()
    spline = CardinalSpline(
        points, 0.2, knots=knots, tangents=rule, start_heading=2.0, end_heading=-1.0
    )
    assert spline.heading(0.0) == pytest.approx(2.0)
    assert spline.heading(spline.domain[1]) == pytest.approx(-1.0)
    chord = np.linalg.norm(points[1] - points[0])
    pieces = spline.via_parameters[1]
    assert np.linalg.norm(spline.evaluate(0.0, 1)) * pieces == pytest.approx(0.8 * chord)
    assert np.array_equal(spline.evaluate(spline.via_parameters), points)


def test_a_heading_replaces_the_repeated_point_by_one_behind_the_start():
    points = random_points()
    away = np.linalg.norm(points[1] - points[0])
    direction = np.array([np.cos(1.0), np.sin(1.0)])
    control = np.concatenate(([points[1] - 2 * away * direction], points))
    spline = CardinalSpline(points, 0.3, start_heading=1.0)
    for w in (0.1, 0.5, 0.9):
        assert spline.evaluate(w) == pytest.approx(basis(w, 0.35) @ control[:4])


def test_headings_may_be_angles_in_the_plane_or_vectors():
    points = random_points(4, 3)
    flat = CardinalSpline(points, start_heading=0.5)
    assert flat.tangent(0.0) == pytest.approx([np.cos(0.5), np.sin(0.5), 0.0])
    climbing = CardinalSpline(points, end_heading=(0, 3, 4))
    assert climbing.tangent(3.0) == pytest.approx([0.0, 0.6, 0.8])
    assert CardinalSpline([[0], [1]], start_heading=[-1]).evaluate(0.0, 1) == pytest.approx([-1])


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("knots", ["centripetal", "chordal"])
@pytest.mark.parametrize("closed", [False, True])
def test_a_repeated_point_adds_an_empty_span_and_changes_nothing_else(rule, knots, closed):
    points = random_points(5)
    twice = points[[0, 0, 1, 2, 2, 2, 3, 4, 4]]
    once = CardinalSpline(points, 0.2, knots=knots, tangents=rule, closed=closed)
    again = CardinalSpline(twice, 0.2, knots=knots, tangents=rule, closed=closed)
    lengths = np.linalg.norm(again.spans[:, 3] - again.spans[:, 0], axis=1)
    assert np.abs(again.spans[lengths > 0] - once.spans).max() < 1e-12
    assert again.length == pytest.approx(once.length)


def test_a_repeated_point_with_uniform_knots_is_the_papers_formula():
    spline = CardinalSpline([(0, 0), (1, 0), (1, 0), (2, 1)])
    assert spline.spans[1] == pytest.approx(np.array([[1, 0], [7 / 6, 0], [5 / 6, -1 / 6], [1, 0]]))


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("knots", KNOTS)
def test_one_point_over_and_over_is_a_curve_of_no_length(rule, knots):
    spline = CardinalSpline(np.ones((4, 2)), knots=knots, tangents=rule)
    assert spline.length == 0.0
    assert np.array_equal(spline.evaluate([0.5, 3]), np.ones((2, 2)))
    assert spline.curvature(1.5) == 0.0
    assert np.array_equal(spline.tangent(1.5), [0, 0])


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("knots", KNOTS)
def test_points_a_nanometre_apart_and_a_thousand_kilometres_away_are_served(rule, knots):
    points = np.array([(0, 0), (1e-9, 0), (1e-9, 1e-9), (1e6, 1e6), (1e6, 0), (1e6 + 1e-9, 0)])
    spline = CardinalSpline(points, knots=knots, tangents=rule)
    u = np.linspace(0, 5, 501)
    assert np.array_equal(spline.evaluate(spline.via_parameters), points)
    assert np.isfinite(spline.evaluate(u)).all()
    assert np.isfinite(spline.curvature(u)).all()
    assert np.linalg.norm(spline.tangent(u), axis=1) == pytest.approx(np.ones(501))
    assert spline.distance(spline.parameter(spline.length / 3)) == pytest.approx(spline.length / 3)
    assert spline.length > 2e6


def test_collinear_points_give_a_straight_line():
    spline = CardinalSpline([(0, 0), (1, 1), (5, 5), (7, 7)], knots="chordal")
    assert spline.length == pytest.approx(7 * np.sqrt(2))
    assert spline.max_curvature()[0] == 0.0


def test_a_spline_is_a_piecewise_cubic_and_hands_out_read_only_arrays():
    spline = CardinalSpline(random_points())
    assert isinstance(spline, PiecewiseCubic)
    for array in (spline.points, spline.spans, spline.knots, spline.tension, spline.slack):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0


def test_the_callers_array_is_not_kept():
    points = random_points()
    spline = CardinalSpline(points)
    before = spline.evaluate(0.0)
    points[0] = 99.0
    assert np.array_equal(spline.evaluate(0.0), before)
    assert np.array_equal(spline.points[0], before)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"points": [(0, 0)]}, r"shape \(n, d\) with n >= 2, not \(1, 2\)"),
        ({"points": [0, 1]}, r"not \(2,\)"),
        ({"points": "abc"}, "expected numbers"),
        ({"points": [(0, 0), (1, np.nan)]}, r"point 1 is not finite"),
        ({"points": [(0, 0), (1e200, 0)]}, "not finite"),
        ({"tension": 1.5}, "at most 1"),
        ({"tension": np.nan}, "at most 1"),
        ({"slack": -0.1}, "at least 0"),
        ({"tension": 0.3, "slack": 0.3}, "give one of them"),
        ({"tension": [0.1, 0.2]}, "a number or 3 of them"),
        ({"knots": "even"}, "'uniform', 'centripetal', 'chordal'"),
        ({"tangents": "even"}, "'cardinal', 'continuous'"),
        ({"closed": True, "start_heading": 0.0}, "no end headings"),
        ({"start_heading": np.inf}, "start_heading = inf is not finite"),
        ({"end_heading": (0, 0)}, "end_heading has to be"),
        ({"end_heading": (0, 0, 1)}, "a vector of 2 numbers"),
    ],
)
def test_an_argument_that_makes_no_sense_is_named(arguments, message):
    with pytest.raises(GeometryError, match=message):
        CardinalSpline(**({"points": [(0, 0), (1, 0), (2, 1), (3, 1)]} | arguments))
