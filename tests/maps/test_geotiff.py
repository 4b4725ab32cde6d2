import struct
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tifffile
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.errors import MissionError
from viaspline.maps.geotiff import read_geotiff
from viaspline.maps.terrain import Terrain

HEIGHTS = np.array([[1, 2, 3], [4, 5, -9999]], np.float32)
SOUTH_UP = [[4, 5, np.nan], [1, 2, 3]]


def geo_keys(**given: int) -> tuple[int, ...]:
    """A directory of keys: model is projected, and places those of pixels' corners."""
    codes = {"model": 1024, "raster": 1025, "linear": 3076, "vertical": 4099}
    values = {"model": 1, "raster": 1} | given
    rows = [(codes[name], 0, 1, value) for name, value in values.items()]
    return (1, 1, 0, len(rows), *(number for row in rows for number in row))


def written(folder: Path, heights: Any = HEIGHTS, **changes: Any) -> Path:
    """A file whose upper left corner is at 10, 24, with cells of 2 m."""
    tags = {
        33550: (12, 3, (2.0, 2.0, 0.0)),
        33922: (12, 6, (0.0, 0.0, 0.0, 10.0, 24.0, 0.0)),
        34735: (3, None, changes.pop("keys", geo_keys())),
        42113: (2, 0, changes.pop("nodata", "-9999")),
    } | changes.pop("tags", {})
    extra = [
        (code, kind, count if count is not None else len(value), value, False)
        for code, (kind, count, value) in tags.items()
        if value is not None
    ]
    file = folder / "dem.tif"
    tifffile.imwrite(file, heights, extratags=extra, metadata=None, **changes)
    return file


def test_rows_come_from_the_north_and_places_are_those_of_corners(tmp_path: Path) -> None:
    assert read_geotiff(written(tmp_path)) == Terrain(SOUTH_UP, 2.0, (11.0, 21.0))


def test_places_may_be_those_of_heights(tmp_path: Path) -> None:
    file = written(tmp_path, keys=geo_keys(raster=2))
    assert read_geotiff(file) == Terrain(SOUTH_UP, 2.0, (10.0, 22.0))


def test_a_matrix_says_the_same_as_scale_and_tie_point(tmp_path: Path) -> None:
    matrix = (2.0, 0, 0, 10.0, 0, -2.0, 0, 24.0, 0, 0, 0, 0, 0, 0, 0, 1.0)
    tags = {33550: (12, 3, None), 33922: (12, 6, None), 34264: (12, 16, matrix)}
    file = written(tmp_path, tags=tags)
    assert read_geotiff(file) == Terrain(SOUTH_UP, 2.0, (11.0, 21.0))
    turned = (2.0, 1.0, *matrix[2:])
    file = written(tmp_path, tags={**tags, 34264: (12, 16, turned)})
    with pytest.raises(MissionError, match="from west to east"):
        read_geotiff(file)


@settings(deadline=None, max_examples=40)
@given(
    seed=st.integers(0, 999),
    kind=st.sampled_from(["float32", "float64", "int16", "uint8"]),
    compression=st.sampled_from([None, "deflate"]),
    tile=st.sampled_from([None, (16, 16)]),
)
def test_what_was_written_is_read(
    seed: int, kind: str, compression: Any, tile: Any, tmp_path_factory: pytest.TempPathFactory
) -> None:
    rng = np.random.default_rng(seed)
    heights = rng.integers(0, 200, rng.integers(2, 40, 2)).astype(kind)
    folder = tmp_path_factory.mktemp("dem")
    file = written(folder, heights, nodata="7", compression=compression, tile=tile)
    south_up = np.where(heights == 7, np.nan, heights.astype(float))[::-1]
    assert read_geotiff(file) == Terrain(south_up, 2.0, (11.0, 25.0 - 2 * len(heights)))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"keys": geo_keys(model=2)}, "longitudes and latitudes; project it .* pyproj"),
        ({"keys": geo_keys(model=3)}, "about earth's middle"),
        ({"keys": geo_keys(linear=9003)}, "its coordinates are in unit 9003 of EPSG"),
        ({"keys": geo_keys(vertical=9002)}, "its heights are in unit 9002 of EPSG"),
        ({"tags": {33550: (12, 3, None)}}, "doesn't say where it lies"),
        ({"tags": {33550: (12, 3, (2.0, 3.0, 0.0))}}, "2 x 3 m, which isn't square"),
        ({"tags": {33550: (12, 3, (0.0, 0.0, 0.0))}}, "makes no plane"),
        ({"tags": {33550: (12, 3, (2.0, np.nan, 0.0))}}, "makes no plane"),
        ({"nodata": "none"}, 'its nodata value is "none"'),
        ({"heights": np.full((2, 2), -3.4e38, np.float32)}, r"a height is -3.4e\+38 m"),
        ({"heights": np.full((2, 2), np.inf, np.float32)}, "a height is infinite"),
        ({"heights": np.zeros((1, 2), np.float32)}, "2 x 1 heights; give at least 2 x 2"),
        ({"heights": np.zeros((2, 2, 3), np.uint8), "photometric": "rgb"}, "has shape"),
        ({"heights": np.zeros((2, 2), np.complex64)}, "its pixels are complex64"),
    ],
)
def test_what_is_no_terrain_in_metres_is_refused(
    changes: dict[str, Any], words: str, tmp_path: Path
) -> None:
    with pytest.raises(MissionError, match=words):
        read_geotiff(written(tmp_path, **changes))


def spoiled(file: Path, tag: int, value: int) -> Path:
    """The file with another value of a tag that is one number."""
    data = bytearray(file.read_bytes())
    places = (data.find(struct.pack("<HHI", tag, kind, 1)) for kind in (3, 4))
    at = next(place for place in places if place >= 0)
    data[at + 8 : at + 10] = struct.pack("<H", value)
    file.write_bytes(data)
    return file


@pytest.mark.skipif(find_spec("imagecodecs") is not None, reason="with it LZW is read")
def test_a_compression_that_needs_another_package_names_it(tmp_path: Path) -> None:
    file = spoiled(written(tmp_path), 259, 5)
    with pytest.raises(MissionError, match=r"compressed with LZW, .* pip install imagecodecs"):
        read_geotiff(file)


def of_no_type(file: Path, code: int) -> Path:
    """The file with a tag whose type there isn't."""
    data = bytearray(file.read_bytes())
    with tifffile.TiffFile(file) as tiff:
        at = tiff.pages[0].tags[code].offset
    data[at + 2 : at + 4] = struct.pack("<H", 99)
    file.write_bytes(data)
    return file


def test_a_terrain_of_too_many_heights_is_refused_before_they_are_read(tmp_path: Path) -> None:
    file = spoiled(spoiled(written(tmp_path), 256, 10_000), 257, 10_000)
    with pytest.raises(MissionError, match="10000 x 10000 heights; cut it"):
        read_geotiff(file)


def test_other_and_broken_files_are_refused(tmp_path: Path) -> None:
    file = tmp_path / "dem.tif"
    file.write_bytes(b"II*\x00 no more")
    with pytest.raises(MissionError, match="isn't a GeoTIFF, or is a broken one"):
        read_geotiff(file)
    short = written(tmp_path)
    short.write_bytes(short.read_bytes()[:-8])
    with pytest.raises(MissionError, match=r"dem.tif: is broken|shape"):
        read_geotiff(short)


def test_nothing_but_our_own_words_is_on_the_terminal(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, capfd: pytest.CaptureFixture[str]
) -> None:
    """tifffile logs what it stumbles on, and reads on without the tag."""
    for code in (257, 339, 33550, 42113):
        with pytest.raises(MissionError, match=rf"a broken one: .*{code}"):
            read_geotiff(of_no_type(written(tmp_path), code))
    assert read_geotiff(of_no_type(written(tmp_path), 305)).heights.shape == (2, 3)  # its software
    assert caplog.text == ""
    assert capfd.readouterr() == ("", "")


@settings(max_examples=60)
@given(seed=st.integers(0, 10_000))
@example(seed=1)
def test_a_file_with_any_byte_changed_is_read_or_refused(
    seed: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    rng = np.random.default_rng(seed)
    file = written(tmp_path_factory.mktemp("bytes"))
    data = bytearray(file.read_bytes())
    for _ in range(int(rng.integers(1, 6))):
        data[int(rng.integers(min(len(data), 400)))] = int(rng.integers(256))
    file.write_bytes(data)
    try:
        terrain = read_geotiff(file)
    except MissionError:
        return
    assert np.isfinite(terrain.heights).any()


def test_without_its_package_the_remedy_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = written(tmp_path)
    monkeypatch.setitem(__import__("sys").modules, "tifffile", None)
    with pytest.raises(MissionError, match=r"pip install 'viaspline\[terrain\]'"):
        read_geotiff(file)
