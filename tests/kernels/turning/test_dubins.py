import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.kernels.jit import kernel
from viaspline.kernels.turning import dubins

RHO = 2.0
angles = st.floats(-math.pi, math.pi)
places = st.floats(-12, 12)


@kernel
def dubins_length(dx, dy, start, goal, rho):
    return dubins.dubins_length(dx, dy, start, goal, rho)


@kernel
def length_to_place(dx, dy, heading, rho):
    return dubins.length_to_place(dx, dy, heading, rho)


def driven(pose, words, lengths):
    """Where turns and lines of some lengths lead, complex numbers for the plane."""
    z, heading = complex(pose[0], pose[1]), pose[2]
    for word, length in zip(words, lengths, strict=True):
        if word == 0:
            z += length * np.exp(1j * heading)
        else:
            turned = heading + word * length / RHO
            z += RHO * word * -1j * (np.exp(1j * turned) - np.exp(1j * heading))
            heading = turned
    return z, heading


@settings(max_examples=200, deadline=None)
@given(
    st.sampled_from([(1, 0, 1), (-1, 0, 1), (1, 0, -1), (-1, 0, -1), (1, -1, 1), (-1, 1, -1)]),
    st.tuples(angles, st.floats(0, 6), st.floats(0, 12), st.floats(0, 6)),
)
@example((1, 0, 1), (0.5, 1e-8, 0.0, 0.0))  # ends on its circle, as far as can be told
def test_no_way_of_its_words_is_shorter(words, way):
    start, *parts = way
    lengths = [part * (RHO if word else 1.0) for word, part in zip(words, parts, strict=True)]
    end, heading = driven((0, 0, start), words, lengths)
    least = dubins_length(end.real, end.imag, start, heading, RHO)
    assert least <= sum(lengths) + 1e-6
    assert length_to_place(end.real, end.imag, start, RHO) <= least + 1e-6


@settings(max_examples=60, deadline=None)
@given(places, places, angles, angles)
def test_it_is_the_same_driven_backwards_or_in_a_mirror(x, y, start, goal):
    length = dubins_length(x, y, start, goal, RHO)
    assert dubins_length(-x, -y, goal + math.pi, start + math.pi, RHO) == pytest.approx(length)
    assert dubins_length(x, -y, -start, -goal, RHO) == pytest.approx(length)
    assert length >= math.hypot(x, y) - 1e-9


@pytest.mark.long_without_jit
def test_the_best_heading_at_a_place_gives_the_length_to_it():
    headings = np.linspace(-math.pi, math.pi, 20001)
    for x, y in [(8, 1), (1, 1), (0.5, 0.2), (-3, 0.1), (0, 4), (0.1, -1.5), (2, 2), (-1, -5)]:
        lengths = [dubins_length(x, y, 0.0, h, RHO) for h in headings]
        assert length_to_place(x, y, 0.0, RHO) == pytest.approx(min(lengths), abs=2e-2)
