"""The pages of every command and of every error, made of the commands and of the classes."""

from __future__ import annotations

import inspect

import click

from viaspline import errors
from viaspline.cli import cli

COMMANDS_INTRODUCTION = """# Every command

Made from the commands themselves. `python -m viaspline` is the same as `viaspline`.

| exit code | means |
|---|---|
| 0 | done |
| 2 | the mission or the arguments are wrong: every fault, with its line |
| 3 | there is no such path, and that is proven: why, where, and what would allow one |
| 4 | the robot did not reach its goal: where, and why |
| 5 | gave up: a budget ran out before it was known |
| 130 | interrupted; 143 terminated |
| 1 | a defect of viaspline |
"""
ERRORS_INTRODUCTION = """# Every error

All of them are `vs.ViasplineError`. Each carries its data as attributes; its message names the
thing and the remedy. [How to read a refusal](../how-to/read-a-refusal.md).
"""


def command_reference() -> str:
    """The page of the commands, in Markdown."""
    parts = [COMMANDS_INTRODUCTION]
    for name in sorted(cli.commands):
        command = cli.commands[name]
        context = click.Context(command, info_name=f"viaspline {name}", terminal_width=90)
        parts.append(f"## viaspline {name}\n\n```text\n{command.get_help(context)}\n```\n")
    return "\n".join(parts)


def error_reference() -> str:
    """The page of the errors, in Markdown."""
    tree = inspect.getdoc(errors) or ""
    picture = inspect.cleandoc(tree.split("::", 1)[1].split("Every error")[0])
    parts = [ERRORS_INTRODUCTION, f"```text\n{picture}\n```\n"]
    for name, kind in inspect.getmembers(errors, inspect.isclass):
        if issubclass(kind, Exception) and kind.__module__ == errors.__name__:
            parts.append(f"## {name}\n\n{_words(kind)}\n")
    return "\n".join(parts)


def _words(kind: type) -> str:
    """A Google docstring of a class; its attributes as a list."""
    text = inspect.getdoc(kind) or ""
    head, _, attributes = text.partition("Attributes:\n")
    lines: list[str] = []
    for line in attributes.splitlines():
        if line.startswith("    ") and not line.startswith("     "):
            name, _, words = line.strip().partition(": ")
            lines.append(f"- `{name}`: {words}")
        elif line.strip():
            lines[-1] += f" {line.strip()}"
    return "\n\n".join(part for part in (head.strip(), "\n".join(lines)) if part)
