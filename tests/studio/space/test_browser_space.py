"""A mission in space is seen from above, from the side and in 3-D, and edited in each of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Visit = Callable[..., Any]

TEXT = """\
# a tower between a pad and a yard
world:
  bounds: [-20, -40, 120, 40]
  altitude: {min_m: 2, max_m: 60, above: home}
  ground: {flat_m: 0}
  known:
    - {name: tower, circle: {center: [60, 1], radius: 6}, height_m: [0, 35]}
    - {name: crate, box: {min: [20, -20, 0], max: [30, -10, 8], yaw_deg: 20}}
    - {name: lamp, ball: {center: [80, 20, 15], radius: 2}}
robot: {radius_m: 0.4, half_height_m: 0.2, clearance_m: 1, max_speed_mps: 6, max_climb_mps: 2}
route:
  start: {at: [0, 0], name: pad}
  takeoff: {to_agl_m: 10}
  via:
    - {at: [40, 0], agl_m: 12}   # before the tower
    - [90, 0, 20]
    - {gate: {at: [100, 10, 12], facing_deg: 60, width_m: 6, height_m: 5}}
  land: {at: [110, 30]}
"""
PLANAR = "route: {start: [0, 0], goal: [9, 0]}\n"
VIA_2 = 2  # of the points of the route: after the start and the first via point


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "tower.yaml"
    path.write_text(TEXT)
    (tmp_path / "flat.yaml").write_text(PLANAR)
    return path


def elevation_place(page: Any, index: int) -> tuple[float, float]:
    x, y = page.js(
        """i => {
          const box = studio.space.elevation.canvas.getBoundingClientRect();
          const point = studio.space.elevation.points()[i];
          return [box.left + point.x, box.top + point.y];
        }""",
        index,
    )
    return x, y


def solid_place(page: Any, at: str) -> tuple[float, float]:
    """Where something is in the 3-D view, once that is drawn."""
    page.until("studio.space.solid?.drawn > 0")
    x, y = page.js(
        f"""() => {{
          const view = studio.space.solid, box = view.canvas.getBoundingClientRect();
          const [x, y] = view.toScreen({at});
          return [box.left + x, box.top + y];
        }}"""
    )
    return x, y


def pull(page: Any, start: tuple[float, float], way: tuple[float, float], key: str = "") -> None:
    mouse, keyboard = page.page.mouse, page.page.keyboard
    x, y = start
    if key:
        keyboard.down(key)
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + way[0] / 2, y + way[1] / 2, steps=3)
    mouse.move(x + way[0], y + way[1], steps=3)
    mouse.up()
    if key:
        keyboard.up(key)
    page.settle()


def requests(page: Any) -> list[str]:
    names = page.js("performance.getEntriesByType('resource').map(entry => entry.name)")
    return [name for name in names if "/vendor/" in name or "/solid/" in name]


def test_a_point_dragged_on_the_map_keeps_its_height(visit: Visit, file: Path) -> None:
    page = visit(file)
    before = page.doc
    page.drag([40, 0], [36, -8])
    via = page.doc["route"]["via"][0]
    assert abs(via["at"][0] - 36) < 1
    assert abs(via["at"][1] + 8) < 1
    assert via["agl_m"] == 12
    assert page.plan["ok"]
    assert page.plan["space"]["stops"][1]["at"] == [*via["at"], 12]
    page.drag([90, 0], [92, -6])
    assert page.doc["route"]["via"][1][2] == 20
    page.drag([100, 10], [101, 12])  # a gate by its middle
    assert page.doc["route"]["via"][2]["gate"]["at"][2] == 12
    assert abs(page.doc["route"]["via"][2]["gate"]["at"][1] - 12) < 1
    page.press("Control+z", "Control+z", "Control+z")
    assert page.doc == before


def test_a_point_is_dragged_up_in_the_elevation_and_down_again_by_undo(
    visit: Visit, file: Path
) -> None:
    page = visit(file)
    before = page.doc
    scale = page.js("studio.space.elevation.pixelsPerMetre")
    pull(page, elevation_place(page, 1), (0, -6 * scale))
    assert abs(page.doc["route"]["via"][0]["agl_m"] - 18) < 0.6
    assert page.plan["ok"]
    assert page.plan["space"]["stops"][1]["at"][2] == page.doc["route"]["via"][0]["agl_m"]
    page.press("Control+z")
    assert page.doc == before
    pull(page, elevation_place(page, 0), (0, -4 * scale))  # the end of take-off
    assert abs(page.doc["route"]["takeoff"]["to_agl_m"] - 14) < 0.6
    pull(page, elevation_place(page, VIA_2), (0, 5 * scale))
    assert abs(page.doc["route"]["via"][1][2] - 15) < 0.6
    assert page.doc["route"]["via"][1][:2] == [90, 0]


def test_the_3d_view_shows_the_world_and_points_are_dragged_in_it(visit: Visit, file: Path) -> None:
    page = visit(file)
    page.until("studio.space.solid?.drawn > 0 && studio.space.scene !== null")
    shades = page.js(
        """() => {
          const view = studio.space.solid, gl = view.renderer.getContext();
          view.draw();
          const [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
          const pixels = new Uint8Array(4 * w * h);
          gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          const found = new Set();
          for (let i = 0; i < pixels.length; i += 4) {
            found.add([0, 1, 2].map(k => pixels[i + k] >> 4).join());
          }
          return found.size;
        }"""
    )
    assert shades > 20
    point = "studio.space.points()[1].at"
    pull(page, solid_place(page, point), (18, 0))
    via = page.doc["route"]["via"][0]
    assert via["at"] != [40, 0]
    assert via["agl_m"] == 12
    assert page.js("studio.store.selection") == "via:0"
    pull(page, solid_place(page, "studio.space.solid.handlePlace()"), (0, -25))
    lifted = page.doc["route"]["via"][0]
    assert lifted["at"] == via["at"]
    assert lifted["agl_m"] > 12.5
    pull(page, solid_place(page, point), (0, 20), key="Shift")
    assert page.doc["route"]["via"][0]["agl_m"] < lifted["agl_m"] - 0.5
    page.press("Control+z", "Control+z", "Control+z")
    assert page.doc["route"]["via"][0] == {"at": [40, 0], "agl_m": 12}


def test_the_view_turns_zooms_and_is_fitted_again(visit: Visit, file: Path) -> None:
    page = visit(file)
    eye = "studio.space.solid.camera.position.toArray()"
    page.until("studio.space.solid?.drawn > 0")
    page.js("studio.space.solid.canvas.focus()")
    page.press("f")  # the panels round it may have settled after the first picture
    before = page.js(eye)
    x, y = solid_place(page, "[20, 30, 0]")
    pull(page, (x, y), (60, 10))
    turned = page.js(eye)
    assert turned != before
    assert page.js("studio.store.past.length") == 0
    page.page.mouse.wheel(0, -300)
    page.until(f"JSON.stringify({eye}) !== {str(turned)!r}")
    page.js("studio.space.solid.canvas.focus()")
    zoomed = page.js(eye)
    page.press("ArrowLeft", "ArrowUp", "+")
    assert page.js(eye) != zoomed
    page.press("f")
    assert page.js(eye) == pytest.approx(before, rel=0.05)


def test_three_js_is_asked_for_by_missions_in_space_only(visit: Visit, file: Path) -> None:
    page = visit(file.with_name("flat.yaml"))
    assert requests(page) == []
    assert not page.page.locator("#solid").is_visible()
    assert not page.page.locator("#elevation").is_visible()
    page.js("studio.link.ask({type: 'open', name: 'tower.yaml'}).then(studio.opened)")
    page.until("studio.space.solid?.drawn > 0")
    assert any("three.min.js" in name for name in requests(page))
    assert page.page.locator("#elevation").is_visible()
    page.js("studio.link.ask({type: 'open', name: 'flat.yaml'}).then(studio.opened)")
    page.settle()
    assert not page.page.locator("#solid").is_visible()


def test_without_webgl_it_is_said_and_the_other_views_work(
    browser: Any, start: Any, page_of: Any, file: Path
) -> None:
    hidden = """const usual = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
        return kind.startsWith("webgl") ? null : usual.call(this, kind, ...more);
      };"""
    context = browser.new_context(viewport={"width": 1280, "height": 820})
    context.add_init_script(hidden)
    page = page_of(context.new_page(), start(file).url)
    page.until("studio.space.views.failure !== ''")
    assert "offers no WebGL 2" in page.page.locator("#solid-note").inner_text()
    scale = page.js("studio.space.elevation.pixelsPerMetre")
    pull(page, elevation_place(page, 1), (0, -6 * scale))
    assert abs(page.doc["route"]["via"][0]["agl_m"] - 18) < 0.6
    assert page.errors == []
    context.close()


def test_everything_is_reached_by_keys(visit: Visit, file: Path) -> None:
    page = visit(file)
    page.js("studio.scene.canvas.focus()")
    page.press("Tab", "Tab", "PageUp")
    assert page.js("studio.store.selection") == "via:0"
    assert page.doc["route"]["via"][0]["agl_m"] == 12.5
    page.press("Shift+PageDown")
    assert page.doc["route"]["via"][0]["agl_m"] == 7.5
    page.js("studio.space.elevation.canvas.focus()")
    page.press("ArrowRight", "ArrowUp", "ArrowUp")
    assert page.js("studio.store.selection") == "via:1"
    assert page.doc["route"]["via"][1] == [90, 0, 21]
    field = page.page.get_by_label("Height in m", exact=True)
    field.fill("25")
    field.press("Enter")
    page.settle()
    assert page.doc["route"]["via"][1] == [90, 0, 25]
    page.page.get_by_role("button", name="Plan view").press("Enter")
    assert not page.page.locator("#solid").is_visible()
    page.page.get_by_role("button", name="3-D view").press("Enter")
    assert page.page.locator("#solid").is_visible()


def test_a_height_that_cannot_be_flown_is_refused_and_mended_by_a_button(
    visit: Visit, file: Path
) -> None:
    page = visit(file)
    page.js("studio.store.select('via:0')")
    field = page.page.get_by_label("Height above ground in m")
    field.fill("70")
    field.press("Enter")
    page.settle()
    assert not page.plan["ok"]
    assert "above the altitude band" in page.page.locator("#summary").inner_text()
    page.page.get_by_role("button", name="Set the height of via 1").click()
    page.settle()
    assert page.doc["route"]["via"][0]["agl_m"] == 60
    assert not any("altitude band" in problem["text"] for problem in page.plan.get("problems", []))


def test_a_flight_is_played_in_all_views(visit: Visit, file: Path) -> None:
    page = visit(file)
    page.page.get_by_role("button", name="Drive", exact=True).click()
    page.until("!!studio.drive.run")
    page.js("studio.drive.pause()")
    page.js("studio.drive.seek(studio.drive.end / 2)")
    state = page.js("studio.drive.state()")
    assert 5 < state["z"] < 45
    path = page.js("studio.space.elevation.flown()")
    there = page.js("s => studio.store.curve.at(s)", path)
    assert abs(there["x"] - state["x"]) + abs(there["z"] - state["z"]) < 3
    page.js("studio.drive.seek(studio.drive.begin)")  # as far away as it can be
    assert page.js("studio.space.elevation.flown()") < 3
    page.until("studio.space.solid.moving.children.length >= 2")  # the robot and its trail


MOVERS = """\
world:
  altitude: {min_m: 2, max_m: 60, above: home}
  ground: {flat_m: 0}
  known:
    - name: hook
      ball: {center: [0, 0, 1], radius: 1}
      motion: {keyframes: [[0, 20, -30, 0, 20], [10, 20, 30, 0, 10]], after: bounce}
  unseen:
    - name: kite
      circle: {center: [0, 0], radius: 1}
      height_m: [-1, 2]
      motion: {from: [60, -20, 5], velocity_mps: [0, 1, 0.25]}
robot: {radius_m: 0.4, clearance_m: 1, max_speed_mps: 5, sensor: {range_m: 15}}
route: {start: [0, 0, 10], goal: [80, 0, 10]}
"""


def test_what_moves_in_a_flight_is_shown_in_3d_and_keeps_its_heights(
    visit: Visit, tmp_path: Path
) -> None:
    """Seen or not: where its motion has it, as high as that says, also when it is edited."""
    file = tmp_path / "movers.yaml"
    file.write_text(MOVERS)
    page = visit(file)
    moved, straight, stands, frame = page.js(
        """async () => {
          const edits = await import("/page/js/core/motion_edits.js");
          const { shapeOf } = await import("/page/js/shapes/registry.js");
          const doc = studio.store.doc, kite = doc.world.unseen[0];
          const straight = edits.setManner(doc, "known:0", "straight", 5).world.known[0];
          const stands = edits.setManner(doc, "unseen:0", "stands", 2).world.unseen[0];
          const more = edits.addKeyframe(doc, "known:0", 0).world.known[0];
          return [shapeOf(kite).movedTo(kite, [1, 2]).motion.from, straight.motion, stands,
                  more.motion.keyframes[1]];
        }"""
    )
    assert moved == [1, 2, 5]
    assert straight["from"] == [20, -30, 15]
    assert straight["velocity_mps"] == [0, 6, 0]
    assert "motion" not in stands
    assert stands["height_m"] == pytest.approx([4.5, 7.5])
    assert stands["circle"]["center"] == pytest.approx([60, -18])
    assert frame == [5, 20, 0, 0, 15]
    page.page.get_by_role("button", name="Drive", exact=True).click()
    page.until("!!studio.drive.run && studio.space.solid?.drawn > 0")
    page.js("studio.drive.pause()")
    page.js("studio.drive.seek(6)")
    page.js(
        """() => { window.movers = () => {
          const view = studio.space.solid;
          const found = view.moving.children.find(one => one.children.length === 2
            && one.children[0].geometry.type === "SphereGeometry");
          return found?.children.map(({position: p, material}) =>
            [p.x + view.origin[0], p.y + view.origin[1], p.z + view.origin[2], material.opacity]);
        }; }"""
    )
    page.until("window.movers()?.[0][1] > 5")
    hook, kite = page.js("window.movers()")
    assert hook == pytest.approx([20, 6, 15, 1])
    assert kite == pytest.approx([60, -14, 6.5, 0.35])
    seen = page.js("studio.drive.run.sight.seen[0]")
    assert seen > 6
    page.js("time => studio.drive.seek(time)", seen + 0.2)
    assert page.js("studio.drive.hasSeen(0)")


def test_new_points_are_as_high_as_those_beside_them(visit: Visit, file: Path) -> None:
    page = visit(file)
    page.press("a")
    page.click([20, 20])
    added = page.doc["route"]["via"][3]
    assert added[2:] == [12]  # as high as the gate before it
    page.press("Escape", "Control+z")
    page.js("studio.store.select('land')")
    assert "straight down" in page.page.locator("#inspector").inner_text()
    page.drag([110, 30], [112, 26])
    assert abs(page.doc["route"]["land"]["at"][1] - 26) < 1


@pytest.mark.parametrize(("width", "height"), [(1280, 820), (390, 844)])
def test_nothing_is_wider_than_the_screen(
    visit: Visit, file: Path, width: int, height: int
) -> None:
    page = visit(file, width=width, height=height)
    assert page.js("document.documentElement.scrollWidth") <= width
    open_views = page.js("document.body.dataset.views")
    assert open_views == ("both" if width > 700 else "plan")
    page.page.get_by_role("button", name="3-D view").click()
    page.until("studio.space.solid?.drawn > 0")
    box = page.page.locator("#solid").bounding_box()
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= width


@pytest.mark.parametrize("size", [(1280, 820), (390, 844)])
def test_every_point_of_the_route_is_seen_at_first_and_until_the_view_is_moved(
    visit: Visit, file: Path, size: tuple[int, int]
) -> None:
    page = visit(file, width=size[0], height=size[1])
    covers = "#tools, #views, #fit, #left, #inspector, #topbar"

    def hidden() -> list[Any]:
        boxes = [page.page.locator(one).bounding_box() for one in covers.split(", ")]
        seen = page.page.locator("#map").bounding_box()
        places = [page.place(at) for at in ([0, 0], [40, 0], [90, 0], [100, 10], [110, 30])]
        return [
            (x, y) for x, y in places
            if any(box and _is_in(box, x, y) for box in boxes) or not _is_in(seen, x, y)
        ]  # fmt: skip

    assert hidden() == []
    page.page.set_viewport_size({"width": size[0] - 40, "height": size[1] - 120})
    page.until(f"studio.camera.height < {size[1]}")
    page.page.wait_for_timeout(300)
    assert hidden() == []
    page.js("studio.camera.zoom(2, 100, 300)")
    moved = page.js("studio.camera.scale")
    page.page.set_viewport_size({"width": size[0], "height": size[1]})
    page.page.wait_for_timeout(300)
    assert page.js("studio.camera.scale") == moved


def _is_in(box: dict[str, float], x: float, y: float) -> bool:
    return box["x"] <= x <= box["x"] + box["width"] and box["y"] <= y <= box["y"] + box["height"]
