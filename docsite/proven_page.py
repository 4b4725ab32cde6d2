"""The page of what is proven as the studio serves it, without any network: ``page/proven.html``."""

from __future__ import annotations

import html
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SOURCE = ROOT / "docs" / "proven.md"
TARGET = ROOT / "src" / "viaspline" / "studio" / "page" / "proven.html"

HEAD = """<!doctype html>
<html lang="en">
<head>
  <meta charset="utf-8">
  <meta name="viewport" content="width=device-width, initial-scale=1">
  <title>What is proven, and what is not</title>
  <link rel="icon" href="/page/icon.svg">
  <link rel="stylesheet" href="/page/proven.css">
</head>
<body>
<main>
"""
FOOT = "</main>\n</body>\n</html>\n"


def proven_page() -> str:
    """The page, made of ``docs/proven.md``: links to pages that the studio hasn't are words."""
    blocks = SOURCE.read_text(encoding="utf-8").strip().split("\n\n")
    return HEAD + "".join(_block(block) for block in blocks) + FOOT


def _block(text: str) -> str:
    heading = re.fullmatch(r"(#+) (.+)", text)
    if heading:
        level, words = len(heading[1]), heading[2]
        name = re.sub(r"[^\w]+", "-", words.lower()).strip("-")
        return f'<h{level} id="{name}">{_words(words)}</h{level}>\n'
    if text.startswith("|"):
        head, _, *rows = text.splitlines()
        body = "".join(_row(row, "td") for row in rows)
        parts = f"<thead>{_row(head, 'th')}</thead>\n<tbody>\n{body}</tbody>"
        return f'<div class="wide" tabindex="0"><table>\n{parts}\n</table></div>\n'
    return f"<p>{_words(text)}</p>\n"


def _row(line: str, tag: str) -> str:
    cells = "".join(f"<{tag}>{_words(cell.strip())}</{tag}>" for cell in line.strip("|").split("|"))
    return f"<tr>{cells}</tr>\n"


def _words(text: str) -> str:
    """Code, strong and stressed words of a paragraph, and links within the page."""
    text = html.escape(text, quote=False)
    text = re.sub(r"\[([^\]]+)\]\((#[\w-]+)\)", r'<a href="\2">\1</a>', text)
    text = re.sub(r"\[([^\]]+)\]\([^)]+\)", r"\1", text)
    text = re.sub(r"\*\*([^*]+)\*\*", r"<strong>\1</strong>", text)
    text = re.sub(r"\*([^*]+)\*", r"<em>\1</em>", text)
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
