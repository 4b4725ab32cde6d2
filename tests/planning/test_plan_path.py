"""From via points to a path, with methods and budgets of the test's own."""

from __future__ import annotations

import pickle
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.methods.at_radii import AtRadii
from viaspline.planning.methods.hybrid_astar_search import HybridAStar
from viaspline.planning.methods.joint_headings import JointHeadings
from viaspline.planning.methods.next_homotopy_classes import NextHomotopyClasses
from viaspline.planning.methods.ordered import BODY_METHODS, NEARBY_HEADINGS
from viaspline.planning.methods.other_sides import OtherSides
from viaspline.planning.methods.spline_as_is import SplineAsItIs
from viaspline.planning.methods.turns_on_shortest import TurnsOnShortest
from viaspline.planning.plan_path import lay_path
from viaspline.planning.problem.method import Refusal
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.planning.routing.route_problem import NO_BARRIERS

LOOP = ([0, 0], [10, 0], [10.5, 1.5], [9, 2], [30, 20])  # nearer than the turning circle
ROOM = [[[-3, -9], [30, -9], [30, -1.5], [-3, -1.5]], [[-3, 1.5], [30, 1.5], [30, 9], [-3, 9]],
        [[30, -9], [31, -9], [31, 9], [30, 9]]]  # fmt: skip


def lay(methods: Any, *route: Any, radius: float | None = 3.0, known: Any = ()) -> Any:
    robot = {"radius_m": 0.5, "clearance_m": 0.5, "min_turn_radius_m": radius}
    mission = vs.Mission.model_validate({
        "world": {"known": [{"polygon": ring} for ring in known]},
        "robot": robot,
        "route": {"start": route[0], "via": route[1:-1], "goal": route[-1]},
    })  # fmt: skip
    sequence, world = via_sequence_of(mission), vs.World.known(mission)
    return lay_path(sequence, world, Requirements.of(mission), methods)[0]


def test_what_parts_come_to_is_kept_for_the_path_alone() -> None:
    mission = vs.Mission.model_validate({
        "world": {"known": [{"circle": {"center": [15, 0.5], "radius": 3}}]},
        "robot": {"radius_m": 0.5},
        "route": {"start": [0, 0], "goal": [30, 0]},
    })  # fmt: skip
    needs, world = Requirements.of(mission), vs.World.known(mission)
    assert needs.parts is None
    _, account = lay_path(via_sequence_of(mission), world, needs)
    kept = account.passed[0].in_the_way.leg.requirements
    assert kept == needs
    assert kept.parts is not None
    assert kept.parts.is_laid
    assert not kept.parts.found
    assert replace(kept, clearance=1.0).parts is None  # it depends on what is asked for
    assert pickle.loads(pickle.dumps(kept)).parts.is_laid


def test_a_robot_that_can_follow_any_curve_takes_the_spline() -> None:
    assert lay((SplineAsItIs(),), *LOOP, radius=None).length < 47


def test_a_spline_sharper_than_the_robot_remains_where_nothing_rounder_is_found() -> None:
    spline = lay((SplineAsItIs(),), *LOOP, radius=None)
    gives_up = AtRadii((NextHomotopyClasses(max_rows=0),))
    assert np.abs(PiecewiseCubic(spline.spans).curvature(np.linspace(0, 12, 5000))).max() > 2.0
    assert lay((SplineAsItIs(), gives_up), *LOOP, radius=None).length == spline.length
    rounder = lay((SplineAsItIs(), gives_up, AtRadii((JointHeadings(),))), *LOOP, radius=None)
    u = np.linspace(0, len(rounder.spans), 5000)
    assert np.abs(PiecewiseCubic(rounder.spans).curvature(u)).max() * 0.5 <= 1.0


def test_without_a_method_that_can_it_is_given_up_and_all_that_was_tried_is_told() -> None:
    tried: list[Any] = [SplineAsItIs()]
    with pytest.raises(vs.GaveUpError, match=r"turning circle of 3 m") as caught:
        lay(tried, *LOOP)
    assert caught.value.tried == ("the spline as it is",)
    tried += [TurnsOnShortest(), AtRadii((NextHomotopyClasses(max_rows=1),))]
    with pytest.raises(vs.GaveUpError) as caught:
        lay(tried, *LOOP)
    assert len(caught.value.tried) == 3
    assert "up to 1 longer ways" in caught.value.tried[-1]


def test_a_method_that_can_is_asked_when_the_others_gave_up() -> None:
    found = lay((SplineAsItIs(), AtRadii((JointHeadings(),))), *LOOP)
    assert found.length > 45
    assert lay(BODY_METHODS, *LOOP).length == found.length


def test_headings_whose_rows_run_out_prove_nothing() -> None:
    with pytest.raises(vs.GaveUpError, match="turning circle") as caught:
        lay((AtRadii((JointHeadings(0, 0, 1),)),), *LOOP)
    assert not isinstance(caught.value, vs.NoPathError)
    assert "0 rows of headings at the via points" in caught.value.tried


def test_a_proof_of_the_last_method_is_a_refusal() -> None:
    dead_end = ({"at": [20, 0], "heading_deg": 0}, [-30, 0])
    with pytest.raises(vs.NoPathError, match="far from the start"):
        lay(BODY_METHODS, *dead_end, known=ROOM)
    with pytest.raises(vs.GaveUpError):
        lay(BODY_METHODS[:1], *dead_end, known=ROOM)


def test_the_other_sides_are_asked_for_what_is_shorter_and_never_lose() -> None:
    known = [[[8, -4], [12, -4], [12, 3], [8, 3]], [[20, -3], [24, -3], [24, 4], [20, 4]]]
    route = ({"at": [0, 0], "heading_deg": 90}, [32, 0])
    plain = lay((TurnsOnShortest(), AtRadii((HybridAStar(),))), *route, radius=4.0, known=known)
    wider = lay(
        (OtherSides((TurnsOnShortest(),), NEARBY_HEADINGS),), *route, radius=4.0, known=known
    )
    assert wider.length <= plain.length + 1e-9


def test_turns_are_given_up_where_a_spline_keeps_sides_on_which_no_route_is_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Sides of what was led round in the other legs may bind a leg that its spline passes."""
    refused = (Refusal("no free cells of a lattice lead there"), NO_BARRIERS)
    monkeypatch.setattr(LegSearch, "shortest_allowed", lambda *_: refused)
    with pytest.raises(vs.GaveUpError):
        lay([TurnsOnShortest()], [0, 0], [20, 0], [20, 20])


@pytest.mark.parametrize("optimise", ["time", "length"])
def test_a_goal_close_beside_a_wide_disc_is_reached_without_going_right_round_it(
    optimise: str,
) -> None:
    """The line between the last disc's middle and the goal lies a quarter turn off its tangent."""
    centres = ([4.727, 3.2586], [4.967, 6.2524], [2.2542, 4.9634])
    mission = vs.Mission.model_validate(
        {
            "world": {"known": [{"circle": {"center": at, "radius": 0.98}} for at in centres]},
            "robot": {"radius_m": 0.468, "clearance_m": 0},
            "route": {"start": [7, 6], "goal": [2.58, 3.433], "optimise": optimise},
        }
    )
    path = vs.plan(mission).path
    turned = np.unwrap(path.heading(np.linspace(0, len(path.spans), 2001)))
    assert path.length < 5.3
    assert np.ptp(turned) < np.pi


def test_legs_are_pushed_clear_where_those_that_are_clear_as_they_are_are_much_longer() -> None:
    """A turning circle that begins the wrong way swings out to a disc that its leg keeps off."""
    known = [
        {"polygon": [[7.29, 14.774], [7.573, 15.215], [7.334, 15.681], [6.81, 15.706],
                     [6.527, 15.265], [6.766, 14.799]]},
        {"circle": {"center": [13.81, 11.9], "radius": 1.121}},
    ]  # fmt: skip
    robot = {"radius_m": 0.4, "clearance_m": 0.256, "min_turn_radius_m": 1.5}

    def laid(*on_the_way: tuple[float, float]) -> vs.Plan:
        route = {
            "start": {"at": [17.91, 7.58], "heading_deg": 54.226},
            "via": [*({"at": at} for at in on_the_way), {"at": [5.5, 13.23], "dwell_s": 2.0}],
            "goal": [10.64, 15.85],
            "optimise": "length",
        }
        asked = {"world": {"known": known}, "robot": robot, "route": route}
        return vs.plan(vs.Mission.model_validate(asked))

    served = laid((9.16818694433221, 11.785609543287817))
    assert served.path.length < 1.01 * laid().path.length
    assert served.certificate.holds
