"""What is loaded, taken out of Python's later garbage collections, which would halt a step."""

from __future__ import annotations

import gc
from typing import Final

MANY: Final = 100_000
"""So many objects take a collection about a hundredth of a second."""


def spare_collections() -> None:
    """Let no later collection look at what is loaded by now, if that is much.

    A full collection looks at every object that may be part of a circle. Kernels and libraries are
    a million of those, so it takes a tenth of a second, at any time: in the middle of a step. They
    stay as long as the process does, so nothing is lost. What goes later goes as ever, but for
    circles that were there by now.

    Example:
        >>> spare_collections()
        >>> len(gc.get_objects(generation=2)) <= MANY
        True
    """
    if len(gc.get_objects(generation=2)) > MANY:
        gc.collect()
        gc.freeze()
