"""Where it is written what "proven" covers, for all that says the word: one place for the address.

The page is part of the documentation. The studio's copy of it is installed with the package, so
that a page of a notebook can hold what it says, without any network.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from html import escape
from importlib.resources import files
from typing import Final

PROVEN_PAGE: Final = "docs/proven.md"
"""What is proven, under which assumptions, and what is not."""
PROVEN_KEY: Final = {"proven_means": PROVEN_PAGE}
"""As documents of JSON say it."""
PROVEN_WORDS: Final = f"what is proven, under which assumptions, and what is not: {PROVEN_PAGE}"
_WORD: Final = "proven"


def says_proven(texts: Iterable[str]) -> bool:
    """Whether any text says that something is proven.

    >>> says_proven(["clearance, proven"]), says_proven(["length"])
    (True, False)
    """
    return any(_WORD in text.lower() for text in texts)


def with_meaning(*lines: str) -> tuple[str, ...]:
    """Lines, and below them where it is written what "proven" covers if one of them says the word.

    >>> with_meaning("177 points, proven 0.500 m clear")[1].endswith("docs/proven.md")
    True
    >>> with_meaning("177 points")
    ('177 points',)
    """
    return (*lines, PROVEN_WORDS) if says_proven(lines) else lines


def folded_page() -> str:
    """The page, as a piece of HTML that opens where it is clicked."""
    words, address = escape(PROVEN_WORDS.split(":", maxsplit=1)[0]), escape(PROVEN_PAGE)
    title = f"{words[0].upper()}{words[1:]} ({address})"
    inside = "max-width:60em;padding:0 1em;text-align:left"
    return (
        f"<details><summary>{title}</summary><div style='{inside}'>{_installed()}</div></details>"
    )


@cache
def _installed() -> str:
    """What stands on the studio's copy, without links and names that would clash with others."""
    text = files("viaspline").joinpath("studio/page/proven.html").read_text(encoding="utf-8")
    inner = text.split("<main>", 1)[1].split("</main>", 1)[0]
    inner = re.sub(r"</?a\b[^>]*>", "", inner)
    return re.sub(r' (?:id|class|tabindex)="[^"]*"', "", inner)
