"""What the command line ends with: every error becomes a message and an exit code.

Tested through ``test_cli``.
"""

from __future__ import annotations

import os
import sys
import traceback
from typing import Any

import click

from viaspline.errors import GaveUpError, MissionError, NoPathError, ViasplineError
from viaspline.report.terminal.interrupts import Terminated, remembered
from viaspline.report.terminal.standard_streams import nobody_listens
from viaspline.report.terminal.terminal_lines import gave_up, no_path, say_error, telling_warnings

DEFECT, WRONG, NO_PATH, NOT_REACHED, GAVE_UP = 1, 2, 3, 4, 5
INTERRUPTED, TERMINATED = 130, 143


class Commands(click.Group):
    """The commands; every error that they raise becomes a message and an exit code.

    In their help a line of nothing but a backslash and a b begins a part that isn't wrapped.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.help = unwrapped(self.help)

    def add_command(self, cmd: click.Command, name: str | None = None) -> None:
        """Take a command in."""
        cmd.help = unwrapped(cmd.help)
        super().add_command(cmd, name)

    def make_context(self, *args: Any, **kwargs: Any) -> click.Context:
        """Read what stands before a command; help and version are said here."""
        try:
            return super().make_context(*args, **kwargs)
        except BrokenPipeError as error:  # click would call it a failure
            raise click.exceptions.Exit(told(error)) from None

    def invoke(self, ctx: click.Context) -> Any:
        """Run a command."""
        try:
            with telling_warnings():
                return super().invoke(ctx)
        except (click.ClickException, click.exceptions.Exit, click.Abort):
            raise
        except (Exception, KeyboardInterrupt, Terminated) as error:
            ctx.exit(told(error))


def unwrapped(text: str | None) -> str | None:
    r"""The help of a command with click's mark of what isn't wrapped, which is a character.

    Docstrings with a backslash are raw ones, in which it is two.

    >>> unwrapped("\\b\nExample:")
    '\x08\nExample:'
    """
    return None if text is None else text.replace("\\b\n", "\b\n")


def told(error: BaseException) -> int:
    """Say what happened; returns the exit code."""
    signalled = remembered()
    if isinstance(error, KeyboardInterrupt) or signalled is KeyboardInterrupt:
        say_error("interrupted; no file was left half written")
        return INTERRUPTED
    if isinstance(error, Terminated) or signalled is Terminated:
        say_error("terminated; no file was left half written")
        return TERMINATED
    if isinstance(error, NoPathError):
        say_error(no_path(error))
        return NO_PATH
    if isinstance(error, GaveUpError):
        say_error(gave_up(error))
        return GAVE_UP
    if isinstance(error, MissionError):
        say_error(*(str(fault) for fault in error.faults), prefix="")
        return WRONG
    if isinstance(error, ViasplineError):
        say_error(str(error))
        return WRONG
    if isinstance(error, MemoryError):
        say_error("gave up: there is not enough memory; make the mission or its maps smaller")
        return GAVE_UP
    if isinstance(error, BrokenPipeError) and nobody_listens(sys.stdout):
        return 0  # whoever reads the first lines of a help has what he wants
    if isinstance(error, OSError):  # the machine's trouble, not the program's
        name = "" if error.filename is None else f"{error.filename}: "
        say_error(f"{name}{(error.strerror or str(error)).lower()}")
        return WRONG
    if os.environ.get("VIASPLINE_DEBUG"):
        traceback.print_exception(error)
    problem = " ".join(str(error).split())
    say_error(f"defect: {type(error).__name__}: {problem} (VIASPLINE_DEBUG=1 shows where)")
    return DEFECT
