"""What is on the picture of a fleet's plan."""

from __future__ import annotations

import io
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

import viaspline as vs
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.lost_times import lost_times
from viaspline.fleet.not_served import NotServed
from viaspline.fleet.timelines import Timeline, timelines_of
from viaspline.report import style
from viaspline.report.fleet.coordination_panel import (
    forbidden_boxes,
    pair_to_show,
    shown_window,
)
from viaspline.report.fleet.fleet_colours import ROBOT_COLOURS
from viaspline.report.fleet.fleet_marks import longest_waits
from viaspline.report.fleet.fleet_picture import apart_words, fleet_picture, heading
from viaspline.report.fleet.waiting_map import waiting_seconds
from viaspline.report.fleet.waits_chart import rows_of


def pixels(picture: bytes) -> NDArray[np.uint8]:
    return np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"))


def share_of(colour: str, picture: bytes) -> float:
    """How much of a picture has about this colour."""
    shown = pixels(picture)
    near = np.ones(shown.shape[:2], bool)
    for k, i in enumerate((1, 3, 5)):  # plane by plane: a fifth of the time that all at once take
        near &= np.abs(shown[:, :, k].astype(np.int16) - int(colour[i : i + 2], 16)) < 12
    return float(near.mean())


@pytest.fixture(scope="module")
def large() -> FleetPlan:
    """45 robots that go north past one that goes east before them."""
    lanes: list[dict[str, Any]] = [
        {"name": f"r{i}", "route": {"start": [4 * i, -12], "goal": [4 * i, 12]}} for i in range(44)
    ]
    east = {"name": "east", "priority": 5, "route": {"start": [-6, 0], "goal": [180, 0]}}
    return vs.plan_fleet(
        vs.Fleet.model_validate({"separation_m": 1, "robots": {"a": {}}, "fleet": [*lanes, east]})
    )


def test_robots_and_forbidden_boxes_are_on_the_picture(fleet_plan: FleetPlan) -> None:
    picture = fleet_picture(fleet_plan, "yard")
    height, width, _ = pixels(picture).shape
    assert 0.7 < width / height < 4.0
    for colour in (*ROBOT_COLOURS[:3], style.OBSTACLE, style.MOVING_FILL, style.TIGHTEST):
        assert share_of(colour, picture) > 1e-5, colour
    assert share_of(ROBOT_COLOURS[3], picture) == 0.0


def test_the_same_plan_of_a_fleet_gives_the_same_bytes(fleet_plan: FleetPlan) -> None:
    assert fleet_picture(fleet_plan, "yard") == fleet_picture(fleet_plan, "yard")


def test_a_large_fleet_has_rows_for_the_latest_and_a_map_of_lost_time(large: FleetPlan) -> None:
    timelines = timelines_of(large)
    rows = rows_of(timelines)
    assert len(rows) == 8
    assert 0 < sum(one.late > 0.05 for one in timelines) < 8
    left_out = {one.name for one in timelines} - {one.name for one in rows}
    late = {one.name: one.late for one in timelines}
    assert max(late[name] for name in left_out) <= min(one.late for one in rows)
    sums = waiting_seconds(large, (-10.0, -16.0, 190.0, 16.0))
    assert sums.sum() == pytest.approx(lost_times(large).all.sum())
    assert share_of(ROBOT_COLOURS[1], fleet_picture(large, "lanes")) > 1e-4


def test_who_is_not_served_is_marked(fleet_plan: FleetPlan) -> None:
    missing = NotServed("north", "refused", "'east' rests on its goal", "let 'east' leave")
    plans = {name: plan for name, plan in fleet_plan.plans.items() if name != "north"}
    half = replace(fleet_plan, plans=plans, not_served=(missing,))
    title, _ = heading(half, timelines_of(half), "yard")
    assert title.startswith("yard: 2 of 3 robots served")
    assert share_of(style.TIGHTEST, fleet_picture(half, "yard")) > 1e-5


def test_a_fleet_of_one_gives_a_picture() -> None:
    only = {"fleet": [{"name": "one", "route": {"start": [0, 0], "goal": [9, 3]}}]}
    plan = vs.plan_fleet(vs.Fleet.model_validate(only))
    assert apart_words(plan.certificate) == "no two robots to keep apart"
    assert pair_to_show(plan) is None
    assert share_of(ROBOT_COLOURS[0], fleet_picture(plan, "one")) > 1e-4


def test_forbidden_boxes_hold_all_pairs_of_places_that_are_too_near(
    fleet_plan: FleetPlan,
) -> None:
    pair = ("east", "tug")
    boxes = forbidden_boxes(fleet_plan, *pair)
    low, high = boxes.min(axis=1), boxes.max(axis=1)
    paths = [fleet_plan.plans[name].path for name in pair]
    s, t = (np.linspace(0, path.length, 120) for path in paths)
    a, b = (np.asarray(path.at_distance(x)) for path, x in zip(paths, (s, t), strict=True))
    apart = np.hypot(*np.moveaxis(a[:, None] - b[None], -1, 0))
    near = np.argwhere(apart < 0.5 + 0.9 + 1.0)
    assert len(near) > 5
    for i, j in near:
        place = np.array([s[i], t[j]])
        assert ((low <= place + 1e-9) & (place <= high + 1e-9)).all(axis=1).any()


def test_the_window_shows_the_closest_crossing(fleet_plan: FleetPlan) -> None:
    pair = pair_to_show(fleet_plan)
    assert pair is not None
    for (low, high), name in zip(shown_window(fleet_plan, pair), pair, strict=True):
        now = float(fleet_plan.plans[name].trajectory.distance_at(fleet_plan.certificate.at_s))
        assert low <= now <= high


def test_arrows_are_drawn_for_the_longest_waits_first(large: FleetPlan) -> None:
    waits = longest_waits(timelines_of(large))
    lost = [wait.lost for _, wait in waits]
    assert 0 < len(waits) <= 40
    assert lost == sorted(lost, reverse=True)
    assert {wait.other for _, wait in waits} == {"east"}


def test_a_large_fleet_in_which_nobody_is_late_has_some_rows_and_one_that_is_late_forty() -> None:
    assert len(rows_of([Timeline(f"r{i}", (), 0.0) for i in range(100)])) == 8
    late = [Timeline(f"r{i}", (), float(i)) for i in range(100)]
    assert [one.late for one in rows_of(late)] == list(range(99, 59, -1))


def test_few_robots_keep_their_order_in_the_chart() -> None:
    shown = [Timeline("b", (), 0.0), Timeline("a", (), 5.0)]
    assert rows_of(shown) == shown
