"""The ledger over random worlds: both sides of every group, measured, and one of them taken."""

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.problem.ledger import Candidate

seeds = st.integers(0, 100_000)
SIDES = ("left", "right")


def random_case(seed: int, forced: float) -> vs.Mission | None:
    """One leg to the east across circles, some of them with a side of their own."""
    rng = np.random.default_rng(seed)
    known: list[dict[str, Any]] = []
    for k in range(int(rng.integers(1, 14))):
        x, y, radius = rng.uniform(12, 88), rng.normal(0, 14), rng.uniform(1, 9)
        known.append({"name": f"o{k}", "circle": {"center": [x, y], "radius": radius}})
        if rng.random() < forced:
            key = str(rng.choice(["pass_on", "never_pass_on"]))
            known[-1][key] = str(rng.choice(SIDES))
    try:
        return vs.Mission.model_validate(
            {"world": {"known": known}, "route": {"start": [0, 0], "goal": [100, 0]}}
        )
    except vs.MissionError:
        return None  # an end is covered


def side_of(candidate: Candidate, centre: tuple[float, float]) -> str:
    """The side on which a curve passes a place: where it crosses the line across the leg there."""
    curve = vs.PiecewiseCubic(candidate.spans)
    points = curve.evaluate(np.linspace(0, curve.domain[1], 5000))
    east = points[:, 0] > centre[0]
    crossings = points[1:][east[1:] != east[:-1], 1]
    left = int((crossings > centre[1]).sum())
    assert left % 2 != (len(crossings) - left) % 2
    return "left" if left % 2 else "right"


@settings(max_examples=60)
@given(seeds)
def test_both_sides_of_every_group_are_there_and_the_fastest_is_taken(seed: int) -> None:
    mission = random_case(seed, 0.0)
    if mission is None:
        return
    found = vs.plan(mission)
    circles = {o.name: o.circle for o in mission.world.known}
    line = shapely.LineString([(0, 0), (100, 0)])
    blocking = {
        name
        for name, circle in circles.items()
        if circle and shapely.Point(circle.center).distance(line) < circle.radius + 1
    }
    members = [name for entry in found.ledger for name in entry.members]
    assert blocking <= set(members)
    assert len(members) == len(set(members))
    for entry in found.ledger:
        assert [c.side for c in entry.candidates] == ["left", "right"]
        (chosen,) = (c for c in entry.candidates if c.chosen)
        np.testing.assert_array_equal(chosen.spans, found.path.spans)
        inside = [name for name in entry.members if name in blocking]
        for candidate in entry.candidates:
            if candidate.impossible is not None:
                assert len(candidate.spans) == 0
                continue
            curve = vs.PiecewiseCubic(candidate.spans)
            assert candidate.length == pytest.approx(curve.length, rel=1e-6)
            # each is bent less for up to 0.2 % of its length once the side is chosen
            assert candidate.duration >= chosen.duration * (1.0 - 3e-3)
            assert vs.certify(curve, found.world, 0.5, radius=0.5).holds
            for name in inside[:1]:
                assert side_of(candidate, circles[name].center) == candidate.side


@settings(max_examples=60)
@given(seeds)
def test_sides_that_are_asked_for_are_kept_by_every_candidate(seed: int) -> None:
    mission = random_case(seed, 0.4)
    if mission is None:
        return
    asked = {o.name for o in mission.world.known if o.forced_side}
    error = None
    try:
        found = vs.plan(mission)
    except vs.NoPathError as refusal:
        error = refusal
    if error is not None:
        assert set(error.obstacles) <= asked  # nothing but the sides can close an open plane
        return
    met = {name for entry in found.ledger for name in entry.members}
    for entry in found.ledger:
        assert [c.chosen for c in entry.candidates].count(True) == 1
        for candidate in entry.candidates:
            if candidate.impossible is not None:
                continue
            for obstacle in mission.world.known:
                if obstacle.name in met and obstacle.forced_side and obstacle.circle:
                    assert side_of(candidate, obstacle.circle.center) == obstacle.forced_side


def test_a_side_with_a_way_and_no_curve_along_it_is_not_told_to_be_too_narrow() -> None:
    known = [
        {"name": "lake", "circle": {"center": [5e4, 5e4], "radius": 9e3}},
        {"name": "pole", "circle": {"center": [2e4, 20_000.2], "radius": 0.1}},
    ]
    mission = vs.Mission.model_validate({
        "world": {"known": known, "bounds": [0, 0, 1e5, 1e5]},
        "robot": {"radius_m": 1, "clearance_m": 2, "max_speed_mps": 20},
        "route": {"start": [1e3, 1e3], "via": [[3e4, 3e4]], "goal": [9.9e4, 9.9e4]},
    })  # fmt: skip
    (left, _), _ = (entry.candidates for entry in vs.plan(mission).ledger)
    assert left.impossible == "no curve was found along the way on the left"
