"""The command line: which commands there are.

Exit codes: 0 done; 2 the mission or the arguments are wrong; 3 there is no such path, proven; 4 the
robot did not reach its goal; 5 gave up before it was known; 130 interrupted; 143 terminated; 1 a
defect of viaspline itself.
"""

from __future__ import annotations

import click

from viaspline import __version__
from viaspline.commands.check_command import check
from viaspline.commands.download_command import download
from viaspline.commands.drive_command import drive
from viaspline.commands.export_command import export_command
from viaspline.commands.figures_command import figures
from viaspline.commands.identify_command import identify
from viaspline.commands.plan_command import plan
from viaspline.commands.replay_command import replay
from viaspline.commands.run_command import run
from viaspline.commands.studio_command import studio
from viaspline.commands.tension_command import tension
from viaspline.commands.upload_command import upload
from viaspline.commands.warm_command import warm
from viaspline.exit_codes import Commands


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="viaspline")
def cli() -> None:
    r"""Lay a spline through your via points: round what stands in the way, proven clear, driven.

    \b
    Example:
      viaspline run examples/fig8-patrol.yaml --out patrol
    """


for command in (
    run, plan, check, tension, studio, export_command, drive, upload, download, identify, replay,
    warm, figures,
):  # fmt: skip
    cli.add_command(command)
