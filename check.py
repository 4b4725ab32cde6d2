#!/usr/bin/env python3
"""Everything that has to hold before a change lands; needs Python 3.11 and nothing else.

    python3 check.py            set up .venv if need be, then format, lint, types, layers, tests
    python3 check.py --fix      let ruff mend what it can first

Run from a checkout; the environment it makes is a developer's environment as well.
"""

from __future__ import annotations

import os
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent
HOME = ROOT / ".venv"
BIN = HOME / ("Scripts" if os.name == "nt" else "bin")
CODE = ("src", "tests", "benchmarks", "check.py")


def run(*command: str | Path) -> None:
    """Run a command in the checkout; stop with its exit code if it fails."""
    words = [str(word) for word in command]
    print(f"\n$ {' '.join(words)}", flush=True)
    code = subprocess.run(words, cwd=ROOT, check=False).returncode
    if code:
        sys.exit(code)


def set_up() -> None:
    """A virtual environment with the package, editable, and the developer's tools."""
    if not (BIN / "pip").exists() and not (BIN / "pip.exe").exists():
        try:
            venv.create(HOME, with_pip=True)
        except subprocess.CalledProcessError:
            sys.exit(
                "this Python can't make virtual environments; on Debian: apt install python3-venv"
            )
    python = BIN / ("python.exe" if os.name == "nt" else "python")
    run(python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-e", ".[dev]")


def main() -> None:
    """Set up, then every check in turn, the quick ones first."""
    if sys.version_info < (3, 11):  # noqa: UP036  (this file runs before anything is installed)
        sys.exit(f"viaspline needs Python 3.11 or newer; this is {sys.version.split()[0]}")
    set_up()
    if "--fix" in sys.argv:
        run(BIN / "ruff", "check", "--fix", *CODE)
        run(BIN / "ruff", "format", *CODE)
    run(BIN / "ruff", "format", "--check", *CODE)
    run(BIN / "ruff", "check", *CODE)
    run(BIN / "lint-imports")
    run(BIN / "mypy")
    run(BIN / "python", "-m", "pytest", "-n", "2")


if __name__ == "__main__":
    main()
