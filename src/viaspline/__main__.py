"""``python -m viaspline`` and the ``viaspline`` command."""

from __future__ import annotations

import sys


def main() -> None:
    """Run the command line; ends the process with its exit code."""
    try:
        from viaspline.cli import cli
        from viaspline.report.interrupts import install

        install()
        cli(prog_name="viaspline")
    except KeyboardInterrupt:
        sys.stderr.write("viaspline: interrupted\n")
        sys.exit(130)


if __name__ == "__main__":
    main()
