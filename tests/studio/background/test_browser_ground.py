"""Where on earth a mission lies, and the picture under it, in a real browser."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
import pytest

from viaspline.formats.local_frame import LocalFrame

EXAMPLES = Path(__file__).parents[3] / "examples"
ORIGIN = (47.3977, 8.5456)
COLOURS = {
    "red": (200, 40, 30),
    "green": (30, 160, 60),
    "blue": (40, 60, 190),
    "grey": (90, 90, 90),
}
Visit = Callable[..., Any]

COLOUR_AT = """([x, y]) => {
  studio.scene.draw();
  const { canvas } = studio.scene, ratio = canvas.width / studio.camera.width;
  const [px, py] = studio.camera.toScreen(x, y).map((value) => Math.round(value * ratio));
  return [...canvas.getContext("2d").getImageData(px, py, 1, 1).data.slice(0, 3)];
}"""

LOCAL = """async ([origin, places]) => {
  const { LocalFrame } = await import("/page/js/geo/local_frame.js");
  const frame = new LocalFrame(...origin);
  return places.map(([lat, lon]) => {
    const at = frame.toLocal(lat, lon);
    return [...at, ...frame.toGeodetic(at)];
  });
}"""

PAIRS = """async (texts) => {
  const { pairFrom } = await import("/page/js/geo/degrees.js");
  return texts.map(pairFrom);
}"""


def type_origin(page: Any, words: str) -> None:
    field = page.page.get_by_label("Latitude, longitude of 0, 0")
    field.fill(words)
    field.press("Enter")


@pytest.mark.slow
def test_a_point_is_read_and_typed_as_latitude_and_longitude(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    page.js("studio.store.select('via:1')")
    page.until("document.querySelector('#inspector h3')?.textContent === 'pump-house'")
    pair = page.page.get_by_label("Latitude, longitude", exact=True)
    assert pair.count() == 0  # nobody said where 0, 0 is
    type_origin(page, "nowhere")
    page.page.get_by_role("alert").filter(has_text="a latitude and a longitude").wait_for()
    type_origin(page, "N 47.3977 E 8.5456")
    pair.wait_for()
    frame = LocalFrame(*ORIGIN)
    shown = [float(word) for word in pair.input_value().split(",")]
    assert np.hypot(*(frame.to_local(*shown) - [140, 170])) < 2e-3
    before, edits = page.doc, page.js("studio.store.past.length")
    target = [float(number) for number in frame.to_geodetic([150.0, 160.0])]
    pair.fill(f" ({target[0]:.8f}, {target[1]:.8f}) ")  # as it is pasted from elsewhere
    pair.press("Enter")
    page.settle()
    moved = page.doc["route"]["via"][1]
    assert np.hypot(*(np.array(moved["at"]) - [150, 160])) < 2e-3
    assert moved["name"] == "pump-house"
    assert page.js("studio.store.past.length") == edits + 1
    for wrong in ("47.1", "91, 8", "48.9, 2.3; 5", "-33.9, 18.4"):
        pair.fill(wrong)
        pair.press("Enter")
        assert pair.get_attribute("aria-invalid") == "true"
        assert page.doc["route"]["via"][1] == moved
    pair.fill(pair.evaluate("(field) => field.defaultValue"))
    page.page.focus("#map")
    page.press("Control+z")
    assert page.doc == before
    page.page.mouse.move(*page.place([200.0, 120.0]))
    page.until("document.querySelector('#where').textContent.includes('·')")
    words = page.page.locator("#where").inner_text().split("·")[1]
    read = [float(word) for word in words.split(",")]
    assert np.hypot(*(frame.to_local(*read) - [200, 120])) < 2.0  # a pixel
    page.open(page.page.url)
    assert page.js("studio.store.origin") == list(ORIGIN)  # it is kept beside the file

    source = np.random.default_rng(3)
    for origin in (ORIGIN, (-79.5, -179.99), (0.0, 30.0)):
        near = np.array(origin) + source.uniform(-2, 2, (40, 2))
        found = np.array(page.js(LOCAL, [list(origin), near.tolist()]))
        assert np.abs(found[:, :2] - LocalFrame(*origin).to_local(*near.T)).max() < 1e-5
        turned = (found[:, 3] - near[:, 1] + 180) % 360 - 180
        assert max(np.abs(found[:, 2] - near[:, 0]).max(), np.abs(turned).max()) < 1e-9

    texts = {
        "47.1, 8.2": [47.1, 8.2], "47.1 8.2": [47.1, 8.2], "[47.1; -8.2]": [47.1, -8.2],
        "E 8.2 N 47.1": [47.1, 8.2], "47.1S, 8.2W": [-47.1, -8.2],
        "47°06'00\"N 8°12'E": [47.1, 8.2], "47° 6′ 0″ N, 8° 12′ 0″ E": [47.1, 8.2],
        "−47.1, 8": [-47.1, 8], "47.1": None, "N47.1 8.2": None, "N 47.1 N 8.2": None,
        "47.1, 8.2, 3": None, "a, b": None, "": None, "95, 8": None, "47.18.2": None,
        "47°60'N 8°E": None, "-47.1S 8E": None,
    }  # fmt: skip
    for text, found in zip(texts, page.js(PAIRS, list(texts)), strict=True):
        assert found == (texts[text] and pytest.approx(texts[text])), text


def test_a_picture_lies_where_its_world_file_says_and_no_plan_knows(
    visit: Visit, patrol: Path
) -> None:
    picture = PIL.Image.new("RGB", (80, 40), COLOURS["grey"])
    picture.paste(COLOURS["red"], (0, 0, 40, 20))
    picture.paste(COLOURS["green"], (40, 0, 80, 20))
    picture.paste(COLOURS["blue"], (0, 20, 40, 40))
    picture.save(patrol.parent / "site.png")
    turn = np.radians(30.0)  # anticlockwise, and 4 m a pixel
    right, down = (
        4 * np.array([np.cos(turn), np.sin(turn)]),
        4 * np.array([np.sin(turn), -np.cos(turn)]),
    )
    corner = np.array([120.0, 190.0])
    middle = corner + (right + down) / 2
    numbers = (right[0], right[1], down[0], down[1], *middle)
    (patrol.parent / "site.pgw").write_text("\n".join(map(str, numbers)))
    page = visit(patrol)
    plan = page.plan
    page.page.click("#menu-more")
    page.page.get_by_role("menuitem", name="Put a picture underneath").click()
    page.page.get_by_role("button", name="site.png").click()
    page.page.get_by_text("as site.pgw says").wait_for(state="attached")
    page.page.get_by_role("button", name="Put it underneath").click()
    page.until("!!studio.background.image")
    slider = page.page.get_by_role("slider", name="Opacity of the picture")
    slider.fill("1")
    page.until("studio.background.shown.opacity === 1 && studio.link.waiting.size === 0")
    page.js("studio.store.show.grid = false")
    page.js("studio.store.show.losers = false")
    for column, row, name in ((9, 7, "red"), (71, 7, "green"), (9, 33, "blue"), (73, 37, "grey")):
        at = corner + column * right + row * down
        assert page.js(COLOUR_AT, at.tolist()) == pytest.approx(COLOURS[name], abs=2), name
    outside = (corner - 3 * right - 3 * down).tolist()
    assert page.js(COLOUR_AT, outside) not in [list(colour) for colour in COLOURS.values()]
    page.settle()
    assert {**page.plan, "ms": 0} == {**plan, "ms": 0, "rev": page.plan["rev"]}
    assert not page.js("studio.store.dirty")
    page.open(page.page.url)
    page.until("!!studio.background.image")
    assert page.js("studio.background.shown.opacity") == 1
    page.page.get_by_role("button", name="Place it").click()
    page.page.get_by_label("Where it lies").select_option("by two corners")
    page.page.get_by_label("The corners are").select_option("degrees")
    page.page.get_by_label("Bottom left").fill("47.3977, 8.5456")
    page.page.get_by_label("Top right").fill("47.4, 8.55")
    page.page.get_by_role("button", name="Put it underneath").click()
    page.page.get_by_role("alert").filter(has_text="0, 0").wait_for()
    page.page.get_by_label("longitude of the mission's 0, 0").fill("47.3977, 8.5456")
    page.page.get_by_role("button", name="Put it underneath").click()
    page.page.wait_for_selector("dialog", state="hidden")
    box = page.js("studio.background.box")
    far = LocalFrame(*ORIGIN).to_local(47.4, 8.55)
    assert np.abs(np.array(box) - [0, 0, *far]).max() < 0.05
    page.page.get_by_role("button", name="Take it away").click()
    page.until("studio.background.shown === null")
    page.page.get_by_role("button", name="Put a picture underneath").wait_for()


def test_the_altitudes_of_an_imported_plan_stand_in_the_list(visit: Visit, tmp_path: Path) -> None:
    shutil.copy(EXAMPLES / "fence-survey.plan", tmp_path)
    page = visit(tmp_path / "fence-survey.plan")
    row = page.page.get_by_role("button", name="via 3, height 50 m")
    row.get_by_text("50 m").wait_for()
    assert page.page.get_by_text("as fence-survey.plan says").count() == 1
    row.click()
    page.page.get_by_label("Height in m").fill("42.5")
    page.press("Tab")
    page.page.get_by_role("button", name="via 3, height 42.5 m").wait_for()
    assert page.doc["route"]["via"][2][2] == 42.5
    row = page.page.locator("[data-id='via:2']")
    row.hover()
    degrees = page.js("document.querySelector('[data-id=\"via:2\"]').title").split(", ")
    assert [round(float(word), 4) for word in degrees[1:]] == [47.3977, 8.5457]
    assert str(tmp_path) not in page.page.locator("body").inner_text()
