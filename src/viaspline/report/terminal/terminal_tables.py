"""What all tables for the terminal have in common: how they look, and how they are shown."""

from __future__ import annotations

from rich import box
from rich.console import Console, RenderableType
from rich.table import Table

from viaspline.report.proven_reference import PROVEN_WORDS, says_proven
from viaspline.report.style import without_folder
from viaspline.report.terminal.terminal_lines import writing_output

Rows = list[tuple[str, str]]  # names, and what they are
MAX_LIST_LINES = 12  # of a long list, before the rest is only counted


class _Console(Console):
    """A console that leaves it to us what happens when nobody is listening any more."""

    def on_broken_pipe(self) -> None:
        raise BrokenPipeError


def console() -> Console:
    """A console that takes names as they are, and hardly wraps when it is not a terminal."""
    plain = _Console(markup=False, highlight=False, emoji=False)
    if not plain.is_terminal:
        plain = _Console(markup=False, highlight=False, emoji=False, width=160)
    return plain


def facts_table(title: str, rows: Rows) -> Table:
    """A table of names and what they are, without lines between."""
    table = Table(title=title, title_justify="left", show_header=False, box=box.SIMPLE_HEAD)
    table.add_column(style="dim", no_wrap=True)
    table.add_column()
    for row in rows:
        table.add_row(*row)
    if says_proven(word for row in rows for word in row):
        table.caption, table.caption_justify = PROVEN_WORDS, "left"
    return table


def few_names(names: tuple[str, ...]) -> str:
    """The first three of some obstacles, and how many more there are.

    >>> few_names(("what is unseen", "tank", "map 'sites/depot.yaml'", "shed", "hedge"))
    "unseen, tank, map 'depot.yaml' and 2 more"
    """
    short = [without_folder(name).removeprefix("what is ") for name in names[:3]]
    return ", ".join(short) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def show(*tables: RenderableType) -> None:
    """Print tables on the output stream; nobody listening any more is no error.

    Raises:
        OutputError: They can't be written.
    """
    with writing_output():
        screen = console()
        for table in tables:
            screen.print(table)
