"""What axe-core finds for people who read the page by its contrast, its names or its roles."""

from __future__ import annotations

from collections.abc import Callable
from importlib import resources
from pathlib import Path
from typing import Any

import pytest

Visit = Callable[..., Any]

ROUTE = "route: {start: [0, 0], via: [{at: [20, 4], name: pump, dwell_s: 3}], goal: [40, 0]}\n"
PLANAR = f"""\
world:
  known:
    - {{name: post, circle: {{center: [10, 2], radius: 2}}}}
  unseen:
    - {{name: crate, circle: {{center: [30, 3], radius: 1}}}}
  speed_zones:
    - {{name: yard, polygon: [[12, -6], [18, -6], [18, 8]], max_speed_mps: 0.5}}
robot: {{radius_m: 0.5, clearance_m: 0.5, sensor: {{range_m: 20}}}}
{ROUTE}"""
FLEET = """\
separation_m: 1.0
robots:
  cart: {radius_m: 0.5, clearance_m: 0.3}
fleet:
  - {name: east, robot: cart, route: {start: [0, 0], goal: [40, 0]}}
  - {name: north, robot: cart, route: {start: [20, -20], goal: [20, 20]}}
"""
SPATIAL = """\
world:
  altitude: {min_m: 2, max_m: 60, above: home}
  ground: {flat_m: 0}
  known:
    - {name: tower, circle: {center: [20, 1], radius: 3}, height_m: [0, 35]}
robot: {radius_m: 0.4, half_height_m: 0.2, clearance_m: 1, max_speed_mps: 6, max_climb_mps: 2}
route:
  start: {at: [0, 0, 10], name: pad}
  goal: [40, 0, 12]
"""
BROKEN = PLANAR.replace("[20, 4]", "[10, 2]")
CHECK = """async (tags) => {
  const { violations } = await axe.run(document, { runOnly: tags, resultTypes: ["violations"] });
  return violations.map(({ id, help, nodes }) =>
    [id, help, nodes.map((node) => [node.target.join(" "), node.any[0]?.message ?? ""])]);
}"""
TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]


def found(page: Any) -> list[Any]:
    """What is wrong with the page as it is, on a light and on a dark screen."""
    wrong = []
    for scheme in ("light", "dark"):
        page.page.emulate_media(color_scheme=scheme)
        page.until(f"matchMedia('(prefers-color-scheme: {scheme})').matches")
        wrong += [(scheme, one) for one in page.js(CHECK, TAGS)]
    return wrong


def opened(visit: Visit, path: Path, text: str) -> Any:
    pytest.importorskip("axe_playwright_python", reason="axe-playwright-python isn't installed")
    axe = resources.files("axe_playwright_python") / "axe.min.js"
    path.write_text(text)
    page = visit(path, reduced_motion="reduce")
    session = page.page.context.new_cdp_session(page.page)  # the page itself runs no foreign script
    session.send("Runtime.evaluate", {"expression": axe.read_text(encoding="utf-8")})
    return page


def test_a_planar_mission_is_read_whatever_is_open(visit: Visit, tmp_path: Path) -> None:
    page = opened(visit, tmp_path / "planar.yaml", PLANAR)
    page.page.focus("#map")
    page.press("Tab", "Tab")
    assert found(page) == []
    page.press("Control+a", "Shift+F10")
    assert found(page) == []
    page.press("Escape", "m", "Enter", "Shift+ArrowRight", "Enter")
    page.page.click("#menu-show")
    assert found(page) == []
    page.press("Escape", "?")
    assert found(page) == []
    page.press("Escape")
    page.page.set_viewport_size({"width": 390, "height": 800})
    page.page.get_by_role("tab", name="Mission").click()
    assert found(page) == []


def test_a_mission_without_a_path_is_read(visit: Visit, tmp_path: Path) -> None:
    page = opened(visit, tmp_path / "broken.yaml", BROKEN)
    assert not page.plan["ok"]
    assert found(page) == []


def test_a_fleet_is_read(visit: Visit, tmp_path: Path) -> None:
    page = opened(visit, tmp_path / "fleet.yaml", FLEET)
    assert found(page) == []


def test_a_mission_in_space_is_read(visit: Visit, tmp_path: Path) -> None:
    page = opened(visit, tmp_path / "space.yaml", SPATIAL)
    page.until("document.querySelector('#solid-note').hidden")
    page.press("Tab")
    assert found(page) == []
