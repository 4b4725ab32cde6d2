"""The facts of a value as text and as a piece of HTML with its picture."""

from __future__ import annotations

from base64 import b64encode
from html import escape

from viaspline.presentable.upper_doors import opened, opened_for
from viaspline.report.proven_reference import PROVEN_WORDS, folded_page, says_proven
from viaspline.report.terminal.terminal_tables import Rows

BESIDE = "vertical-align:top;padding:1px 1.2em 1px 0;text-align:left;white-space:nowrap"
WORDS = "vertical-align:top;padding:1px 0;text-align:left;white-space:normal"


def rows_of(value: object) -> Rows:
    """What a value is, in names and facts."""
    rows: Rows = opened_for("facts", value)(value)
    return rows


def summary_text(value: object) -> str:
    """A value in a few lines: each a name, and what that is.

    Args:
        value: A plan, a run, a mission, a curve and so on.

    >>> from viaspline.curve.cardinal import CardinalSpline
    >>> print(summary_text(CardinalSpline([(0, 0), (4, 0)])))
    CardinalSpline
      length             4.00 m
      via points         2
      spans              1, in the plane
      largest curvature  0 1/m (straight)
    """
    rows = rows_of(value)
    wide = max((len(name) for name, _ in rows), default=0)
    lines = [f"  {name:<{wide}}  {words}".rstrip() for name, words in rows]
    if _says_proven(rows):
        lines.append(f"  ({PROVEN_WORDS})")
    return "\n".join([type(value).__name__, *lines])


def html_page(value: object) -> str:
    """A value as a piece of HTML: its facts, and its picture if it can be drawn.

    Where something is proven, what that covers unfolds at a click.

    Args:
        value: As for ``summary_text``.
    """
    rows = rows_of(value)
    cells = "".join(
        f"<tr><th style='{BESIDE}'>{escape(name.strip())}</th>"
        f"<td style='{WORDS}'>{escape(words)}</td></tr>"
        for name, words in rows
    )
    title = f"<b>{escape(type(value).__name__)}</b>"
    table = f"<table style='border-collapse:collapse;margin:4px 0'>{cells}</table>"
    page = folded_page() if _says_proven(rows) else ""
    return f"<div>{title}{table}{page}{_image(value)}</div>"


def _says_proven(rows: Rows) -> bool:
    return says_proven(text for row in rows for text in row)


def _image(value: object) -> str:
    if not hasattr(value, "plot"):
        return ""
    data = b64encode(opened("picture")(value)).decode()
    alt = escape(type(value).__name__, quote=True)
    return f"<img alt='{alt}' style='max-width:100%' src='data:image/png;base64,{data}'/>"
