"""The panels beside the map in a real browser: their widths, and what stands in their rows."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Visit = Callable[..., Any]

MISSION = """
world:
  bounds: [0, 0, 100, 60]
  known:
    - circle: {center: [30, 30], radius: 4}
    - {polygon: [[50, 20], [60, 22], [55, 34]], pass_on: left}
    - {name: water tower number one, circle: {center: [75, 40], radius: 3}}
  unseen:
    - circle: {center: [40, 45], radius: 2}
robot: {sensor: {range_m: 20}}
route:
  start: [5, 30]
  via: [[45, 40], {at: [66, 28], name: a long name of a point, dwell_s: 5}]
  goal: [95, 30]
"""

CLIPPED = """() => {
  const panels = ["left", "right", "bottom"].map((id) => document.getElementById(id));
  return panels.flatMap((panel) => [...panel.querySelectorAll("*")].filter((one) => {
    if (!one.checkVisibility() || one.closest(".visually-hidden, select, svg")) return false;
    const isWide = one.scrollWidth > one.clientWidth + 1 && one.children.length === 0;
    const isCut = isWide && one.textContent && getComputedStyle(one).overflow !== "visible";
    return isCut || one.getBoundingClientRect().right > panel.getBoundingClientRect().right + 1;
  }).map((one) => `${one.tagName}.${one.className}: ${one.textContent.slice(0, 40)}`));
}"""


def widths(page: Any) -> list[float]:
    return [
        page.page.locator(name).bounding_box()["width"] for name in ("#left", "#stage", "#right")
    ]


@pytest.mark.slow
def test_panels_are_as_wide_as_somebody_drags_them_and_nothing_in_them_is_cut(
    visit: Visit, tmp_path: Path
) -> None:
    (tmp_path / "round.yaml").write_text(MISSION)
    page = visit(tmp_path / "round.yaml")
    usual = widths(page)
    lists = page.page.get_by_role("separator", name="Width of the lists")
    fields = page.page.get_by_role("separator", name="Width of the fields")
    page.page.get_by_role("button", name="a long name of a point, stays").click()
    assert page.js(CLIPPED) == []

    for edge, to in ((lists, 20.0), (fields, 1279.0)):  # as narrow as they get
        box = edge.bounding_box()
        page.page.mouse.move(box["x"] + box["width"] / 2, 400)
        page.page.mouse.down()
        page.page.mouse.move(to, 400, steps=3)
        page.page.mouse.up()
    narrow = widths(page)
    assert narrow[0] < usual[0] - 50
    assert narrow[2] < usual[2] - 40
    assert lists.get_attribute("aria-valuenow") == lists.get_attribute("aria-valuemin")
    assert page.js(CLIPPED) == []
    assert page.js("studio.camera.width") == narrow[1]

    lists.press("ArrowRight")
    fields.press("Shift+ArrowLeft")
    wider = widths(page)
    assert [wider[0] - narrow[0], wider[2] - narrow[2]] == [16, 64]
    lists.press("End")
    fields.press("End")
    widest = widths(page)
    assert widest[1] >= 470  # the map doesn't go
    assert page.js(CLIPPED) == []
    page.open(page.page.url)
    assert widths(page) == widest  # another visit
    lists.press("Enter")
    fields.dblclick()
    assert widths(page) == usual
    page.open(page.page.url)
    assert widths(page) == usual

    row = page.page.get_by_role("button", name="world.known[0]")
    assert row.inner_text().split() == ["world.known[0]", "obstacle", "1"]  # as plans call it
    assert page.page.get_by_role("button", name="world.unseen[0]").count() == 1
    tower = page.page.get_by_role("button", name="water tower number one")
    assert "world." not in tower.inner_text()
    row.click()
    page.page.get_by_label("Name", exact=True).fill("silo")
    page.press("Tab")
    assert page.page.get_by_role("button", name="world.known[0]").count() == 0
    assert page.doc["world"]["known"][0]["name"] == "silo"
