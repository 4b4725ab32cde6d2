"""Areas and the robot's parts in a real browser: drawn, dragged, typed, and planned with."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
Visit = Callable[..., Any]


def near(a: list[float], b: list[float], tolerance: float = 2.0) -> bool:
    return abs(a[0] - b[0]) < tolerance and abs(a[1] - b[1]) < tolerance


def test_a_speed_zone_is_drawn_shaped_slowed_and_deleted(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    before = page.plan["duration"]
    page.press("z")
    for at in ([220, 330], [350, 330], [350, 440], [220, 440]):
        page.click(at)
    page.press("Enter")
    (zone,) = page.doc["world"]["speed_zones"]
    assert near(zone["polygon"][2], [350, 440])
    page.page.get_by_label("Top speed in it").fill("0.2")
    page.press("Tab")
    assert page.doc["world"]["speed_zones"][0]["max_speed_mps"] == 0.2
    assert page.plan["duration"] > 1.2 * before
    page.drag([350, 440], [370, 450])  # a corner
    assert near(page.doc["world"]["speed_zones"][0]["polygon"][2], [370, 450])
    page.drag([285, 330], [285, 340])  # the middle of an edge: a new corner
    assert len(page.doc["world"]["speed_zones"][0]["polygon"]) == 5
    assert page.page.get_by_role("button", name="zone 1, speed zone").is_visible()
    page.press("Escape")
    page.page.get_by_role("button", name="zone 1, speed zone").click()
    page.page.get_by_label("Name", exact=True).fill("yard")
    page.press("Tab")
    assert page.doc["world"]["speed_zones"][0]["name"] == "yard"
    page.page.get_by_role("button", name="yard, speed zone").click()
    page.press("Delete")
    assert "speed_zones" not in page.doc["world"]
    assert page.plan["duration"] == before


def test_a_zone_that_is_gone_round_is_listed_with_the_way_through(
    visit: Visit, tmp_path: Path
) -> None:
    lab = "{polygon: [[40, -10], [60, -10], [60, 6], [40, 6]], max_speed_mps: 0.5, name: lab}"
    mission = tmp_path / "lab.yaml"
    mission.write_text(
        f"world:\n  speed_zones: [{lab}]\nroute: {{start: [0, 0], goal: [100, 0]}}\n"
    )
    page = visit(mission)
    (entry,) = page.js("studio.store.ledger")
    assert entry["members"] == ["speed zone 'lab'"]
    through = page.page.locator(".side:has-text('through')")
    assert "100.0 m" in through.inner_text()
    assert through.is_disabled()


def test_a_fence_is_drawn_and_moved_without_a_mouse(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    page.page.focus("#map")
    page.press("b")
    for key in ("Shift+ArrowLeft", "Shift+ArrowDown", "Shift+ArrowRight"):
        page.press(key, "Enter")
    page.press("Enter")
    ring = page.doc["world"]["fences"][0]
    assert len(ring) == 3
    assert not page.plan["ok"]  # the route leaves it
    page.press("ArrowRight")
    moved = page.doc["world"]["fences"][0]
    assert all(b[0] > a[0] and b[1] == a[1] for a, b in zip(ring, moved, strict=True))
    page.press("Tab")
    assert page.js("studio.store.selection") == "fence:0:0"
    page.press("ArrowUp")
    assert page.doc["world"]["fences"][0][0][1] > moved[0][1]
    page.press("Shift+Tab", "Delete")
    assert "fences" not in page.doc["world"]
    assert page.plan["ok"]


@pytest.mark.slow
def test_the_robot_gets_a_polygon_for_a_body_and_a_drive(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    field = page.page.get_by_label
    field("Body", exact=True).select_option("polygon")
    page.settle()
    field("Corners").fill("nonsense 3")
    page.press("Tab")
    assert field("Corners").get_attribute("aria-invalid") == "true"
    field("Corners").fill("-1 -0.8, 3 -0.8; (3, 0.8) -1 0.8")
    page.press("Tab")
    robot = page.doc["robot"]
    assert robot["footprint"] == [[-1, -0.8], [3, -0.8], [3, 0.8], [-1, 0.8]]
    assert "radius_m" not in robot
    field("Turning radius").fill("4")
    page.press("Tab")
    assert page.doc["robot"]["min_turn_radius_m"] == 4
    assert page.plan["ok"]
    assert page.plan["curvature"] <= 0.25 + 1e-9
    field("Drive", exact=True).select_option("ackermann")
    page.settle()
    field("Wheelbase").fill("2")
    page.press("Tab")
    assert page.doc["robot"]["drive"]["ackermann"] == {"wheelbase_m": 2, "max_steer_deg": 30}
    field("Drive", exact=True).select_option("omnidirectional")
    page.settle()
    field("Keeps heading").fill("-90")
    page.press("Tab")
    drive = page.doc["robot"]["drive"]["omnidirectional"]
    assert drive == {"max_speed_along_mps": 1, "max_speed_across_mps": 0.7, "hold_heading_deg": -90}
    field("Drive", exact=True).select_option("")
    page.settle()
    assert "drive" not in page.doc["robot"]
    field("Body", exact=True).select_option("disc")
    page.settle()
    assert page.doc["robot"]["radius_m"] == 0.8
    assert "footprint" not in page.doc["robot"]


def test_a_corridor_and_laps_are_typed_and_the_corridor_is_the_one_that_is_planned_in(
    visit: Visit, patrol: Path
) -> None:
    page = visit(patrol)
    page.page.get_by_label("Corridor to the left").fill("60")
    page.press("Tab")
    assert page.doc["route"]["corridor"] == {"right_m": 60, "left_m": 60}
    ring = page.plan["corridor"][0]
    assert len(ring) > 4
    page.page.get_by_label("Corridor to the left").fill("")
    page.press("Tab")
    assert "corridor" not in page.doc["route"]
    assert page.plan["corridor"] == []
    page.page.get_by_label("Closed").check()
    page.settle()
    one = page.plan["length"]
    page.page.get_by_label("Laps").fill("2")
    page.press("Tab")
    assert page.doc["route"]["laps"] == 2
    assert page.plan["length"] > 1.9 * one


def test_squares_that_nobody_has_seen_are_made_free(visit: Visit, tmp_path: Path) -> None:
    shutil.copytree(EXAMPLES / "maps", tmp_path / "maps")
    page = visit(Path(shutil.copy(EXAMPLES / "depot-round.yaml", tmp_path)))
    page.page.get_by_role("button", name="depot.yaml, map").click()
    page.page.get_by_label("Squares that nobody has seen").select_option("free")
    page.settle()
    assert page.doc["world"]["known"][0]["unknown"] == "free"


def test_the_body_is_drawn_where_it_starts_and_sweeps(visit: Visit, tmp_path: Path) -> None:
    file = tmp_path / "long.yaml"
    file.write_text(
        "world: {bounds: [0, 0, 40, 20]}\nroute: {start: [5, 10], goal: [30, 10]}\n"
        "robot: {footprint: [[-1, -2], [4, -2], [4, 2], [-1, 2]], clearance_m: 0.2}\n"
    )
    page = visit(file)
    colour = """([x, y]) => {
      const [px, py] = studio.camera.toScreen(x, y), ratio = devicePixelRatio;
      return [...studio.scene.ctx.getImageData(px * ratio, py * ratio, 1, 1).data];
    }"""
    inside, beyond = [21.3, 11.3], [21.3, 13.3]
    swept = page.js(colour, inside)
    assert swept != page.js(colour, beyond)
    page.press("o")
    assert page.js(colour, inside) != swept
    bare = page.js(colour, [4.4, 11.3])
    page.press("o")
    assert page.js(colour, [4.4, 11.3]) != bare  # half a metre behind the start's point
    assert page.js(colour, [3.4, 11.3]) == bare


def test_the_robot_that_drives_has_its_shape(visit: Visit, tmp_path: Path) -> None:
    file = tmp_path / "long.yaml"
    file.write_text(
        "world: {bounds: [0, 0, 40, 20]}\nroute: {start: [5, 10], goal: [30, 10]}\n"
        "robot: {footprint: [[-1, -2], [4, -2], [4, 2], [-1, 2]], clearance_m: 0.2}\n"
    )
    page = visit(file)
    page.page.get_by_role("button", name="Drive", exact=True).click()
    page.page.wait_for_selector("body.is-driving")
    page.js("(studio.drive.pause(), studio.drive.seek(8))")
    page.show()
    x = page.js("studio.drive.state().x")
    colour = """([x, y]) => {
      const [px, py] = studio.camera.toScreen(x, y), ratio = devicePixelRatio;
      return [...studio.scene.ctx.getImageData(px * ratio, py * ratio, 1, 1).data];
    }"""
    front, beside = [x + 3.6, 11.6], [x + 3.6, 12.5]
    assert page.js(colour, front) == page.js(colour, [x + 3.6, 8.4])
    assert page.js(colour, front) != page.js(colour, beside)


def test_areas_are_in_the_picture_that_is_exported(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    page.js("""async () => {
      const edits = await import("/page/js/core/edits.js"), { store } = studio;
      const zone = edits.addArea(store.doc, "zone", [[1, 2], [30, 2], [30, 40]])[0];
      store.edit(edits.addArea(zone, "fence", [[0, 0], [500, 0], [500, 500], [0, 500]])[0]);
    }""")
    page.settle()
    svg = page.js('import("/page/js/files/svg.js").then((m) => m.svgOf(studio.store))')
    assert "M1 2L30 2L30 40Z" in svg
    assert "M0 0L500 0L500 500L0 500Z" in svg


@pytest.mark.slow
def test_every_kind_of_obstacle_that_is_drawn_by_hand_can_be_picked_moved_and_exported(
    visit: Visit, patrol: Path
) -> None:
    page = visit(patrol)
    tools = page.js(
        'import("/page/js/shapes/registry.js").then('
        "m => m.DRAWN.map(({shape, tool}) => [shape.key, tool.key, !!tool.close]))"
    )
    assert len({letter for _, letter, _ in tools}) == len(tools) > 1
    for key, letter, by_corners in tools:
        count = len(page.doc["world"]["known"])
        page.press(letter.lower())
        if by_corners:
            for at in ([60, 150], [100, 150], [80, 190]):
                page.click(at)
            page.press("Enter")
        else:
            page.drag([70, 160], [85, 165])
        assert list(page.doc["world"]["known"][count]) == [key]
        before = page.js(f"studio.store.doc.world.known[{count}]")
        assert page.js("studio.store.selection") == f"known:{count}"
        page.press("ArrowRight")
        assert page.js(f"studio.store.doc.world.known[{count}]") != before
        page.press("Escape")
        page.click([80, 163])
        assert page.js("studio.store.selection") == f"known:{count}"
        svg = page.js('import("/page/js/files/svg.js").then((m) => m.svgOf(studio.store))')
        page.press("Delete")
        assert len(page.doc["world"]["known"]) == count
        bare = page.js('import("/page/js/files/svg.js").then((m) => m.svgOf(studio.store))')
        assert svg != bare
