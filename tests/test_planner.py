"""Which sides a plan takes and what it says of the others; what it refuses, and the remedy."""

import math
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from asked_missions import BOUNDS, Oracle, clear, disc, mission
from viaspline.planning.plan_path import find_path
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import via_sequence_of


def refused(wanted: vs.Mission) -> vs.NoPathError:
    with pytest.raises(vs.NoPathError) as caught:
        vs.plan(wanted)
    assert caught.value.reason
    assert caught.value.remedy
    return caught.value


# The ledger


def side_at(found: vs.Plan, x: float, y: float) -> str:
    """On which side a path that goes to the east passes a place."""
    points = found.path.evaluate(np.linspace(0, found.path.domain[1], 4001))
    above = np.interp(x, points[:, 0], points[:, 1]) > y
    return "left" if above else "right"


@pytest.mark.parametrize("y", [-3.0, -0.5, 0.5, 3.0])
def test_the_shorter_side_is_taken_and_the_other_is_kept(y: float) -> None:
    found = vs.plan(mission([0, 0], [100, 0], known=[disc(50, y, 10, name="tank")]))
    (entry,) = found.ledger
    assert entry.members == ("tank",)
    assert entry.leg == ("start", "goal")
    assert [c.side for c in entry.candidates] == ["left", "right"]
    left, right = entry.candidates
    assert left.chosen == (y < 0)
    assert right.chosen == (y > 0)
    assert entry.chosen is not None
    assert entry.chosen.length == min(c.length for c in entry.candidates if c.length)
    assert entry.chosen.length == pytest.approx(found.path.length, rel=1e-6)
    assert side_at(found, 50, y) == entry.chosen.side
    np.testing.assert_array_equal(entry.chosen.spans, found.path.spans)


def test_every_candidate_is_a_curve_that_keeps_its_distance(shapely_distance: Oracle) -> None:
    known = [disc(25, 1, 6), disc(50, -2, 7), disc(75, 3, 5), disc(50, 40, 6)]
    wanted = mission([0, 0], [100, 0], known=known)
    found = vs.plan(wanted)
    assert len(found.ledger) == 3
    for entry, (x, y) in zip(found.ledger, [(25, 1), (50, -2), (75, 3)], strict=True):
        assert [c.chosen for c in entry.candidates].count(True) == 1
        for candidate in entry.candidates:
            assert candidate.impossible is None
            curve = vs.PiecewiseCubic(candidate.spans)
            points = curve.evaluate(np.linspace(0, curve.domain[1], 3000))
            assert shapely_distance(points, wanted.world.known).min() >= 1 - 2e-6
            assert candidate.length == pytest.approx(curve.length, rel=1e-6)
            above = np.interp(x, points[:, 0], points[:, 1]) > y
            assert candidate.side == ("left" if above else "right")
            assert candidate.clearance is not None
            assert candidate.clearance >= 0.5 - 1e-6
            assert {tuple(at) for at in candidate.vias} <= {
                tuple(at) for at in candidate.spans[1:, 0]
            }
        assert entry.chosen is not None
        assert entry.chosen.length == pytest.approx(found.path.length, rel=1e-6)
        assert all(c.duration >= entry.chosen.duration - 1e-6 for c in entry.candidates)


def test_obstacles_that_stand_close_together_are_one_entry() -> None:
    known = [disc(50, 0, 5, name="a"), disc(50, 11, 5, name="b"), disc(57, -8, 5, name="c")]
    (entry,) = vs.plan(mission([0, 0], [100, 0], known=known)).ledger
    assert entry.members == ("a", "b", "c")


def test_a_side_that_a_wall_closes_is_impossible_with_a_reason() -> None:
    known = [{"name": "wall", "polygon": [[45, -1], [55, -1], [55, 100], [45, 100]]}]
    found = vs.plan(mission([10, 20], [90, 20], known=known, bounds=[0, -50, 100, 100]))
    (entry,) = found.ledger
    left, right = entry.candidates
    assert right.chosen
    assert not left.chosen
    assert left.impossible is not None
    assert "left" in left.impossible
    assert left.spans.shape == (0, 4, 2)
    assert left.length is None


@pytest.mark.parametrize(
    ("asked", "side"),
    [
        ({"pass_on": "left"}, "left"),
        ({"pass_on": "right"}, "right"),
        ({"never_pass_on": "left"}, "right"),
        ({"never_pass_on": "right"}, "left"),
    ],
)
@pytest.mark.parametrize("y", [-6.0, 6.0])
@pytest.mark.parametrize("kind", ["circle", "polygon"])
def test_a_side_that_is_asked_for_is_taken(asked: Any, side: str, y: float, kind: str) -> None:
    shape = disc(50, y, 10, name="tank", **asked)
    if kind == "polygon":
        ring = [[90, y], [45, y + 12], [40, y - 10]]
        shape = {"name": "tank", "polygon": ring, **asked}
    found = vs.plan(mission([0, 0], [100, 0], known=[shape]))
    (entry,) = found.ledger
    assert entry.chosen is not None
    assert entry.chosen.side == side
    assert side_at(found, 48, y) == side
    (other,) = (c for c in entry.candidates if c.side != side)
    assert other.impossible is not None
    assert "'tank'" in other.impossible


def test_sides_are_kept_by_ways_that_meet_other_obstacles_as_well() -> None:
    known = [
        disc(40, 2, 12, name="first"),
        disc(40, -14, 3, name="low", pass_on="right"),
        disc(70, -4, 8, name="last", pass_on="left"),
    ]
    found = vs.plan(mission([0, 0], [100, 0], known=known))
    assert side_at(found, 70, -4) == "left"
    assert side_at(found, 40, 2) == "right"
    assert side_at(found, 40, -14) == "right"
    for entry in found.ledger:
        for candidate in entry.candidates:
            if candidate.impossible is None:
                points = vs.PiecewiseCubic(candidate.spans).evaluate(
                    np.linspace(0, len(candidate.spans), 2000)
                )
                assert np.interp(70, points[:, 0], points[:, 1]) > -4


def test_sides_that_leave_no_way_are_named() -> None:
    known = [disc(50, 25, 26, name="gate", pass_on="right"), disc(50, 80, 10)]
    error = refused(mission([10, 50], [90, 50], known=known, bounds=BOUNDS))
    assert error.obstacles == ("gate",)
    known = [
        disc(50, 30, 21, name="gate", pass_on="left"),
        disc(50, 76, 24.5, name="post", never_pass_on="right"),
    ]
    error = refused(mission([10, 50], [90, 50], known=known, bounds=BOUNDS))
    assert set(error.obstacles) == {"gate", "post"}
    assert "pass_on" in error.remedy


# What can't be served


def test_a_wall_from_bound_to_bound_is_named() -> None:
    wall = {"name": "wall", "polygon": [[45, -5], [55, -5], [55, 105], [45, 105]]}
    error = refused(
        mission([10, 50], {"at": [90, 50], "name": "quay"}, known=[wall], bounds=BOUNDS)
    )
    assert error.obstacles == ("wall",)
    assert error.via == "quay"
    assert "'quay'" in error.reason


@pytest.mark.parametrize("gap", [0.2, 1.2, 1.9])
def test_a_gap_that_is_too_narrow_is_named_with_the_clearance_that_serves(
    gap: float, shapely_distance: Oracle
) -> None:
    top = 50 + gap
    known = [
        {"name": "south", "polygon": [[45, -5], [55, -5], [55, 50], [45, 50]]},
        {"name": "north", "polygon": [[45, top], [55, top], [55, 105], [45, 105]]},
    ]
    robot = {"radius_m": 0.05, "clearance_m": 0.95}
    error = refused(mission([10, 20], [90, 80], known=known, bounds=BOUNDS, robot=robot))
    assert {"north", "south"} & set(error.obstacles)
    assert 44 < error.where[0] < 56
    assert 49 < error.where[1] < top + 1
    clearance = float(error.remedy.split("at most ")[1].split()[0])
    assert clearance == pytest.approx(gap / 2 - 0.05, abs=3e-3)
    robot["clearance_m"] = clearance
    served = vs.plan(mission([10, 20], [90, 80], known=known, bounds=BOUNDS, robot=robot))
    clear(served, shapely_distance, 0.05 + clearance)


def test_a_gap_between_circles_is_named_with_the_clearance_that_serves() -> None:
    known = [disc(50, 25, 24.6, name="south"), disc(50, 75, 24.6, name="north")]
    bounds = [0, 10, 100, 90]
    error = refused(mission([10, 30], [90, 70], known=known, bounds=bounds))
    least = float(error.remedy.split("at most ")[1].split()[0])
    robot = {"radius_m": 0.5, "clearance_m": least}
    if "radius" in error.remedy:
        robot = {"radius_m": least, "clearance_m": 0.0}
    assert vs.plan(
        mission([10, 30], [90, 70], known=known, bounds=bounds, robot=robot)
    ).certificate.holds


def test_a_via_point_that_is_shut_in_is_named() -> None:
    ring = [[30, 30], [70, 30], [70, 70], [30, 70]]
    hole = [[40, 40], [60, 40], [60, 60], [40, 60]]
    known = [{"name": "ring", "polygon": ring, "holes": [hole]}]
    error = refused(mission([10, 50], {"at": [50, 50], "name": "pump"}, [90, 50], known=known))
    assert error.via == "pump"
    assert error.obstacles == ("ring",)


def loose(**robot: float) -> Requirements:
    return Requirements(radius=robot["radius_m"], clearance=robot["clearance_m"])


@pytest.mark.parametrize(
    "at", [(50.0, 10.8), (50.0, -10.9), (59.9, 4.0), (50.0, 10.5001), (40.5, 3.0)]
)
def test_a_via_point_inside_a_clearance_is_refused_with_moves_that_serve(at: Any) -> None:
    # the mission itself refuses such a point; under way, and through the API, it can still come up
    tank = disc(50, 0, 10, name="tank")
    free = mission([0, 0], {"at": [50, 30], "name": "pump"}, [100, 0])
    world = vs.World([vs.Obstacle(**tank)])
    course = via_sequence_of(free)
    start, pump, goal = course.vias
    moved = type(pump)(pump.name, np.array(at), pump.index)
    bad = type(course)((start, moved, goal), course.legs, course.spline)
    with pytest.raises(vs.NoPathError) as caught:
        find_path(bad, world, loose(radius_m=0.5, clearance_m=0.5))
    error = caught.value
    assert error.via == "pump"
    assert error.obstacles == ("tank",)
    assert error.where == at
    assert f"{1 - (math.hypot(at[0] - 50, at[1]) - 10):.3f} m inside" in error.reason
    x, y = (float(v) for v in error.remedy.split("(")[1].split(")")[0].split(","))
    vs.plan(mission([0, 0], [x, y], [100, 0], known=[tank]))
    if "clearance_m" in error.remedy:
        clearance = float(error.remedy.split("at most ")[1])
        robot = {"radius_m": 0.5, "clearance_m": clearance}
        vs.plan(mission([0, 0], list(at), [100, 0], known=[tank], robot=robot))


def test_a_via_point_is_moved_to_where_ways_lead_not_into_a_hole_beside_it() -> None:
    ring = [[30, 30], [70, 30], [70, 70], [30, 70]]
    hole = [[40, 40], [60, 40], [60, 62], [40, 62]]
    known = [{"name": "ring", "polygon": ring, "holes": [hole]}]
    free = via_sequence_of(mission([10, 50], {"at": [50, 90], "name": "pump"}, [90, 50]))
    start, pump, goal = free.vias
    moved = type(pump)(pump.name, np.array([50.0, 61.4]), pump.index, key=pump.key)
    bad = type(free)((start, moved, goal), free.legs, free.spline)
    with pytest.raises(vs.NoPathError) as caught:
        find_path(bad, vs.World([vs.Obstacle(**known[0])]), loose(radius_m=0.5, clearance_m=0.5))
    assert [change.key for change in caught.value.changes] == ["route.via[0].at"]
    x, y = caught.value.changes[0].value
    assert "clearance_m" not in caught.value.remedy
    vs.plan(mission([10, 50], [x, y], [90, 50], known=known))


def test_a_via_point_is_offered_a_clearance_that_leaves_room_for_the_tracking_error() -> None:
    asked = mission([0, 0], {"at": [50, 30], "name": "pump"}, [100, 0])
    world = vs.World([vs.Obstacle(**disc(50, 41, 10))])
    needs = Requirements(radius=0.5, clearance=0.5, tracking_error=0.2)
    with pytest.raises(vs.NoPathError) as caught:
        find_path(via_sequence_of(asked), world, needs)
    changes = {change.key: change.value for change in caught.value.changes}
    assert changes["robot.clearance_m"] == pytest.approx(0.3, abs=1e-3)


@pytest.mark.parametrize("sensor", [None, {"range_m": 20}])
def test_the_known_world_is_built_once(monkeypatch: pytest.MonkeyPatch, sensor: Any) -> None:
    asked = vs.Mission.model_validate(
        {
            "world": {"known": [disc(30, 1, 4)]},
            "robot": {
                "sensor": sensor, "drive": {"differential": {"track_m": 0.5}, "delay_s": 0.1},
            },
            "route": {
                "start": [0, 0], "via": [[40, 5], [20, -5]], "goal": [60, 0], "order": "shortest",
            },
            "spline": {"tension": "auto"},
        }
    )  # fmt: skip
    built: list[vs.World] = []

    def known(mission: vs.Mission) -> vs.World:
        spec = mission.world
        built.append(vs.World(spec.known, bounds=spec.bounds, fences=spec.fences))
        return built[-1]

    monkeypatch.setattr(vs.World, "known", staticmethod(known))
    plan = vs.plan(asked)
    assert built == [plan.world]


def test_a_corridor_runs_along_the_via_points_in_the_order_that_was_found() -> None:
    asked = vs.Mission.model_validate(
        {
            "route": {
                "start": [0, 0], "via": [[40, 0], [20, 8]], "goal": [60, 0], "order": "shortest",
                "corridor": {"left_m": 6, "right_m": 6},
            },
        }
    )  # fmt: skip
    plan = vs.plan(asked)
    assert plan.mission.route.via[0].at == (20.0, 8.0)
    assert plan.world.corridor == vs.World.known(plan.mission).corridor
    assert plan.world.corridor != vs.World.known(asked).corridor


def test_a_plan_and_a_run_show_themselves_in_a_line() -> None:
    mission = vs.Mission.model_validate({"route": {"start": [0, 0], "goal": [50, 0]}})
    assert repr(vs.plan(mission)).startswith("<Plan: 50.0 m in 27.0 s, inf m clear")
    run = repr(vs.simulate(mission))
    assert run.startswith("<Run: 27.0 s")
    assert run.endswith("reached>")
