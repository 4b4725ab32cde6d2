"""The file of an animation: what can be written is known before the long work begins."""

from __future__ import annotations

import shutil
from pathlib import Path

from viaspline.errors import OutputError
from viaspline.report.result_files import ResultFolder

KINDS = (".gif", ".mp4")


class FilmFile:
    """Where an animation goes.

    Args:
        path: Ends in ``.gif``, or in ``.mp4`` where ffmpeg is installed.

    Raises:
        OutputError: For another kind, without ffmpeg, or when the folder can't be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.kind = path.suffix.lower()
        if self.kind not in KINDS:
            raise OutputError(path, f"an animation ends in {' or '.join(KINDS)}; rename it")
        self.ffmpeg = shutil.which("ffmpeg") if self.kind == ".mp4" else None
        if self.kind == ".mp4" and self.ffmpeg is None:
            raise OutputError(
                path, "an .mp4 needs the program ffmpeg; install it, or write a .gif instead"
            )
        self.folder = ResultFolder(path.parent, (path.name,))
