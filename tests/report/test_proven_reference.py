"""All that says "proven" says where it is written what that covers."""

import json
from pathlib import Path

import pytest
from matplotlib.figure import Figure

import viaspline as vs
from viaspline.report.files.fleet_json import fleet_json
from viaspline.report.files.fleet_run_json import fleet_run_json
from viaspline.report.files.plan_json import plan_json
from viaspline.report.files.run_json import run_json
from viaspline.report.notebook.notebook_page import html_page, summary_text
from viaspline.report.proven_reference import PROVEN_PAGE, PROVEN_WORDS, folded_page
from viaspline.report.sheet import new_sheet
from viaspline.report.space.spatial_json import flight_json, spatial_plan_json

ROOT = Path(__file__).parents[2]
ROUTE = {"start": [0, 0], "goal": [40, 0]}
FLAT = {"world": {"known": [{"circle": {"center": [20, 1], "radius": 3}}]}, "route": ROUTE}
FLIGHT = {"world": {"ground": {"flat_m": 0}}, "route": {"start": [0, 0, 5], "goal": [40, 0, 5]}}
FLEET = {"fleet": [{"name": "a", "route": ROUTE}]}


def test_the_page_is_one_of_the_documentation() -> None:
    assert (ROOT / PROVEN_PAGE).read_text().startswith("# What is proven, and what is not")
    assert "What is proven, and what is not" in folded_page()
    assert "href" not in folded_page()
    assert " id=" not in folded_page()


def test_every_document_says_what_proven_means() -> None:
    planned = vs.plan(vs.Mission.model_validate(FLAT))
    flight = vs.plan(vs.Mission.model_validate(FLIGHT))
    fleet = vs.plan_fleet(vs.Fleet.model_validate(FLEET))
    documents = [
        plan_json(planned, "x", spacing=0.1),
        run_json(vs.simulate(planned.mission, plan=planned), "x"),
        spatial_plan_json(flight, "x"),
        flight_json(vs.fly(flight), "x"),
        fleet_json(fleet, "x", {"a": "a"}),
        fleet_run_json(vs.simulate_fleet(fleet.fleet, plan=fleet), "x"),
    ]
    assert {json.loads(text)["proven_means"] for text in documents} == {PROVEN_PAGE}


def test_a_page_of_a_notebook_unfolds_it() -> None:
    planned = vs.plan(vs.Mission.model_validate(FLAT))
    assert folded_page() in html_page(planned)
    assert PROVEN_WORDS in summary_text(planned)
    assert PROVEN_WORDS not in summary_text(planned.mission)
    assert "<details>" not in html_page(planned.mission)


@pytest.mark.parametrize(
    ("line", "is_told"), [("proven: nowhere closer than 1 m", True), ("as driven", False)]
)
def test_a_picture_that_says_so_has_it_at_its_foot(line: str, is_told: bool) -> None:
    figure: Figure = new_sheet((0, 0, 10, 10), (), "x", (line,)).figure
    assert (PROVEN_WORDS in [text.get_text() for text in figure.texts]) == is_told
