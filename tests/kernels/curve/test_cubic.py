import numpy as np
import pytest

from viaspline.kernels.curve import cubic
from viaspline.kernels.jit import kernel

SPAN = np.array([[0.0, 0.0], [1.0, 2.0], [3.0, -2.0], [4.0, 1.0]])


def bernstein(span, w):
    v = 1 - w
    return v**3 * span[0] + 3 * v * v * w * span[1] + 3 * v * w * w * span[2] + w**3 * span[3]


@kernel
def derivatives(spans, k, axis, w):
    return (
        cubic.first_derivative(spans, k, axis, w),
        cubic.second_derivative(spans, k, axis, w),
        cubic.third_derivative(spans, k, axis),
    )


@kernel
def speed_bound(spans, k):
    return cubic.speed_bound(spans, k)


def two_spans(dimension):
    spans = np.random.default_rng(0).normal(size=(2, 4, dimension))
    spans[1, 0] = spans[0, 3]
    return spans


@pytest.mark.parametrize("dimension", [1, 2, 3, 4])
def test_rows_evaluate_to_the_bernstein_polynomials(dimension):
    spans = two_spans(dimension)
    rows, fault, index = cubic.prepare(spans, False)
    assert (fault, index) == (cubic.FINE, -1)
    u = np.array([0.0, 0.25, 0.75, 1.0, 1.5, 2.0, 0.5])
    out = np.empty((7, dimension))
    assert cubic.evaluate(rows, u, False, out) == -1
    expected = [bernstein(spans[min(int(x), 1)], x - min(int(x), 1)) for x in u]
    assert out == pytest.approx(np.array(expected))


@pytest.mark.parametrize("dimension", [2, 3])
def test_the_first_parameter_outside_is_told(dimension):
    rows, _, _ = cubic.prepare(two_spans(dimension), False)
    out = np.empty((4, dimension))
    assert cubic.evaluate(rows, np.array([0.5, 2.0, 2.1, -1.0]), False, out) == 2
    assert cubic.evaluate(rows, np.array([0.5, np.nan, 2.1, -1.0]), False, out) == 1
    assert cubic.evaluate(rows, np.array([-0.5, 0.1, 0.1, 0.1]), False, out) == 0


def test_faults_are_told_with_their_span():
    spans = two_spans(2)
    spans[1, 2, 1] = np.inf
    assert cubic.prepare(spans, False)[1:] == (cubic.NOT_FINITE, 1)
    spans = two_spans(2)
    spans[1, 0, 1] += 1e-6
    assert cubic.prepare(spans, False)[1:] == (cubic.APART, 1)
    assert cubic.prepare(two_spans(2), True)[1:] == (cubic.APART, 0)


@pytest.mark.parametrize(
    ("u", "closed", "expected"),
    [(0.0, False, 0), (5.0, False, 5), (5.5, True, 0.5), (-0.5, True, 4.5), (-1e-300, True, 5)],
)
def test_parameters_wrap_into_the_domain(u, closed, expected):
    assert cubic.wrapped(u, 5, closed) == expected


@pytest.mark.parametrize(("u", "closed"), [(5.5, False), (np.nan, True), (-np.inf, True)])
def test_parameters_that_have_no_place_are_not_a_number(u, closed):
    assert np.isnan(cubic.wrapped(u, 5, closed))


def test_derivatives_are_those_of_the_polynomial():
    spans = SPAN[None]
    rows, _, _ = cubic.prepare(spans.copy(), False)
    for axis in range(2):
        c = rows[0, :, axis]
        for w in (0.0, 0.3, 1.0):
            first = c[1] + 2 * c[2] * w + 3 * c[3] * w * w
            second = 2 * c[2] + 6 * c[3] * w
            expected = (first, second, 6 * c[3])
            assert derivatives(spans, 0, axis, w) == pytest.approx(expected)


def test_no_speed_is_above_its_bound():
    spans = np.random.default_rng(1).normal(size=(20, 4, 3))
    for k in range(20):
        for w in np.linspace(0, 1, 30):
            velocity = [derivatives(spans, k, axis, w)[0] for axis in range(3)]
            assert np.linalg.norm(velocity) <= speed_bound(spans, k) * (1 + 1e-12)
    line = np.array([[[0.0], [1.0], [2.0], [3.0]]])
    assert speed_bound(line, 0) == 3.0


def test_a_part_of_a_span_is_the_same_polynomial():
    part = np.empty((4, 2))
    cubic.subspan(SPAN, 0.2, 0.7, part)
    for w in (0.0, 0.4, 1.0):
        assert bernstein(part, w) == pytest.approx(bernstein(SPAN, 0.2 + 0.5 * w))
    cubic.subspan(SPAN, 0.0, 1.0, part)
    assert np.array_equal(part, SPAN)


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_parameter_just_beyond_the_end_is_told_after_one_at_the_end(dimension):
    rows, _, _ = cubic.prepare(two_spans(dimension), False)
    u = np.array([1.8, 1.9, 2.0, 2.1])
    assert cubic.evaluate(rows, u, False, np.empty((4, dimension))) == 3
