import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.formats.local_frame import LocalFrame
from viaspline.studio.background.background import Background
from viaspline.studio.background.picture_place import PicturePlace
from viaspline.studio.background.placed_picture import PlacedPicture, placed_picture
from viaspline.studio.refused_error import RefusedError

SIZE = (400, 200)


def at(placed: PlacedPicture, u: float, v: float) -> list[float]:
    a, b, c, d, e, f = placed.sheet
    return [a + b * u + c * v, d + e * u + f * v]


def test_corners_in_metres_are_bottom_left_and_top_right() -> None:
    placed = placed_picture(Background("x.png", corners=((10, 20), (110, 70))), None, SIZE, None)
    assert np.allclose([at(placed, 0, 1), at(placed, 1, 0)], [[10, 20], [110, 70]])
    assert placed.off_by < 1e-9


def test_a_turned_world_file_turns_the_picture() -> None:
    said = PicturePlace((5.0, 0.3, 0.4, 7.0, 0.4, -0.3), None, "x.pgw")
    placed = placed_picture(Background("x.png"), said, SIZE, None)
    assert np.allclose(at(placed, 1, 0), [5 + 0.3 * 400, 7 + 0.4 * 400])
    assert np.allclose(at(placed, 0, 1), [5 + 0.4 * 200, 7 - 0.3 * 200])


@settings(max_examples=25)
@given(latitude=st.floats(-70, 70), longitude=st.floats(-179, 179), size=st.floats(1e-4, 0.02))
def test_corners_in_degrees_lie_where_the_exports_put_them(
    latitude: float, longitude: float, size: float
) -> None:
    low, high = (latitude, longitude), (latitude + size, longitude + size)
    asked = Background("x.png", grid="degrees", corners=(low, high))
    frame = LocalFrame(latitude + 0.01, longitude - 0.01)
    placed = placed_picture(asked, None, SIZE, (frame.latitude, frame.longitude))
    far = 0.0
    for (u, v), place in (((0, 1), low), ((1, 0), high), ((0, 0), (high[0], low[1]))):
        far = max(far, float(np.hypot(*(at(placed, u, v) - frame.to_local(*place)))))
    assert far <= placed.off_by + 1e-6
    assert placed.off_by < 2e-3 * size * 111e3  # a sheet of 2 km is off by metres at most


def test_a_projected_picture_lies_by_its_own_grid_whatever_is_asked() -> None:
    said = PicturePlace((465000.0, 1.0, 0.0, 5247000.0, 0.0, -1.0), "EPSG:32632", "x.tif")
    origin = 47.375521283, 8.536369798  # of the first pixel, by PROJ
    placed = placed_picture(Background("x.tif"), said, SIZE, origin)
    assert np.hypot(*at(placed, 0, 0)) < 0.01
    assert np.hypot(*at(placed, 1, 0)) == pytest.approx(400, rel=1e-3)


@pytest.mark.parametrize(
    ("asked", "origin", "why"),
    [
        (Background("x.png"), None, "give its corners"),
        (Background("x.png", grid="degrees", corners=((47, 8), (48, 9))), None, "no origin"),
        (Background("x.png", corners=((0, 0), (1e9, 5))), None, "Say which grid"),
        (Background("x.png", corners=((0, 0), (1e-5, 1e-5))), None, "millimetre"),
        (Background("x.png", grid="degrees", corners=((47, 8), (48, 9))), (10.0, 8.0), "km from"),
        (
            Background("x.png", grid="degrees", corners=((8, 47), (1e3, 1e3))),
            (10.0, 8.0),
            "degrees",
        ),
    ],
)
def test_what_lies_nowhere_is_refused_with_the_remedy(
    asked: Background, origin: tuple[float, float] | None, why: str
) -> None:
    with pytest.raises(RefusedError, match=why):
        placed_picture(asked, None, SIZE, origin)
