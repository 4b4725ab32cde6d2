"""Fingers and keys reach what the mouse does, and where the focus is can be seen."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Visit = Callable[..., Any]

MISSION = """\
world:
  known:
    - {name: post, circle: {center: [20, 30], radius: 4}}
robot: {radius_m: 0.5, clearance_m: 0.5}
route: {start: [0, 0], via: [[40, 10], [60, 20]], goal: [100, 0]}
"""
MOST_TABS = 120


class Fingers:
    """Fingers on a page: browsers take them for real ones."""

    def __init__(self, page: Any) -> None:
        self.page = page
        self.cdp = page.page.context.new_cdp_session(page.page)

    def tell(self, kind: str, *places: tuple[float, float]) -> None:
        points = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(places)]
        self.cdp.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    def drag(self, *ways: tuple[tuple[float, float], tuple[float, float]]) -> None:
        """Each finger from a place to another, one set down after the other, in eight steps."""
        for n in range(len(ways)):
            self.tell("touchStart", *(way[0] for way in ways[: n + 1]))
        for k in range(1, 9):
            part = k / 8
            places = [(a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])) for a, b in ways]
            self.tell("touchMove", *places)
        self.tell("touchEnd")
        self.page.settle()

    def tap(self, place: tuple[float, float]) -> None:
        self.tell("touchStart", place)
        self.tell("touchEnd")
        self.page.settle()


def mission(folder: Path) -> Path:
    path = folder / "small.yaml"
    path.write_text(MISSION)
    return path


@pytest.mark.slow
def test_fingers_select_drag_pan_zoom_draw_and_open_menus(visit: Visit, tmp_path: Path) -> None:
    page = visit(mission(tmp_path), width=800, height=700, has_touch=True)
    fingers = Fingers(page)
    before = page.doc
    fingers.tap(page.place([40, 10]))
    assert page.js("studio.store.selection") == "via:0"
    fingers.drag((page.place([40, 10]), page.place([46, 20])))
    x, y = page.doc["route"]["via"][0]
    assert abs(x - 46) < 1
    assert abs(y - 20) < 1
    page.press("Control+z")

    (px, py), scale = page.place([20, 12]), page.js("studio.camera.scale")
    fingers.drag(((px, py), (px - 60, py)), ((px + 60, py), (px + 120, py)))
    assert 2.7 < page.js("studio.camera.scale") / scale < 3.3  # three times as far apart
    seen = page.place([20, 12])
    fingers.drag(((px, py), (px, py - 60)), ((px + 60, py), (px + 60, py - 60)))
    moved = page.place([20, 12])
    assert abs(moved[1] - seen[1] + 60) < 4
    assert abs(page.js("studio.camera.scale") / scale - 3) < 0.3
    assert page.doc == before
    page.js("studio.fit()")

    page.press("a")  # a pinch makes no point, a tap does
    fingers.drag(((px, py), (px - 20, py)), ((px + 60, py), (px + 90, py)))
    assert page.doc == before
    page.js("studio.fit()")
    fingers.tap(page.place([30, -10]))
    assert abs(page.doc["route"]["via"][2][1] + 10) < 1
    page.press("Control+z", "Escape")

    fingers.tell("touchStart", page.place([20, 30]))
    page.until("studio.menu.isOpen")
    fingers.tell("touchEnd")
    menu = page.page.get_by_role("menu", name="Menu of post")
    menu.get_by_role("menuitemcheckbox", name="Pass on the left").click()
    page.settle()
    assert page.doc["world"]["known"][0]["pass_on"] == "left"
    page.press("Control+z")
    fingers.tell("touchStart", page.place([20, 30]))
    fingers.tell("touchMove", page.place([26, 30]))
    page.until("studio.pointer.longPress.timer === 0")  # moved: that is a drag
    assert not page.js("studio.menu.isOpen")
    fingers.tell("touchEnd")
    page.settle()
    page.press("Control+z")

    page.page.get_by_role("button", name="Select several by a box").click()
    fingers.drag((page.place([-6, -8]), page.place([70, 36])))
    assert set(page.js("studio.store.chosen")) == {"start", "via:0", "via:1", "known:0"}
    fingers.tap(page.place([60, 20]))
    assert set(page.js("studio.store.chosen")) == {"start", "via:0", "known:0"}
    assert page.doc == before


@pytest.mark.slow
def test_every_tool_and_entry_is_reached_by_tab_with_a_focus_that_is_seen(
    visit: Visit, tmp_path: Path
) -> None:
    page = visit(mission(tmp_path))
    seen: list[str] = []
    for _ in range(MOST_TABS):
        page.page.keyboard.press("Tab")
        label, is_marked = page.js(
            """() => {
              const one = document.activeElement;
              if (one === document.body) return ['', true]; // the browser's own end of the page
              const marked = [one, one.closest('.field-box')].some((each) => {
                const look = each && getComputedStyle(each);
                return look && look.outlineStyle !== 'none' && parseFloat(look.outlineWidth) > 0;
              });
              const bar = getComputedStyle(one, '::after');
              const isBar = bar.content !== 'none' && bar.backgroundColor !== 'rgba(0, 0, 0, 0)';
              return [one.getAttribute('aria-label') ?? one.textContent.trim(), marked || isBar];
            }"""
        )
        assert is_marked, label
        seen.append(label)
    wanted = page.js(
        """() => [...document.querySelectorAll(
          '#tools button, #left .row-main, #topbar button:not(:disabled), #inspector input, #fit'
        )].map((one) => one.getAttribute('aria-label') ?? one.textContent.trim())"""
    )
    assert set(wanted) <= set(seen)


def test_what_the_mouse_makes_is_made_with_keys_alone(visit: Visit, tmp_path: Path) -> None:
    page = visit(mission(tmp_path))
    page.page.focus("#map")
    page.press("c", "Enter")
    assert len(page.doc["world"]["known"]) == 2
    page.press("Control+z", "Escape", "m", "Enter", "Shift+ArrowRight", "Enter")
    (ax, ay), (bx, by) = page.js("studio.measure.places")
    assert bx > ax
    assert by == ay
    assert f"{bx - ax:.2f} m" in page.page.locator("#measured").inner_text()
    page.press("Enter")  # on the same place: ended
    assert page.js("studio.measure.isDone")
    page.press("Escape", "Escape", "Escape", "?")
    help_sheet = page.page.get_by_role("dialog", name="Mouse, fingers and keys")
    for words in ("measure", "duplicate", "select everything", "what can be done with it"):
        assert words in help_sheet.inner_text()
    page.press("Escape")
    assert not help_sheet.is_visible()
