"""The file of an animation: what can be written is known before the long work begins.

Tested through ``report/test_animation``.
"""

from __future__ import annotations

import shutil
from pathlib import Path

from viaspline.errors import OutputError
from viaspline.report.files.result_files import ResultFolder

VIDEO_SUFFIXES = (".gif", ".mp4")


class VideoFile:
    """Where an animation goes.

    Args:
        path: Ends in ``.gif``, or in ``.mp4`` where ffmpeg is installed.

    Raises:
        OutputError: For another kind, without ffmpeg, or when the folder can't be written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.kind = path.suffix.lower()
        if self.kind not in VIDEO_SUFFIXES:
            raise OutputError(
                path, f"an animation ends in {' or '.join(VIDEO_SUFFIXES)}; rename it"
            )
        self.ffmpeg = shutil.which("ffmpeg") if self.kind == ".mp4" else None
        if self.kind == ".mp4" and self.ffmpeg is None:
            raise OutputError(
                path, "an .mp4 needs the program ffmpeg; install it, or write a .gif instead"
            )
        self.folder = ResultFolder(path.parent, (path.name,))
