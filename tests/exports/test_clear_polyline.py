"""Straight lines from proven paths: clear by shapely, near by dense samples, in random worlds."""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from viaspline.errors import PlanningError
from viaspline.exports.clear_polyline import (
    EXPORT_SLACK_M,
    ClearPolyline,
    clear_polyline,
    polyline_proof,
)
from viaspline.exports.line_proof import LineProver
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan

discs = st.lists(
    st.tuples(st.floats(10, 50), st.floats(-8, 8), st.floats(1, 5)), min_size=1, max_size=4
)


def cut(planned: Plan, chord_error: float, acceptance: float = 0.0) -> ClearPolyline:
    path = planned.path
    fixed = np.unique([0.0, *(via.u for via in path.vias if via.kind == "user"), path.domain[1]])
    return clear_polyline(
        path, LineProver.of(planned), fixed, np.empty(0), chord_error=chord_error,
        acceptance=acceptance, may_join=lambda a, b: True, most=2000, known={},
    )  # fmt: skip


def planned_among(found: list[tuple[float, float, float]]) -> Plan:
    known = [{"circle": {"center": [x, y], "radius": r}} for x, y, r in found]
    route = {"start": [0, 0], "via": [[30, 14]], "goal": [60, 0]}
    return plan(Mission.model_validate({"world": {"known": known}, "route": route}))


@settings(max_examples=40, deadline=None)
@given(discs, st.sampled_from([0.02, 0.05, 0.2]))
def test_the_lines_are_clear_and_as_near_to_the_path_as_is_said(
    found: list[tuple[float, float, float]], chord_error: float
) -> None:
    assume(all(math.dist((x, y), p) > r + 1.1 for x, y, r in found
               for p in ((0, 0), (30, 14), (60, 0))))  # fmt: skip
    try:
        planned = planned_among(found)
    except PlanningError:
        return
    lines = cut(planned, chord_error)
    assert lines.holds
    drawn = shapely.LineString(lines.points)
    for x, y, r in found:
        away = drawn.distance(shapely.Point(x, y)) - r - 0.5
        assert away >= 0.5 - EXPORT_SLACK_M
        assert away >= lines.clearances.min() - 1e-9
    u = np.linspace(0, planned.path.domain[1], 20001)
    sampled = shapely.points(planned.path.evaluate(u))
    assert shapely.distance(sampled, drawn).max() <= lines.chord_error + 1e-9
    assert lines.chord_error <= chord_error + 1e-9
    for via in planned.path.vias:
        if via.kind == "user":
            assert np.abs(lines.points - np.array(via.at)).sum(axis=1).min() < 1e-9


@settings(max_examples=15, deadline=None)
@given(discs)
def test_a_vehicle_that_cuts_corners_is_clear_too(
    found: list[tuple[float, float, float]],
) -> None:
    assume(all(math.dist((x, y), p) > r + 1.1 for x, y, r in found
               for p in ((0, 0), (30, 14), (60, 0))))  # fmt: skip
    try:
        planned = planned_among(found)
    except PlanningError:
        return
    lines = cut(planned, 0.1, 0.2)
    if not lines.holds:
        return
    at, driven = lines.points[0], [lines.points[0]]
    for point in lines.points[1:]:  # it turns as early as it may
        way = point - at
        length = float(np.linalg.norm(way))
        at = at if length <= 0.2 else point - way / length * 0.2
        driven.append(at)
    drawn = shapely.LineString(driven)
    for x, y, r in found:
        assert drawn.distance(shapely.Point(x, y)) - r - 0.5 >= 0.5 - EXPORT_SLACK_M


def test_lines_round_something_that_the_path_just_clears_are_few() -> None:
    planned = planned_among([(30, 2, 5)])
    lines = cut(planned, 0.05)
    assert lines.holds
    assert len(lines.points) < 40


def test_what_can_not_be_kept_is_told_and_not_claimed() -> None:
    planned = planned_among([(30, 2, 5)])
    wide = cut(planned, 0.05, 30.0)
    assert not wide.holds
    assert wide.clearances.min() < 0.5


def test_a_robot_in_a_gap_that_just_fits_gets_lines_that_fit_as_well() -> None:
    known = [{"polygon": [[20, 1.0001], [40, 1.0001], [40, 9], [20, 9]]},
             {"polygon": [[20, -9], [40, -9], [40, -1.0001], [20, -1.0001]]}]  # fmt: skip
    route = {"start": [0, 5], "goal": [60, -5]}
    planned = plan(Mission.model_validate({"world": {"known": known}, "route": route}))
    lines = cut(planned, 0.05)
    assert lines.holds
    drawn = shapely.LineString(lines.points)
    walls = [shapely.Polygon(one["polygon"]) for one in known]
    assert min(drawn.distance(wall) for wall in walls) == pytest.approx(1.0, abs=2e-4)


def test_a_long_body_that_turns_in_a_gap_gets_lines_that_end_on_the_path() -> None:
    known: list[Any] = [
        {"circle": {"center": [5.289, 0.7389], "radius": 0.5257420122976015}},
        {"circle": {"center": [4.3668, -1.6191], "radius": 1.152077648573482}},
    ]
    corners = [[-0.35, -0.25], [0.35, -0.25], [0.35, 0.25], [-0.35, 0.25]]
    robot: dict[str, Any] = {"footprint": corners, "clearance_m": 0.15}
    route = {"start": {"at": [0, 0], "heading_deg": -32.33505040921129},
             "goal": [10, 1.0226744566367083], "optimise": "length"}  # fmt: skip
    data = {"world": {"known": known}, "robot": robot, "route": route}
    planned = plan(Mission.model_validate(data))
    lines = cut(planned, 0.015)
    assert lines.holds
    assert len(lines.points) < 100
    body = shapely.Polygon(robot["footprint"])
    discs = [shapely.Point(one["circle"]["center"]) for one in known]
    for a, b in pairwise(lines.points):
        turned = shapely.affinity.rotate(body, math.atan2(*(b - a)[::-1]), (0, 0), use_radians=True)
        for place in (a, b):
            there = shapely.affinity.translate(turned, *place)
            for one, disc in zip(known, discs, strict=True):
                assert there.distance(disc) - one["circle"]["radius"] >= 0.15 - EXPORT_SLACK_M


def test_rows_of_short_lines_are_proven_as_each_of_them_is() -> None:
    planned = planned_among([(30, 2, 5)])
    path, prover = planned.path, LineProver.of(planned)
    u = np.linspace(0, path.domain[1], 200)
    points = np.asarray(path.evaluate(u))
    found = polyline_proof(path, prover, u, points, 0.0)
    each = [prover.proof(points[k : k + 2], 1.0).clearance for k in range(199)]
    assert (found.clearances <= np.array(each) + 1e-3).all()
    assert found.clearances.min() == pytest.approx(min(each), abs=2e-3)
