import base64
import re
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest

import viaspline as vs

NAUGHTY = "<b>tank & 'co'</b>"
MISSION = vs.Mission.model_validate(
    {
        "world": {"known": [{"name": NAUGHTY, "circle": {"center": [25, 0.5], "radius": 4}}]},
        "route": {"start": [0, 0], "goal": [50, 0]},
    }
)
PLAN = vs.plan(MISSION)
TOWER = {"circle": {"center": [25, 0.5], "radius": 4}, "height_m": [0, 30]}
FLOWN = vs.plan(
    vs.Mission.model_validate(
        {
            "world": {"known": [TOWER], "ground": {"flat_m": 0}, "bounds": [-9, -20, 60, 20]},
            "route": {"start": [0, 0, 10], "goal": [50, 0, 15]},
        }
    )
)
PAIR = vs.Fleet.model_validate(
    {"fleet": [{"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}}]}
)
FLEET_PLAN = vs.plan_fleet(PAIR)
CELLS = np.array([[True, False], [False, False]])
FENCED = vs.World(
    [vs.Obstacle(grid=vs.Grid(CELLS, 1.0))],
    bounds=(-9, -9, 9, 9),
    fences=[[(0, 0), (9, 0), (0, 9)]],
)
STOPS = vs.retime(PLAN.path, vs.Limits(max_speed=1, max_accel=1), [vs.Station(5.0, 4.0)])
TOLD: dict[str, tuple[Any, str]] = {
    "mission": (MISSION, "2 points"),
    "fleet": (PAIR, "1 robot"),
    "plan": (PLAN, "clearance, proven"),
    "plan in space": (FLOWN, "above ground, proven"),
    "run": (vs.simulate(MISSION, plan=PLAN), "reached its goal"),
    "flight": (vs.fly(FLOWN), "other paths under way"),
    "fleet plan": (FLEET_PLAN, "1 of 1"),
    "fleet run": (vs.simulate_fleet(PAIR, plan=FLEET_PLAN), "later than planned"),
    "spline": (vs.CardinalSpline([(0, 0), (3, 1), (5, 0)], closed=True), "via points         3"),
    "path": (PLAN.path, "of detours"),
    "law": (STOPS, "1 stop of 4 s together"),
    "world": (FENCED, "maps"),
    "world in space": (FLOWN.world, "flat, at 0.00 m"),
    "grid": (vs.Grid(CELLS, 0.5, unknown=CELLS, source="yard.yaml"), "25.0 %"),
}


class Tags(HTMLParser):
    """Every tag that is opened and closed."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[str] = []

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.seen.append(tag)
        if tag != "img":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag != "img":
            assert self.open.pop() == tag


@pytest.mark.parametrize("name", TOLD)
def test_a_summary_is_a_few_lines_of_names_and_facts(name: str) -> None:
    value, fact = TOLD[name]
    lines = value.summary().splitlines()
    assert lines[0] == type(value).__name__
    assert fact in value.summary()
    assert 2 <= len(lines) <= 25
    assert all(line.startswith("  ") for line in lines[1:])


@pytest.mark.parametrize("name", TOLD)
def test_a_page_is_sound_html_with_the_facts_and_the_picture(name: str) -> None:
    value, _ = TOLD[name]
    page = value._repr_html_()
    tags = Tags()
    tags.feed(page)
    assert not tags.open
    assert tags.seen.count("tr") == len(value.summary().splitlines()) - 1
    pictures = re.findall(r"data:image/png;base64,([\w+/=]+)", page)
    if hasattr(value, "plot"):
        assert [base64.b64decode(one) for one in pictures] == [value._repr_png_()]
    else:
        assert not pictures


def test_names_of_the_users_own_are_text_and_no_html() -> None:
    page = PLAN._repr_html_()
    assert NAUGHTY not in page
    assert "&lt;b&gt;tank &amp; &#x27;co&#x27;&lt;/b&gt;" in page
    assert NAUGHTY in PLAN.summary()
