"""A slow plan's provisional path: soon there, called so, and the plan after it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.studio.document import EMPTY_DOCUMENT
from viaspline.studio.early_paths import SLOW_PLAN_S, is_wanted
from viaspline.studio.plan_document import PlannedDocument

Visit = Callable[..., Any]
EXAMPLES = Path(__file__).parents[2] / "examples"


def test_only_what_takes_long_gets_one() -> None:
    cart = {**EMPTY_DOCUMENT, "robot": {"drive": {}}}
    assert is_wanted(cart, None)
    assert not is_wanted(EMPTY_DOCUMENT, None)
    assert not is_wanted({**cart, "fleet": []}, None)
    assert not is_wanted({**cart, "world": {"altitude": {}}}, None)
    mission = Mission.model_validate(EMPTY_DOCUMENT)
    known = {"document": EMPTY_DOCUMENT, "unfolded": None, "mission": mission, "problems": ()}
    slow, quick = 2 * SLOW_PLAN_S, SLOW_PLAN_S / 2
    for seconds, wanted in ((slow, True), (quick, False)):
        before = PlannedDocument(**known, plan=plan(mission), seconds=seconds)
        assert is_wanted(cart, before) is wanted
        assert not is_wanted(EMPTY_DOCUMENT, before)
        assert is_wanted(cart, PlannedDocument(**known, plan=None, seconds=seconds))


def test_an_edit_of_a_slow_mission_is_answered_by_a_path_and_then_by_its_plan(
    start: Callable[..., Any], tmp_path: Path
) -> None:
    shelves = Path(shutil.copy(EXAMPLES / "mecanum-shelves.yaml", tmp_path))
    with start(shelves).client() as client:
        first = client.edit()
        assert first["ok"]
        client.heard.clear()
        second = client.edit([["route", "via", 1, "at"], [8.0, 7.5]])
        early = [m for m in client.heard if m["type"] == "provisional"]
    assert second["ok"]
    if first["ms"] <= 1e3 * SLOW_PLAN_S:
        assert not early  # a quick machine
        return
    assert [m["rev"] for m in early] == [client.revision]
    assert "it is not yet driven" in early[0]["leftOut"]
    points = np.reshape(early[0]["spans"], (-1, 4, 2))
    ends = np.vstack([points[:, 0], points[-1:, 3]])
    for at in ([2, 2], [4.5, 8], [8.0, 7.5], [15.5, 8], [18, 2]):
        assert np.hypot(*(ends - at).T).min() < 1e-9


def test_while_a_point_is_dragged_the_path_follows_and_says_that_it_is_provisional(
    visit: Visit, tmp_path: Path
) -> None:
    shutil.copytree(EXAMPLES / "maps", tmp_path / "maps")
    page = visit(Path(shutil.copy(EXAMPLES / "depot-cart.yaml", tmp_path)))
    page.js("() => { studio.latencies.length = 0; }")
    old = page.js("studio.store.plan.rev")
    x, y = page.place([7.6, 13.4])
    mouse = page.page.mouse
    mouse.move(x, y)
    mouse.down()
    for k in range(1, 9):
        mouse.move(x + k, y + k)
        page.until("studio.early.newest?.rev === studio.store.revision")
    at = page.doc["route"]["via"][0]
    assert page.js("studio.store.plan.rev") == old
    assert page.js("studio.store.isLate")
    spans = np.reshape(page.js("studio.early.shown.spans"), (-1, 2))
    assert np.hypot(*(spans - at).T).min() < 1e-9
    page.until("document.querySelector('#status').textContent.startsWith('provisional, not yet')")
    assert "is-busy" in page.js("document.querySelector('#status').className")
    page.until("document.querySelector('#timeline').classList.contains('is-late')")
    assert len(page.js("studio.latencies")) > 3  # on the screen, one after the other
    mouse.up()
    page.settle()
    assert page.js("studio.early.shown") is None
    assert not page.js("studio.store.isLate")
    page.until("!document.querySelector('#timeline').classList.contains('is-late')")
    assert page.plan["ok"]
