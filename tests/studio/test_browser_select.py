"""Several things are selected, moved, copied and deleted at once, measured and snapped to."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from math import hypot
from pathlib import Path
from typing import Any

import pytest

from viaspline.formats.yaml_document import yaml_document

EXAMPLES = Path(__file__).parents[2] / "examples"
Visit = Callable[..., Any]

SMALL = """\
world:
  known:
    - {name: post, circle: {center: [20, 30], radius: 2}}
    - {name: hut, polygon: [[60, 40], [70, 40], [70, 52], [60, 52]]}
robot: {radius_m: 0.5, clearance_m: 0.5}
route:
  start: [0, 0]
  via: [{at: [40, 10], name: a}, [60, 20]]
  goal: [100, 0]
spline: {tension: [0.1, 0.2, 0.3]}
"""


@pytest.fixture
def small(tmp_path: Path) -> Path:
    shutil.copy(EXAMPLES / "fig8-patrol.yaml", tmp_path)
    path = tmp_path / "small.yaml"
    path.write_text(SMALL)
    return path


def chosen(page: Any) -> list[str]:
    return list(page.js("studio.store.chosen"))


def shift_click(page: Any, at: list[float]) -> None:
    page.page.keyboard.down("Shift")
    page.click(at)
    page.page.keyboard.up("Shift")


def near(a: list[float], b: list[float], tolerance: float = 0.6) -> bool:
    return hypot(a[0] - b[0], a[1] - b[1]) < tolerance


def test_what_is_selected_together_is_moved_and_deleted_as_one_step(
    visit: Visit, small: Path
) -> None:
    page = visit(small)
    before = page.doc
    page.click([40, 10])
    shift_click(page, [20, 30])
    shift_click(page, [65, 46])
    assert chosen(page) == ["via:0", "known:0", "known:1"]
    page.until("document.querySelector('#inspector').innerText.includes('1 point, 2 obstacles')")
    page.drag([20, 30], [25, 36])
    doc = page.doc
    assert near(doc["route"]["via"][0]["at"], [45, 16])
    assert near(doc["world"]["known"][0]["circle"]["center"], [25, 36])
    moved = doc["world"]["known"][1]["polygon"]
    ways = {(round(x - a, 3), round(y - b, 3)) for (x, y), (a, b) in zip(
        moved, before["world"]["known"][1]["polygon"], strict=True)}  # fmt: skip
    assert len(ways) == 1  # all corners by the same way
    page.press("Control+z")
    assert page.doc == before  # one step, however many moves the mouse told
    page.js("studio.store.select('via:1', ['start', 'via:0', 'via:1', 'known:1'])")
    page.press("ArrowRight", "Shift+ArrowUp")
    assert page.doc["route"]["start"] != before["route"]["start"]
    page.press("Delete")
    doc = page.doc
    assert doc["route"]["via"] == []
    assert [one["name"] for one in doc["world"]["known"]] == ["post"]
    assert doc["spline"] == {"tension": [0.3]}  # that of the span that is left
    page.press("Control+z", "Control+z")
    assert page.doc == before


def test_a_box_and_the_keyboard_select_several(visit: Visit, small: Path) -> None:
    page = visit(small)
    page.page.keyboard.down("Shift")
    page.drag([10, 4], [68, 38])
    page.page.keyboard.up("Shift")
    assert chosen(page) == ["via:0", "via:1", "known:0"]  # the hut sticks out
    shift_click(page, [40, 10])
    assert chosen(page) == ["via:1", "known:0"]
    page.press("Escape")
    assert chosen(page) == []
    page.press("Tab", "e", "Tab", "Tab", "e", "Tab")
    assert chosen(page) == ["start", "via:1", "goal"]
    page.press("Escape", "q")
    page.click([40, 10])
    page.click([20, 30])
    assert chosen(page) == ["via:0", "known:0"]
    page.drag([5, -5], [110, 5])
    assert chosen(page) == ["via:0", "known:0", "goal"]
    page.press("Control+a")
    assert set(chosen(page)) == {"start", "via:0", "via:1", "goal", "known:0", "known:1"}
    page.press("Escape")
    row = page.page.locator("#left [data-id='known:1'] button")
    row.focus()
    page.press("Enter")
    page.page.locator("#left [data-id='via:0'] button").focus()
    page.press("Shift+Enter")
    assert chosen(page) == ["known:1", "via:0"]
    page.until("document.querySelectorAll('#left .row.is-selected').length === 2")


def test_copies_are_text_of_the_mission_and_go_into_another_mission(
    visit: Visit, small: Path
) -> None:
    page = visit(small, permissions=["clipboard-read", "clipboard-write"])
    before = page.doc
    page.page.focus("#map")
    page.js("studio.store.select('via:0', ['known:1'])")
    page.press("Control+c")
    text = page.js("navigator.clipboard.readText()")
    assert yaml_document(text, "clipboard").data == {
        "route": {"via": [before["route"]["via"][0]]},
        "world": {"known": [before["world"]["known"][1]]},
    }
    page.press("Control+d")
    doc = page.doc
    assert [point["name"] for point in doc["route"]["via"][:2]] == ["a", "a 2"]
    assert doc["world"]["known"][2]["name"] == "hut 2"
    assert doc["world"]["known"][2]["polygon"] != before["world"]["known"][1]["polygon"]
    assert len(doc["spline"]["tension"]) == 4
    assert chosen(page) == ["via:1", "known:2"]  # what is new is at hand
    page.press("Control+z")
    assert page.doc == before
    page.js("studio.files.load('fig8-patrol.yaml')")
    page.until("studio.store.name === 'fig8-patrol.yaml'")
    page.settle()
    known, vias = len(page.doc["world"]["known"]), len(page.doc["route"]["via"])
    page.press("Control+v")
    page.until(f"studio.store.doc.world.known.length === {known + 1}")
    page.settle()
    assert page.doc["world"]["known"][-1] == before["world"]["known"][1]  # where it was
    assert page.doc["route"]["via"][-1] == before["route"]["via"][0]
    page.press("Control+x")
    assert len(page.doc["world"]["known"]) == known
    assert len(page.doc["route"]["via"]) == vias
    page.js("navigator.clipboard.writeText('Dear all')")
    page.press("Control+v")
    page.until("document.querySelector('.toast.is-bad')?.textContent.includes('route.via')")


def test_lengths_and_bearings_are_measured_and_snap_to_points(visit: Visit, small: Path) -> None:
    page = visit(small)
    page.press("m")
    x, y = page.place([40, 10])
    page.page.mouse.click(x + 4, y - 3)  # near the point: it snaps
    page.click([60, 20])
    page.click([60, 52])
    assert page.js("studio.measure.places") == [[40, 10], [60, 20], [60, 52]]
    words = page.page.locator("#measured").inner_text()
    assert f"{hypot(20, 10) + 32:.2f} m" in words  # the sum
    assert "32.00 m" in words
    assert "bearing 0.0°" in words  # north, by the compass
    assert "heading 90.0°" in words  # and as heading_deg counts
    page.press("Backspace")
    assert "bearing 63.4°" in page.page.locator("#measured").inner_text()
    page.press("Enter")
    page.click([20, 30])  # begins anew
    assert page.js("studio.measure.places") == [[20, 30]]
    page.press("Escape", "Escape")
    assert page.js("studio.store.tool") == "select"
    assert not page.page.locator("#measured").is_visible()
    before = page.doc
    page.click([65, 46])
    x, y = page.place([70, 40])  # a corner of the hut
    ex, ey = page.place([60, 20])
    mouse = page.page.mouse
    for free in (True, False):
        mouse.move(x, y)
        mouse.down()
        if free:
            page.page.keyboard.down("Alt")
        mouse.move(ex + 20, ey, steps=3)
        mouse.move(ex + 5, ey + 3, steps=3)
        if free:
            assert page.js("studio.snap.shown") is None
        else:
            assert page.js("studio.snap.shown.name") == "via 2"
        mouse.up()
        page.page.keyboard.up("Alt")
        page.settle()
        assert (page.doc["world"]["known"][1]["polygon"][1] == [60, 20]) is not free
        page.press("Control+z")
        assert page.doc == before
    assert page.js("studio.snap.shown") is None
    page.drag([40, 10], [70.3, 40.3])  # points of the route keep off corners
    assert page.doc["route"]["via"][0]["at"] != [70, 40]
    page.drag(page.doc["route"]["via"][0]["at"], [60.5, 20.4])
    assert page.doc["route"]["via"][0]["at"] == [60, 20]
    page.press("Control+z", "Control+z", "s", "j")  # the grid, and no points
    page.drag([40, 10], [52.3, 21.7])
    step = page.js("studio.camera.step(28)")
    assert all(abs(v / step - round(v / step)) < 1e-6 for v in page.doc["route"]["via"][0]["at"])


def test_a_menu_tells_what_can_be_done_with_what_is_there(visit: Visit, small: Path) -> None:
    page = visit(small, permissions=["clipboard-read", "clipboard-write"])
    menu = page.page.get_by_role("menu", name="Menu of")
    before = page.doc
    page.page.mouse.click(*page.place([20, 30]), button="right")
    assert menu.get_attribute("aria-label") == "Menu of post"
    menu.get_by_role("menuitem", name="Delete").click()
    page.settle()
    assert [one["name"] for one in page.doc["world"]["known"]] == ["hut"]
    page.press("Control+z")
    page.page.mouse.click(*page.place([20, 30]), button="right")
    page.press("ArrowUp", "Escape")
    assert not menu.is_visible()
    assert page.js("document.activeElement.id") == "map"
    page.page.mouse.click(*page.place([20, 30]), button="right")
    menu.get_by_role("menuitem", name="Copy").click()
    page.page.mouse.click(*page.place([30, -8]), button="right")
    menu.get_by_role("menuitem", name="Paste here").click()
    page.until("studio.store.doc.world.known.length === 3")
    page.settle()
    assert near(page.doc["world"]["known"][2]["circle"]["center"], [30, -8])
    page.press("Control+z")
    page.page.mouse.click(*page.place([8, 30]), button="right")
    menu.get_by_role("menuitem", name="Add a via point at the end").click()
    page.settle()
    assert near(page.doc["route"]["via"][2], [8, 30])
    page.press("Control+z", "Escape")
    page.page.focus("#map")
    page.press("Tab", "Shift+F10")  # the same by the keyboard: of the start
    assert menu.get_attribute("aria-label").startswith("Menu of start")
    assert menu.get_by_role("menuitem", name="Delete").count() == 0
    page.press("s", "Enter")  # by its first letter: Select the span after it
    assert chosen(page) == ["span:0"]
    page.press("ContextMenu", "Enter")
    page.until("studio.store.doc.route.via.length === 3")
    page.settle()
    page.press("Control+z")
    page.page.locator("#left [data-id='known:1'] button").focus()
    page.press("Shift+F10")
    assert menu.get_attribute("aria-label") == "Menu of hut"
    page.press("End", "ArrowUp", "Escape")
    assert page.js("document.activeElement.closest('[data-id]').dataset.id") == "known:1"
    page.js("studio.store.select('known:1:1')")
    page.page.focus("#map")
    page.press("Shift+F10", "a", "Enter")
    assert page.doc["world"]["known"][1]["polygon"][2] == [70, 46]
    page.press("Control+z")
    assert page.doc == before
