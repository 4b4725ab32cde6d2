"""Rows of a table that are kept in a file, to be held against those of other sources."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

Rows = list[dict[str, Any]]


def keep(rows: Rows, to: Path | None) -> None:
    """Write rows to a file, if one is named: a line of JSON each."""
    if to is not None:
        to.write_text("\n".join(map(json.dumps, rows)) + "\n", encoding="utf-8")


def kept(before: Path) -> Rows:
    """The rows that another run has kept."""
    return [json.loads(line) for line in before.read_text(encoding="utf-8").splitlines()]
