"""Follow every link of the site that stays in it: the file has to be there, and the place in it."""

from __future__ import annotations

from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class _Page(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.links: list[str] = []
        self.places: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if value and name in ("href", "src"):
                self.links.append(value)
            elif value and name in ("id", "name"):
                self.places.add(value)


def broken_links(site: Path) -> list[str]:
    """Each broken link as ``page: link``, and each that would need a network to show the page."""
    pages = {file: _read(file) for file in sorted(site.rglob("*.html")) if file.name != "404.html"}
    return [f"{file.relative_to(site)}: {link}" for file in pages for link in _of(file, pages)]


def _read(file: Path) -> _Page:
    page = _Page()
    page.feed(file.read_text(encoding="utf-8"))
    return page


def _of(file: Path, pages: dict[Path, _Page]) -> Iterator[str]:
    for link in pages[file].links:
        parts = urlsplit(link)
        if parts.scheme or parts.netloc or link.startswith("/"):
            continue
        target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
        if target.is_dir():
            target /= "index.html"
        if not target.exists() or (
            target in pages and unquote(parts.fragment) not in {"", *pages[target].places}
        ):
            yield link
