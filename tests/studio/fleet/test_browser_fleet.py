"""A fleet is laid out with a mouse in a real browser, and all of its robots are played."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from viaspline.formats.yaml_document import read_document

Visit = Callable[..., Any]

TEXT = """\
world:
  bounds: [-10, -30, 60, 30]
  known:   # on the map
    - {name: rock, circle: {center: [10, 8], radius: 2}}
separation_m: 1.0
robots:
  cart: {radius_m: 0.8, clearance_m: 0.3}
fleet:
  - {name: east, robot: cart, route: {start: [0, 0], via: [[12, 0]], goal: [40, 0]}}   # first
  - name: north
    robot: cart
    priority: 2
    route: {start: [20, -20], via: [[20, -8]], goal: [20, 20]}
  - {name: own, mission: own.yaml}
"""
COLOUR_AT = """([x, y]) => {
  studio.scene.draw();
  const { canvas, ctx } = studio.scene;
  const ratio = canvas.width / studio.camera.width;
  const [px, py] = studio.camera.toScreen(x, y);
  return [...ctx.getImageData(Math.round(px * ratio), Math.round(py * ratio), 1, 1).data];
}"""
PLACE_OF = """([name, time]) => {
  const { curve } = studio.store.fleetPlan.byName.get(name);
  const at = curve.at(curve.distanceAt(time));
  return [at.x, at.y];
}"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "own.yaml").write_text(
        "robot: {radius_m: 0.8}\nroute: {start: [0, -15], via: [[30, -14]], goal: [50, -15]}\n"
    )
    path = tmp_path / "fleet.yaml"
    path.write_text(TEXT)
    return path


def fleet(page: Any) -> Any:
    return page.js("studio.store.file")


def text(page: Any, place: str) -> str:
    return str(page.page.locator(place).inner_text())


def test_a_fleet_opens_with_its_robots_its_proof_and_who_waits(visit: Visit, file: Path) -> None:
    page = visit(file)
    assert text(page, "#robot-count") == "3"
    for name in ("east", "north", "own"):
        assert name in text(page, "#robot-list")
    assert "proven apart" in text(page, "#status")
    proof = text(page, "#fleet-proof")
    assert "3 of 3" in proof
    assert "east waits" in proof
    assert page.js("studio.store.fleetPlan.certificate.separation") >= 1.0
    assert page.plan["length"] == pytest.approx(40, abs=0.1)


def test_a_robot_is_chosen_in_the_list_and_by_its_path(visit: Visit, file: Path) -> None:
    page = visit(file)
    page.page.get_by_role("button", name="robot north").click()
    page.settle()
    assert page.doc["route"]["start"] == [20, -20]
    assert page.plan["length"] == pytest.approx(40, abs=0.1)
    page.click([33, 0])  # the path of another one
    assert page.js("studio.store.robot") == 0
    assert page.doc["route"]["goal"] == [40, 0]
    assert page.js("studio.store.selection") is None


def test_a_via_point_of_any_robot_is_dragged_and_only_that_one_is_laid_again(
    visit: Visit, file: Path
) -> None:
    page = visit(file)
    paths = "[...studio.store.fleetPlan.byName.values()].map(({path}) => path.spans)"
    before = page.js(paths)
    page.drag([20, -8], [24, -6])
    assert page.js("studio.store.robot") == 1
    x, y = fleet(page)["fleet"][1]["route"]["via"][0]
    assert abs(x - 24) < 1
    assert abs(y + 6) < 1
    after = page.js(paths)
    assert after[0] == before[0]
    assert after[1] != before[1]
    assert after[2] == before[2]
    assert page.js("studio.store.fleetPlan.certificate.holds")
    page.press("Control+z")
    assert fleet(page) == read_document(file).data
    assert page.js(paths) == before


def test_points_are_added_to_the_robot_that_is_chosen_and_taken_out(
    visit: Visit, file: Path
) -> None:
    page = visit(file)
    page.page.get_by_role("button", name="robot north").click()
    page.press("a")
    page.click([25, 10])
    assert len(fleet(page)["fleet"][1]["route"]["via"]) == 2
    assert len(fleet(page)["fleet"][0]["route"]["via"]) == 1
    page.press("Escape", "Delete")
    assert fleet(page) == read_document(file).data


def test_the_scrubber_plays_every_robot(visit: Visit, file: Path) -> None:
    page = visit(file)
    end = page.js("studio.preview.end")
    assert end == max(
        page.js(f"studio.store.fleetPlan.byName.get('{n}').law.times.at(-1)")
        for n in ("east", "north", "own")
    )
    page.show()
    scrub = page.page.locator("#scrub")
    scrub.fill(str(round(end / 3, 1)))
    time = page.js("studio.preview.time")
    assert abs(time - end / 3) < 0.2
    seen = set()
    for name in ("east", "north", "own"):
        x, y = page.js(PLACE_OF, [name, time])
        red, green, blue, _ = page.js(COLOUR_AT, [x - 0.3, y - 0.4])
        assert max(red, green, blue) - min(red, green, blue) > 60  # on its disc
        seen.add((red, green, blue))
    assert len(seen) == 3
    page.page.get_by_role("button", name="Play the plan", exact=True).click()
    page.until(f"studio.preview.time > {time} + 1")
    page.page.get_by_role("button", name="Pause the plan", exact=True).click()


def test_a_fleet_is_driven_and_the_drive_is_played(visit: Visit, file: Path) -> None:
    page = visit(file)
    page.page.get_by_role("button", name="Drive", exact=True).click()
    page.until("studio.drive.run && studio.drive.isPlaying")
    page.page.get_by_role("button", name="Pause", exact=True).click()
    assert page.js("studio.drive.run.reached")
    end = page.js("studio.drive.end")
    page.page.locator("#scrub").fill(str(round(end / 2, 1)))
    for name in ("east", "north", "own"):
        x, y, speed = page.js(
            "([name]) => { const { x, y, speed } = studio.drive.run.fleet.stateOf(name, "
            "studio.drive.time); return [x, y, speed]; }",
            [name],
        )
        red, green, blue, _ = page.js(COLOUR_AT, [x - 0.3, y - 0.4])
        assert max(red, green, blue) - min(red, green, blue) > 60  # on its disc
        assert speed >= 0.0
    page.page.locator("#scrub").fill(str(end))
    assert "all arrived in" in text(page, "#drive-note")
    proven = page.page.locator("#drive-note").get_by_role("link", name="proven")
    assert proven.get_attribute("href") == "/page/proven.html#fleets-and-space"
    page.page.get_by_role("button", name="robot north").click()
    assert page.js("studio.drive.run !== null")  # another one is looked at, the drive stays
    page.page.get_by_role("button", name="Back to editing").click()
    assert page.js("studio.drive.run") is None
    page.page.get_by_role("button", name="Drive", exact=True).click()
    page.until("studio.drive.run")
    page.drag([20, -8], [22, -6])
    assert page.js("studio.drive.run") is None  # it was driven on other paths


def test_what_is_said_of_a_kind_goes_for_all_of_it(visit: Visit, file: Path) -> None:
    page = visit(file)
    field = page.page.get_by_label("Top speed in m/s", exact=True)
    field.fill("1.5")
    field.press("Enter")
    page.settle()
    assert fleet(page)["robots"]["cart"]["max_speed_mps"] == 1.5
    priority = page.page.get_by_label("Priority")
    priority.fill("5")
    priority.press("Enter")
    page.settle()
    assert fleet(page)["fleet"][0]["priority"] == 5
    assert page.js("studio.store.fleetPlan.waits[0].robot") == "north"


def test_a_robot_is_added_beside_another_and_taken_out(visit: Visit, file: Path) -> None:
    page = visit(file)
    page.page.get_by_role("button", name="Add a robot").click()
    page.settle()
    assert [one["name"] for one in fleet(page)["fleet"]] == ["east", "north", "own", "r4"]
    assert page.js("studio.store.robot") == 3
    assert page.plan["ok"]
    page.page.get_by_role("button", name="Take this robot out").click()
    page.settle()
    assert fleet(page) == read_document(file).data


def test_the_route_of_a_robot_with_a_file_is_shown_and_not_edited(visit: Visit, file: Path) -> None:
    page = visit(file)
    page.drag([30, -14], [30, -20])
    assert page.js("studio.store.robot") == 2
    assert page.doc["route"]["via"] == [[30, -14]]
    assert fleet(page) == read_document(file).data
    assert "own.yaml" in text(page, "#toasts")
    assert "only shown" in text(page, "#robot-fields")
    page.page.locator("#robot-fields").get_by_role("button", name="Open own.yaml").click()
    page.until("studio.store.name === 'own.yaml'")
    assert page.doc["route"]["via"] == [[30, -14]]


def test_a_fault_is_told_with_its_robot_and_its_button_helps(visit: Visit, file: Path) -> None:
    page = visit(file)
    page.drag([12, 0], [10, 7])
    page.page.get_by_role("button", name="robot own").click()
    page.show()
    assert "east: via 1" in text(page, "#summary")
    page.page.get_by_role("button", name="Move east: via 1 to").click()
    page.settle()
    assert page.js("studio.store.robot") == 0
    assert page.plan["ok"]


def test_what_is_saved_keeps_its_comments(visit: Visit, file: Path) -> None:
    page = visit(file)
    page.drag([12, 0], [14, -2])
    page.press("Control+s")
    page.page.wait_for_selector("#file-name:not(:has(.dirty))")
    saved = file.read_text()
    assert read_document(file).data == fleet(page)
    assert "# on the map" in saved
    assert "# first" in saved


def test_a_mission_is_made_a_fleet_and_back_again(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    before = page.doc
    assert page.page.locator("#fleet-section").is_hidden()
    page.page.get_by_role("button", name="More").click()
    page.page.get_by_role("menuitem", name="Make a fleet of it").click()
    page.settle()
    assert fleet(page)["fleet"][0]["route"] == before["route"]
    assert page.doc["route"] == before["route"]
    page.press("Control+z")
    assert page.doc == before
    assert page.plan["ok"]
