"""The page's own files: all named to the browser, and kinds of obstacles told in one place."""

from __future__ import annotations

import re

import pytest

from viaspline.mission.shapes.obstacle import KINDS
from viaspline.studio.page_files import LATE_MODULES, PAGE_FOLDER, PRELOAD_MARK, page_files

MODULES = sorted(
    path
    for path in PAGE_FOLDER.glob("js/**/*.js")
    if not path.relative_to(PAGE_FOLDER).as_posix().startswith(LATE_MODULES)
)


def test_the_page_names_every_module_once_and_itself_no_other() -> None:
    page = page_files()["index.html"][0].decode()
    named = re.findall(r'<link rel="modulepreload" href="/page/([^"]+)">', page)
    assert named == [path.relative_to(PAGE_FOLDER).as_posix() for path in MODULES]
    assert PRELOAD_MARK.decode() not in page


def test_the_page_knows_every_kind_of_obstacle_that_missions_have() -> None:
    registry = (PAGE_FOLDER / "js/shapes/registry.js").read_text()
    for key in KINDS:
        assert re.search(rf'key: "{key}"', (PAGE_FOLDER / f"js/shapes/{key}.js").read_text())
        assert f"  {key},\n" in registry


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.name)
def test_only_shapes_and_areas_look_into_an_outline(path: object) -> None:
    module = PAGE_FOLDER / str(path)
    if module.parent.name == "shapes":
        return
    found = re.findall(r"(\w+)(?:\.|\?\.)(circle|polygon|holes)\b", module.read_text())
    assert {owner for owner, _ in found} <= {"zone", "next"}  # speed zones and fences
