#!/usr/bin/env python3
"""Everything that has to hold before a change lands; needs Python 3.11 and nothing else.

    python3 check.py            set up .venv if need be, then format, lint, types, layers, tests
    python3 check.py --all      the slow tests as well, for what many drives or fleets show
    python3 check.py --fix      let ruff mend what it can first
    python3 check.py --quick    for the edit loop, less than a minute: of the tests those of the
                                files that differ from the last commit, and the house's own
    python3 check.py --docs     run the pages of the documentation and make the site in build/site
    python3 check.py --set-up   the environment in .venv alone

Run from a checkout; the environment it makes is a developer's environment as well.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent
HOME = ROOT / ".venv"
MADE_OF = HOME / "made-of"  # what it was made of: it is made again where that is another
BIN = HOME / ("Scripts" if os.name == "nt" else "bin")
CODE = (
    "src",
    "tests",
    "benchmarks",
    "docsite",
    "check.py",
    "conftest.py",
    "compiled_wheel.py",
    "hatch_build.py",
)


def run(*command: str | Path) -> None:
    """Run a command in the checkout; stop with its exit code if it fails."""
    words = [str(word) for word in command]
    print(f"\n$ {' '.join(words)}", flush=True)
    code = subprocess.run(words, cwd=ROOT, check=False).returncode
    if code:
        sys.exit(code)


def run_beside(beside: Path, *commands: tuple[str | Path, ...]) -> None:
    """Run commands while another, which only one core can serve, runs to its end beside them.

    What the other says comes after; it is stopped where a command fails.
    """
    other = subprocess.Popen(
        [str(beside)], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    try:
        for command in commands:
            run(*command)
        said = other.communicate()[0]
    finally:
        other.kill()
    print(f"\n$ {beside}\n{said}", end="", flush=True)
    if other.returncode:
        sys.exit(other.returncode)


def asked_for() -> str:
    """What an environment is made of."""
    return sys.version + (ROOT / "pyproject.toml").read_text(encoding="utf-8")


def is_set_up() -> bool:
    """Whether there is an environment that was made of what is asked for today."""
    return MADE_OF.exists() and MADE_OF.read_text(encoding="utf-8") == asked_for()


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
    # What is imported of all that is compiled then: pip would take a minute to compile the rest.
    pip = (python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-compile")
    if not installed_by_uv(python, pip):
        run(*pip, "-e", ".[dev]")
    MADE_OF.write_text(asked_for(), encoding="utf-8")


def installed_by_uv(python: Path, pip: tuple[str | Path, ...]) -> bool:
    """Whether uv has installed all of it, in a fifth of the time that pip takes.

    It doesn't read pip's configuration, so that it may be without what pip has: then pip does it.
    """
    words = (python, "-m", "uv", "pip", "install", "--quiet", "--python", python, "-e", ".[dev]")
    try:
        for command in ((*pip, "uv"), words):
            print(f"\n$ {' '.join(map(str, command))}", flush=True)
            subprocess.run([str(word) for word in command], cwd=ROOT, check=True, timeout=180.0)
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as fault:
        print(f"uv can't: {fault}", flush=True)
        return False
    return True


def changed() -> list[Path]:
    """The Python files that differ from the last commit, or that git doesn't know yet."""
    words = ["git", "status", "--porcelain", "--untracked-files=all", "--", "src", "tests"]
    told = subprocess.run(words, cwd=ROOT, check=False, capture_output=True, text=True).stdout
    names = [line[3:].split(" -> ")[-1].strip('"') for line in told.splitlines()]
    return [Path(name) for name in names if name.endswith(".py") and (ROOT / name).exists()]


def tests_of(paths: list[Path]) -> list[str]:
    """The tests of some files: their own, those that they say they are tested through, examples."""
    found = {"tests/test_house.py"}
    for path in paths:
        if path.parts[0] == "tests":
            found |= {str(path)} if path.name.startswith("test_") else set()
            continue
        text = (ROOT / path).read_text(encoding="utf-8")
        room = Path("tests", *path.parts[2:-1])
        names = [room / f"test_{path.name}"]
        for said in re.findall(r"Tested through ((?:``[\w/]+``(?:,| and)?\s*)+)", text):
            names += [Path("tests", f"{name}.py") for name in re.findall(r"``([\w/]+)``", said)]
        found |= {str(name) for name in names if (ROOT / name).exists()}
        found |= {str(path)} if ">>> " in text else set()
    return sorted(found)


def main() -> None:
    """Set up, then every check in turn, the quick ones first."""
    if sys.version_info < (3, 11):  # noqa: UP036  (this file runs before anything is installed)
        sys.exit(f"viaspline needs Python 3.11 or newer; this is {sys.version.split()[0]}")
    # Without it every process that a test starts would compile all the sources anew.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    if "--set-up" in sys.argv or not (is_set_up() or ("--quick" in sys.argv and BIN.exists())):
        set_up()
    if "--set-up" in sys.argv:
        return
    if "--docs" in sys.argv:
        run(BIN / "python", "-m", "pip", "install", "--quiet", "-e", ".[docs]")
        run(BIN / "python", "docsite/build.py")
        return
    if "--fix" in sys.argv:
        run(BIN / "ruff", "check", "--fix", *CODE)
        run(BIN / "ruff", "format", *CODE)
    run(BIN / "ruff", "format", "--check", *CODE)
    run(BIN / "ruff", "check", *CODE)
    run(BIN / "lint-imports")
    if "--quick" in sys.argv:
        run(BIN / "mypy")
        mine = tests_of(changed())
        run(BIN / "python", "-m", "pytest", "-x", "-m", "not slow", *mine)
    else:
        # Collected once, the tests' bytecode is there for the processes that run them. They are
        # four: some wait for a browser, or for a kernel that another one compiles.
        pytest = (BIN / "python", "-m", "pytest")
        chosen = () if "--all" in sys.argv else ("-m", "not slow")
        collect, tests = ("--collect-only", "-qq"), ("-n", "4", "--dist", "worksteal")
        run_beside(BIN / "mypy", (*pytest, *collect), (*pytest, *chosen, *tests))


if __name__ == "__main__":
    main()
