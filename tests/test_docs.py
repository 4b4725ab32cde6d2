"""The documentation as a newcomer meets it: what its first pages say is done, and does that.

All other pages are run by ``check.py --docs``: most of the time goes into starting processes.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from check_links import broken_links
from command_reference import command_reference, error_reference
from fences import fences, pictures
from proven_page import TARGET, proven_page
from run_page import PageError, run_page

from viaspline import __all__ as exported
from viaspline.cli import cli

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted((ROOT / "docs").rglob("*.md"))
TUTORIALS = ("start/five-minutes", "start/your-map")


def _links(page: Path) -> Iterator[str]:
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    for link in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", text)):
        if not link.startswith(("http", "#")):
            yield link


@pytest.mark.slow
@pytest.mark.parametrize("name", TUTORIALS)
def test_a_newcomer_who_follows_a_page_gets_what_it_shows(name: str, tmp_path: Path) -> None:
    page = ROOT / "docs" / f"{name}.md"
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    run_page(page, tmp_path)
    for picture in pictures(page.read_text(encoding="utf-8")):
        assert (tmp_path / picture).stat().st_size > 1000


def test_a_page_whose_command_fails_is_told_with_its_line(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("One:\n\n```sh\nviaspline plan nowhere.yaml\n```\n", encoding="utf-8")
    with pytest.raises(PageError, match=r"page\.md:4.*\n(.|\n)*nowhere\.yaml"):
        run_page(page, tmp_path)


def test_a_page_whose_python_fails_is_told_with_its_line(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("One:\n\n```python\n1 / 0\n```\n", encoding="utf-8")
    with pytest.raises(PageError, match=r"line 4(.|\n)*ZeroDivisionError"):
        run_page(page, tmp_path)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_page_links_to_and_shows_is_there(page: Path) -> None:
    for link in (*_links(page), *pictures(page.read_text(encoding="utf-8"))):
        assert (page.parent / link.partition("#")[0]).exists(), link


def test_every_page_is_in_the_contents_of_the_site() -> None:
    contents = (ROOT / "zensical.toml").read_text(encoding="utf-8")
    for page in PAGES:
        assert f'"{page.relative_to(ROOT).as_posix()}"' in contents


@pytest.mark.parametrize(
    ("name", "made"),
    [
        ("mission", "mission_reference import mission_reference"),
        ("commands", "command_reference import command_reference"),
        ("errors", "command_reference import error_reference"),
    ],
)
def test_a_page_of_the_reference_is_what_the_declarations_say(name: str, made: str) -> None:
    """In a process of its own, which nothing else has had its hands on."""
    script = f"import sys; from {made} as made; sys.stdout.buffer.write(made().encode())"
    said = subprocess.run(
        [sys.executable, "-c", script], cwd=ROOT / "docsite", capture_output=True, check=True
    )
    kept = (ROOT / "docs" / "reference" / f"{name}.md").read_text(encoding="utf-8")
    assert said.stdout.decode() == kept, "run docsite/build.py --keep --no-site docs/glossary.md"


def test_every_key_that_the_reference_speaks_of_has_its_place_in_it() -> None:
    page = (ROOT / "docs" / "reference" / "mission.md").read_text(encoding="utf-8")
    places = set(re.findall(r"\{ #([\w-]+) \}", page))
    assert {"rosspec", "route"} <= places
    assert set(re.findall(r"\]\(#([\w-]+)\)", page)) <= places


def test_the_studio_shows_the_page_of_what_is_proven_as_it_is() -> None:
    kept, page = TARGET.read_text(encoding="utf-8"), proven_page()
    assert kept == page, "run docsite/build.py --keep --no-site docs/glossary.md"
    assert not re.search(r"\*|`|\]\(|^\|", page, re.MULTILINE)  # all of it became HTML
    folder = TARGET.parent / "js"
    scripts = "".join(file.read_text(encoding="utf-8") for file in folder.rglob("*.js"))
    led = set(re.findall(r'meaning\("([\w-]+)"', scripts))
    assert len(led) == 4
    assert led <= set(re.findall(r'id="([\w-]+)"', page))


def test_every_command_and_every_public_name_has_its_place_in_the_reference() -> None:
    commands, errors = command_reference(), error_reference()
    assert all(f"## viaspline {name}\n" in commands for name in cli.commands)
    python = (ROOT / "docs" / "reference" / "python.md").read_text(encoding="utf-8")
    named = set(re.findall(r"^::: .*\.(\w+)$", python, re.MULTILINE))
    named |= set(re.findall(r"^## (\w+)$", errors, re.MULTILINE))
    assert set(exported) - {"__version__"} <= named


def test_a_block_knows_its_language_its_file_and_its_line() -> None:
    (block,) = fences('Hi:\n\n  ```yaml title="a.yaml"\n  x: 1\n    y: 2\n  ```\n')
    assert (block.language, block.title, block.line) == ("yaml", "a.yaml", 4)
    assert block.body == "x: 1\n  y: 2\n"


def test_a_broken_link_of_the_site_is_found(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text('<a href="b.html#x">1</a><a href="b.html#y">2</a>')
    (tmp_path / "b.html").write_text('<p id="x"></p><img src="c.png"><a href="https://x.y">3</a>')
    assert broken_links(tmp_path) == ["a.html: b.html#y", "b.html: c.png"]
