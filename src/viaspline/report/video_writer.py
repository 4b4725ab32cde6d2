"""Frames to a file: a .gif with Pillow, an .mp4 with ffmpeg; a whole file or none.

Tested through ``report/test_animation``.
"""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from viaspline.errors import OutputError
from viaspline.report.files.result_files import replacing
from viaspline.report.video_file import VideoFile

Frame = NDArray[np.uint8]  # (height, width, 3)
FRAMES_PER_S = 15  # frames a second
LAST_FRAME_S = 2.0  # the last frame stays [s]
MAX_FRAMES = 180  # of a run or a flight
FILM_DPI = 80


def write_film(
    film: VideoFile, frames: Iterable[Frame], count: int, progress: Callable[[float], None]
) -> None:
    """Write an animation.

    Args:
        film: Where to, and as what.
        frames: All of one size with even numbers of pixels.
        count: How many they are.
        progress: Hears how much is done, from 0 to 1.
    """

    def counted() -> Iterator[Frame]:
        for i, frame in enumerate(frames):
            yield frame
            progress((i + 1) / count)

    with replacing(film.path) as temporary:
        if film.ffmpeg is None:
            _gif(temporary, counted(), count)
        else:
            _mp4(temporary, counted(), film.ffmpeg)


def _gif(path: Path, frames: Iterator[Frame], count: int) -> None:
    pictures = list(frames)
    paint = _Paint(pictures[0], pictures[len(pictures) // 2], pictures[-1])
    images = [paint(picture) for picture in pictures]
    durations = [round(1000 / FRAMES_PER_S)] * (count - 1) + [round(1000 * LAST_FRAME_S)]
    images[0].save(
        path, format="GIF", save_all=True, append_images=images[1:], duration=durations, loop=0,
        optimize=False,
    )  # fmt: skip


class _Paint:
    """Pictures in one palette for the whole film: the colours that a few of them have most of."""

    def __init__(self, *pictures: Frame) -> None:
        colours, counts = np.unique(
            np.concatenate([_packed(p) for p in pictures]), return_counts=True
        )
        self._palette = colours[np.argsort(-counts, kind="stable")[:256]]
        self._index = np.full(1 << 24, -1, np.int16)  # of every colour that was met

    def __call__(self, picture: Frame) -> Image.Image:
        packed = _packed(picture)
        new = np.unique(packed[self._index[packed] < 0])
        if new.size:
            apart = _split(new)[:, None, :] - _split(self._palette)[None]
            self._index[new] = np.square(apart).sum(axis=2).argmin(axis=1)
        places = self._index[packed].astype(np.uint8).reshape(picture.shape[:2])
        image = Image.fromarray(places).convert("P")
        image.putpalette(_split(self._palette).astype(np.uint8).tobytes())
        return image


def _packed(picture: Frame) -> NDArray[np.int64]:
    """One number for each pixel."""
    flat = picture.reshape(-1, 3).astype(np.int64)
    packed: NDArray[np.int64] = (flat[:, 0] << 16) | (flat[:, 1] << 8) | flat[:, 2]
    return packed


def _split(packed: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.stack([packed >> 16, (packed >> 8) & 255, packed & 255], axis=-1)


def _mp4(path: Path, frames: Iterator[Frame], ffmpeg: str) -> None:
    first = next(frames)
    height, width, _ = first.shape
    command = [
        ffmpeg, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24",
        "-s", f"{width}x{height}", "-r", str(FRAMES_PER_S), "-i", "-", "-an", "-c:v", "libx264",
        "-pix_fmt", "yuv420p", "-fflags", "+bitexact", "-flags:v", "+bitexact",
        "-map_metadata", "-1", "-movflags", "+faststart", "-f", "mp4", str(path),
    ]  # fmt: skip
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE)
    assert process.stdin is not None
    try:
        last = first
        process.stdin.write(first.tobytes())
        for last in frames:
            process.stdin.write(last.tobytes())
        for _ in range(round(LAST_FRAME_S * FRAMES_PER_S)):
            process.stdin.write(last.tobytes())
    except BrokenPipeError:
        pass  # it ended early; its message says why
    except BaseException:
        process.kill()
        process.wait()
        raise
    _, problem = process.communicate()
    if process.returncode != 0:
        words = " ".join(problem.decode(errors="replace").split())[:300]
        raise OutputError(path, f"ffmpeg failed ({words or 'no message'}); write a .gif instead")
