"""The page's own files, read once: asked one by one, a folder is slow while numba loads."""

from __future__ import annotations

from collections.abc import Mapping
from mimetypes import types_map
from pathlib import Path
from typing import Final

PAGE_FOLDER: Final = Path(__file__).parent / "page"

PRELOAD_MARK: Final = b"<!-- modulepreload -->"
"""Where the page names its modules, so that a browser asks for all of them at once."""

LATE_MODULES: Final = ("js/space/solid/", "vendor/")
"""Modules that the page asks for only when it opens a mission in space."""

MEDIA_TYPES: Final = {
    **types_map,
    ".js": "text/javascript",  # whatever this machine calls it: the page is served with nosniff
    ".css": "text/css",
    ".html": "text/html",
    ".svg": "image/svg+xml",
}


def page_files() -> Mapping[str, tuple[bytes, str]]:
    """Content and media type of every file of the page, by its name from the page's folder.

    >>> page_files()["js/main.js"][1]
    'text/javascript'
    """
    files = {
        path.relative_to(PAGE_FOLDER).as_posix(): (path.read_bytes(), MEDIA_TYPES[path.suffix])
        for path in PAGE_FOLDER.rglob("*")
        if path.is_file() and path.suffix in MEDIA_TYPES
    }
    page, kind = files["index.html"]
    modules = (name for name in sorted(files) if name.endswith(".js"))
    links = (_preload(name) for name in modules if not name.startswith(LATE_MODULES))
    return {**files, "index.html": (page.replace(PRELOAD_MARK, b"\n  ".join(links)), kind)}


def _preload(name: str) -> bytes:
    return f'<link rel="modulepreload" href="/page/{name}">'.encode()
