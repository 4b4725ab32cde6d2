"""The fenced blocks of a page: what it shows, what it says to type, what it writes into files."""

from __future__ import annotations

import re
from dataclasses import dataclass

_FENCE = re.compile(
    r"^(?P<indent> *)```(?P<language>[\w-]+)(?P<rest>[^\n]*)\n(?P<body>.*?)^(?P=indent)```",
    re.DOTALL | re.MULTILINE,
)
_TITLE = re.compile(r'title="([^"]+)"')


@dataclass(frozen=True)
class Fence:
    """One block.

    Attributes:
        language: ``python``, ``sh``, ``yaml``, ``text``, ...
        body: Its text.
        title: The file that it is, if it says so.
        line: Its first line in the page, from 1.
    """

    language: str
    body: str
    title: str | None
    line: int


def fences(page: str) -> list[Fence]:
    r"""All blocks of a page in their order.

    >>> fences('Hi:\n```yaml title="a.yaml"\nx: 1\n```\n')
    [Fence(language='yaml', body='x: 1\n', title='a.yaml', line=3)]
    """
    found = []
    for match in _FENCE.finditer(page):
        title = _TITLE.search(match["rest"])
        width = len(match["indent"])
        body = "".join(line[width:] for line in match["body"].splitlines(keepends=True))
        line = page.count("\n", 0, match.start("body")) + 1
        found.append(Fence(match["language"], body, title[1] if title else None, line))
    return found


def pictures(page: str) -> list[str]:
    """The pictures that a page shows from its own folder or one beside it.

    >>> pictures('![A](run.png) <img src="b.png"> ![C](https://x.org/c.png)')
    ['run.png', 'b.png']
    """
    named = re.findall(r'!\[[^\]]*\]\(([^)\s]+)[^)]*\)|<img[^>]*src="([^"]+)"', page)
    return [one or other for one, other in named if not (one or other).startswith("http")]
