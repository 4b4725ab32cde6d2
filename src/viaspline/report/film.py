"""Frames to a file: a .gif with Pillow, an .mp4 with ffmpeg; a whole file or none."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from viaspline.errors import OutputError
from viaspline.report.files import replacing
from viaspline.report.film_file import FilmFile

Frame = NDArray[np.uint8]  # (height, width, 3)
RATE = 15  # frames a second
LAST = 2.0  # the last frame stays [s]


def write_film(
    film: FilmFile, frames: Iterable[Frame], count: int, progress: Callable[[float], None]
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
    images = [Image.fromarray(frame) for frame in frames]
    first = images[0]
    # one palette for all, from the first and the last frame: between them they have every colour
    both = Image.new("RGB", (first.width, 2 * first.height))
    both.paste(images[0], (0, 0))
    both.paste(images[-1], (0, first.height))
    palette = both.quantize(128, method=Image.Quantize.MEDIANCUT)
    small = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    durations = [round(1000 / RATE)] * (count - 1) + [round(1000 * LAST)]
    small[0].save(
        path, format="GIF", save_all=True, append_images=small[1:], duration=durations, loop=0,
        optimize=False,
    )  # fmt: skip


def _mp4(path: Path, frames: Iterator[Frame], ffmpeg: str) -> None:
    first = next(frames)
    height, width, _ = first.shape
    command = [
        ffmpeg, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24",
        "-s", f"{width}x{height}", "-r", str(RATE), "-i", "-", "-an", "-c:v", "libx264",
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
        for _ in range(round(LAST * RATE)):
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
