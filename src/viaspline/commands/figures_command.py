"""``viaspline figures``: those of the paper, made again.

Tested through ``report/test_figures``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

import click

from viaspline.commands.command_steps import progress_bar, result_folder, say_written
from viaspline.commands.common_options import QUIET
from viaspline.report.terminal.terminal_lines import say

FIGURE_NAMES: Final = tuple(
    f"{name}.png" for name in ("fig2", "fig3", "fig5", "fig6", "fig7", "fig8", "curvature")
)


@click.command()
@click.option(
    "--out", "-o", type=click.Path(path_type=Path), metavar="DIR",
    default=Path("viaspline-out/figures"), show_default=True, help="Folder for the figures.",
)  # fmt: skip
@QUIET
def figures(out: Path, quiet: bool) -> None:
    r"""Make the figures of the paper anew, and one that it lacks.

    \b
    Example:
      viaspline figures --out figures
    """
    with result_folder(out, FIGURE_NAMES) as folder, progress_bar(quiet) as watch:
        contents = {}
        with watch.stage("load", "loading"):
            from viaspline.report.figures import FIGURES
        for name, (_, draw) in FIGURES.items():
            with watch.stage(name, f"drawing {name}"):
                contents[name] = draw()
        files = [folder.write(name, content) for name, content in contents.items()]
    if not quiet:
        say(*(f"{name:<14} {caption}" for name, (caption, _) in FIGURES.items()))
        say_written(files)
