from __future__ import annotations

import os
import stat
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from viaspline.errors import OutputError
from viaspline.maps.grid import Grid
from viaspline.mission.model import Mission
from viaspline.report import style
from viaspline.report.animation import film_run, frames
from viaspline.report.video_file import VideoFile
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate


def test_the_robot_moves_and_the_size_stays(driven: Run) -> None:
    pictures = list(frames(driven, "yard", 5))
    assert len({picture.shape for picture in pictures}) == 1
    assert all(size % 2 == 0 for size in pictures[0].shape[:2])
    assert all((a != b).any() for a, b in pairwise(pictures))


def share_of(colour: str, frame: NDArray[np.uint8]) -> float:
    wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return float((np.abs(frame.astype(int) - wanted).max(axis=2) < 12).mean())


@pytest.mark.slow
def test_a_lidar_sweeps_the_ground_in_the_film(scanned: Run) -> None:
    first, *_, last = frames(scanned, "posts", 6)
    assert share_of(style.UNSEEN, last) > share_of(style.UNSEEN, first) > 0


def test_a_map_that_was_not_known_appears_when_it_is_found() -> None:
    wall = Grid(np.ones((4, 40), bool), 0.25, (20.0, 2.0, 0.0))
    mission = Mission.model_validate(
        {
            "world": {"unseen": [{"grid": wall}]},
            "robot": {"sensor": {"range_m": 8}},
            "route": {"start": [0, 0], "goal": [40, 0]},
        }
    )
    first, *_, last = frames(simulate(mission), "wall", 6)
    assert share_of(style.UNSEEN_FILL, last) > share_of(style.UNSEEN_FILL, first)


def test_a_gif_is_written_whole_with_progress(
    driven: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viaspline.report.animation.MAX_FRAMES", 12)
    heard: list[float] = []
    film_run(driven, "yard", VideoFile(tmp_path / "run.gif"), heard.append)
    with Image.open(tmp_path / "run.gif") as film:
        assert film.n_frames == 12
        first = np.asarray(film.convert("RGB"))
    assert (first[2, 2] == 255).all()
    assert heard == pytest.approx(np.arange(1, 13) / 12)
    assert os.listdir(tmp_path) == ["run.gif"]


def test_an_interrupted_film_leaves_nothing(
    driven: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viaspline.report.animation.MAX_FRAMES", 12)

    def interrupt(done: float) -> None:
        if done > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        film_run(driven, "yard", VideoFile(tmp_path / "run.gif"), interrupt)
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("name", ["run.avi", "run", "gif"])
def test_another_kind_of_film_is_refused_with_the_remedy(tmp_path: Path, name: str) -> None:
    with pytest.raises(OutputError, match=r"ends in \.gif or \.mp4"):
        VideoFile(tmp_path / name)


def test_an_mp4_without_ffmpeg_names_the_remedy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(OutputError, match=r"ffmpeg; install it, or write a \.gif"):
        VideoFile(tmp_path / "run.mp4")


def _fake_ffmpeg(folder: Path, script: str) -> None:
    program = folder / "ffmpeg"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)


@pytest.mark.skipif(os.name != "posix", reason="needs a shell")
def test_an_mp4_gets_every_frame_and_two_seconds_of_the_last(
    driven: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _fake_ffmpeg(tmp_path, 'for last; do :; done; cat > "$last"')
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    monkeypatch.setattr("viaspline.report.animation.MAX_FRAMES", 6)
    film_run(driven, "yard", VideoFile(tmp_path / "run.mp4"), lambda done: None)
    frame = next(frames(driven, "yard", 2))
    assert (tmp_path / "run.mp4").stat().st_size == (6 + 30) * frame.size


@pytest.mark.skipif(os.name != "posix", reason="needs a shell")
def test_a_failing_ffmpeg_is_reported_in_its_own_words(
    driven: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _fake_ffmpeg(tmp_path, "echo no such encoder >&2; exit 1")
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    monkeypatch.setattr("viaspline.report.animation.MAX_FRAMES", 6)
    with pytest.raises(OutputError, match=r"no such encoder\); write a \.gif instead"):
        film_run(driven, "yard", VideoFile(tmp_path / "run.mp4"), lambda done: None)
    assert sorted(os.listdir(tmp_path)) == ["ffmpeg"]
