"""The page in a real browser: laid out, planned, driven, saved, with a mouse and without one."""

from __future__ import annotations

import base64
import random
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from viaspline.cli import cli
from viaspline.formats.load import load, origin_of
from viaspline.mission.document import read_document
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.studio import planning

EXAMPLES = Path(__file__).parents[2] / "examples"
Start = Callable[..., Any]

PLACE = """([x, y]) => {
  const box = studio.scene.canvas.getBoundingClientRect();
  const [px, py] = studio.camera.toScreen(x, y);
  return [px + box.left, py + box.top];
}"""


class Page:
    """A page of the studio, in the words of the person before it."""

    def __init__(self, page: Any, url: str) -> None:
        self.page = page
        self.errors: list[str] = []
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", lambda m: self.errors.append(m.text) if m.type == "error" else None)
        self.open(url)

    def open(self, url: str) -> None:
        self.page.goto(url)
        self.page.wait_for_selector("body[data-ready]", timeout=240_000)
        self.settle()

    def js(self, script: str, argument: Any = None) -> Any:
        return self.page.evaluate(script, argument)

    def until(self, script: str) -> None:
        """Wait for something to become true; the page forbids waiting by eval."""
        deadline = time.monotonic() + 60
        while not self.js(script):
            assert time.monotonic() < deadline, script
            self.page.wait_for_timeout(10)

    def settle(self) -> None:
        self.until("studio.store.plan?.rev === studio.store.revision")
        self.page.wait_for_timeout(120)  # the panels follow

    @property
    def doc(self) -> Any:
        return self.js("studio.store.doc")

    @property
    def plan(self) -> Any:
        return self.js("studio.store.plan")

    def place(self, at: list[float]) -> tuple[float, float]:
        x, y = self.js(PLACE, at)
        return x, y

    def drag(self, start: list[float], end: list[float]) -> None:
        x, y = self.place(start)
        ex, ey = self.place(end)
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        mouse.move((x + ex) / 2, (y + ey) / 2, steps=4)
        mouse.move(ex, ey, steps=4)
        mouse.up()
        self.settle()

    def click(self, at: list[float]) -> None:
        self.page.mouse.click(*self.place(at))
        self.settle()

    def press(self, *keys: str) -> None:
        for key in keys:
            self.page.keyboard.press(key)
        self.settle()


@pytest.fixture
def visit(browser: Any, start: Start) -> Iterator[Callable[..., Page]]:
    """Opens pages, and finds no error in any of them at the end."""
    contexts, pages = [], []

    def open_page(
        mission: Path | Any, *, width: int = 1280, height: int = 820, **options: Any
    ) -> Page:
        studio = mission if hasattr(mission, "url") else start(mission)
        context = browser.new_context(
            viewport={"width": width, "height": height}, accept_downloads=True, **options
        )
        contexts.append(context)
        pages.append(Page(context.new_page(), studio.url))
        return pages[-1]

    yield open_page
    errors = [error for page in pages for error in page.errors]
    for context in contexts:
        context.close()
    assert errors == []


def near(a: list[float], b: list[float], tolerance: float = 2.0) -> bool:
    return abs(a[0] - b[0]) < tolerance and abs(a[1] - b[1]) < tolerance


def test_points_are_added_dragged_deleted_and_all_of_it_undone(
    visit: Callable[..., Page], patrol: Path
) -> None:
    page = visit(patrol)
    before = page.doc
    page.press("a")
    page.click([440, 420])
    assert near(page.doc["route"]["via"][5], [440, 420])
    page.press("Escape")
    page.drag([440, 420], [380, 440])
    assert near(page.doc["route"]["via"][5], [380, 440])
    assert page.plan["ok"]
    assert any(near(via[1:3], [380, 440]) for via in page.plan["vias"])
    page.press("Delete")
    assert page.doc == before
    for _ in range(3):
        page.press("Control+z")
    assert page.doc == before
    page.press("Control+Shift+z", "Control+y")
    assert near(page.doc["route"]["via"][5], [380, 440])


def test_a_double_click_on_the_path_adds_a_point_in_its_leg(
    visit: Callable[..., Page], patrol: Path
) -> None:
    page = visit(patrol)
    at = page.js(
        "(() => { const c = studio.store.curve, p = c.at(0.55 * c.length); return [p.x, p.y]; })()"
    )
    page.page.mouse.dblclick(*page.place(at))
    page.settle()
    assert near(page.doc["route"]["via"][3], at)
    assert len(page.doc["route"]["via"]) == 6


def test_obstacles_are_drawn_moved_sized_and_marked_as_unseen(
    visit: Callable[..., Page], patrol: Path
) -> None:
    page = visit(patrol)
    count = len(page.doc["world"]["known"])
    page.press("c")
    page.drag([210, 400], [225, 400])
    circle = page.doc["world"]["known"][count]["circle"]
    assert near(circle["center"], [210, 400])
    assert abs(circle["radius"] - 15) < 2
    page.drag([225, 400], [240, 400])  # the handle of its radius
    assert abs(page.doc["world"]["known"][count]["circle"]["radius"] - 30) < 2
    page.drag([205, 405], [255, 425])
    assert near(page.doc["world"]["known"][count]["circle"]["center"], [260, 420])
    page.press("p")
    for at in ([60, 150], [100, 150], [80, 190]):
        page.click(at)
    page.press("Enter")
    polygon = page.doc["world"]["known"][count + 1]["polygon"]
    assert len(polygon) == 3
    page.drag([80, 190], [80, 205])  # a corner
    assert near(page.doc["world"]["known"][count + 1]["polygon"][2], [80, 205])
    page.click([80, 170])
    page.press("u")
    assert len(page.doc["world"]["known"]) == count + 1
    assert near(page.doc["world"]["unseen"][-1]["polygon"][2], [80, 205])


def test_a_heading_is_turned_by_its_handle(visit: Callable[..., Page], patrol: Path) -> None:
    page = visit(patrol)
    page.click([50, 250])
    x, y = page.place([50, 250])
    reach = 44 * 2**-0.5
    page.page.mouse.move(x + reach, y - reach)
    page.page.mouse.down()
    page.page.mouse.move(x + 10, y - 60, steps=3)
    page.page.mouse.move(x, y - 70, steps=3)
    page.page.mouse.up()
    page.settle()
    assert abs(page.doc["route"]["start"]["heading_deg"] - 90) <= 2


def test_the_losing_side_is_taken_by_a_click_and_freed_again(
    visit: Callable[..., Page], patrol: Path
) -> None:
    page = visit(patrol)
    (entry,) = page.js("studio.store.ledger")
    loser = next(c for c in entry["candidates"] if not c["chosen"])
    middle = 8 * (len(loser["spans"]) // 16)
    page.click(loser["spans"][middle : middle + 2])
    assert page.doc["world"]["known"][0]["pass_on"] == loser["side"]
    (entry,) = page.js("studio.store.ledger")
    assert next(c["side"] for c in entry["candidates"] if c["chosen"]) == loser["side"]
    page.page.get_by_role("button", name="forced · free it").click()
    page.settle()
    assert "pass_on" not in page.doc["world"]["known"][0]


def test_a_span_is_tightened_by_dragging_it_and_by_its_slider(
    visit: Callable[..., Page], patrol: Path
) -> None:
    page = visit(patrol)
    at = page.js(
        "(() => { const c = studio.store.curve; const [a, b] = c.legRange(2);"
        "const p = c.at((a + b) / 2); return [p.x, p.y]; })()"
    )
    page.drag(at, [at[0], at[1] - 12])
    tension = page.doc["spline"]["tension"]
    assert len(tension) == 6
    assert tension[2] < 0.1
    assert tension[0] == 0.1
    page.page.get_by_role("slider", name="Tension of this span").fill("0.8")
    page.settle()
    assert page.doc["spline"]["tension"][2] == 0.8
    assert page.plan["ok"]


def test_without_a_path_the_page_says_why_and_its_button_helps(
    visit: Callable[..., Page], patrol: Path
) -> None:
    page = visit(patrol)
    page.drag([90, 330], [120, 255])
    assert not page.plan["ok"]
    assert "inside obstacle 'well'" in page.page.locator("#summary").inner_text()
    page.page.get_by_role("button", name="Move via 1 to").click()
    page.settle()
    assert page.plan["ok"]


def test_while_a_slow_plan_is_made_the_old_path_is_shown_as_such_and_the_newest_edit_counts(
    visit: Callable[..., Page], patrol: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def endless(mission: Mission) -> Plan:
        while mission.route.via and mission.route.via[0].at[0] == 99:
            pass
        return plan(mission)

    page = visit(patrol)
    monkeypatch.setattr(planning, "plan", endless)
    move = """x => {
      const doc = structuredClone(studio.store.doc);
      doc.route.via[0] = [x, 330];
      studio.store.edit(doc);
    }"""
    page.js(move, 99)
    page.until("studio.store.isLate")
    page.until("document.querySelector('.status-text').textContent === 'planning'")
    page.js(move, 91)
    page.settle()
    assert not page.js("studio.store.isLate")
    assert page.plan["vias"][1][1:3] == [91, 330]
    assert "proven clear" in page.page.locator("#status").inner_text()


def test_a_drive_is_played_to_the_goal_with_its_events(
    visit: Callable[..., Page], patrol: Path
) -> None:
    page = visit(patrol)
    page.page.get_by_role("button", name="Drive", exact=True).click()
    page.page.wait_for_selector("body.is-driving")
    assert len(page.page.query_selector_all("#marks .mark.is-replan")) == 2
    page.page.select_option("#factor", "50")
    page.js("studio.drive.seek(140)")
    page.until("studio.drive.stay() !== null")
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


def test_what_is_saved_opens_again_and_plans_the_same_bytes(
    visit: Callable[..., Page], patrol: Path
) -> None:
    page = visit(patrol)
    page.drag([270, 150], [260, 120])
    assert "edited" in page.page.locator("#file-name").inner_text()
    page.press("Control+s")
    page.page.wait_for_selector("#file-name:not(:has(.dirty))")
    assert read_document(patrol).data == page.doc
    assert "# on the map" in patrol.read_text()
    with page.page.expect_download() as caught:
        page.press("Control+e")
        page.page.get_by_role("button", name="plan.json").click()
    result = CliRunner().invoke(
        cli, ["plan", str(patrol), "--out", str(patrol.parent / "out"), "-q"]
    )
    assert result.exit_code == 0
    assert Path(caught.value.path()).read_bytes() == (patrol.parent / "out/plan.json").read_bytes()
    page.press("Escape")
    page.press("Control+o")
    page.page.get_by_role("button", name=patrol.name).click()
    page.page.wait_for_selector("dialog", state="hidden")
    page.settle()
    assert page.doc == read_document(patrol).data


def test_a_mission_is_saved_as_a_plan_and_what_it_can_not_carry_is_shown(
    visit: Callable[..., Page], patrol: Path
) -> None:
    page = visit(patrol)
    page.drag([270, 150], [260, 120])
    edited = page.doc
    page.js("studio.files.saveAs()")
    assert page.page.get_by_label("Origin").is_hidden()
    page.page.get_by_label("Kind of file").select_option(".plan")
    assert page.page.get_by_label("File name").input_value() == f"{patrol.stem}.plan"
    page.page.get_by_role("button", name="Save", exact=True).last.click()
    page.page.get_by_role("alert").filter(has_text="origin").wait_for()
    page.page.get_by_label("Origin").fill("47.3977, 8.5456")
    page.page.get_by_role("button", name="Save", exact=True).last.click()
    page.page.get_by_text("unseen obstacle: crate").wait_for()
    page.page.get_by_role("button", name="OK").click()
    assert "edited" in page.page.locator("#file-name").inner_text()  # the file isn't all of it
    plan = load(patrol.with_suffix(".plan"))
    assert len(plan.route.via) == len(edited["route"]["via"])
    assert origin_of(patrol.with_suffix(".plan")) == (47.3977, 8.5456)


def test_a_closed_tab_loses_nothing(visit: Callable[..., Page], patrol: Path) -> None:
    page = visit(patrol)
    page.drag([270, 150], [260, 120])
    edited = page.doc
    url = page.page.url
    context = page.page.context
    page.page.close(run_before_unload=True)
    again = Page(context.new_page(), url)
    assert again.doc == edited
    again.page.get_by_role("button", name="Drop them").click()
    assert again.doc == read_document(patrol).data


def test_an_address_restores_the_scene(
    visit: Callable[..., Page], patrol: Path, start: Start
) -> None:
    studio = start(patrol)
    page = visit(studio)
    page.drag([270, 150], [260, 120])
    page.js("studio.files.link()")
    page.until("location.hash.length > 20")
    other = visit(studio)
    other.page.goto("about:blank")
    other.open(page.page.url)
    other.until("studio.store.dirty")
    assert other.doc == page.doc


def test_everything_can_be_done_without_a_mouse(visit: Callable[..., Page], patrol: Path) -> None:
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


def test_the_map_zooms_to_the_cursor_and_moves(visit: Callable[..., Page], patrol: Path) -> None:
    page = visit(patrol)
    x, y = page.place([290, 390])
    page.page.mouse.move(x, y)  # wheels tell whole pixels
    page.page.mouse.wheel(0, -400)
    page.page.wait_for_timeout(100)
    assert near(list(page.place([290, 390])), [x, y], 1.5)
    page.page.mouse.move(x, y + 40)
    page.page.mouse.down(button="middle")
    page.page.mouse.move(x + 30, y + 50)
    page.page.mouse.up(button="middle")
    assert near(list(page.place([290, 390])), [x + 30, y + 10], 3)


def test_a_narrow_screen_with_fingers_works(visit: Callable[..., Page], patrol: Path) -> None:
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


def test_a_map_is_put_underneath(visit: Callable[..., Page]) -> None:
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


def test_the_page_comes_back_when_the_studio_does(visit: Callable[..., Page], patrol: Path) -> None:
    page = visit(patrol)
    page.js("studio.link.socket.close()")
    page.until("studio.link.socket === null")
    page.js(
        "(() => { const { doc } = studio.store;"
        "studio.store.edit({...doc, robot: {...doc.robot, radius_m: 0.7}}); })()"
    )
    page.settle()
    assert page.plan["ok"]


def test_three_hundred_random_edits_end_where_the_command_line_does(
    visit: Callable[..., Page], patrol: Path
) -> None:
    page = visit(patrol)
    random_edits(page, random.Random(5), 300)
    assert page.js("studioMend()")
    page.settle()
    name = "fuzzed.yaml"
    page.js(f"studio.files.write('{name}', true)")
    page.until(f"studio.store.name === '{name}'")
    assert read_document(patrol.parent / name).data == page.doc
    result = CliRunner().invoke(
        cli, ["plan", str(patrol.parent / name), "--out", str(patrol.parent / "out"), "-q"]
    )
    assert result.exit_code == 0, result.output
    answer = page.js("studio.link.ask({type: 'export', kind: 'plan.json'})")
    assert base64.b64decode(answer["data"]) == (patrol.parent / "out/plan.json").read_bytes()


def random_edits(page: Page, source: random.Random, count: int) -> None:
    """Edits in a row, as fast as the page takes them; see also benchmarks/studio_fuzz.py."""
    script = (Path(__file__).parents[2] / "benchmarks" / "studio_fuzz.js").read_text()
    page.js(script)
    page.js("([seed, count]) => studioFuzz(seed, count)", [source.randrange(2**31), count])
