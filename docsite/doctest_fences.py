"""For the pages of the API: examples in docstrings are code, whichever section they stand in."""

from __future__ import annotations

import re
from typing import Any

import griffe

_EXAMPLE = re.compile(
    r"(?:^ *>>> .*\n(?:^ *\S.*\n?)*)(?:\n*^ *>>> .*\n(?:^ *\S.*\n?)*)*", re.MULTILINE
)


class DoctestFences(griffe.Extension):
    """Puts fences round every run of lines that begins with ``>>>``."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        """See ``griffe.Extension``."""
        if obj.docstring is not None:
            obj.docstring.value = fenced(obj.docstring.value)


def fenced(text: str) -> str:
    r"""A docstring with its examples in fences.

    >>> fenced("One.\n\n>>> 1 + 1\n2\n")
    'One.\n\n```pycon\n>>> 1 + 1\n2\n```\n'
    """

    def fence(match: re.Match[str]) -> str:
        block = match[0].rstrip("\n")
        indent = re.match(r" *", block)
        margin = indent[0] if indent else ""
        return f"{margin}```pycon\n{block}\n{margin}```\n"

    if re.search(r"^ *Example:", text, re.MULTILINE):  # the section's name is in the plural
        return re.sub(r"^( *)Example:", r"\1Examples:", text, flags=re.MULTILINE)
    return _EXAMPLE.sub(fence, text if text.endswith("\n") else f"{text}\n")
