from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
import pytest

from viaspline.studio.background.picture_place import matrix_of, place_of
from viaspline.studio.folder import Folder
from viaspline.studio.refused_error import RefusedError

DOUBLES, SHORTS = 12, 3


def tiff(path: Path, *tags: tuple[int, int, tuple[float, ...]]) -> Path:
    """A TIFF of somebody else's making."""
    tifffile = pytest.importorskip("tifffile")
    extra = [(code, kind, len(values), values, True) for code, kind, values in tags]
    tifffile.imwrite(path, np.zeros((20, 40, 3), np.uint8), extratags=extra, photometric="rgb")
    return path


def place(path: Path) -> Any:
    with PIL.Image.open(path) as image:
        return place_of(path, image, Folder(path.parent))


def keys(*numbers: tuple[int, int]) -> tuple[int, int, tuple[int, ...]]:
    rows = [value for key, number in numbers for value in (key, 0, 1, number)]
    return 34735, SHORTS, (1, 1, 0, len(numbers), *rows)


def test_a_geotiff_says_where_it_lies_by_a_scale_and_a_tie_point(tmp_path: Path) -> None:
    scale, tie = (0.5, 0.25, 0.0), (10.0, 4.0, 0.0, 465000.0, 5247000.0, 0.0)
    found = place(
        tiff(
            tmp_path / "a.tif", (33550, DOUBLES, scale), (33922, DOUBLES, tie),
            keys((1024, 1), (1025, 1), (3072, 32632)),
        )
    )  # fmt: skip
    assert found.matrix == (464995.0, 0.5, 0.0, 5247001.0, 0.0, -0.25)
    assert (found.grid, found.source) == ("EPSG:32632", "a.tif")


def test_a_geotiff_may_be_turned_and_count_from_the_middle_of_a_pixel(tmp_path: Path) -> None:
    whole = (2.0, 1.0, 0.0, 100.0, 1.0, -2.0, 0.0, 50.0, *[0.0] * 7, 1.0)
    found = place(tiff(tmp_path / "a.tif", (34264, DOUBLES, whole), keys((1025, 2))))
    assert found.matrix == (98.5, 2.0, 1.0, 50.5, 1.0, -2.0)
    assert found.grid is None


def test_degrees_of_a_geotiff_are_known_by_its_model(tmp_path: Path) -> None:
    scale, tie = (1e-5, 1e-5, 0.0), (0.0, 0.0, 0.0, 8.5, 47.4, 0.0)
    tags = (33550, DOUBLES, scale), (33922, DOUBLES, tie)
    found = place(tiff(tmp_path / "a.tif", *tags, keys((1024, 2), (2048, 4326))))
    assert found.grid == "degrees"
    assert place(tiff(tmp_path / "plain.tif")) is None


@pytest.mark.parametrize("name", ["site.pgw", "site.pngw", "site.wld", "site.PGW", "site.png.wld"])
def test_a_world_file_counts_from_the_middle_of_its_first_pixel(tmp_path: Path, name: str) -> None:
    PIL.Image.new("RGB", (4, 2)).save(tmp_path / "site.png")
    (tmp_path / name).write_text("0,5\n0\n0\n-0.5\n10.25\n19.75\n")
    found = place(tmp_path / "site.png")
    assert found.matrix == (10.0, 0.5, 0.0, 20.0, 0.0, -0.5)
    assert found.source.lower() == name.lower()


@pytest.mark.parametrize(
    "text", ["", "1 2 3 4 5", "1 0 0 -1 0 x", "nan 0 0 1 0 0", "0 0 0 0 5 5", "1 1 1 1 0 0"]
)
def test_a_world_file_that_is_none_is_refused_by_its_name(text: str) -> None:
    with pytest.raises(RefusedError, match=r"^site\.pgw: "):
        matrix_of(text, "site.pgw")


def test_a_world_file_is_not_read_through_a_link_out_of_the_folder(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "secret").write_text("1\n0\n0\n-1\n0\n0\n")
    inner = tmp_path / "missions"
    inner.mkdir()
    PIL.Image.new("RGB", (4, 2)).save(inner / "site.png")
    (inner / "site.pgw").symlink_to(tmp_path / "out" / "secret")
    with pytest.raises(RefusedError, match="outside"):
        place(inner / "site.png")
