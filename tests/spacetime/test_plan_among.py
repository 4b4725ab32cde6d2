"""Plans past what moves: proven by the package, sampled here by numpy alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.plan_drive import find_drive
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.report.files.plan_json import plan_json
from viaspline.spacetime import alternatives, timed_problem
from viaspline.world.world import World

RADIUS, CLEARANCE = 0.3, 0.2


def mission(moving: list[dict[str, Any]], **route: Any) -> vs.Mission:
    return vs.Mission.model_validate(
        {
            "world": {"known": moving},
            "robot": {"radius_m": RADIUS, "clearance_m": CLEARANCE},
            "route": {"start": [0, 0], "goal": [20, 0], **route},
        }
    )


def disc(name: str, start: tuple[float, float], velocity: tuple[float, float]) -> dict[str, Any]:
    return {
        "name": name,
        "circle": {"center": [0, 0], "radius": 0.5},
        "motion": {"from": list(start), "velocity_mps": list(velocity)},
    }


def least_gap(plan: vs.Plan, moving: list[dict[str, Any]]) -> float:
    """The least free space between robot and discs that go straight on, by samples [m]."""
    law = plan.trajectory
    times = np.arange(law.start_time, law.end_time + plan.mission.route.hold_s, 2e-3)
    robot = np.asarray(plan.path.at_distance(law.distance_at(times)))
    gaps = [
        np.hypot(*(np.array(d["motion"]["from"]) + np.outer(times, d["motion"]["velocity_mps"])
                   - robot).T)
        for d in moving
    ]  # fmt: skip
    return float(np.min(gaps)) - 0.5 - RADIUS


def test_where_nothing_is_met_the_plan_is_the_one_without_what_moves() -> None:
    far = [disc("far", (0, 50), (1, 0))]
    among, alone = vs.plan(mission(far)), vs.plan(mission([]))
    assert among.trajectory.times.tolist() == alone.trajectory.times.tolist()
    assert among.path.spans.tolist() == alone.path.spans.tolist()
    assert among.moving_certificate is not None
    assert alone.moving_certificate is None


def test_what_crosses_is_passed_with_the_clearance_that_is_asked_for() -> None:
    crossing = [disc("cart", (10, -8), (0, 1.3))]
    plan = vs.plan(mission(crossing))
    certificate = plan.moving_certificate
    assert certificate is not None
    assert certificate.holds
    assert certificate.obstacle == "cart"
    assert CLEARANCE - 1e-6 <= certificate.clearance <= least_gap(plan, crossing) + 1e-9
    assert plan.timed is not None
    assert sum(one.chosen for one in plan.timed.candidates) == 1


def test_a_plan_that_departs_later_moves_by_the_same_clock() -> None:
    crossing = [disc("cart", (10, -8), (0, 1.3))]
    plan = vs.plan(mission(crossing, depart_s=30.0))
    assert plan.trajectory.start_time == 30.0
    assert plan.trajectory.duration == vs.plan(mission([])).trajectory.duration


def test_the_goal_stays_free_for_as_long_as_is_asked() -> None:
    passing = [disc("cart", (20, -18), (0, 1.0))]
    free = vs.plan(mission([])).trajectory.duration
    plan = vs.plan(mission(passing, hold_s=20.0))
    assert plan.trajectory.end_time > free + 1.0
    assert least_gap(plan, passing) >= CLEARANCE - 1e-6


def test_a_start_that_is_run_over_is_refused_with_a_departure_that_would_do() -> None:
    truck = {
        "name": "truck",
        "polygon": [[-1, -15], [1, -15], [1, 15], [-1, 15]],
        "motion": {"from": [-4, 0], "velocity_mps": [6, 0]},
    }
    with pytest.raises(vs.NoPathError, match="'truck' runs over the start") as caught:
        vs.plan(mission([truck]))
    assert "depart" in caught.value.remedy
    later = float(caught.value.remedy.split("route.depart_s: ")[1].rstrip(")"))
    vs.plan(mission([truck], depart_s=later))


def parked(times_and_places: list[list[float]], after: str) -> dict[str, Any]:
    return {
        "name": "van",
        "circle": {"center": [0, 0], "radius": 0.5},
        "motion": {"keyframes": times_and_places, "after": after},
    }


def test_a_goal_on_which_something_parks_for_good_is_refused_by_name() -> None:
    van = parked([[0, 30, 0], [5, 20, 0.3]], "stay")
    with pytest.raises(
        vs.NoPathError, match=r"the goal can't be held for 0 s: 'van' is from 5\.0 s"
    ):
        vs.plan(mission([van]))


def test_a_goal_that_is_free_only_for_a_while_is_refused_with_what_can_be_held() -> None:
    van = parked([[0, 60, 0], [40, 60, 0], [60, 20, 0]], "stay")
    with pytest.raises(vs.NoPathError, match=r"'van' is from 60\.0 s on") as caught:
        vs.plan(mission([van], hold_s=120.0))
    (change,) = caught.value.changes
    assert change.key == "route.hold_s"
    assert isinstance(change.value, float)
    assert 40.0 < change.value < 60.0
    plan = vs.plan(mission([van]))
    assert plan.trajectory.end_time < 15.0


def test_a_goal_round_which_something_turns_for_ever_is_refused() -> None:
    sweeper = {
        "name": "sweeper",
        "polygon": [[-2, -2], [2, -2], [2, 2], [-2, 2]],
        "motion": {
            "keyframes": [[0, 20, 0, 0], [5, 20.2, 0, 180], [9, 20, 0, 360]],
            "after": "loop",
        },
    }
    with pytest.raises(vs.NoPathError, match="'sweeper' always is nearer"):
        vs.plan(mission([sweeper]))


def test_a_robot_waits_for_what_waits_on_its_goal_and_leaves() -> None:
    van = parked([[0, 20, 0], [25, 20, 0], [35, 30, 0]], "stay")
    plan = vs.plan(mission([van], hold_s=5.0))
    assert plan.trajectory.end_time > 25.0
    assert plan.timed is not None
    assert {wait.obstacle for wait in plan.timed.waits} == {"van"}


def test_what_jumps_off_the_goal_doesnt_stay_there() -> None:
    jumper = parked([[0, 20, 0], [20, 20.5, 0], [20.5, 40, 0], [30, 40, 0]], "loop")
    with pytest.warns(vs.MissionWarning, match="jumps"):
        asked = mission([jumper], hold_s=2.0)
    plan = vs.plan(asked)
    assert plan.moving_certificate is not None
    assert plan.moving_certificate.holds


def test_two_plans_of_a_mission_are_the_same_bytes() -> None:
    crossing = [disc("a", (10, -8), (0, 1.3)), disc("b", (14, 9), (0, -1.1))]
    one, other = (plan_json(vs.plan(mission(crossing)), "x", spacing=0.5) for _ in range(2))
    assert one == other
    assert '"among_moving"' in one


discs = st.lists(
    st.tuples(
        st.tuples(st.floats(3, 17), st.floats(-10, 10)),
        st.tuples(st.floats(-1.5, 1.5), st.floats(-1.5, 1.5)),
    ),
    min_size=1,
    max_size=4,
)


@settings(max_examples=9, deadline=None)
@given(discs)
@example([((10.0, -8.0), (0.0, 1.3)), ((12.0, 8.0), (0.0, -1.3))])
def test_no_plan_comes_nearer_than_it_proves(
    drawn: list[tuple[tuple[float, float], tuple[float, float]]],
) -> None:
    moving = [disc(f"d{i}", place, velocity) for i, (place, velocity) in enumerate(drawn)]
    try:
        plan = vs.plan(mission(moving))
    except vs.PlanningError:
        return
    certificate = plan.moving_certificate
    assert certificate is not None
    assert certificate.holds
    assert least_gap(plan, moving) >= certificate.clearance - 1e-9
    assert plan.certificate.holds


def places_between(keyframes: list[list[float]], times: np.ndarray) -> np.ndarray:
    """Where something is that goes from keyframe to keyframe, again and again [m], (n, 2)."""
    frames = np.array(keyframes)
    local = np.mod(times - frames[0, 0], frames[-1, 0] - frames[0, 0]) + frames[0, 0]
    return np.column_stack([np.interp(local, frames[:, 0], frames[:, k]) for k in (1, 2)])


SHUTTLE = [[0.0, 10.0, -6.0], [9.0, 10.0, 6.0], [18.0, 10.0, -6.0]]


@pytest.mark.parametrize("laps", [1, 3])
def test_every_lap_of_a_patrol_is_another_time(laps: int) -> None:
    patrol = vs.Mission.model_validate(
        {
            "world": {"known": [parked(SHUTTLE, "loop")]},
            "robot": {"radius_m": RADIUS, "clearance_m": CLEARANCE},
            "route": {
                "start": [0, 0],
                "via": [[20, 0], {"at": [20, 8], "dwell_s": 2.0}, [0, 8]],
                "closed": True,
                "laps": laps,
            },
        }
    )
    plan = vs.plan(patrol)
    law = plan.trajectory
    times = np.arange(law.start_time, law.end_time, 1e-3)
    along = np.minimum(law.distance_at(times), plan.path.length)
    robot = np.asarray(plan.path.at_distance(along))
    gap = np.hypot(*(robot - places_between(SHUTTLE, times)).T).min() - 0.5 - RADIUS
    assert plan.moving_certificate is not None
    assert plan.moving_certificate.holds
    assert gap >= plan.moving_certificate.clearance - 1e-9
    assert plan.moving_certificate.clearance >= CLEARANCE - 1e-6
    assert law.distances[-1] == pytest.approx(plan.path.length)


def test_what_has_parked_beside_the_way_stays_there_while_others_go_on() -> None:
    van = parked([[0, 8, 6], [6, 8, 0.2]], "stay")
    shuttle = {**parked([[t, x + 5.0, y] for t, x, y in SHUTTLE], "loop"), "name": "shuttle"}
    plan = vs.plan(mission([van, shuttle], depart_s=20.0))
    law = plan.trajectory
    times = np.arange(law.start_time, law.end_time, 1e-3)
    robot = np.asarray(plan.path.at_distance(np.minimum(law.distance_at(times), plan.path.length)))
    to_van = np.hypot(*(robot - [8.0, 0.2]).T).min()
    to_shuttle = np.hypot(*(robot - [5.0, 0.0] - places_between(SHUTTLE, times)).T).min()
    assert min(to_van, to_shuttle) - 0.5 - RADIUS >= CLEARANCE - 1e-6


fast_discs = st.lists(
    st.tuples(st.floats(1.0, 6.0), st.floats(-3.1, 3.1), st.floats(1.0, 9.0), st.floats(-0.4, 0.4)),
    min_size=1,
    max_size=3,
)


@settings(max_examples=25, deadline=None)
@given(fast_discs)
@example([(2.0, 0.0, 9.0, 0.0)])
def test_from_a_start_that_is_refused_no_straight_escape_is_clear(
    drawn: list[tuple[float, float, float, float]],
) -> None:
    moving = []
    for i, (far, bearing, speed, aside) in enumerate(drawn):
        place = (far * np.cos(bearing), far * np.sin(bearing))
        course = bearing + np.pi + aside
        moving.append(disc(f"d{i}", place, (speed * np.cos(course), speed * np.sin(course))))
    asked = mission(moving)
    try:
        vs.plan(asked)
    except vs.NoPathError:
        late = np.arange(0.0, 4.0, 2e-3)
        top, accel = asked.robot.max_speed_mps, asked.robot.max_accel_mps2
        gone = np.minimum(0.5 * accel * late**2, top * late)
        for angle in np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False):
            robot = gone[:, None] * [np.cos(angle), np.sin(angle)]
            gaps = [
                np.hypot(
                    *(d["motion"]["from"] + np.outer(late, d["motion"]["velocity_mps"]) - robot).T
                ).min()
                for d in moving
            ]
            assert min(gaps) - 0.5 - RADIUS < CLEARANCE
    except vs.GaveUpError:
        pass


def herd() -> vs.Mission:
    """Discs that go to and fro across the way, with stretches where there is no way past them."""
    moving = [
        {
            "name": f"disc {k}",
            "circle": {"center": [0, 0], "radius": 1.6},
            "motion": {
                "keyframes": [[0, 4 + 3 * k, -3 + k], [9 - k, 4 + 3 * k, 3]],
                "after": "bounce",
            },
        }
        for k in range(5)
    ]
    return mission(moving, hold_s=1.0)


def test_all_paths_and_laws_past_what_moves_share_one_budget(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    budgets: list[WorkBudget] = []

    def laid(asked: vs.Mission, world: World, requirements: Requirements) -> Solution:
        assert requirements.budget is not None
        budgets.append(requirements.budget)
        return find_drive(asked, world, requirements)

    monkeypatch.setattr(alternatives, "find_drive", laid)
    vs.plan(herd())
    assert len(budgets) > 10
    assert sum(budget.spent for budget in budgets) <= timed_problem.AMONG_S
    known = len(budgets)
    monkeypatch.setattr(timed_problem, "BETTER_S", 0.0)
    vs.plan(herd())
    assert len(budgets) == known


def test_what_a_budget_cuts_off_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = mission([disc("head-on", (30, 0), (-1, 0))], start={"at": [0, 0], "heading_deg": 0})
    assert vs.plan(asked).timed is not None
    monkeypatch.setattr(timed_problem, "AMONG_S", 1e-3)
    with pytest.raises(vs.GaveUpError, match="no path was found") as caught:
        vs.plan(asked)
    assert any("s of work allow" in tried for tried in caught.value.tried)
