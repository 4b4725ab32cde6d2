"""Warnings that name the line that called the package, not one of its own."""

from __future__ import annotations

import sys
import warnings
from types import FrameType
from typing import Final

from viaspline.errors import MissionWarning

PASSED: Final = ("viaspline", "pydantic")
"""Packages whose lines tell a caller nothing: this one, and what builds its missions."""


def warn_caller(words: str) -> None:
    """Warn of something in a mission, at the first line that is neither ours nor pydantic's.

    How deep that lies differs from door to door (``vs.load``, ``Mission.model_validate``), and
    filters that show a warning once for each line need the true one.
    """
    depth, frame = 1, sys._getframe()
    while _is_passed(frame) and frame.f_back is not None:
        depth, frame = depth + 1, frame.f_back
    warnings.warn(words, MissionWarning, stacklevel=depth)


def _is_passed(frame: FrameType) -> bool:
    return str(frame.f_globals.get("__name__")).partition(".")[0] in PASSED
