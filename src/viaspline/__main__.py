"""``python -m viaspline`` and the ``viaspline`` command."""

from __future__ import annotations

import os
import sys
from contextlib import suppress

from viaspline.errors import OutputError

BY_SIGNAL = (130, 143)
"""Exit codes of work that a signal has ended."""


def main() -> None:
    """Run the command line; ends the process with its exit code."""
    try:
        from viaspline.cli import cli
        from viaspline.report.terminal.interrupts import install
        from viaspline.report.terminal.standard_streams import make_fit
        from viaspline.report.terminal.terminal_lines import writing_output

        make_fit()
        install()
        with writing_output():
            cli(prog_name="viaspline")
    except KeyboardInterrupt:
        sys.stderr.write("viaspline: interrupted\n")
        _end(130)
    except SystemExit as end:
        if end.code not in BY_SIGNAL:
            raise
        _end(int(end.code))
    except OutputError as error:  # of what stands in no command: help, the version
        from viaspline.report.terminal.terminal_lines import say_error

        say_error(str(error))
        sys.exit(2)


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
