import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.formats.local_frame import LocalFrame
from viaspline.studio.background.earth_grids import check_grid, geodetic
from viaspline.studio.refused_error import RefusedError

BY_PROJ = [  # grid, x, y, and what PROJ makes of them
    ("EPSG:32632", 465000.0, 5247000.0, 47.375521283, 8.536369798),
    ("EPSG:32632", 180000.0, 5900000.0, 53.153014202, 4.213236198),
    ("EPSG:32617", 630084.0, 4833438.0, 43.642561781, -79.387142870),
    ("EPSG:32733", 261878.0, 6243186.0, -33.924866341, 12.424062096),
    ("EPSG:25832", 691608.0, 5334739.0, 48.137029725, 11.575548252),
    ("EPSG:26910", 491900.0, 5456000.0, 49.256713483, -123.111315913),
    ("EPSG:3857", 951000.0, 5975000.0, 47.201339816, 8.542978352),
]


@pytest.mark.parametrize(("grid", "x", "y", "latitude", "longitude"), BY_PROJ)
def test_places_are_where_proj_has_them_to_a_millimetre(
    grid: str, x: float, y: float, latitude: float, longitude: float
) -> None:
    found = geodetic(grid, (x, y))
    assert np.hypot(*LocalFrame(latitude, longitude).to_local(*found)) < 1e-3


@settings(max_examples=40)
@given(east=st.floats(200e3, 800e3), north=st.floats(1000.0, 9e6), turn=st.floats(0.0, 6.28))
def test_utm_keeps_angles_and_its_scale_near_the_middle(
    east: float, north: float, turn: float
) -> None:
    """It is conformal, and its scale is 0.9996 (1 + e² / 2R²) to a few parts in a million."""
    here = geodetic("EPSG:32633", (east, north))
    step = 10.0 * np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    a, b = LocalFrame(float(here[0]), float(here[1])).to_local(
        *geodetic("EPSG:32633", np.array([east, north]) + step)
    )
    assert abs(a @ b) < 1e-3  # of 100 square metres
    scale = 0.9996 * (1 + ((east - 500e3) / 0.9996) ** 2 / 2 / 6.37e6**2)
    assert 10.0 / np.hypot(*a) == pytest.approx(scale, rel=2e-5)


@pytest.mark.parametrize("grid", ["EPSG:2056", "EPSG:32661", "EPSG:32700", "feet", "EPSG:", ""])
def test_a_grid_that_is_not_known_is_refused_with_the_remedy(grid: str) -> None:
    with pytest.raises(RefusedError, match="gdalwarp"):
        check_grid(grid)
