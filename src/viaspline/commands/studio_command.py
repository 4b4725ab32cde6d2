"""``viaspline studio``: missions laid out in the browser.

Tested through ``studio/test_launch``.
"""

from __future__ import annotations

from pathlib import Path

import click

from viaspline.report.terminal.terminal_lines import say


@click.command()
@click.argument("mission", type=click.Path(path_type=Path), required=False)
@click.option("--port", type=click.IntRange(0, 65535), default=8474, show_default=True,
              help="0: any that is free.")  # fmt: skip
@click.option("--host", default="127.0.0.1", show_default=True,
              help="Another address lets others in, with a token.")  # fmt: skip
@click.option(
    "--token", help="What the page's address has to hold.  [default: made up where --host is given]"
)
@click.option("--no-browser", is_flag=True, help="Print the address and open nothing.")
def studio(mission: Path | None, port: int, host: str, token: str | None, no_browser: bool) -> None:
    r"""Edit, plan and drive a mission or a fleet in the browser.

    MISSION is a file, or a folder of them. Nothing outside of that folder is read or written.

    \b
    Example:
      viaspline studio examples/fig8-patrol.yaml
    """
    from viaspline.studio.serve import serve

    serve(mission, host=host, port=port, token=token, browser=not no_browser, say=say)
