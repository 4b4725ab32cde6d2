"""The page in a real browser: driven, moved, used with keys and with fingers, with maps."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

EXAMPLES = Path(__file__).parents[2] / "examples"
Visit = Callable[..., Any]


def near(a: list[float], b: list[float], tolerance: float = 2.0) -> bool:
    return abs(a[0] - b[0]) < tolerance and abs(a[1] - b[1]) < tolerance


def test_a_drive_is_played_to_the_goal_with_its_events(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    page.page.get_by_role("button", name="Drive", exact=True).click()
    page.page.wait_for_selector("body.is-driving")
    assert len(page.page.query_selector_all("#marks .mark.is-replan")) == 2
    page.page.select_option("#factor", "50")
    page.js("(studio.drive.pause(), studio.drive.seek(140))")  # it plays by itself
    assert page.js("studio.drive.stay() !== null")
    assert not page.js("studio.drive.hasSeen(0)")
    page.js("studio.drive.seek(studio.drive.run.duration - 8)")
    page.js("studio.drive.play()")
    page.until("studio.drive.time >= studio.drive.run.duration && !studio.drive.isPlaying")
    assert page.js("studio.drive.hasSeen(0) && studio.drive.hasSeen(1)")
    assert "reached the goal" in page.page.locator("#drive-note").inner_text()
    end = page.js("studio.drive.state()")
    assert near([end["x"], end["y"]], [430, 180], 0.1)
    page.js("studio.drive.step(-1)")
    assert page.js("studio.drive.time") < page.js("studio.drive.run.duration")
    page.page.get_by_role("button", name="Back to editing").click()
    page.until("studio.drive.run === null")


def test_a_path_that_does_not_drive_well_says_why_and_shows_where(
    visit: Visit, tmp_path: Path
) -> None:
    mission = tmp_path / "corner.yaml"
    mission.write_text(
        "robot: {radius_m: 0.5}\nroute: {start: [0, 0], via: [[40, 0]], goal: [0, 3]}\n"
        "spline: {knots: uniform, tension: 0.6}\n"
    )
    page = visit(mission)
    assert page.plan["drivability"]["verdict"] == "rough"
    page.page.locator(".drives summary").click()
    first = page.page.locator(".drives li button").first
    assert first.inner_text().startswith("Nearly a cusp: it turns by ")
    first.click()
    reason = page.plan["drivability"]["reasons"][0]
    assert near([page.js("studio.camera.x"), page.js("studio.camera.y")], reason["at"][:2], 0.01)
    assert page.js("studio.store.cursor") == reason["distance_m"]
    page.js("studio.store.edit({...studio.store.doc, route: {start: [0, 0], goal: [40, 0]}})")
    page.settle()
    assert page.page.locator(".drives.is-good").inner_text() == "drives well"


def test_everything_can_be_done_without_a_mouse(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    page.page.focus("#map")
    page.press("Tab", "Tab")
    assert page.js("studio.store.selection") == "via:0"
    at = page.doc["route"]["via"][0]
    page.press("ArrowRight", "ArrowRight", "ArrowUp")
    moved = page.doc["route"]["via"][0]
    assert moved[0] > at[0]
    assert moved[1] > at[1]
    page.press("Alt+ArrowDown")
    assert page.doc["route"]["via"][1] == moved
    page.press("Enter")
    page.page.keyboard.type("mast")
    page.press("Tab")
    assert page.doc["route"]["via"][1]["name"] == "mast"
    page.press("Escape")
    page.press("a", "ArrowRight", "Enter", "Escape", "Escape")
    assert len(page.doc["route"]["via"]) == 6
    page.press("p", "Enter")
    for key in ("Shift+ArrowRight", "Shift+ArrowUp"):
        page.press(key, "Enter")
    page.press("Enter")
    assert len(page.doc["world"]["known"][-1]["polygon"]) == 3
    page.press("Delete")
    assert len(page.doc["world"]["known"]) == 4
    page.press("?")
    assert page.page.locator("#help").is_visible()
    page.press("Escape")
    assert not page.page.locator("#help").is_visible()


def test_the_map_zooms_to_the_cursor_and_moves(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    x, y = page.place([290, 390])
    page.page.mouse.move(x, y)  # wheels tell whole pixels
    scale = page.js("studio.camera.scale")
    page.page.mouse.wheel(0, -400)
    page.until(f"studio.camera.scale > {scale}")
    assert near(list(page.place([290, 390])), [x, y], 1.5)
    page.page.mouse.move(x, y + 40)
    page.page.mouse.down(button="middle")
    page.page.mouse.move(x + 30, y + 50)
    page.page.mouse.up(button="middle")
    assert near(list(page.place([290, 390])), [x + 30, y + 10], 3)


def test_a_narrow_screen_with_fingers_works(visit: Visit, patrol: Path) -> None:
    page = visit(patrol, width=390, height=844, has_touch=True, is_mobile=True, color_scheme="dark")
    assert page.js("document.documentElement.scrollWidth <= innerWidth")
    page.page.get_by_role("tab", name="Selection").tap()
    page.settle()
    page.page.touchscreen.tap(*page.place([290, 390]))
    page.settle()
    assert page.js("studio.store.selection") == "via:3"
    assert page.page.get_by_label("Dwell in s").is_visible()
    page.page.get_by_role("tab", name="Drive").tap()
    page.page.get_by_role("button", name="Drive", exact=True).tap()
    page.page.wait_for_selector("body.is-driving")
    scale = page.js("studio.camera.scale")
    page.js(PINCH)
    assert page.js("studio.camera.scale") > 1.5 * scale


PINCH = """() => {
  const map = studio.scene.canvas, box = map.getBoundingClientRect();
  const send = (type, id, x) => map.dispatchEvent(new PointerEvent(type, {
    pointerId: id, pointerType: "touch", clientX: box.left + x, clientY: box.top + 200,
  }));
  send("pointerdown", 1, 150); send("pointerdown", 2, 200);
  for (let i = 1; i <= 10; i++) {
    send("pointermove", 1, 150 - 4 * i);
    send("pointermove", 2, 200 + 4 * i);
  }
  send("pointerup", 1, 110); send("pointerup", 2, 240);
}"""


def test_a_map_is_put_underneath(visit: Visit) -> None:
    page = visit(EXAMPLES / "depot-round.yaml")
    page.until(
        "(() => { const all = [...studio.scene.maps.images.values()];"
        "return all.length === 2 && all.every(i => i.complete); })()"
    )
    assert page.plan["ok"]
    page.js("studio.files.addMap()")
    page.page.get_by_role("button", name="maps/Boston_0_256.map").click()
    page.settle()
    assert page.doc["world"]["known"][-1] == {"map": "maps/Boston_0_256.map"}
