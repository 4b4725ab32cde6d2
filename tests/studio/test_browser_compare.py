"""Variants side by side over the same map, and one of them taken over."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

Visit = Callable[..., Any]

PIXELS = """(colour) => {
  const { scene } = studio;
  scene.draw();
  const { data } = scene.ctx.getImageData(0, 0, scene.canvas.width, scene.canvas.height);
  const [r, g, b] = colour;
  let count = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (data[i] === r && data[i + 1] === g && data[i + 2] === b) count += 1;
  }
  return count;
}"""


def add(page: Any, kind: str, values: str | None = None) -> None:
    page.page.get_by_label("What differs").select_option(kind)
    if values is not None:
        page.page.get_by_label("Values").fill(values)
    page.page.get_by_role("button", name="Add", exact=True).click()
    page.until("!studio.compare.isRunning")
    page.until("document.querySelectorAll('#compare .spinner').length === 0")


def cells(page: Any) -> list[list[str]]:
    rows: list[list[str]] = page.js(
        "[...document.querySelectorAll('#compare tbody tr')]"
        ".map(row => [...row.children].map(cell => cell.textContent))"
    )
    return rows


def test_variants_are_compared_drawn_and_one_is_taken_over_in_one_step(
    visit: Visit, patrol: Path
) -> None:
    page = visit(patrol)
    before = page.doc
    page.page.get_by_role("button", name="Compare variants …").click()
    page.until("studio.compare.rows[0]?.state === 'done'")
    add(page, "tension", "0.6, −0.5")
    add(page, "clearance", "60")
    side = page.js(
        "[...document.querySelectorAll('#compare option')].map(o => o.value)"
        ".find(value => value.startsWith('side:'))"
    )
    add(page, side)
    rows = cells(page)
    names = ["as it stands", "tension 0.6", "tension -0.5", "clearance 60 m"]
    assert [row[0][1:] for row in rows] == [*names, "well: left", "well: right"]
    assert rows[0][1] == f"{page.plan['length']:.1f} m"
    assert rows[1][1] != rows[2][1]
    assert rows[3][1].startswith("refused: start lies")
    assert rows[4][1] != rows[5][1]
    assert page.doc == before
    assert page.js(PIXELS, [0xC2, 0x54, 0x0A]) > 300  # tension 0.6, in its own colour
    assert page.js(PIXELS, [0x8A, 0x62, 0x00]) > 300  # the side that isn't taken
    for column, section in (("Clear", "a-path"), ("Drives", "how-it-drives")):
        link = page.page.locator("#compare thead").get_by_role("link", name=column)
        assert link.get_attribute("href") == f"/page/proven.html#{section}"
    add(page, "tension", "0.6")
    assert len(cells(page)) == 6  # it is there already

    page.page.get_by_role("button", name="Take tension -0.5 out of the table").click()
    page.until("document.querySelectorAll('#compare tbody tr').length === 5")
    add(page, "clearance", "-3")
    assert len(cells(page)) == 5
    page.page.get_by_role("button", name="Take over tension 0.6").click()
    page.settle()
    assert page.doc == {**before, "spline": {**before["spline"], "tension": 0.6}}
    assert page.js("studio.compare.isOpen") is False
    assert f"{page.plan['length']:.1f} m" == rows[1][1]
    page.press("Control+z")
    assert page.doc == before


def test_rows_of_an_older_mission_cant_be_taken_over_until_they_are_planned_anew(
    visit: Visit, patrol: Path
) -> None:
    page = visit(patrol)
    page.js("studio.compare.open()")
    add(page, "clearance", "2")
    page.js("studio.pointer, studio.store.edit({...studio.store.doc, spline: {tension: 0.9}})")
    page.settle()
    take = page.page.get_by_role("button", name="Take over clearance 2 m")
    page.until("document.querySelector('.compare-note') !== null")
    assert take.is_disabled()
    old = cells(page)[0][1]
    page.page.get_by_role("button", name="Plan them anew").click()
    page.until("studio.compare.isOfNow && studio.compare.rows.every(r => r.state === 'done')")
    page.until("document.querySelector('.compare-note') === null")
    page.until("!document.querySelector('#compare tbody').textContent.includes('planning')")
    assert cells(page)[0][1] == f"{page.plan['length']:.1f} m" != old
    take.click()
    page.settle()
    assert page.doc["robot"]["clearance_m"] == 2
    assert page.doc["spline"] == {"tension": 0.9}
