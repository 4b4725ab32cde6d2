import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.formats.local_frame import LocalFrame

A = 6378137.0
E2 = 0.0066943799901413165


def cartesian(latitude: float, longitude: float) -> np.ndarray:
    """Earth-centred coordinates of a place on the WGS 84 ellipsoid, from its definition."""
    phi, lam = math.radians(latitude), math.radians(longitude)
    n = A / math.sqrt(1 - E2 * math.sin(phi) ** 2)
    across = n * math.cos(phi)
    return np.array([across * math.cos(lam), across * math.sin(lam), n * (1 - E2) * math.sin(phi)])


@settings(deadline=None)
@given(
    latitude=st.floats(-89, 89),
    longitude=st.floats(-180, 180),
    north=st.floats(-1, 1),
    east=st.floats(-1, 1),
)
def test_local_metres_agree_with_an_independent_formula_and_go_back(
    latitude: float, longitude: float, north: float, east: float
) -> None:
    frame = LocalFrame(latitude, longitude)
    x, y = frame.to_local(latitude + north, longitude + east)
    chord = cartesian(latitude + north, longitude + east) - cartesian(latitude, longitude)
    phi, lam = math.radians(latitude), math.radians(longitude)
    to_east = np.array([-math.sin(lam), math.cos(lam), 0])
    to_north = np.array(
        [-math.sin(phi) * math.cos(lam), -math.sin(phi) * math.sin(lam), math.cos(phi)]
    )
    np.testing.assert_allclose([x, y], [chord @ to_east, chord @ to_north], atol=1e-6)
    back = frame.to_geodetic([x, y])
    np.testing.assert_allclose(back[0], latitude + north, atol=1e-9)
    turn = (back[1] - longitude - east + 180) % 360 - 180
    np.testing.assert_allclose(turn * math.cos(phi), 0, atol=1e-8)


def test_the_antimeridian_is_no_border() -> None:
    there = LocalFrame(10, 179.999).to_local(10, -179.999)
    assert 200 < there[0] < 230
    assert abs(there[1]) < 0.01


def test_many_places_go_at_once() -> None:
    local = LocalFrame(10, 20).to_local([10, 10.1], [20, 20.1])
    assert local.shape == (2, 2)
    assert np.allclose(local[0], 0)
