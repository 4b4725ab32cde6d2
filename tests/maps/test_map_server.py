import math
import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image

from viaspline.errors import MissionError
from viaspline.maps.grid import Grid
from viaspline.maps.map_server import read_map_server

Write: TypeAlias = Callable[..., Path]


def faults_of(path: Path) -> list[str]:
    with pytest.raises(MissionError) as caught:
        read_map_server(path)
    return [str(fault).replace(str(path.parent) + "/", "") for fault in caught.value.faults]


def nav2(pixel: tuple[int, ...], mode: str, negate: bool, occupied: float, free: float) -> int:
    """The occupancy of an 8-bit pixel, from 0 to 100 or -1, pixel by pixel as Nav2 has it."""
    colours, alpha = (pixel, 255) if len(pixel) in (1, 3) else (pixel[:-1], pixel[-1])
    if len(colours) == 1:
        colours = colours * 3
    channels = [*colours, alpha] if mode == "trinary" and len(pixel) in (2, 4) else [*colours]
    mean = sum(channels) / len(channels)
    if mode == "raw":
        return math.floor(mean + 0.5) if mean < 100.5 else -1
    p = mean / 255 if negate else (255 - mean) / 255
    if mode == "scale" and alpha < 255:
        return -1
    if p > occupied:
        return 100
    if p < free:
        return 0
    return -1 if mode == "trinary" else min(round((p - free) / (occupied - free) * 100), 99)


def test_black_is_blocked_white_free_and_the_top_row_of_the_picture_is_the_highest(
    described: Write, tmp_path: Path
) -> None:
    (tmp_path / "a.pgm").write_bytes(b"P5\n3 2\n255\n" + bytes([0, 255, 255, 255, 255, 150]))
    grid = read_map_server(described(origin=[1, 2, 0]))
    assert grid.blocked.tolist() == [[False, False, True], [True, False, False]]
    assert grid.unknown is not None
    assert grid.unknown.tolist() == [[False, False, True], [False, False, False]]
    assert grid.center(row=1, column=0) == (1.25, 2.75)
    assert (grid.resolution, grid.origin) == (0.5, (1.0, 2.0, 0.0))


def test_what_is_unknown_may_be_taken_as_free(described: Write, tmp_path: Path) -> None:
    (tmp_path / "a.pgm").write_bytes(b"P5 2 1 255\n" + bytes([0, 150]))
    grid = read_map_server(described(), unknown="free")
    assert grid.blocked.tolist() == [[True, False]]
    assert grid.unknown is None


def test_the_yaw_of_the_origin_turns_the_map_about_its_corner(
    described: Write, tmp_path: Path
) -> None:
    (tmp_path / "a.pgm").write_bytes(b"P5 4 2 255\n" + bytes(8))
    grid = read_map_server(described(origin=[10, 0, math.pi / 2]))
    assert np.allclose(grid.corners, [(10, 0), (10, 2), (9, 2), (9, 0)])


def test_the_real_depot_has_its_size_and_walls_all_round(data: Path) -> None:
    grid = read_map_server(data / "depot.yaml")
    pixels = np.asarray(Image.open(data / "depot.pgm"))[::-1]
    assert (grid.width, grid.height) == (604, 307)
    assert np.allclose(grid.extent, (0, 0, 30.2, 15.35))
    assert np.array_equal(grid.blocked, pixels < 0.75 * 255)
    assert read_map_server(data / "depot_keepout.yaml").blocked.shape == (307, 604)


@settings(
    deadline=None, max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data())
def test_every_kind_of_picture_means_what_nav2_makes_of_it(
    data: st.DataObject, described: Write, tmp_path: Path
) -> None:
    mode = data.draw(st.sampled_from(["trinary", "scale", "raw"]))
    colours, kind = data.draw(st.sampled_from([(1, "L"), (2, "LA"), (3, "RGB"), (4, "RGBA")]))
    ending = data.draw(st.sampled_from(["png", "bmp", "pgm"] if kind == "L" else ["png"]))
    negate = data.draw(st.booleans())
    occupied, free = data.draw(st.sampled_from([(0.65, 0.196), (0.65, 0.25), (0.9, 0.1)]))
    values = st.integers(0, 255) | st.sampled_from([0, 100, 101, 205, 254, 255])
    size = data.draw(st.integers(1, 5)), data.draw(st.integers(1, 5))
    count = size[0] * size[1] * colours
    pixels = np.array(data.draw(st.lists(values, min_size=count, max_size=count)), np.uint8)
    shape = size if colours == 1 else (*size, colours)
    Image.fromarray(pixels.reshape(shape)).save(tmp_path / f"a.{ending}")
    spec = described(
        image=f"a.{ending}", mode=mode, negate=str(negate).lower(),
        occupied_thresh=occupied, free_thresh=free,
    )  # fmt: skip
    flat = pixels.reshape(-1, colours).tolist()
    expected = np.array([nav2(tuple(p), mode, negate, occupied, free) for p in flat])
    expected = expected.reshape(size)[::-1]
    grid = read_map_server(spec)
    least = 100 * occupied if mode == "raw" else 100
    unknown = np.zeros(size, bool) if grid.unknown is None else grid.unknown
    assert np.array_equal(unknown, expected == -1)
    assert np.array_equal(grid.blocked & ~unknown, expected >= least)
    free_too = read_map_server(spec, unknown="free")
    assert np.array_equal(free_too.blocked, grid.blocked & ~unknown)
    assert free_too.unknown is None


def test_graded_squares_are_passable_and_transparent_ones_unknown(
    described: Write, tmp_path: Path
) -> None:
    pixels = np.array([[[0, 255], [128, 255], [255, 255], [0, 254]]], np.uint8)
    Image.fromarray(pixels).save(tmp_path / "a.png")
    grid = read_map_server(described(image="a.png", mode="scale"))
    assert grid.blocked.tolist() == [[True, False, False, True]]
    assert grid.unknown is not None
    assert grid.unknown.tolist() == [[False, False, False, True]]


def test_palettes_bits_and_sixteen_bits_are_read(described: Write, tmp_path: Path) -> None:
    grey = np.array([[0, 255, 0], [255, 255, 255]], np.uint8)
    expected = (grey == 0)[::-1]
    plain = Image.fromarray(grey)
    deep = Image.fromarray(grey.astype(np.uint16) * 257)
    pictures = {
        "bits": plain.convert("1"), "palette": plain.convert("P"), "deep": deep,
        "quantized": plain.convert("RGB").quantize(2),
    }  # fmt: skip
    for name, picture in pictures.items():
        picture.save(tmp_path / f"{name}.png")
        assert read_map_server(described(image=f"{name}.png")).blocked.tolist() == expected.tolist()


def test_a_palette_with_a_transparent_colour_has_opacity(described: Write, tmp_path: Path) -> None:
    picture = Image.fromarray(np.array([[0, 1]], np.uint8), mode="P")
    picture.putpalette([255, 255, 255, 255, 255, 255])
    picture.save(tmp_path / "a.png", transparency=1)
    grid = read_map_server(described(image="a.png", mode="scale"))
    assert grid.unknown is not None
    assert grid.unknown.tolist() == [[False, True]]


@pytest.mark.parametrize(
    ("keys", "faults"),
    [
        ({"resolution": None}, [":1:1: resolution: is missing; give resolution: a number of"]),
        ({"resolution": 0}, [":2:13: resolution: found 0; it should be a number of metres gre"]),
        ({"resolution": -0.05}, [":2:13: resolution: found -0.05;"]),
        ({"resolution": ".nan"}, [":2:13: resolution: found"]),
        ({"resolution": "[1]"}, [":2:13: resolution: found a list of 1;"]),
        ({"origin": "[1, 2]"}, [":3:9: origin: found a list of 2; it should be [x, y, yaw]"]),
        ({"origin": "[1, 2, east]"}, [":3:9: origin: found a list of 3;"]),
        ({"origin": "[1, 2e9, 0]"}, [":3:9: origin:"]),
        ({"origin": "here"}, [':3:9: origin: found "here";']),
        ({"negate": 7}, [":4:9: negate: found 7; it should be 0 or 1"]),
        ({"occupied_thresh": 65}, [":5:18: occupied_thresh: found 65; it should be a number fr"]),
        ({"free_thresh": -0.1}, [":6:14: free_thresh: found -0.1; it should be a number from"]),
        ({"free_thresh": 0.65}, [":5:18: occupied_thresh: found 0.65; it should be greater tha"]),
        ({"mode": "triple"}, [':7:7: mode: found "triple"; it should be trinary, scale or raw']),
        ({"image": None}, [":1:1: image: is missing; give image: the path of a PGM or PNG"]),
        ({"image": "none.pgm"}, [":1:8: image: none.pgm: there is no such file; give the path"]),
        ({"image": "."}, [":1:8: image: "]),
        (
            {"image": None, "resolution": "x", "mode": 1},
            [":1:1: image: is miss", ':1:13: resolution: found "x"', ":6:7: mode: found 1;"],
        ),
    ],
)
def test_each_mistake_in_the_yaml_has_its_line_and_its_remedy(
    keys: dict[str, Any], faults: list[str], described: Write
) -> None:
    found = faults_of(described(**keys))
    assert len(found) == len(faults)
    for fault, expected in zip(found, faults, strict=True):
        assert fault.startswith("map.yaml" + expected)
        assert "; " in fault


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", "map.yaml:1:1: the file is empty; it should be a mapping with the keys image,"),
        ("- 1\n", "map.yaml:1:1: the file isn't a mapping;"),
        ("image: [\n", "map.yaml:2:1: is not YAML:"),
        ("image: a: b\n", "map.yaml:1:9: is not YAML:"),
        ("image: \x01\n", "map.yaml:1:1: is not YAML:"),
    ],
)
def test_what_is_no_yaml_mapping_is_said(tmp_path: Path, text: str, fault: str) -> None:
    (tmp_path / "map.yaml").write_text(text)
    (found,) = faults_of(tmp_path / "map.yaml")
    assert found.startswith(fault)


def test_a_missing_map_a_folder_and_bytes_that_are_no_text_are_named(tmp_path: Path) -> None:
    assert faults_of(tmp_path / "no.yaml")[0].startswith("no.yaml: there is no such file; give")
    assert faults_of(tmp_path)[0].endswith(": is a folder; give the path of a map that can be read")
    (tmp_path / "bad.yaml").write_bytes(b"image: a\nresolution: \xff\n")
    assert faults_of(tmp_path / "bad.yaml")[0].startswith("bad.yaml:2:13: the byte 0xFF is not")


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a.png", b"no picture at all", "is not a picture of a kind that is understood; give a"),
        ("a.png", b"", "is not a picture"),
        ("a.pgm", b"P6 1 1 255 \x00\x00\x00", "is not a picture"),
        ("a.pgm", b"P5 3 2 255\n12345", "ends after 5 of the 6 pixels of 3 x 2 that its header sa"),
        ("a.pgm", b"P5 3 2 65535\n12345", "ends after 2 of the 6 pixels"),
        ("a.pgm", b"P5 3 2 255\n1234567", "has more than the 6 pixels of 3 x 2 that its header"),
        ("a.pgm", b"P5 0 2 255\n", "the map has 0 x 2 cells"),
        ("a.pgm", b"P5 40000 2 255\n", "cut it: at most 32000 aside are read"),
        ("a.pgm", b"P5 999999999999 2 255\n", "the header of the greymap is broken"),
        ("a.pgm", b"P5 3 2\n", "the header of the greymap is broken; it should be P5, width"),
        ("a.pgm", b"P5 1 1 0\n1", "the header's maximum is 0; it should be between 1 and 65535"),
        ("a.pgm", b"P5 1 1 70000\n12", "the header's maximum is 70000"),
        ("a.pgm", b"P5 1 1 9\n1", "a pixel has the value 49, more than the header's maximum 9"),
        ("a.pgm", b"P2 2 1 255\n1", "ends after 1 of the 2 pixels"),
        ("a.pgm", b"P2 2 1 255\n1 2 3", "has more than the 2 pixels"),
        ("a.pgm", b"P2 2 1 255\n1 x", "a pixel is not a number"),
        ("a.pgm", b"P2 2 1 255\n1 -2", "a pixel is not between 0 and 65535"),
    ],
)
def test_a_broken_picture_is_a_fault_of_the_key_that_names_it(
    name: str, content: bytes, words: str, described: Write, tmp_path: Path
) -> None:
    (tmp_path / name).write_bytes(content)
    (fault,) = faults_of(described(image=name))
    assert fault.startswith(f"map.yaml:1:8: image: {name}: ")
    assert words in fault


def test_a_truncated_png_and_a_kind_of_pixels_without_meaning_are_said(
    described: Write, tmp_path: Path
) -> None:
    noise = np.random.default_rng(1).integers(0, 256, (99, 99), np.uint8)
    Image.fromarray(noise).save(tmp_path / "a.png")
    whole = (tmp_path / "a.png").read_bytes()
    (tmp_path / "a.png").write_bytes(whole[: len(whole) // 2])
    (fault,) = faults_of(described(image="a.png"))
    assert fault.startswith("map.yaml:1:8: image: a.png: the picture is broken: ")
    deep = Image.fromarray(noise.astype(np.uint16) * 257)
    deep.save(tmp_path / "b.png", transparency=0)
    (fault,) = faults_of(described(image="b.png"))
    assert "has pixels of an unknown kind, 'I;16'; save it with grey or RGB colours" in fault


greys = st.tuples(st.integers(1, 7), st.integers(1, 7), st.integers(1, 65535)).flatmap(
    lambda shape: st.tuples(
        st.lists(
            st.lists(st.integers(0, shape[2]), min_size=shape[0], max_size=shape[0]),
            min_size=shape[1],
            max_size=shape[1],
        ),
        st.just(shape[2]),
        st.sampled_from(["# a comment\n", "#\n#\n", "", "\n\t ", "# P5 9 9 9\r\n"]),
    )
)


def written(pixels: NDArray[np.uint16], white: int, comment: str, plain: bool) -> bytes:
    height, width = pixels.shape
    head = f"P{2 if plain else 5}\n{comment}{width} {comment}{height}\n{comment}{white}\n"
    if plain:
        return (head + "\n".join(" ".join(map(str, row)) for row in pixels.tolist())).encode()
    return head.encode() + pixels.astype(np.uint8 if white < 256 else ">u2").tobytes()


@settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(grey=greys, plain=st.booleans())
def test_a_greymap_that_is_written_reads_back(
    grey: tuple[list[list[int]], int, str], plain: bool, described: Write, tmp_path: Path
) -> None:
    rows, white, comment = grey
    pixels = np.array(rows, np.uint16)
    (tmp_path / "a.pgm").write_bytes(written(pixels, white, comment, plain))
    grid = read_map_server(described(), unknown="free")
    expected = (white - pixels.astype(float)) / white > 0.65
    assert np.array_equal(grid.blocked, expected[::-1])


def test_a_picture_in_many_bands_is_put_together(
    described: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    noise = np.random.default_rng(2).integers(0, 256, (31, 8, 4), np.uint8)
    Image.fromarray(noise).save(tmp_path / "a.png")
    whole = read_map_server(described(image="a.png"))
    monkeypatch.setattr("viaspline.maps.picture.BAND_PIXELS", 50)
    banded = read_map_server(described(image="a.png"))
    assert banded == whole
    assert banded.unknown is not None
    assert whole.unknown is not None
    assert np.array_equal(banded.unknown, whole.unknown)


def test_a_grid_remembers_how_it_was_read(described: Write, tmp_path: Path) -> None:
    (tmp_path / "a.pgm").write_bytes(b"P5 1 1 255\n1")
    file = described()
    grid = read_map_server(file, unknown="free", source="maps/map.yaml")
    assert isinstance(grid, Grid)
    assert grid.source == "maps/map.yaml"
    assert grid.reading is not None
    assert (grid.reading.path, grid.reading.unknown) == (file, "free")


def test_a_large_map_is_read_in_little_more_memory_than_its_squares_and_its_picture_take(
    described: Write, tmp_path: Path
) -> None:
    size = 3000
    pixels = np.random.default_rng(3).integers(0, 256, size * size, np.uint8)
    (tmp_path / "a.pgm").write_bytes(b"P5 %d %d 255\n" % (size, size) + pixels.tobytes())
    del pixels
    spec = described()
    tracemalloc.start()
    try:
        grid = read_map_server(spec)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    # Two bytes a square that stay, one that the picture has; the rest is two bands of it.
    assert grid.blocked.size == size * size
    assert peak < 3.3 * size * size + 15e6
