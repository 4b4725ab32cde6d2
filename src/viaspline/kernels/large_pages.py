"""Memory of large tables in large pages, where the system has them.

A table that is written for the first time is given to the process page by page, each of 4 kB filled
with zeros: that takes several times as long as to write it. Linux gives 2 MB at once where it is
asked to. numpy asks for its own arrays; what kernels allocate is asked for here.
"""

from __future__ import annotations

import sys
from typing import Any

import numba
from numba.core import types

from viaspline.kernels.arrays import Floats, Ints, Steps
from viaspline.kernels.jit import inlined

LEAST_BYTES = 1 << 22  # smaller tables aren't worth it; numpy's limit as well
PAGE = 4096
ADVICE = 14  # MADV_HUGEPAGE of Linux; another system says that it doesn't know it

_config: Any = numba.config  # which says nothing of its types

if sys.platform == "linux" and not _config.DISABLE_JIT:
    _madvise: Any = types.ExternalFunction(
        "madvise", types.intc(types.uintp, types.uintp, types.intc)
    )

    @inlined
    def in_large_pages(table: Floats | Ints | Steps) -> None:
        """Ask for large pages for a table that nothing is written to yet, if it is large."""
        if table.nbytes >= LEAST_BYTES:
            begin = (table.ctypes.data + PAGE - 1) // PAGE * PAGE  # only whole pages of its own
            end = (table.ctypes.data + table.nbytes) // PAGE * PAGE
            _madvise(begin, end - begin, ADVICE)

else:

    @inlined
    def in_large_pages(table: Floats | Ints | Steps) -> None:
        """There is nobody to ask."""
