"""The door to ``warming``, which drives missions of its own and so stands above the navigators.

Tested through ``warming/test_warm_up``.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING, Final

from viaspline.handed_in import check_callable, check_kind

if TYPE_CHECKING:
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.model import Mission

HOME: Final = "viaspline.warming.warm_up"

KernelCallback = Callable[[str], None]


def warm_up(asked: Mission | Fleet, progress: KernelCallback | None, warm: bool = True) -> None:
    """Load all that a mission or a fleet can need; see ``Navigator.warm``.

    Args:
        asked: What will be driven.
        progress: Hears the name of every kernel that has to be compiled.
        warm: Whether to.

    Raises:
        GeometryError: The progress can't be called, or it isn't said whether.
    """
    check_kind("warm", warm, bool, "give True or False")
    if progress is not None:
        check_callable("progress", progress, "give a function of a kernel's name")
    if warm:
        import_module(HOME).warm_up(asked, progress)
