import base64
import re
from collections.abc import Callable
from functools import cache
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.report.proven_reference import PROVEN_WORDS

NAUGHTY = "<b>tank & 'co'</b>"
MISSION = vs.Mission.model_validate(
    {
        "world": {"known": [{"name": NAUGHTY, "circle": {"center": [25, 0.5], "radius": 4}}]},
        "route": {"start": [0, 0], "goal": [50, 0]},
    }
)
TOWER = {"circle": {"center": [25, 0.5], "radius": 4}, "height_m": [0, 30]}
FLIGHT = vs.Mission.model_validate(
    {
        "world": {"known": [TOWER], "ground": {"flat_m": 0}, "bounds": [-9, -20, 60, 20]},
        "route": {"start": [0, 0, 10], "goal": [50, 0, 15]},
    }
)
PAIR = vs.Fleet.model_validate(
    {"fleet": [{"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}}]}
)
CELLS = np.array([[True, False], [False, False]])


@cache
def planned() -> vs.Plan:
    return vs.plan(MISSION)


@cache
def flown() -> Any:
    return vs.plan(FLIGHT)


@cache
def fleet_plan() -> vs.FleetPlan:
    return vs.plan_fleet(PAIR)


def fenced() -> vs.World:
    grid = vs.Obstacle(grid=vs.Grid(CELLS, 1.0))
    return vs.World([grid], bounds=(-9, -9, 9, 9), fences=[[(0, 0), (9, 0), (0, 9)]])


def stopping() -> vs.Trajectory:
    limits = vs.Limits(max_speed=1, max_accel=1)
    return vs.retime(planned().path, limits, [vs.Station(5.0, 4.0)])


TOLD: dict[str, tuple[Callable[[], Any], str]] = {
    "mission": (lambda: MISSION, "2 points"),
    "fleet": (lambda: PAIR, "1 robot"),
    "plan": (planned, "clearance, proven"),
    "plan in space": (flown, "above ground, proven"),
    "run": (lambda: vs.simulate(MISSION, plan=planned()), "reached its goal"),
    "flight": (lambda: vs.fly(flown()), "other paths under way"),
    "fleet plan": (fleet_plan, "1 of 1"),
    "fleet run": (lambda: vs.simulate_fleet(PAIR, plan=fleet_plan()), "later than planned"),
    "spline": (
        lambda: vs.CardinalSpline([(0, 0), (3, 1), (5, 0)], closed=True),
        "via points         3",
    ),
    "path": (lambda: planned().path, "of detours"),
    "law": (stopping, "1 stop of 4 s together"),
    "world": (fenced, "maps"),
    "world in space": (lambda: flown().world, "flat, at 0.00 m"),
    "grid": (lambda: vs.Grid(CELLS, 0.5, unknown=CELLS, source="yard.yaml"), "25.0 %"),
}


@cache
def told(name: str) -> tuple[Any, str]:
    made, fact = TOLD[name]
    return made(), fact


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
    value, fact = told(name)
    lines = value.summary().splitlines()
    assert lines[0] == type(value).__name__
    assert fact in value.summary()
    assert 2 <= len(lines) <= 25
    assert all(line.startswith("  ") for line in lines[1:])


@pytest.mark.parametrize("name", TOLD)
def test_a_page_is_sound_html_with_the_facts_and_the_picture(name: str) -> None:
    value, _ = told(name)
    page = value._repr_html_()
    tags = Tags()
    tags.feed(page)
    assert not tags.open
    facts = [line for line in value.summary().splitlines()[1:] if PROVEN_WORDS not in line]
    assert page.split("<details>")[0].count("<tr>") == len(facts)
    pictures = re.findall(r"data:image/png;base64,([\w+/=]+)", page)
    if hasattr(value, "plot"):
        assert [base64.b64decode(one) for one in pictures] == [value._repr_png_()]
    else:
        assert not pictures


def test_names_of_the_users_own_are_text_and_no_html() -> None:
    page = planned()._repr_html_()
    assert NAUGHTY not in page
    assert "&lt;b&gt;tank &amp; &#x27;co&#x27;&lt;/b&gt;" in page
    assert NAUGHTY in planned().summary()
