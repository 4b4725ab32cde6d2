"""What is said on the terminal in plain lines: never wrapped, no colour codes in a pipe.

Tested through ``test_cli``.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import click

from viaspline.errors import (
    GaveUpError,
    MissionWarning,
    NoPathError,
    OutputError,
    PlanningError,
)
from viaspline.report.terminal.standard_streams import discard
from viaspline.report.units import place


def say(*lines: str) -> None:
    """Lines on the output stream.

    Raises:
        OutputError: They can't be written; nobody listening any more is no error.
    """
    with writing_output():
        for line in lines:
            click.echo(line, file=sys.stdout)


@contextmanager
def writing_output() -> Iterator[None]:
    """Within the block something is written on the output stream, and at its end it is there.

    Raises:
        OutputError: It can't be written; nobody listening any more is no error.
    """
    try:
        yield
        sys.stdout.flush()
    except BrokenPipeError:
        discard(sys.stdout)
    except OSError as error:
        discard(sys.stdout)
        why = (error.strerror or str(error)).lower()
        remedy = "free some space, or send it elsewhere"
        raise OutputError("<output>", f"can't be written ({why}); {remedy}") from None


def say_error(*lines: str, prefix: str = "viaspline: ") -> None:
    """A message on the error stream; the first line begins with the prefix in red."""
    try:
        for i, line in enumerate(lines):
            start = click.style(prefix, fg="red", bold=True) if prefix and i == 0 else ""
            click.echo(start + line, file=sys.stderr)
    except OSError:  # there is no one left to tell
        discard(sys.stderr)


def no_path(error: NoPathError) -> str:
    """Why there is no path, where, and what would help, on a line each."""
    where, remedy = _where(error), error.remedy
    return f"there is no such path: {error.reason}\n  where:  {where}\n  remedy: {remedy}"


def gave_up(error: GaveUpError) -> str:
    """Where the search for a path was given up, what was tried, and what would help, on lines."""
    tried = "".join(f"\n  tried:  {one}" for one in error.tried)
    remedy = f"\n  remedy: {error.remedy}"
    return f"gave up: {error.reason}\n  where:  {_where(error)}{tried}{remedy}"


def _where(error: PlanningError) -> str:
    return place(error.where)


@contextmanager
def telling_warnings() -> Iterator[None]:
    """Within the block a warning is one line on the error stream."""

    def show(message: Warning | str, *_: Any, **__: Any) -> None:
        say_error(" ".join(str(message).split()), prefix="warning: ")

    with warnings.catch_warnings():
        warnings.simplefilter("always", MissionWarning)
        warnings.showwarning = show
        yield
