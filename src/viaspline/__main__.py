"""``python -m viaspline`` and the ``viaspline`` command."""

from __future__ import annotations

import os
import sys
from contextlib import suppress

BY_SIGNAL = (130, 143)
"""Exit codes of work that a signal has ended."""


def main() -> None:
    """Run the command line; ends the process with its exit code."""
    try:
        from viaspline.cli import cli
        from viaspline.report.interrupts import install

        install()
        cli(prog_name="viaspline")
    except KeyboardInterrupt:
        sys.stderr.write("viaspline: interrupted\n")
        _end(130)
    except SystemExit as end:
        if end.code not in BY_SIGNAL:
            raise
        _end(int(end.code))


def _end(code: int) -> None:
    """End the process at once, with its exit code.

    Python kills itself with SIGINT at its end if an interrupt ever came out of text that was being
    executed, as the classes of many libraries are made, even if it was handled further out.
    """
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
    os._exit(code)


if __name__ == "__main__":
    main()
