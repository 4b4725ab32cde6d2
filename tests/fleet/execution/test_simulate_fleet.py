"""Fleets that are driven through delays: they stay apart, arrive, and keep their limits."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from straight_drives import (
    CROSS,
    REACH,
    driven_on,
    nearest_two,
    timed_lines,
)

import viaspline as vs
from viaspline.fleet.execution.delays import Delays
from viaspline.fleet.execution.simulate_fleet import drive_fleet

ALL_DELAYS = st.builds(
    Delays,
    slowed=st.floats(0.0, 0.9),
    stretch_m=st.floats(1.0, 30.0),
    halts=st.floats(0.0, 3.0),
    halts_s=st.floats(0.0, 60.0),
    lost=st.floats(0.0, 0.8),
)


@pytest.mark.slow
@given(
    seed=st.integers(0, 10_000),
    delays=ALL_DELAYS,
    step=st.sampled_from([0.05, 0.1, 0.5, 2.0]),
    vanish=st.booleans(),
    swaps=st.booleans(),
)
@settings(max_examples=15, deadline=None)
@example(seed=3, delays=Delays(slowed=0.3, halts=1.0, lost=0.3), step=0.1, vanish=False, swaps=True)
def test_whatever_the_delays_none_touch_and_all_arrive(
    seed: int, delays: Delays, step: float, vanish: bool, swaps: bool
) -> None:
    lines = timed_lines(seed, 10)
    fleet = driven_on(lines, vanish=vanish)
    run = drive_fleet(fleet, delays, seed=seed, step=step, swaps=swaps)
    assert run.reached
    assert run.deadlock == ()
    assert nearest_two(run, lines) >= 2.0 * REACH


@given(seed=st.integers(0, 10_000), delays=ALL_DELAYS)
@settings(max_examples=12, deadline=None)
def test_robots_keep_their_speeds_and_accelerations(seed: int, delays: Delays) -> None:
    fleet = driven_on(timed_lines(seed, 9))
    run = drive_fleet(fleet, delays, seed=seed)
    courses, laws = run.courses.packed, run.laws.packed
    for r, name in enumerate(run.names):
        nodes = slice(courses.first[r], courses.first[r + 1])
        along, speed = courses.distance[nodes], laws.speed[nodes]
        width, lasts = np.diff(along), laws.arrive[nodes][1:] - laws.leave[nodes][:-1]
        rise = np.diff(speed**2) / (2.0 * np.maximum(width, 1e-12))
        assert (speed <= 2.0 + 1e-9).all()
        assert (np.abs(rise[width > 1e-6]) <= 1.0 + 1e-6).all()
        # who has a hair of speed left when it is to stand is taken to stand
        goes = width > 0.0  # else it stands between nodes
        law = 2.0 * width[goes] / (speed[1:] + speed[:-1])[goes]
        assert lasts[goes] == pytest.approx(law, abs=1e-3)
        assert (speed[1:] + speed[:-1])[~goes].max(initial=0.0) == 0.0
        assert (laws.leave[nodes] >= laws.arrive[nodes]).all()
        assert along[-1] == pytest.approx(fleet.lengths[r])
        # by differences of places, whatever the nodes say
        times = np.arange(0.0, run.end_s, 0.01)
        gone = np.diff(run.distance_at(name, times))
        assert (gone >= 0.0).all()
        assert gone.max() <= 0.02 + 1e-9


def test_without_delays_a_robot_alone_drives_as_planned() -> None:
    run = drive_fleet(driven_on([((0.0, 0.0), (30.0, 0.0))]))
    assert run.arrivals == {"r0": pytest.approx(17.0)}
    assert run.delays == {"r0": pytest.approx(0.0, abs=1e-9)}
    assert run.mean_delay == pytest.approx(0.0, abs=1e-9)


def test_the_second_is_hardly_later_than_planned_for_it_brakes_before_what_is_not_granted() -> None:
    run = drive_fleet(driven_on(CROSS))
    assert run.delays["r0"] == pytest.approx(0.0, abs=1e-9)
    assert 0.0 < run.delays["r1"] < 1.5  # it brakes and speeds up again: a second at 2 m/s


def test_a_halt_is_handed_on_to_those_who_wait_only() -> None:
    lines = [*CROSS, ((0.0, 30.0), (40.0, 30.0))]
    fleet = driven_on(lines)
    for seed in range(20):
        run = drive_fleet(fleet, Delays(halts=1.0, halts_s=30.0), seed=seed, swaps=False)
        assert nearest_two(run, lines) >= 2.0 * REACH
        halted = run.delays["r2"]
        own = round(halted / 30.0)
        assert own * 30.0 <= halted + 1e-6 <= own * 32.5 + 1e-3  # and what braking costs
        assert run.delays["r1"] >= -1e-9


def test_who_halts_before_a_crossing_is_overtaken_and_one_in_it_is_waited_for() -> None:
    fleet = driven_on(CROSS)
    found = set()
    for seed in range(60):
        delays = Delays(halts=0.5, halts_s=200.0)
        kept = drive_fleet(fleet, delays, seed=seed, swaps=False)
        run = drive_fleet(fleet, delays, seed=seed)
        is_swapped = any(event.kind == "swapped" for event in run.events)
        assert nearest_two(run, CROSS) >= 2.0 * REACH
        assert sum(run.delays.values()) <= sum(kept.delays.values()) + 5.0
        if kept.delays["r0"] > 150.0 and kept.delays["r1"] < 210.0:
            found.add(is_swapped)
            if is_swapped:
                assert run.delays["r1"] < 150.0 or run.delays == kept.delays
    assert True in found


def test_the_same_seed_makes_the_same_run_and_another_one_does_not() -> None:
    fleet = driven_on(timed_lines(3, 9))
    delays = Delays(slowed=0.3, halts=1.0, lost=0.2)
    one, again, other = (drive_fleet(fleet, delays, seed=seed) for seed in (5, 5, 6))
    assert one.arrivals == again.arrivals
    assert one.events == again.events
    assert one.laws.packed.arrive.tobytes() == again.laws.packed.arrive.tobytes()
    assert one.arrivals != other.arrivals


def test_events_say_who_waits_for_whom_and_where() -> None:
    run = drive_fleet(driven_on(CROSS))
    waits = next(event for event in run.events if event.kind == "waits")
    assert (waits.name, waits.other) == ("r1", "r0")
    assert 17.0 <= waits.at_m <= 18.0  # type: ignore[operator]
    assert waits.message.startswith("r1 waits at 1")
    assert [event.kind for event in run.events] == ["waits", "goes on", "arrived", "arrived"]


@pytest.mark.parametrize("seed", [85, 111, 773])
def test_who_has_a_hair_of_speed_left_when_it_halts_comes_to_rest_and_goes_on(seed: int) -> None:
    run = drive_fleet(
        driven_on([((0.0, 0.0), (60.0, 0.0))]), Delays(halts=3.0, halts_s=5.0), seed=seed
    )
    assert run.reached
    assert run.deadlock == ()


@given(seed=st.integers(0, 10_000), delays=ALL_DELAYS)
@settings(max_examples=15, deadline=None)
@example(seed=69, delays=Delays(slowed=0.8125, stretch_m=8.5))
@example(  # a report a nanometre before its goal, at 28 µm/s
    seed=179,
    delays=Delays(slowed=0.7535561358603714, stretch_m=8.75, halts=2.375, halts_s=10.0),
)
def test_what_is_driven_is_proven_to_be_as_far_apart_as_was_planned(
    seed: int, delays: Delays
) -> None:
    """Laws that say where a robot is at constant accelerations only about would cost a part."""
    run = drive_fleet(driven_on(timed_lines(seed, 9)), delays, seed=seed)
    assert run.certificate.holds
    courses, laws = run.courses.packed, run.laws.packed
    for first, end in zip(courses.first[:-1], courses.first[1:], strict=True):
        speed, lasts = (
            laws.speed[first:end],
            laws.arrive[first + 1 : end] - laws.leave[first : end - 1],
        )
        off = np.diff(courses.distance[first:end]) - 0.5 * (speed[1:] + speed[:-1]) * lasts
        assert np.abs(off).max() < 1e-8


def test_lost_messages_only_delay() -> None:
    fleet = driven_on(CROSS)
    heard = drive_fleet(fleet).delays["r1"]
    delays = [
        drive_fleet(fleet, Delays(lost=0.9), seed=seed, swaps=False).delays["r1"]
        for seed in range(20)
    ]
    assert min(delays) >= heard - 1e-9
    assert max(delays) > heard + 0.5


def test_a_robot_that_has_no_law_is_among_those_that_are_proven_apart() -> None:
    """r0 can't pass r1 in an aisle, and stands at its start (found by strange_fleet_runs.py)."""
    ends = ((2.0, 28.0), (10.0, 20.0))
    fleet = vs.Fleet.model_validate(
        {
            "separation_m": 0.3,
            "world": {"bounds": [0, 0, 30, 1.6]},
            "robots": {"cart": {"radius_m": 0.4, "clearance_m": 0.1}},
            "fleet": [
                {
                    "name": f"r{k}", "robot": "cart",
                    "route": {"start": [a, 0.8], "goal": [b, 0.8]},
                }
                for k, (a, b) in enumerate(ends)
            ],
        }
    )  # fmt: skip
    plan = vs.plan_fleet(fleet)
    assert set(plan.plans) == {"r1"}
    run = vs.simulate_fleet(fleet, plan=plan)
    assert run.reached
    assert set(run.arrivals) == {"r1"}
    assert run.certificate.separation <= 10.0 - 2.0 - 2.0 * 0.4
    assert run.certificate.separation == pytest.approx(plan.certificate.separation, abs=1e-3)
    assert run.distance_at("r0", np.array([0.0, 5.0])).tolist() == [0.0, 0.0]
    with pytest.raises(vs.GeometryError, match="times: expected numbers"):
        run.distance_at("r0", "soon")  # type: ignore[arg-type]


@pytest.mark.parametrize("delays", [Delays(), Delays(slowed=0.3, halts=2.0, halts_s=3.0, lost=0.3)])
def test_a_robot_gets_past_the_tip_of_a_turn_that_it_drives_at_nanometres_a_second(
    delays: Delays,
) -> None:
    start = {"at": [23.23, 17.18], "heading_deg": 47.251}
    route = {"start": start, "via": [[23.24, 17.83]], "closed": True, "laps": 1}
    fleet = vs.Fleet.model_validate(
        {
            "spline": {"tension": 0.482},
            "robots": {"cart": {"max_yaw_accel_degps2": 111.385}},
            "fleet": [{"name": "a", "robot": "cart", "route": route}],
        }
    )
    plan = vs.plan_fleet(fleet)
    law = plan.plans["a"].trajectory
    assert law.speeds[law.speeds > 0.0].min() < 1e-6
    run = vs.simulate_fleet(fleet, delays, plan)
    assert run.deadlock == ()
    if delays == Delays():
        assert run.arrivals["a"] == pytest.approx(law.end_time, abs=0.2)
    else:
        assert run.arrivals["a"] > law.end_time
