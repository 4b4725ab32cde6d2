"""No text is cut off or lies outside of its panel, at any width, in any state, light or dark.

What people have named themselves may be longer than its row: it ends in dots there, and the whole
of it is told by the row's title.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

Visit = Callable[..., Any]

WIDTHS = (1280, 1360, 1920, 390)
SHEETS = ("route", "plan", "edit", "settings", "drive")

CUT = """() => {
  const found = [];
  const pen = document.createElement("canvas").getContext("2d");
  const hides = (how) => how === "hidden" || how === "clip";
  const isSeen = (e) => e.checkVisibility({ visibilityProperty: true })
    && !e.closest(".visually-hidden, .skip, [aria-hidden=true], #toasts");
  const isToldElsewhere = (e) => e.closest("[title]")?.title.includes(e.textContent.trim());
  const say = (e, why) => {
    const name = `${e.tagName.toLowerCase()}#${e.id}.${e.className}`;
    found.push(`${name}: ${e.textContent.trim().slice(0, 60)}: ${why}`);
  };
  const outOf = (e, range) => {
    for (let up = e.parentElement; up && up !== document.body; up = up.parentElement) {
      const style = getComputedStyle(up);
      if (["auto", "scroll"].includes(style.overflowX) && !up.matches(".panel")) return null;
      if (!hides(style.overflowX) && !up.matches(".panel, .menu, dialog, #topbar")) continue;
      const box = up.getBoundingClientRect();
      const over = Math.max(range.right - box.right, box.left - range.left);
      if (over > 1.5) return `${Math.round(over)} px out of ${up.id || up.className}`;
    }
    return null;
  };
  for (const e of document.querySelectorAll("body *")) {
    if (!(e instanceof HTMLElement) || !isSeen(e)) continue;
    const style = getComputedStyle(e);
    if (e instanceof HTMLSelectElement) {
      pen.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
      const width = pen.measureText(e.selectedOptions[0]?.textContent ?? "").width + 26;
      if (width > e.clientWidth + 1 && !e.title) say(e, `choice cut by ${width - e.clientWidth}`);
    }
    if (e instanceof HTMLInputElement && ["number", "text"].includes(e.type)) {
      if (e.type === "number" && e.scrollWidth > e.clientWidth + 1) say(e, `${e.value} is cut`);
      pen.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
      const room = e.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
      const hint = e.value ? 0 : pen.measureText(e.placeholder).width;
      if (hint > room + 1) say(e, `${e.placeholder} is cut`);
    }
    if (![...e.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim())) continue;
    if (e instanceof HTMLOptionElement) continue;
    const range = document.createRange();
    range.selectNodeContents(e);
    const box = range.getBoundingClientRect();
    if (!box.width) continue;
    if (isToldElsewhere(e)) continue;
    if (hides(style.overflowX) && e.scrollWidth > e.clientWidth + 1) say(e, "is cut");
    if (hides(style.overflowY) && e.scrollHeight > e.clientHeight + 2) say(e, "is cut below");
    const where = outOf(e, box);
    if (where) say(e, where);
  }
  return found;
}"""

LONG = "the pump house behind the second hall on the left"
MISSION = {
    "world": {
        "bounds": [0, 0, 100, 80],
        "known": [
            {"circle": {"center": [50, 41], "radius": 5}, "name": LONG, "pass_on": "left"},
            {"polygon": [[20, 60], [30, 60], [30, 70]], "name": "yard"},
            {
                "circle": {"center": [0, 0], "radius": 1},
                "motion": {"keyframes": [[0, 80, 60, 90], [20, 90, 70, 0]], "after": "bounce"},
            },
        ],
        "unseen": [{"circle": {"center": [70, 20], "radius": 2}}],
        "speed_zones": [{"polygon": [[1, 1], [9, 1], [9, 9]], "max_speed_mps": 1, "name": LONG}],
    },
    "robot": {"radius_m": 0.5, "clearance_m": 0.5, "sensor": {"range_m": 20}},
    "route": {
        "start": {"at": [10, 40], "heading_deg": 33.25},
        "via": [{"at": [30, 40], "name": LONG, "dwell_s": 125.5}, [33, 47]],
        "goal": [90, 40],
    },
}

SELECTIONS = ("start", "via:0", "known:0", "known:2", "known:2:1", "unseen:0", "zone:0", "span:1")


def texts_at_all_widths(page: Any, state: str) -> Iterator[str]:
    """What is cut off in the panels, with the width and the state."""
    for width in WIDTHS:
        page.page.set_viewport_size({"width": width, "height": 844 if width == 390 else 820})
        for sheet in SHEETS if width == 390 else ("plan",):
            page.js("(name) => studio.openSheet(name)", sheet)
            for found in page.js(CUT):
                yield f"{width} px, {state}, {sheet}: {found}"


@pytest.mark.slow
def test_no_text_is_cut_in_the_panels(visit: Visit, tmp_path: Path) -> None:
    path = tmp_path / "a-survey-with-a-name.yaml"
    path.write_text(yaml.safe_dump(MISSION))
    page = visit(path)
    assert page.plan["ok"]
    found = list(texts_at_all_widths(page, "nothing selected"))
    for one in SELECTIONS:
        page.js("(id) => studio.store.select(id)", one)
        page.until("!studio.lists.signature || studio.lists.inView === studio.store.selection")
        found += texts_at_all_widths(page, one)
    page.page.emulate_media(color_scheme="dark")
    found += texts_at_all_widths(page, "dark")
    page.page.emulate_media(color_scheme="light")
    page.js("studio.compare.open()")
    page.page.get_by_label("Values").fill("0.2, 1.5, 30")
    page.page.get_by_role("button", name="Add", exact=True).click()
    page.until("studio.compare.rows.length === 4 && !studio.compare.isRunning")
    page.until("document.querySelectorAll('#compare .spinner').length === 0")
    found += texts_at_all_widths(page, "compared")
    page.js("studio.compare.close()")
    page.js(
        "studio.store.edit({...studio.store.doc, robot: {...studio.store.doc.robot,"
        "clearance_m: 30}, spline: {tension: 'much'}})"
    )
    page.settle()
    assert not page.plan["ok"]
    found += texts_at_all_widths(page, "refused")
    assert found == []


def test_no_text_is_cut_in_menus_and_dialogs(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    found = []
    for width in (1280, 390):
        page.page.set_viewport_size({"width": width, "height": 844})
        for button in ("#menu-show", "#menu-more", "#show-help"):
            page.page.click(button)
            found += [f"{width} px, {button}: {text}" for text in page.js(CUT)]
            page.page.keyboard.press("Escape")
        for name in ("export", "saveAs", "open", "addMap"):
            page.js("(name) => studio.files[name]()", name)
            page.until("document.querySelector('#dialog').open")
            found += [f"{width} px, {name}: {text}" for text in page.js(CUT)]
            page.page.keyboard.press("Escape")
            page.until("!document.querySelector('#dialog').open")
    assert found == []
