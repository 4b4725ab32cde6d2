"""What moves, in a real browser: drawn at an instant, dragged, planned past, and undone."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from viaspline.formats.yaml_document import read_document
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.moving_obstacles import MovingObstacles

Visit = Callable[..., Any]

CROSSING = """\
world:
  bounds: [0, 0, 40, 30]
  known:
    # it comes from the south
    - name: cart
      polygon: [[-1, -0.6], [1, -0.6], [1, 0.6], [-1, 0.6]]
      motion: {keyframes: [[0, 20, 5, 90], [10, 20, 25, 90]], after: bounce}
    - {name: rock, circle: {center: [30, 20], radius: 2}}
route: {start: [4, 15], goal: [36, 15]}
"""


@pytest.fixture
def crossing(tmp_path: Path) -> Path:
    file = tmp_path / "crossing.yaml"
    file.write_text(CROSSING)
    return file


def cart(page: Any) -> Any:
    return page.doc["world"]["known"][0]


def test_a_frame_is_where_the_planner_has_it_at_every_instant(visit: Visit, crossing: Path) -> None:
    page = visit(crossing)
    rng = np.random.default_rng(5)
    motions: list[dict[str, Any]] = [{"from": [3, -2], "velocity_mps": [0.5, -1.5]}]
    for after in ("loop", "bounce", "stay", "vanish"):
        for before in (None, "stay", "absent")[: 1 if after in ("loop", "bounce") else 3]:
            times = np.cumsum(rng.uniform(0.2, 3.0, 5)) - 2.0
            frames = [[float(t), *rng.uniform(-9, 9, 2).tolist()] for t in times]
            for k in np.flatnonzero(rng.random(5) < 0.5):
                frames[k].append(float(rng.uniform(-400, 400)))
            motion = {"keyframes": frames, "after": after}
            motions.append(motion if before is None else {**motion, "before": before})
    instants = [*rng.uniform(-30.0, 40.0, 60).tolist(), 0.0]
    drawn = page.js(
        """async ([motions, instants]) => {
          const { frameAt } = await import('/page/js/geometry/motion.js');
          return motions.map((motion) => instants.map((time) => frameAt(motion, time)));
        }""",
        [motions, instants],
    )
    for motion, frames_then in zip(motions, drawn, strict=True):
        disc = Obstacle.model_validate(
            {"circle": {"center": [0, 0], "radius": 1}, "motion": motion}
        )
        moving = MovingObstacles([disc])
        for time, frame in zip(instants, frames_then, strict=True):
            x, y, heading = moving.frames(time)[0].tolist()
            if frame is None:
                assert math.isnan(x)
                continue
            assert frame["x"] == pytest.approx(x, abs=1e-9)
            assert frame["y"] == pytest.approx(y, abs=1e-9)
            assert frame["heading"] == pytest.approx(heading, abs=1e-9)


COLOUR = """([x, y]) => {
  const { canvas, ctx } = studio.scene;
  const [px, py] = studio.camera.toScreen(x, y);
  const ratio = canvas.width / studio.camera.width;
  return [...ctx.getImageData(Math.round(px * ratio), Math.round(py * ratio), 1, 1).data];
}"""


def seek(page: Any, time: float) -> None:
    page.js("time => studio.preview.seek(time)", time)
    page.show()


def test_a_cart_is_drawn_where_it_is_at_the_instant_and_turned(
    visit: Visit, crossing: Path
) -> None:
    page = visit(crossing)
    beside = page.js(COLOUR, [20.4, 19.8])
    seek(page, 7.5)  # it is at (20, 20) and points north
    assert page.js(COLOUR, [20.4, 19.8]) != beside
    assert page.js(COLOUR, [20.4, 20.8]) == page.js(COLOUR, [20.4, 19.8])
    away = page.js(COLOUR, [21.4, 20])  # within its length, if it weren't turned
    assert away != page.js(COLOUR, [20.4, 19.8])
    seek(page, 0)
    assert page.js(COLOUR, [20.4, 19.8]) == beside


def test_the_scrubber_shows_the_robot_where_the_plan_has_it(visit: Visit, crossing: Path) -> None:
    page = visit(crossing)
    assert page.js("studio.preview.time") == 0
    scrub = page.page.get_by_label("Time of the plan or the drive")
    scrub.focus()
    end = page.js("studio.preview.end")
    page.page.keyboard.press("Shift+ArrowRight")
    page.page.keyboard.press("ArrowRight")
    assert page.js("studio.preview.time") == pytest.approx(end * (1 / 20 + 1 / 200))
    law = page.plan["law"]
    for time in np.linspace(0, law["times"][-1], 23).tolist():
        seek(page, time)
        state = page.js("studio.preview.state()")
        late = page.js("s => studio.store.curve.timeAt(s)", state["s"])
        assert late <= time + 1e-3
        assert page.js("s => studio.store.curve.timeAt(s)", state["s"] + 1e-2) >= time - 1e-3
    seek(page, 0)
    page.page.get_by_role("button", name="Play the plan").click()
    page.until("studio.preview.time > 0.2")
    page.page.get_by_role("button", name="Pause the plan").click()
    assert not page.js("studio.preview.isPlaying")


def test_a_keyframe_is_dragged_planned_past_undone_and_saved(visit: Visit, crossing: Path) -> None:
    page = visit(crossing)
    before = page.doc
    straight = page.plan["spans"]
    page.drag([20, 25], [20, 18])  # slower: now it is in the way
    assert cart(page)["motion"]["keyframes"][1] == [10, 20, 18, 90]
    assert cart(page)["motion"]["keyframes"][0] == [0, 20, 5, 90]
    assert page.plan["ok"]
    assert page.plan["spans"] != straight
    assert page.plan["timing"]["certificate"]["holds"]
    assert page.plan["timing"]["certificate"]["obstacle"] == "cart"
    page.until("studio.store.spaceTime?.rev === studio.store.plan.rev")
    page.press("Control+z")
    assert page.doc == before
    page.press("Control+Shift+z")
    page.press("Control+s")
    page.until("!studio.store.dirty")
    text = crossing.read_text()
    assert "# it comes from the south" in text
    assert read_document(crossing).data["world"]["known"][0] == cart(page)


def test_a_body_is_dragged_with_its_whole_way(visit: Visit, crossing: Path) -> None:
    page = visit(crossing)
    seek(page, 5)
    page.drag([20.3, 15.4], [24.3, 16.4])
    (_, x0, y0, _), (_, x1, y1, _) = cart(page)["motion"]["keyframes"]
    assert [x0, x1] == pytest.approx([24, 24], abs=0.1)
    assert [y0, y1] == pytest.approx([6, 26], abs=0.1)


def test_keyframes_are_typed_added_and_taken_out(visit: Visit, crossing: Path) -> None:
    page = visit(crossing)
    page.page.get_by_role("button", name="cart, moving polygon").click()
    page.settle()
    page.page.get_by_label("keyframe 2, t in s").fill("12")
    page.page.get_by_label("keyframe 2, heading in °").fill("120")
    page.page.keyboard.press("Tab")
    page.settle()
    assert cart(page)["motion"]["keyframes"][1] == [12, 20, 25, 120]
    page.js("studio.store.select('known:0:0')")
    page.settle()
    page.page.get_by_role("button", name="Keyframe after 1").click()
    page.settle()
    assert cart(page)["motion"]["keyframes"][1] == [6, 20, 15, 105]
    assert page.js("studio.store.selection") == "known:0:1"
    page.page.get_by_role("button", name="Delete keyframe 1").click()
    page.settle()
    assert [k[0] for k in cart(page)["motion"]["keyframes"]] == [6, 12]
    page.page.get_by_label("Then it").select_option("vanish")
    page.settle()
    assert cart(page)["motion"]["after"] == "vanish"
    page.page.get_by_label("May be off by in m").fill("0.3")
    page.page.keyboard.press("Tab")
    page.settle()
    assert cart(page)["motion"]["error"] == {"position_m": 0.3}
    assert page.plan["ok"]


def test_what_stands_begins_to_move_and_stands_again_where_it_is(
    visit: Visit, crossing: Path
) -> None:
    page = visit(crossing)
    page.js("studio.store.select('known:1')")
    page.settle()
    moves = page.page.get_by_label("How it moves")
    moves.select_option("straight")
    page.settle()
    rock = page.doc["world"]["known"][1]
    assert rock["circle"]["center"] == [0, 0]
    assert rock["motion"] == {"from": [30, 20], "velocity_mps": [1, 0]}
    assert page.plan["ok"]
    seek(page, 4)
    page.page.get_by_label("How it moves").select_option("stands")
    page.settle()
    rock = page.doc["world"]["known"][1]
    assert rock == {"name": "rock", "circle": {"center": [34, 20], "radius": 2}}


def test_the_panel_and_the_ledger_say_what_is_waited_for(visit: Visit, crossing: Path) -> None:
    page = visit(crossing)
    page.drag([20, 25], [20, 18])
    page.until("studio.store.spaceTime?.rev === studio.store.plan.rev")
    shown = page.js("studio.store.spaceTime")
    assert [one["obstacle"] for one in shown["blocked"]] == ["cart"]
    words = page.page.locator("#summary").inner_text()
    assert "proven clear of what moves, at every instant" in words
    for wait in page.plan["timing"]["waits"]:
        assert f"for {wait['obstacle']}" in words
    page.page.locator("#summary").get_by_role("button", name="tightest at").last.click()
    proof = page.plan["timing"]["certificate"]
    assert page.js("studio.preview.time") == pytest.approx(proof["tightest_at_s"])
    box = page.page.locator("#space-time").bounding_box()
    page.page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert page.js("studio.preview.time") == pytest.approx(
        (shown["begin"] + shown["end"]) / 2, rel=0.1
    )


EDITS = """async ([seed, count]) => {
  const motions = await import('/page/js/core/motion_edits.js');
  const { setManner, setKeyframe, addKeyframe, setAfter, setError } = motions;
  const { moveTo, remove, toggleUnseen } = await import('/page/js/core/edits.js');
  const { fewestOf } = await import('/page/js/shapes/moving.js');
  let state = seed;
  const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const pick = (list) => list[Math.floor(random() * list.length)];
  const afters = (count) =>
    ['loop', 'bounce', 'stay', 'vanish'].filter((after) => count >= fewestOf({ after }));
  const upTo = (most) => Math.round(random() * most);
  const faults = [];
  for (let n = 0; n < count; n += 1) {
    const { doc } = studio.store;
    const lists = ['known', 'unseen'].filter((list) => doc.world[list]?.length);
    const list = pick(lists);
    const i = Math.floor(random() * doc.world[list].length);
    const id = `${list}:${i}`;
    const item = doc.world[list][i];
    const frames = item.motion?.keyframes;
    const k = frames ? Math.floor(random() * frames.length) : -1;
    const time = Math.round((frames?.[k]?.[0] ?? 0) * 100 + 10) / 100;
    const deeds = [
      () => setManner(doc, id, pick(['stands', 'keyframes', 'straight']), upTo(200) / 10),
      () => moveTo(doc, k < 0 ? id : `${id}:${k}`, [upTo(40), upTo(30)]),
      () => (frames ? addKeyframe(doc, id, k) : doc),
      () => (frames ? remove(doc, `${id}:${k}`) : doc),
      () => (frames ? setKeyframe(doc, id, k, pick([1, 2, 3]), upTo(30)) : doc),
      () => (frames ? setKeyframe(doc, id, k, 3, null) : doc),
      () => (item.motion ? setError(doc, id, pick(['position_m', 'growth_mps']), upTo(1)) : doc),
      () => (frames ? setAfter(doc, id, pick(afters(frames.length))) : doc),
      () => toggleUnseen(doc, id)[0],
    ];
    studio.store.edit(pick(deeds)());
    studio.preview.seek(time);
    await studio.settled();
    const { plan } = studio.store;
    if (!plan.ok) faults.push(...plan.problems.map((one) => one.text));
  }
  return faults;
}"""


@pytest.mark.slow
@pytest.mark.parametrize("seed", [11, 2718])
def test_whatever_is_done_to_motions_they_stay_sound_and_all_is_undone(
    visit: Visit, tmp_path: Path, seed: int
) -> None:
    file = tmp_path / "many.yaml"
    file.write_text(
        "world:\n  known:\n"
        "    - {name: disc, circle: {center: [10, 22], radius: 1}, pass_on: left}\n"
        "    - {name: bar, capsule: {from: [20, 22], to: [23, 25], radius: 0.4}}\n"
        "    - {name: box, polygon: [[30, 20], [32, 20], [32, 23], [30, 23]]}\n"
        "robot: {sensor: {range_m: 20}}\nroute: {start: [0, -900], goal: [40, -900]}\n"
    )
    page = visit(file)
    before = page.doc
    assert page.js(EDITS, [seed, 50]) == []
    while page.js("studio.store.undo()"):
        pass
    page.settle()
    assert page.doc == before
