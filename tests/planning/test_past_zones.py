"""Speed zones are gone round where that is sooner, and driven through where it isn't."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs

ROBOT = {"radius_m": 0.4, "max_speed_mps": 2.0, "max_accel_mps2": 2.0}
ENDS = [[0.0, 0.0], [100.0, 0.0]]
LAB = [[40, -10], [60, -10], [60, 6], [40, 6]]


def crossing(zones: list[Any], known: tuple[Any, ...] = (), **route: Any) -> vs.Mission:
    return vs.Mission.model_validate(
        {
            "world": {"speed_zones": zones, "known": list(known)},
            "robot": ROBOT,
            "route": {"start": ENDS[0], "goal": ENDS[1], **route},
        }
    )


def zone(polygon: Any, speed: float, name: str = "lab") -> dict[str, Any]:
    return {"polygon": polygon, "max_speed_mps": speed, "name": name}


def metres_inside(plan: vs.Plan, polygon: Any) -> float:
    places = plan.path.evaluate(np.linspace(0.0, len(plan.path.spans), 4001))
    return float(shapely.LineString(places).intersection(shapely.Polygon(polygon)).length)


def soonest_by_hand(corners: np.ndarray, speed: float) -> float:
    """Straight through the zone, or along straight lines round some of its corners [s]."""
    area = shapely.Polygon(corners).buffer(-1e-9)
    times = []
    for count in range(len(corners) + 1):
        for some in itertools.permutations(range(len(corners)), count):
            line = shapely.LineString([ENDS[0], *corners[list(some)], ENDS[1]])
            slow = line.intersection(area).length
            if slow == 0.0 or count == 0:
                times.append((line.length - slow) / 2.0 + slow / speed)
    return min(times) + 1.0  # to speed up and to slow down


@settings(deadline=None, max_examples=12)
@given(
    st.floats(15, 85), st.floats(-12, 12), st.floats(3, 20), st.floats(3, 20),
    st.floats(0.0, math.pi / 2), st.floats(0.1, 1.9),
)  # fmt: skip
@example(50.0, -2.0, 10.0, 8.0, 0.0, 0.5)
@example(50.0, 1.0, 3.0, 20.0, 0.3, 1.8)
def test_no_straight_lines_round_a_zone_or_through_it_are_sooner(
    x: float, y: float, width: float, height: float, turned: float, speed: float
) -> None:
    c, s = math.cos(turned), math.sin(turned)
    half = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [0.5 * width, 0.5 * height]
    corners = half @ np.array([[c, s], [-s, c]]) + [x, y]
    plan = vs.plan(crossing([zone(corners.tolist(), speed)], detours="short"))
    assert plan.trajectory.duration <= 1.01 * soonest_by_hand(corners, speed) + 0.5
    if metres_inside(plan, corners) == 0.0:
        assert plan.trajectory.duration >= plan.path.length / 2.0


def test_a_slow_zone_is_gone_round_on_the_sooner_side_and_the_ledger_tells_the_others() -> None:
    plan = vs.plan(crossing([zone(LAB, 0.5)]))
    assert metres_inside(plan, LAB) == 0.0
    [entry] = plan.ledger
    assert entry.members == ("speed zone 'lab'",)
    times = {one.side: one.duration for one in entry.candidates}
    assert entry.chosen is not None
    assert entry.chosen.side == "left"
    assert times["left"] < times["right"] < times["through"]
    assert {one.clearance for one in entry.candidates} == {math.inf}  # nothing stands there
    assert times["through"] == pytest.approx(80 / 2.0 + 20 / 0.5 + 2.0, abs=0.5)


def test_a_zone_that_costs_less_than_the_way_round_is_driven_through() -> None:
    plan = vs.plan(crossing([zone(LAB, 1.9)]))
    assert metres_inside(plan, LAB) == pytest.approx(20.0, abs=1e-3)
    assert plan.ledger == ()


@pytest.mark.parametrize("inside", [[50, 0], [41, 5.9]])
def test_a_zone_with_a_via_point_in_it_is_driven_through(inside: list[float]) -> None:
    plan = vs.plan(crossing([zone(LAB, 0.5)], via=[inside]))
    assert metres_inside(plan, LAB) > 1.0
    assert any(np.allclose(via.at[:2], inside) for via in plan.path.vias)


def test_a_zone_from_wall_to_wall_is_driven_through() -> None:
    walls = (
        {"polygon": [[-9, 6], [109, 6], [109, 9], [-9, 9]]},
        {"polygon": [[-9, -13], [109, -13], [109, -10], [-9, -10]]},
        {"polygon": [[-9, -13], [-6, -13], [-6, 9], [-9, 9]]},
    )
    slow = crossing([zone(LAB, 0.2)], walls)
    assert metres_inside(vs.plan(slow), LAB) == pytest.approx(20.0, abs=0.1)


def test_two_zones_side_by_side_are_gone_round_together() -> None:
    both = [zone(LAB, 0.3), zone([[40, 6], [60, 6], [60, 12], [40, 12]], 0.3, "store")]
    plan = vs.plan(crossing(both))
    assert all(metres_inside(plan, one["polygon"]) == 0.0 for one in both)


def test_a_zone_that_the_way_round_another_would_meet_is_left_out_as_well() -> None:
    beside = zone([[30, 7], [70, 7], [70, 40], [30, 40]], 0.2, "store")
    plan = vs.plan(crossing([zone(LAB, 0.2), beside]))
    assert metres_inside(plan, LAB) == 0.0
    assert metres_inside(plan, beside["polygon"]) == 0.0


def test_by_length_zones_are_no_reason_to_go_round() -> None:
    plan = vs.plan(crossing([zone(LAB, 0.5)], optimise="length"))
    assert plan.path.length == pytest.approx(100.0)


def test_what_stands_is_kept_clear_of_beside_a_zone_that_is_gone_round() -> None:
    post = {"circle": {"center": [50, 8], "radius": 1.0}}
    plan = vs.plan(crossing([zone(LAB, 0.3)], (post,)))
    assert plan.certificate.holds
    places = plan.path.evaluate(np.linspace(0.0, len(plan.path.spans), 4001))[:, :2]
    assert np.linalg.norm(places - [50, 8], axis=1).min() >= 1.0 + 0.4 + 0.5 - 1e-6
    assert metres_inside(plan, LAB) == 0.0
