"""Refusals of legs: the gap that is named is there, and each remedy serves."""

import re
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

import viaspline as vs

BOUNDS = (0.0, 0.0, 12.0, 8.0)
TOLD = re.compile(
    r"at \((\S+), (\S+)\) with (?:just )?(\d+\.\d+) m of room, (?:more than )?(\S+) m"
)


def wall(x: float, *gaps: tuple[float, float]) -> list[dict[str, Any]]:
    """A wall across the world, 0.1 m thick, with gaps from y to y."""
    ends = [-1.0, *(y for gap in gaps for y in gap), 9.0]
    return [
        {"polygon": [(x, low), (x + 0.1, low), (x + 0.1, high), (x, high)]}
        for low, high in zip(ends[::2], ends[1::2], strict=True)
    ]


def asked(known: list[Any], *places: Any, radius: float = 0.1, clearance: float = 0.4) -> dict:
    return {
        "world": {"bounds": BOUNDS, "known": known},
        "robot": {"radius_m": radius, "clearance_m": clearance},
        "route": {"start": {"at": places[0]}, "via": [{"at": at} for at in places[1:-1]],
                  "goal": {"at": places[-1]}},
    }  # fmt: skip


def refusal_of(data: dict) -> vs.NoPathError | None:
    try:
        vs.plan(vs.Mission.model_validate(data))
    except vs.NoPathError as refused:
        return refused
    return None


def followed(data: dict, error: vs.NoPathError) -> list[vs.Plan]:
    """The plans that the changes lead to, each by itself."""
    plans = []
    for change in error.changes:
        robot, route = dict(data["robot"]), dict(data["route"])
        if change.key.startswith("robot."):
            robot[change.key.removeprefix("robot.")] = change.value
        elif change.key.startswith("route.via["):
            k = int(change.key[10:].split("]")[0])
            route["via"] = [*route["via"][:k], {"at": change.value}, *route["via"][k + 1 :]]
        else:
            route[change.key.split(".")[1]] = {"at": change.value}
        mission = vs.Mission.model_validate(data | {"robot": robot, "route": route})
        plans.append(vs.plan(mission))
    return plans


@settings(max_examples=12)
@given(st.floats(1e-3, 1.2), st.floats(0.1, 0.6), st.floats(0.0, 1.0))
@example(0.9999, 0.5, 0.5)
@example(0.0041, 0.5, 0.0)
@example(0.002, 0.5, 0.5)
@example(0.6 - 1e-6, 0.3, 0.0)
def test_the_gap_told_is_as_wide_as_it_is_and_remedies_serve(
    width: float, required: float, share: float
) -> None:
    assume(width < 2.0 * required)
    known = [*wall(4.0, (3.0, 3.0 + width)), *wall(8.0, (1.0, 1.0 + 2.5 * required))]
    parts = {"radius": share * required, "clearance": (1.0 - share) * required}
    data = asked(known, (2.0, 4.0), (10.0, 4.0), **parts)
    refused = refusal_of(data)
    assert refused is not None
    told = TOLD.search(refused.reason)
    assert told is not None, refused.reason
    assert [float(told[1]), float(told[2])] == pytest.approx([4.05, 3.0 + 0.5 * width], abs=0.06)
    assert float(told[3]) == pytest.approx(width, abs=1e-3)
    assert told[3] != told[4]
    assert refused.obstacles == ("obstacle 1", "obstacle 2")
    assert refused.changes
    assert all(plan.certificate.holds for plan in followed(data, refused))


@settings(max_examples=12)
@given(st.floats(100.0, 600.0), st.floats(0.6, 0.97), st.floats(1.0, 300.0))
@example(418.48, 0.7, 5.0)
def test_a_clearance_of_hundreds_of_metres_leaves_a_curve_room_as_well(
    required: float, share: float, radius: float
) -> None:
    """A millimetre is little there: a spline touches what it passes."""
    end = 20e3 - 2.0 * share * required - radius
    data = {
        "world": {
            "bounds": (0.0, 0.0, 20e3, 20e3),
            "known": [{"capsule": {"from": (0.0, 8e3), "to": (end, 9e3), "radius": radius}}],
        },
        "robot": {"radius_m": 0.0, "clearance_m": required},
        "route": {"start": {"at": (15e3, 3e3)}, "goal": {"at": (16e3, 16e3)}},
    }
    refused = refusal_of(data)
    assert refused is not None
    assert all(plan.certificate.holds for plan in followed(data, refused))


def test_nothing_is_said_to_be_shut_off_where_a_narrow_gap_is() -> None:
    refused = refusal_of(asked(wall(4.0, (3.0, 3.001)), (2.0, 4.0), (10.0, 4.0)))
    assert refused is not None
    assert "with 0.001 m of room" in refused.reason
    refused = refusal_of(asked(wall(4.0), (2.0, 4.0), (10.0, 4.0)))
    assert refused is not None
    assert refused.reason == "nothing leads from 'start' to 'goal': 'obstacle 1' shuts it off"
    assert "open a gap of 1.003 m" in refused.remedy


def test_a_via_point_in_a_pocket_is_named_with_its_mouth() -> None:
    pocket = [{"polygon": [(5, 0), (5.1, 0), (5.1, 3), (5, 3)]},
              {"polygon": [(6.3, 0), (6.4, 0), (6.4, 3), (6.3, 3)]},
              {"polygon": [(5, 3), (5.6, 3), (5.6, 3.1), (5, 3.1)]}]  # fmt: skip
    data = asked(pocket, (5.7, 1.5), (10.0, 4.0))
    refused = refusal_of(data)
    assert refused is not None
    assert "leaves 'start', right behind it, through a gap" not in refused.reason
    data["route"]["start"]["at"] = (5.7, 2.3)
    refused = refusal_of(data)
    assert refused is not None
    assert "leaves 'start', right behind it, through a gap" in refused.reason
    assert all(plan.certificate.holds for plan in followed(data, refused))


def test_a_via_point_is_moved_only_to_where_its_other_neighbour_can_be_reached_from() -> None:
    data = asked(wall(4.0), (2.0, 4.0), (3.0, 2.0), (10.0, 4.0))
    refused = refusal_of(data)
    assert refused is not None
    assert [change.key for change in refused.changes] == ["route.goal.at"]
    assert all(plan.certificate.holds for plan in followed(data, refused))


@given(room=st.floats(0.05, 0.95), clearance=st.sampled_from([0.0, 0.2, 0.6]))
@example(room=0.6, clearance=0.5)  # 0.29 m were told, with which it was refused again
@settings(deadline=None, max_examples=5)
def test_a_radius_that_may_be_does_so_with_the_clearance_that_is_told(
    room: float, clearance: float
) -> None:
    data = asked(wall(6.0, (4.0, 4.0 + room)), (2, 3), (10, 5), radius=0.5, clearance=clearance)
    refused = refusal_of(data)
    assert refused is not None
    told = re.search(
        r"(with robot.clearance_m 0 )?the body's radius may be at most (\S+) m", refused.remedy
    )
    assert told is not None
    assert bool(told[1]) == (clearance > 0.0)
    body = {"radius_m": float(told[2]), "clearance_m": 0.0}
    assert vs.plan(vs.Mission.model_validate(data | {"robot": body})).certificate.holds


def test_clearance_that_is_lowered_leaves_the_tracking_error_what_it_needs() -> None:
    data = asked(wall(4.0, (3.0, 3.8)), (2.0, 4.0), (10.0, 4.0))
    data["robot"]["tracking_error_m"] = 0.1
    refused = refusal_of(data)
    assert refused is not None
    assert refused.changes[0].value == pytest.approx(0.2, abs=3e-3)
    assert all(plan.certificate.holds for plan in followed(data, refused))


def test_a_map_with_a_gap_between_its_cells_and_the_bounds_is_told_so() -> None:
    cells = np.zeros((40, 60), bool)
    cells[:36, 30] = True
    grid = vs.Obstacle(grid=vs.Grid(cells, 0.2))
    refused = refusal_of(asked([grid], (2.0, 4.0), (10.0, 4.0)))
    assert refused is not None
    told = TOLD.search(refused.reason)
    assert told is not None
    assert float(told[3]) == pytest.approx(0.8)
    assert set(refused.obstacles) == {"obstacle 1", "bounds"}
