"""Whatever a path leads to, reading it ends soon, with what it holds or with a message."""

import os
import socket
from pathlib import Path

import pytest

from viaspline.bounded_file import MAP_FILE, FileKind, read_bytes, read_text
from viaspline.errors import MissionError
from viaspline.formats.load import load
from viaspline.mission.load_map import load_map
from viaspline.mission.track_file import read_track

SMALL = FileKind("note", 10, "say less")

needs_posix = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="has pipes by name")


def refused(path: Path | str, kind: FileKind = SMALL) -> str:
    with pytest.raises(MissionError) as caught:
        read_bytes(path, kind)
    [fault] = caught.value.faults
    assert fault.source == str(path)
    return f"{fault.problem}; {fault.remedy}"


@pytest.mark.parametrize("content", [b"", b"a", b"0123456789"])
def test_a_file_up_to_the_limit_is_read_as_it_is(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "a").write_bytes(content)
    assert read_bytes(tmp_path / "a", SMALL) == content


def test_a_file_beyond_the_limit_is_refused_with_the_limit_and_what_to_do(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"01234567890")
    assert refused(tmp_path / "a") == (
        "has 0.0 MB, more than the 0.0 MB that are read of a note; say less"
    )


def test_a_large_hole_is_refused_before_it_is_read(tmp_path: Path) -> None:
    with (tmp_path / "a").open("wb") as file:
        file.truncate(1 << 40)
    assert "has 1099512 MB, more than the 40 MB" in refused(tmp_path / "a", MAP_FILE)


@needs_posix
def test_a_file_that_says_that_it_is_empty_is_read_up_to_the_limit() -> None:
    if not Path("/proc/self/maps").exists():
        pytest.skip("has no /proc")
    assert "goes on, more than" in refused("/proc/self/maps")
    assert read_bytes("/proc/self/maps", MAP_FILE)


@needs_posix
def test_what_is_no_regular_file_is_refused_without_waiting(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.csv")
    (tmp_path / "loop.csv").symlink_to("loop.csv")
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(str(tmp_path / "socket.csv"))
        assert "is a socket" in refused(tmp_path / "socket.csv")
    assert "is a pipe, not a file; give the path of a note" in refused(tmp_path / "pipe.csv")
    assert "is a link that leads back to itself" in refused(tmp_path / "loop.csv")
    assert "is a device" in refused("/dev/zero")
    assert "is a folder" in refused(tmp_path)
    assert "there is no such file" in refused(tmp_path / "none")


@needs_posix
@pytest.mark.skipif(getattr(os, "geteuid", lambda: 1)() == 0, reason="root may read everything")
def test_a_file_that_may_not_be_read_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a").touch(0o000)
    assert "can't be read: permission denied" in refused(tmp_path / "a")


@pytest.mark.parametrize("name", ["a" * 300, "a\0b"])
def test_a_name_that_no_file_can_have_is_refused(name: str) -> None:
    assert "can't be read: " in refused(name)


def test_what_is_no_text_is_told_with_its_place(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"ab\nc\xff")
    with pytest.raises(MissionError) as caught:
        read_text(tmp_path / "a", SMALL)
    assert str(caught.value) == (
        f"{tmp_path / 'a'}:2:2: the byte 0xFF is not UTF-8; save the file as UTF-8"
    )


@needs_posix
@pytest.mark.parametrize(
    "ending", [".yaml", ".plan", ".waypoints", ".json", ".svg", ".geojson", ".map", ".csv"]
)
@pytest.mark.parametrize("kind", ["pipe", "device", "loop", "folder"])
def test_no_reader_waits_or_fills_the_memory(tmp_path: Path, ending: str, kind: str) -> None:
    path = tmp_path / f"a{ending}"
    if kind == "pipe":
        os.mkfifo(path)
    elif kind == "folder":
        path.mkdir()
    else:
        path.symlink_to("/dev/zero" if kind == "device" else path.name)
    told = "leads back to itself" if kind == "loop" else f"is a {kind}"
    with pytest.raises(MissionError, match=told):
        load(path)
    if ending == ".csv":
        rows, [fault] = read_track(path)
        assert not rows
        assert told in fault.problem
    elif ending not in (".plan", ".waypoints"):
        with pytest.raises(MissionError, match=told):
            load_map(path)


@needs_posix
def test_a_picture_of_a_map_is_a_regular_file_too(tmp_path: Path) -> None:
    lines = ["image: /dev/zero", "resolution: 1", "origin: [0, 0, 0]", "negate: 0"]
    lines += ["occupied_thresh: 0.65", "free_thresh: 0.2"]
    (tmp_path / "a.yaml").write_text("\n".join(lines))
    with pytest.raises(MissionError, match="/dev/zero: is a device"):
        load_map(tmp_path / "a.yaml")
