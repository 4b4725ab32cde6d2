"""Eight hundred via points: a map that can be read, a list that is quick, and all of it shown."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations, product
from pathlib import Path
from typing import Any

import pytest
import yaml

Visit = Callable[..., Any]

TEXTS = """() => {
  const { ctx } = studio.scene;
  const found = [];
  const usual = ctx.fillText;
  ctx.fillText = function (text, x, y) {
    const width = ctx.measureText(text).width;
    const left = ctx.textAlign === "center" ? x - width / 2 : x;
    const box = [left, y - 5, left + width, y + 5];
    found.push({ text, isNumber: ctx.textAlign === "center", box });
    usual.call(ctx, text, x, y);
  };
  studio.scene.draw();
  ctx.fillText = usual;
  return found;
}"""

SEEN = """() => {
  const { store, camera } = studio;
  const places = [];
  const { start, via, goal } = store.doc.route;
  for (const one of [start, ...via, goal]) places.push(Array.isArray(one) ? one : one.at);
  const { spans } = store.plan;
  for (let i = 0; i < spans.length; i += 2) places.push([spans[i], spans[i + 1]]);
  for (const { circle, motion } of [...store.doc.world.known, ...store.doc.world.unseen]) {
    const [x, y] = circle.center;
    for (const [, dx, dy] of motion?.keyframes ?? [[0, 0, 0]]) {
      for (const r of [-circle.radius, circle.radius]) places.push([x + dx + r, y + dy + r]);
    }
  }
  for (const { polygon } of store.doc.world.speed_zones) places.push(...polygon);
  return places.every(([x, y]) => {
    const [px, py] = camera.toScreen(x, y);
    return px > 0 && py > 0 && px < camera.width && py < camera.height;
  });
}"""


@pytest.fixture
def survey(tmp_path: Path) -> Path:
    """Twenty rows of forty named points; a crate, a zone and a cart's way far off."""
    via = [
        {"at": [10 + 12 * (c if r % 2 == 0 else 39 - c), 10 + 18 * r], "name": f"WP-{40 * r + c}"}
        for r in range(20)
        for c in range(40)
    ]
    via[250]["dwell_s"] = 5
    mission = {
        "world": {
            "known": [
                {"circle": {"center": [-90, 40], "radius": 3}},
                {
                    "circle": {"center": [0, 0], "radius": 2},
                    "motion": {"keyframes": [[0, -60, 60], [40, -60, 460]], "after": "bounce"},
                },
            ],
            "unseen": [{"circle": {"center": [640, 450], "radius": 8}, "name": "crate"}],
            "speed_zones": [
                {"polygon": [[200, -70], [230, -70], [230, -50]], "max_speed_mps": 1}
            ],
        },
        "robot": {"max_speed_mps": 3, "sensor": {"range_m": 20}},
        "route": {"start": [0, 0], "via": via, "goal": [0, 370]},
        "spline": {"tension": 0.1},
    }  # fmt: skip
    path = tmp_path / "survey.yaml"
    path.write_text(yaml.safe_dump(mission))
    return path


@pytest.mark.slow
def test_a_long_survey_is_read_shown_and_dragged(visit: Visit, survey: Path) -> None:
    page = visit(survey)
    assert page.plan["ok"]

    texts = page.js(TEXTS)
    names = [one for one in texts if one["text"].startswith("WP-")]
    numbers = [one for one in texts if one["isNumber"] and one["text"].isdigit()]
    assert 5 <= len(names) <= 150
    assert 50 <= len(numbers) <= 400
    for kind in (names, numbers):
        for one, other in combinations(kind, 2):
            a, b = one["box"], other["box"]
            clear = a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]
            assert clear, (one["text"], other["text"])
    assert "250" in {one["text"] for one in numbers} or "251" in {one["text"] for one in numbers}

    page.js("() => { studio.camera.pan(4000, 0); studio.store.tell('view'); }")
    assert not page.js(SEEN)
    page.press("f")
    assert page.js(SEEN)

    page.js(
        "() => { window.made = 0; new MutationObserver((changes) => {"
        "for (const { addedNodes } of changes) window.made += addedNodes.length;"
        "}).observe(document.querySelector('#route-list'), { childList: true }); }"
    )
    page.js("studio.store.select('via:700')")
    page.until("document.querySelector('#route-list .is-selected')?.dataset.id === 'via:700'")
    row, left = page.js(
        "['#route-list .is-selected', '#left'].map((one) => {"
        "const { top, bottom } = document.querySelector(one).getBoundingClientRect();"
        "return [top, bottom]; })"
    )
    assert left[0] <= row[0] <= row[1] <= left[1]  # brought into view
    page.js("studio.store.select('via:3')")
    page.until("document.querySelector('#route-list .is-selected')?.dataset.id === 'via:3'")
    assert page.js("window.made") == 3  # of 802 rows, those that say something else
    assert page.js("document.querySelector('#route-list').children.length") == 802

    at = page.doc["route"]["via"][410]["at"]
    page.drag(at, [at[0] + 24, at[1] + 15])
    assert page.doc["route"]["via"][410]["at"] != at
    assert page.plan["ok"]


@pytest.mark.parametrize("width", [390, 600, 1920])
def test_names_of_many_points_lie_on_nothing_however_wide_the_map_is(
    visit: Visit, survey: Path, width: int
) -> None:
    page = visit(survey, width=width, height=800)
    texts = page.js(TEXTS)
    names = [one["box"] for one in texts if one["text"].startswith("WP-")]
    numbers = [one["box"] for one in texts if one["isNumber"] and one["text"].isdigit()]
    assert numbers
    for a, b in [*combinations(names, 2), *product(names, numbers)]:
        assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1]
    width = page.js("studio.camera.width")
    assert all(left >= 0 and right <= width for left, _, right, _ in names)


def test_a_few_points_are_all_numbered_and_named(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    texts = {one["text"] for one in page.js(TEXTS)}
    assert {"S", "1", "2", "3", "4", "5", "G"} <= texts
    assert {"pump-house · 20 s", "gate · 10 s", "charger"} <= texts
