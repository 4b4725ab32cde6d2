"""A mission is laid out with a mouse in a real browser, and planned meanwhile."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.studio import plan_document

Visit = Callable[..., Any]


def near(a: list[float], b: list[float], tolerance: float = 2.0) -> bool:
    return abs(a[0] - b[0]) < tolerance and abs(a[1] - b[1]) < tolerance


def test_points_are_added_dragged_deleted_and_all_of_it_undone(visit: Visit, patrol: Path) -> None:
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


def test_a_double_click_on_the_path_adds_a_point_in_its_leg(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    at = page.js(
        "(() => { const c = studio.store.curve, p = c.at(0.55 * c.length); return [p.x, p.y]; })()"
    )
    page.page.mouse.dblclick(*page.place(at))
    page.settle()
    assert near(page.doc["route"]["via"][3], at)
    assert len(page.doc["route"]["via"]) == 6


def test_obstacles_are_drawn_moved_sized_and_marked_as_unseen(visit: Visit, patrol: Path) -> None:
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


def test_a_heading_is_turned_by_its_handle(visit: Visit, patrol: Path) -> None:
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


def test_the_losing_side_is_taken_by_a_click_and_freed_again(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    (entry,) = page.js("studio.store.ledger")
    loser = next(c for c in entry["candidates"] if not c["chosen"])
    middle = 8 * (len(loser["spans"]) // 16)
    page.click(loser["spans"][middle : middle + 2])
    assert page.doc["world"]["known"][0]["pass_on"] == loser["side"]
    (entry,) = page.js("studio.store.ledger")
    assert next(c["side"] for c in entry["candidates"] if c["chosen"]) == loser["side"]
    page.page.get_by_role("button", name=f"forced {loser['side']} · free it").click()
    page.settle()
    assert "pass_on" not in page.doc["world"]["known"][0]


def test_a_span_is_tightened_by_dragging_it_and_by_its_slider(visit: Visit, patrol: Path) -> None:
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


def test_without_a_path_the_page_says_why_and_its_button_helps(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    page.drag([90, 330], [120, 255])
    assert not page.plan["ok"]
    assert "inside obstacle 'well'" in page.page.locator("#summary").inner_text()
    page.page.get_by_role("button", name="Move via 1 to").click()
    page.settle()
    assert page.plan["ok"]


def test_while_a_slow_plan_is_made_the_old_path_is_shown_as_such_and_the_newest_edit_counts(
    visit: Visit, patrol: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def endless(mission: Mission) -> Plan:
        while mission.route.via and mission.route.via[0].at[0] == 99:
            pass
        return plan(mission)

    page = visit(patrol)
    monkeypatch.setattr(plan_document, "plan", endless)
    move = """x => {
      const doc = structuredClone(studio.store.doc);
      doc.route.via[0] = [x, 330];
      studio.store.edit(doc);
    }"""
    page.js(move, 99)
    page.until("studio.store.isLate")
    page.until("document.querySelector('.status-text').textContent === 'planning'")
    page.until("document.querySelector('#summary').classList.contains('is-late')")
    colours = page.js(
        """['.proof-figure', '.hint'].map(
          one => getComputedStyle(document.querySelector(`#right ${one}`)).color
        )"""
    )
    assert colours[0] == colours[1]  # grey: it was proven of another document
    page.js(move, 91)
    page.settle()
    assert not page.js("studio.store.isLate")
    page.until("!document.querySelector('#summary').classList.contains('is-late')")
    assert page.plan["vias"][1][1:3] == [91, 330]
    assert "proven clear" in page.page.locator("#status").inner_text()


def test_more_clearance_is_preferred_by_a_slider_that_plans_while_it_is_dragged(
    visit: Visit, patrol: Path
) -> None:
    page = visit(patrol)
    before = page.plan["certificate"]
    slider = page.page.get_by_role("slider", name="Clearance liked beyond that")
    slider.fill("0.4")
    page.settle()
    assert page.doc["robot"]["prefer_clearance_m"] == 0.4
    after = page.plan["certificate"]
    assert after["required"] == before["required"]
    assert after["clearance"] > before["clearance"] + 0.1
    slider.fill("0")
    page.settle()
    assert "prefer_clearance_m" not in page.doc["robot"]
    assert page.plan["certificate"] == before


def test_what_sides_are_chosen_by_is_asked_for_in_the_form(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    choice = page.page.get_by_label("Sides and shapes with the least")
    assert choice.input_value() == "length"
    choice.select_option("time")
    page.settle()
    assert "optimise" not in page.doc["route"]
    choice.select_option("length")
    page.settle()
    assert page.doc["route"]["optimise"] == "length"


def test_each_side_is_listed_with_its_length_and_its_time(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    (entry,) = page.js("studio.store.ledger")
    for candidate in entry["candidates"]:
        words = page.page.locator(f".side:has-text('{candidate['side']}')").inner_text()
        assert f"{candidate['length']:.1f} m" in words
        minutes, seconds = divmod(round(candidate["duration"]), 60)
        short = f"{candidate['duration']:.1f} s"
        assert (
            f"{minutes} min {seconds:02d} s" if candidate["duration"] >= 100 else short
        ) in words


def test_a_tension_is_suggested_and_taken(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    page.js("studio.store.edit({...studio.store.doc, spline: {tension: -0.5}})")
    page.settle()
    slow = page.plan["duration"]
    page.page.get_by_role("button", name="Suggest a tension").click()
    page.until("document.querySelector('#settings').innerText.includes('Suggested: ')")
    page.page.get_by_role("button", name="Take it").click()
    page.settle()
    assert page.doc["spline"] != {"tension": -0.5}
    assert page.plan["duration"] < slow
    page.press("Control+z")
    assert page.doc["spline"] == {"tension": -0.5}
