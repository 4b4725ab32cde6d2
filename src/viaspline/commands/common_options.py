"""Arguments and options that several commands have.

Tested through ``test_cli``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

import click

MISSION: Final = click.argument("mission", type=click.Path(path_type=Path))
OUT: Final = click.option(
    "--out", "-o", type=click.Path(path_type=Path), metavar="DIR",
    help="Folder for the results.  [default: viaspline-out/<name of the mission>]",
)  # fmt: skip
QUIET: Final = click.option(
    "--quiet", "-q", is_flag=True, help="Print nothing unless something goes wrong."
)
