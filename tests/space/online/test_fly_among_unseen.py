"""Flights among things that move and aren't on the map, against exact gaps at fine instants."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from unseen_flights import CLEARANCE, RADIUS, gaps_and_speeds, mission, moves, wanderer

from viaspline.errors import GeometryError
from viaspline.report.space.flight_picture import how_near_in_space
from viaspline.report.space.flown_clearance import flown_clearance
from viaspline.space.online import watch_flight
from viaspline.space.online.fly import fly
from viaspline.space.plan_spatial import plan_spatial
from viaspline.studio.space.simulated_flight import flown

CROSSING = moves("kite", 1.0, [[0, 40, -24, 10], [30, 40, 24, 10]])
HEAD_ON = moves("plane", 1.0, [[0, 80, 2, 10], [40, -20, 2, 10]])


def test_what_crosses_straight_on_is_let_pass_with_the_clearance_that_is_asked_for() -> None:
    slow = moves("kite", 1.0, [[0, 40, -15, 10], [20, 40, 15, 10]])
    plan = plan_spatial(mission([slow]))
    run = fly(plan)
    gaps, _ = gaps_and_speeds(run, slow)
    assert run.reached
    assert plan.trajectory.duration < run.duration < plan.trajectory.duration + 8
    assert gaps.min() >= CLEARANCE - 1e-3
    assert run.encounters is not None
    assert run.encounters.contacts == ()
    assert 0.9 < run.encounters.clearance <= gaps.min() + 1e-9


def test_nobody_gives_way_to_what_is_never_in_the_way() -> None:
    plan = plan_spatial(mission([CROSSING]))
    aside = moves("kite", 1.0, [[0, 40, 9, 10], [30, 70, 9, 10]])
    run = fly(plan_spatial(mission([aside])))
    assert run.duration == pytest.approx(plan.trajectory.duration)
    assert run.replans == ()


def test_what_comes_head_on_is_flown_round_where_it_is_seen_soon_enough() -> None:
    run = fly(plan_spatial(mission([HEAD_ON], reach=40)))
    gaps, _ = gaps_and_speeds(run, HEAD_ON)
    assert run.reached
    assert [one.obstacles for one in run.replans] == [("plane",)]
    assert gaps.min() >= CLEARANCE
    assert run.speeds[(run.times > 4) & (run.times < 15)].min() > 2.5


@pytest.mark.parametrize("side", [0.0, 0.5])
def test_what_comes_head_on_is_swerved_from_though_it_is_seen_late(side: float) -> None:
    """7 to 8 m/s towards each other, seen 20 m off by a sensor that is a little wrong."""
    plane = moves("plane", 1.0, [[0, 80, side, 10], [33, -20, side, 10]])
    run = fly(plan_spatial(mission([plane], reach=20, noise=0.2)))
    gaps, speeds = gaps_and_speeds(run, plane)
    assert run.reached
    assert gaps.min() >= CLEARANCE - 1e-3
    assert speeds[len(speeds) // 4 : len(speeds) // 2].min() > 2.5
    assert [via.name for via in run.replans[0].path.vias if via.name == "aside"] == ["aside"]


def test_a_place_that_was_swerved_through_is_not_served_by_a_later_path() -> None:
    """Two come head on, one after the other, from either side of the line.

    A via point of the route has the name of such places, and is served by all paths.
    """
    first = moves("first", 1.0, [[0, 80, 0.3, 10], [33, -20, 0.3, 10]])
    later = moves("later", 1.0, [[0, 118, -0.3, 10], [47, -20, -0.3, 10]])
    point = {"name": "aside", "at": [72, 0, 10]}
    run = fly(plan_spatial(mission([first, later], reach=20, noise=0.1, via=[point])))
    assert run.reached
    for one in (first, later):
        assert gaps_and_speeds(run, one)[0].min() >= CLEARANCE - 1e-3
    paths = [one.path for one in run.replans if one.path is not None]
    assert len(paths) >= 2
    asides = [[via for via in path.vias if via.name == "aside"] for path in paths]
    assert all(sum(via.index is None for via in found) <= 1 for found in asides)
    assert all([via.at for via in found if via.index == 1] == [(72, 0, 10)] for found in asides)


def test_what_stands_in_the_way_for_good_ends_the_flight_before_it_with_its_name(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(watch_flight, "MAX_HELD_UP_S", 5.0)
    blocking = {**moves("crane", 45.0, [[0, 60, 0, 10], [1, 60, 0, 10.0001]])}
    run = fly(plan_spatial(mission([blocking], reach=30)), step=0.2)
    assert not run.reached
    assert "'crane'" in run.reason
    assert run.speeds[-1] == 0.0
    gaps, _ = gaps_and_speeds(run, blocking)
    assert gaps[-1] >= 0.0


@pytest.mark.slow
def test_what_goes_away_again_is_waited_for() -> None:
    gate = moves("gate", 25.0, [[0, 40, 0, 10], [5, 40, 0, 10], [8, 40, 0, 110]])
    plan = plan_spatial(mission([gate], reach=30))
    run = fly(plan, step=0.2)
    gaps, speeds = gaps_and_speeds(run, gate)
    assert run.reached
    assert run.duration > plan.trajectory.duration + 1
    assert gaps[speeds > 1e-3].min() >= 0.0


def test_things_that_move_on_the_map_and_off_it_are_both_let_pass() -> None:
    lift = moves("lift", 1.0, [[0, 60, 0, 40], [10, 60, 0, 10], [16, 60, 0, 10], [26, 60, 0, 40]])
    slow = moves("kite", 1.0, [[0, 30, -12, 10], [16, 30, 12, 10]])
    run = fly(plan_spatial(mission([slow], known=[lift])))
    assert run.reached
    for one in (lift, slow):
        assert gaps_and_speeds(run, one)[0].min() >= CLEARANCE - 1e-3
    assert CLEARANCE - 1e-6 <= run.clearance <= gaps_and_speeds(run, lift)[0].min() + 1e-6


def test_what_stands_unseen_behind_what_moves_unseen_is_led_round_too() -> None:
    stands = {"name": "mast", "ball": {"center": [68, 0, 10], "radius": 2}}
    slow = moves("kite", 1.0, [[0, 30, -12, 10], [16, 30, 12, 10]])
    run = fly(plan_spatial(mission([slow, stands])))
    assert run.reached
    assert "mast" in {name for one in run.replans for name in one.obstacles}
    assert run.clearance >= CLEARANCE - 1e-6
    free = np.linalg.norm(run.positions - (68, 0, 10), axis=1).min() - 2.5
    assert free >= run.clearance - 1e-6
    assert gaps_and_speeds(run, slow)[0].min() >= CLEARANCE - 1e-3


@pytest.mark.parametrize("noise", [0.0, 0.2])
def test_what_was_seen_aside_of_the_way_is_not_swerved_into(noise: float) -> None:
    """Posts beside the line, seen while nothing is in the way, and then a plane comes head on."""
    plane = moves("plane", 1.0, [[0, 80, 0.2, 10], [33, -20, 0.2, 10]])
    posts = [
        {"name": f"post {x} {y}", "circle": {"center": [x, y], "radius": 0.4}, "height_m": [0, 30]}
        for x in range(14, 76, 4)
        for y in (-2.2, 2.2)
    ]
    run = fly(plan_spatial(mission([plane, *posts], reach=20, noise=noise)))
    middles = np.array([post["circle"]["center"] for post in posts])
    apart = np.linalg.norm(run.positions[:, None, :2] - middles, axis=2)
    over = np.maximum(run.positions[:, 2] - 30.0, 0.0)[:, None]
    gaps = np.hypot(np.maximum(apart - 0.4, 0.0), over) - RADIUS
    assert gaps.min() >= CLEARANCE - 1e-6  # -0.46 m before that was known to a swerve
    assert run.clearance >= CLEARANCE - 1e-6


def test_a_premise_that_is_broken_is_told() -> None:
    fast = moves("jet", 0.5, [[0, 40, -60, 10], [20, 40, 60, 10]])
    run = fly(plan_spatial(mission([fast], things={"max_speed_mps": 2, "safety": "none"})))
    assert any("'jet' goes 6.00 m/s, and not 2 at most" in one for one in run.broken_premises)
    kept = fly(plan_spatial(mission([fast], things={"max_speed_mps": 7, "safety": "none"})))
    assert kept.broken_premises == ()


def test_what_jumps_into_the_way_is_told_as_a_contact_that_came_too_late() -> None:
    jumps = moves("ghost", 1.0, [[6.0, 26.0, 0, 10], [7, 26.0, 0, 10.01]])
    jumps["motion"]["before"] = "absent"
    run = fly(plan_spatial(mission([jumps])))
    assert run.encounters is not None
    assert not run.reached
    assert run.encounters.contacts[0].appeared_within_braking_time
    assert "the robot touched 'ghost'" in run.reason


def test_a_flight_among_what_moves_unseen_takes_a_sensor() -> None:
    asked = mission([CROSSING])
    blind = asked.model_copy(update={"robot": asked.robot.model_copy(update={"sensor": None})})
    with pytest.raises(GeometryError, match="no sensor"):
        fly(plan_spatial(blind))


@pytest.mark.slow
@settings(max_examples=4)
@given(seed=st.integers(0, 100_000))
def test_flights_keep_their_limits_and_tell_the_gaps_that_there_were(seed: int) -> None:
    rng = np.random.default_rng(seed)
    moving = [wanderer(rng, f"m{k}", 3.0) for k in range(int(rng.integers(1, 4)))]
    asked = mission(moving, noise=float(rng.choice((0.0, 0.2))))
    run = fly(plan_spatial(asked), seed=seed)
    event("reached" if run.reached else "not reached")
    assert run.encounters is not None
    least = min(gaps_and_speeds(run, one)[0].min() for one in moving)
    assert run.encounters.clearance <= least + 5e-3  # places are interpolated there
    touched = [one for one in run.encounters.contacts if one.robot_speed > 0.0]
    assert run.reached or touched or run.reason
    lasts = np.maximum(np.diff(run.times), 1e-9)
    steps = np.linalg.norm(np.diff(run.positions, axis=0), axis=1)
    assert (steps / lasts)[lasts > 1e-6].max() <= 5 * (1 + 1e-6)
    assert np.abs(np.diff(run.speeds) / lasts)[lasts > 1e-6].max() <= 2 * (1 + 1e-6)
    assert run.clearance >= CLEARANCE - 1e-6


def test_the_same_seed_gives_the_same_flight() -> None:
    rng = np.random.default_rng(11)
    plan = plan_spatial(mission([wanderer(rng, "m", 3.0)], noise=0.2))
    first, again, other = (fly(plan, step=0.2, seed=seed) for seed in (3, 3, 4))
    assert first.samples().tobytes() == again.samples().tobytes()
    assert first.samples().tobytes() != other.samples().tobytes()


def test_a_touch_while_it_hovers_is_told_wherever_a_flight_is() -> None:
    frames = [[0, 40, 40, 10], [20, 20, 0.3, 10], [22, 20, -0.3, 10], [40, 60, -40, 10]]
    stays = [{"at": [20, 0, 10], "dwell_s": 30}]
    run = fly(plan_spatial(mission([moves("dog", 0.5, frames)], via=stays)))
    assert run.reached
    assert run.encounters is not None
    [contact] = run.encounters.contacts
    assert contact.robot_speed == 0.0
    assert run.least_clearance == run.encounters.clearance < 0.0 < run.clearance
    told = run.encounters.touched
    assert f"{run.least_clearance:.2f} m clear, 0 re-plans, reached, {told}>" in repr(run)
    assert how_near_in_space(run).startswith(f"{told}; proven: nowhere closer than")
    assert flown_clearance(run).min() == pytest.approx(-1.0, abs=0.02)  # it flew through the robot
    page = flown(run)
    assert (page["touched"], page["clearance"]) == (told, run.least_clearance)
    assert [one["time"] for one in page["events"] if one["kind"] == "contact"] == [contact.time]
    for words in (run.summary(), run._repr_html_()):
        assert "CONTACT" in words
