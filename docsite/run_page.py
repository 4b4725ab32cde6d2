"""Do what a page says, as a reader would: write its files, type its commands, run its Python.

In an empty folder with the examples beside it. Python blocks of a page share their names. What a
page only shows is in a block of another language (``text``).
"""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from pathlib import Path

from fences import Fence, fences

NOT_TYPED = ("pip ", "python3 -m venv", "git ", "cd ", "source ", "#")
TIMEOUT_S = 600.0


class PageError(Exception):
    """A block of a page doesn't do what the page says."""


def run_page(page: Path, folder: Path) -> None:
    """Do what a page says in a folder.

    Raises:
        PageError: If a block fails; with the page, its line and what was said.
    """
    blocks = fences(page.read_text(encoding="utf-8"))
    script: list[str] = []
    for block in blocks:
        if block.title is not None:
            _write(block, folder)
        elif block.language == "python":
            script += ["\n" * max(0, block.line - 1 - sum(text.count("\n") for text in script))]
            script += [block.body]
        elif block.language == "sh":
            _flush(script, page, folder)
            _type(block, page, folder)
    _flush(script, page, folder)


def _write(block: Fence, folder: Path) -> None:
    assert block.title is not None
    file = folder / block.title
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(block.body, encoding="utf-8")


def _environment() -> dict[str, str]:
    home = Path(sys.executable).parent
    paths = os.pathsep.join((str(home), os.environ.get("PATH", "")))
    return os.environ | {"PATH": paths, "MPLBACKEND": "Agg", "COLUMNS": "100"}


def _flush(script: list[str], page: Path, folder: Path) -> None:
    """Run the Python that has come together, with the page's own line numbers."""
    if not script:
        return
    source = folder / f".{page.stem}.py"
    source.write_text("".join(script), encoding="utf-8")
    _run([sys.executable, str(source)], page, folder)


def _type(block: Fence, page: Path, folder: Path) -> None:
    text = block.body.replace("\\\n", " ")
    for line in text.splitlines():
        if line.strip() and not line.startswith(NOT_TYPED):
            _run(shlex.split(line, comments=True), page, folder, line=block.line)


def _run(words: list[str], page: Path, folder: Path, *, line: int | None = None) -> None:
    done = subprocess.run(
        words, cwd=folder, env=_environment(), timeout=TIMEOUT_S, check=False,
        capture_output=True, text=True,
    )  # fmt: skip
    if done.returncode:
        place = page.name if line is None else f"{page.name}:{line}"
        raise PageError(f"{place}: {' '.join(words)}\n{done.stdout}\n{done.stderr}")
