"""The spline that every path begins with: laid, refused, or given up."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.methods.clear_spline import ClearSpline
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.planning.routing.exact_route import ExactRoute
from viaspline.planning.routing.lattice_route import LatticeRoute
from viaspline.planning.routing.leg_errors import BlockedLegError, UnfinishedLegError
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.planning.routing.router import Router

DISC = {"circle": {"center": [50, 1], "radius": 8}}


def wall(*slots: tuple[float, float]) -> list[dict[str, Any]]:
    """Across everything at x = 49 to 51, with slots of (middle, width)."""
    edges = [0.0, *(edge for y, width in slots for edge in (y - width / 2, y + width / 2)), 100.0]
    return [
        {"polygon": [[49, low], [51, low], [51, high], [49, high]]}
        for low, high in zip(edges[::2], edges[1::2], strict=True)
    ]


def problem(known: Any, start: Any = (5, 50), goal: Any = (95, 50), **budget: Any) -> PathProblem:
    mission = vs.Mission.model_validate({
        "world": {"known": known, "bounds": [0, 0, 100, 100]},
        "robot": {"radius_m": 1.0, "clearance_m": 0},
        "route": {"start": start, "goal": goal},
    })  # fmt: skip
    return PathProblem.of(
        via_sequence_of(mission), vs.World.known(mission), Requirements.of(mission)
    )


def with_budget(asked: PathProblem, gaps: int) -> PathProblem:
    """The problem for a router that gives up after so many gaps of a lattice."""
    router = Router(
        asked.world, asked.requirements.required, asked.router.places, (LatticeRoute(gaps),)
    )
    return PathProblem(asked.sequence, asked.world, asked.requirements, router)


def test_a_blocked_leg_is_led_round_and_the_account_names_it() -> None:
    asked = problem([{"circle": {"center": [50, 51], "radius": 8}}])
    cleared = ClearSpline().lay(asked)
    line = shapely.LineString(vs.PiecewiseCubic(cleared.spline_path.spans).sample(0.05)[2])
    assert line.distance(shapely.Point(50, 51)) >= 9 - 1e-6
    assert list(cleared.passed) == [0]


def test_a_leg_that_is_shut_off_is_refused() -> None:
    with pytest.raises(BlockedLegError) as caught:
        ClearSpline().lay(problem(wall()))
    assert caught.value.via == "goal"
    assert isinstance(caught.value, vs.NoPathError)


@pytest.mark.parametrize("gaps", [1, 200])
def test_slots_that_are_too_narrow_are_refused_even_where_the_search_ran_out(gaps: int) -> None:
    slots = [(4.0 + 9 * k, 1.9) for k in range(11)]
    with pytest.raises(BlockedLegError, match="no way from 'start' to 'goal' is wide enough"):
        ClearSpline().lay(with_budget(problem(wall(*slots)), gaps))


def test_a_search_that_ran_out_says_so_and_what_was_tried() -> None:
    slots = [(4.0 + 9 * k, 1.9 if k else 2.00001) for k in range(11)]
    with pytest.raises(UnfinishedLegError, match="none is ruled out") as caught:
        ClearSpline().lay(with_budget(problem(wall(*slots)), gaps=1))
    error = caught.value
    assert isinstance(error, vs.GaveUpError)
    assert not isinstance(error, vs.NoPathError)
    assert "gaps" in error.tried[0]
    assert "robot.clearance_m" in error.remedy or "radius" in error.remedy
    assert np.isfinite(error.where).all()


def test_an_exact_search_that_ran_out_proves_nothing_by_itself() -> None:
    asked = problem([DISC | {"circle": {"center": [50, 50], "radius": 8}}])
    space = asked.router
    router = Router(space.world, space.required, space.places, (ExactRoute(max_met=0),))
    with pytest.raises(UnfinishedLegError):
        ClearSpline().lay(PathProblem(asked.sequence, asked.world, asked.requirements, router))


def test_rounds_that_run_out_are_given_up_with_the_via_point_that_has_least_room() -> None:
    known = [{"circle": {"center": [50, 51], "radius": 8}}]
    with pytest.raises(vs.GaveUpError, match="no curve was found that passes") as caught:
        ClearSpline(max_rounds=1).lay(problem(known))
    assert caught.value.tried == ("1 rounds of drawing the spline in",)


def bracket(right: float, thickness: float) -> list[dict[str, Any]]:
    """Walls end to end, past which a way leads by four corners that stand in a straight line."""
    walls = [
        (0.0, 30.0, right, 30.0 + thickness),
        (right - thickness, 30.0, right, 70.0),
        (20.0, 70.0 - thickness, right, 70.0),
    ]
    return [{"polygon": [[a, b], [c, b], [c, d], [a, d]]} for a, b, c, d in walls]


@settings(max_examples=15, deadline=None)
@example(right=70.123, thickness=1.0, radius=0.1, share=0.2)
@given(
    right=st.floats(60.0, 80.0),
    thickness=st.floats(0.1, 3.0),
    radius=st.floats(0.02, 6.0),
    share=st.floats(0.05, 1.0),
)
def test_the_path_of_a_slimmer_robot_is_no_longer(
    right: float, thickness: float, radius: float, share: float
) -> None:
    lengths = [
        vs.plan(
            vs.Mission.model_validate({
                "world": {"known": bracket(right, thickness), "bounds": [0, 0, 100, 100]},
                "robot": {"radius_m": kept, "clearance_m": 0},
                "route": {"start": [10, 15], "goal": [10, 85], "optimise": "length"},
            })
        ).path.length
        for kept in (share * radius, radius)
    ]  # fmt: skip
    assert lengths[0] <= lengths[1] * (1.0 + 1e-4)


@pytest.mark.parametrize(("kept", "low"), [(0.062, 2.672618), (0.03, 2.055025), (0.2, 1.258755)])
def test_a_gap_as_wide_as_a_route_turns_beyond_what_is_required_is_passed(
    kept: float, low: float
) -> None:
    high = low + 2 * kept + 1e-3
    walls = [
        [[2, 0], [2.05, 0], [2.05, low], [2, low]],
        [[2, high], [2.05, high], [2.05, 4], [2, 4]],
    ]
    mission = vs.Mission.model_validate({
        "world": {"known": [{"polygon": wall} for wall in walls], "bounds": [0, 0, 7, 4]},
        "robot": {"radius_m": kept, "clearance_m": 0},
        "route": {"start": [0.5, 3.37], "goal": [6, 1.18]},
    })  # fmt: skip
    assert vs.plan(mission).certificate.holds
