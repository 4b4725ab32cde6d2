"""``viaspline check``: every fault of a mission at once.

Tested through ``test_cli``.
"""

from __future__ import annotations

from pathlib import Path

import click

from viaspline.commands.command_steps import load_asked
from viaspline.report.terminal.terminal_lines import say


@click.command()
@click.argument("mission", type=click.Path(path_type=Path), required=False)
@click.option(
    "--schema", is_flag=True, help="Print the JSON Schema of missions and fleets, for editors."
)
def check(mission: Path | None, schema: bool) -> None:
    r"""Check a mission: every fault at once, each with its line.

    A fault is one line: file:line:column: key: what is wrong, and what would be right.

    \b
    Examples:
      viaspline check examples/fig8-patrol.yaml
      viaspline check --schema > mission.schema.json
    """
    if schema:
        import json

        from viaspline.mission.fleet.file_schema import file_schema

        say(json.dumps(file_schema(), indent=2))
        return
    if mission is None:
        raise click.UsageError("give a mission, or --schema")
    loaded = load_asked(mission)
    from viaspline.mission.model import Mission

    if isinstance(loaded, Mission):
        from viaspline.commands.mission_steps import check_mission

        lines = check_mission(loaded)
    else:
        from viaspline.commands.fleet_steps import check_fleet

        lines = check_fleet(loaded)
    say(f"{mission} is sound", *(f"  {name:<7} {words}" for name, words in lines))
