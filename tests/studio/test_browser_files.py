"""What is laid out in a real browser is kept: in files, in the browser, in an address."""

from __future__ import annotations

import base64
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from viaspline.cli import cli
from viaspline.formats.load import load, origin_of
from viaspline.formats.yaml_document import read_document

Start = Callable[..., Any]
Visit = Callable[..., Any]


def test_what_is_saved_opens_again_and_plans_the_same_bytes(visit: Visit, patrol: Path) -> None:
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
    visit: Visit, patrol: Path
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


def test_a_closed_tab_loses_nothing(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    page.drag([270, 150], [260, 120])
    edited = page.doc
    url = page.page.url
    context = page.page.context
    page.page.close(run_before_unload=True)
    again = type(page)(context.new_page(), url)
    assert again.doc == edited
    again.page.get_by_role("button", name="Drop them").click()
    assert again.doc == read_document(patrol).data


def test_an_address_restores_the_scene(visit: Visit, patrol: Path, start: Start) -> None:
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


def test_the_page_comes_back_when_the_studio_does(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    page.js("studio.link.socket.close()")
    page.until("studio.link.socket === null")
    page.js(
        "(() => { const { doc } = studio.store;"
        "studio.store.edit({...doc, robot: {...doc.robot, radius_m: 0.7}}); })()"
    )
    page.settle()
    assert page.plan["ok"]


@pytest.mark.slow
def test_three_hundred_random_edits_end_where_the_command_line_does(
    visit: Visit, patrol: Path
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


def random_edits(page: Any, source: random.Random, count: int) -> None:
    """Edits in a row, as fast as the page takes them; see also benchmarks/studio_fuzz.py."""
    script = (Path(__file__).parents[2] / "benchmarks" / "studio_fuzz.js").read_text()
    page.js(script)
    page.js("([seed, count]) => studioFuzz(seed, count)", [source.randrange(2**31), count])


def test_the_path_is_taken_in_formats_of_others_and_what_is_proven_is_shown(
    visit: Visit, patrol: Path
) -> None:
    page = visit(patrol)
    page.press("Control+e")
    page.page.get_by_role("button", name="path.kml").click()
    page.page.get_by_role("alert").filter(has_text="give the origin").wait_for()
    page.page.get_by_label("Origin").fill("47.3977, 8.5456")
    with page.page.expect_download() as caught:
        page.page.get_by_role("button", name="path.kml").click()
    assert caught.value.suggested_filename == f"{patrol.stem}-path.kml"
    page.page.get_by_text("not carried: speeds").wait_for()
    told = page.page.locator("#dialog-body")
    meaning = told.get_by_role("link", name="proven").get_attribute("href")
    assert meaning == "/page/proven.html#a-path"
    assert "docs/" not in told.inner_text()  # the page is the studio's own
    page.page.get_by_role("button", name="OK").click()


def test_what_was_proven_of_the_file_before_is_not_shown_for_the_next_one(
    visit: Visit, patrol: Path
) -> None:
    patrol.with_name("other.yaml").write_text("route: {start: [0, 0], goal: [9, 0]}\n")
    page = visit(patrol)
    assert page.page.locator("#summary .proof-figure").count() == 1
    seen = page.js(
        """async () => {
          const answer = await studio.link.ask({type: "open", name: "other.yaml"});
          studio.opened(answer);
          return ["#summary", "#clock"].map((id) => document.querySelector(id).innerText);
        }"""
    )
    assert "once it is planned" in seen[0]
    assert seen[1] == "–"  # nor how long it takes
    page.settle()
    assert "nothing to keep clear of" in page.page.locator("#summary").inner_text()
    assert "nothing to keep clear of" in page.page.locator("#status").inner_text()
    assert "unlimited" not in page.page.locator("#summary").inner_text()
