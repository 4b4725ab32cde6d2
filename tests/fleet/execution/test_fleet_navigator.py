"""The navigator of a fleet in a person's own control room: what it grants, and what it believes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from obeying_carts import carts_of, start
from straight_drives import REACH, driven_on, timed_lines

from viaspline.errors import GeometryError
from viaspline.fleet.execution.fleet_messages import FleetCommand, ProgressReport
from viaspline.fleet.execution.fleet_navigator import FleetNavigator


def test_the_first_may_go_to_its_goal_and_the_second_to_the_crossing() -> None:
    commands, nav = start().step([], 0.0)
    assert [commands[name].granted for name in ("r0", "r2")] == [40.0, 40.0]
    second = commands["r1"]
    assert 17.0 <= second.granted <= 18.0
    assert second.waits_for == "r0"
    assert commands["r0"].waits_for is None
    assert nav.time == 0.0
    assert start().time == -math.inf


def test_a_report_of_having_left_the_crossing_opens_it() -> None:
    commands, nav = start().step([], 0.0)
    opens_at = 0.0
    for time in range(20, 40):  # a bar after the other: it follows
        commands, nav = nav.step([ProgressReport("r0", float(time), opens_at)], float(time))
        if commands["r1"].waits_for is None:
            break
        opens_at = commands["r1"].opens_at
    assert 22.0 <= opens_at <= 23.0
    assert commands["r1"].granted == 40.0


def test_with_a_margin_it_opens_that_much_later_and_at_the_goal_in_any_case() -> None:
    _, nav = start(margin_m=1.0).step([], 0.0)
    needed = max(nav._state.orders.packed.passed[nav._state.orders.packed.other == 0])
    for beyond, is_open in ((0.0, False), (0.9, False), (1.001, True)):
        commands, _ = nav.step([ProgressReport("r0", 15.0, needed + beyond)], 15.0)
        assert (commands["r1"].waits_for is None) == is_open
    with pytest.raises(GeometryError, match="margin_m is -1"):
        start(margin_m=-1.0)


REFUSED = {
    "from the future": ProgressReport("r0", 10.5, 5.0),
    "of no robot of this fleet": ProgressReport("r7", 10.0, 5.0),
    "can't have come farther than 20.00 m": ProgressReport("r0", 10.0, 22.0),
    "of a path of 40.00 m": ProgressReport("r0", 10.0, 41.0),
    "not finite": ProgressReport("r0", 10.0, math.nan),
    "that it has arrived": ProgressReport("r0", 10.0, 10.0, arrived=True),
}


@pytest.mark.parametrize("words", REFUSED)
def test_a_report_that_can_not_be_true_is_refused_and_opens_nothing(words: str) -> None:
    _, nav = start().step([], 0.0)
    kept, _ = nav.step([], 10.0)
    commands, nav = nav.step([REFUSED[words]], 10.0)
    assert nav.progress == {"r0": 0.0, "r1": 0.0, "r2": 0.0}
    refused = [event for event in nav.events if event.kind == "refused"]
    assert [event.name for event in refused] == [REFUSED[words].name]
    assert words in refused[0].message
    assert commands == kept


@pytest.mark.parametrize("field", ["time", "distance", "speed", "holds", "heard"])
@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_numbers_that_are_none_are_refused(field: str, value: float) -> None:
    report = replace(ProgressReport("r0", 0.0, 0.0), **{field: value})
    _, nav = start().step([report], 0.0)
    assert [event.kind for event in nav.events] == ["refused"]


def test_old_reports_are_ignored() -> None:
    _, nav = start().step([], 0.0)
    _, nav = nav.step([ProgressReport("r0", 10.0, 15.0)], 10.0)
    _, after = nav.step([ProgressReport("r0", 9.0, 14.0)], 11.0)
    assert after.progress["r0"] == 15.0
    assert [event.kind for event in after.events] == ["ignored"]
    assert "is old" in after.events[0].message
    _, after = nav.step([ProgressReport("r0", 11.0, 14.95)], 11.0)  # noise
    assert after.events == ()
    assert after.progress["r0"] == 15.0


@pytest.mark.slow
@given(seed=st.integers(0, 10_000), parts=st.lists(st.floats(0.0, 1.0), min_size=9, max_size=9))
@settings(max_examples=20, deadline=None)
def test_robots_that_stop_within_the_tolerance_before_their_bars_all_arrive(
    seed: int, parts: list[float]
) -> None:
    """Each comes to rest so far before the end of its grant, and stays there till it grows."""
    fleet = driven_on(timed_lines(seed, 9))
    nav = FleetNavigator.of(fleet, stops_within_m=0.3)
    places = dict.fromkeys(nav.names, 0.0)
    for time in range(0, 40 * len(nav.names)):
        reports = [
            ProgressReport(name, 30.0 * time, place, arrived=place == fleet.lengths[robot])
            for robot, (name, place) in enumerate(places.items())
        ]
        commands, nav = nav.step(reports, 30.0 * time)
        assert not [event for event in nav.events if event.kind == "refused"]
        if nav.reached:
            break
        for robot, name in enumerate(nav.names):
            granted, part = commands[name].granted, parts[robot]
            is_end = granted == fleet.lengths[robot]
            aim = granted if is_end else granted - 0.3 * part
            places[name] = max(places[name], aim)
    assert nav.reached


def test_a_tolerance_with_which_robots_could_wait_for_each_other_for_ever_is_refused() -> None:
    """Each ends on the way of the next one and passes the end of another: no order is to be had."""
    corners = [np.array([16.0 * np.cos(a), 16.0 * np.sin(a)]) / 3**0.5 for a in (0.0, 2.1, 4.2)]
    lines = []
    for k, end in enumerate(corners):
        way = (end - corners[k - 1]) / np.hypot(*(end - corners[k - 1]))
        lines.append((tuple(corners[k - 1] - 8.0 * way), tuple(end)))
    fleet = driven_on(lines)
    refused = []
    for short in (0.0, 0.05, 20.0):
        try:
            FleetNavigator.of(fleet, stops_within_m=short)
        except GeometryError as error:
            refused.append((short, str(error)))
    assert [short for short, _ in refused] == [20.0]
    assert refused[0][1].startswith("the orders have a cycle: ")
    with pytest.raises(GeometryError, match="stops_within_m is -1"):
        FleetNavigator.of(fleet, stops_within_m=-1.0)


def test_a_report_along_another_path_is_ignored() -> None:
    _, nav = start().step([], 0.0)
    _, nav = nav.step([ProgressReport("r0", 10.0, 15.0, path=1)], 10.0)
    assert nav.progress["r0"] == 0.0
    assert nav.events[0].kind == "ignored"
    assert "along its path 1, and it drives 0" in nav.events[0].message


def test_a_robot_that_is_not_heard_of_is_named_once_and_others_wait_for_it() -> None:
    _, nav = start().step([], 0.0)
    said = []
    for time in range(1, 20):
        heard = [ProgressReport(name, float(time), 0.0) for name in ("r1", "r2")]
        commands, nav = nav.step(heard, float(time))
        said += [(event.kind, event.name) for event in nav.events]
        assert commands["r1"].waits_for == "r0"
    assert said == [("silent", "r0")]


def test_what_is_no_report_or_no_time_is_an_error() -> None:
    nav = start()
    with pytest.raises(GeometryError, match=r"reports\[0\] is of the class int"):
        nav.step([5], 0.0)  # type: ignore[list-item]
    _, nav = nav.step([], 3.0)
    with pytest.raises(GeometryError, match=r"time 2\.0 s is before the last step's, 3\.0 s"):
        nav.step([], 2.0)
    with pytest.raises(GeometryError, match="nan"):
        nav.step([], math.nan)


def test_a_step_changes_nothing_of_the_navigator_before() -> None:
    _, nav = start().step([], 0.0)
    one = nav.step([ProgressReport("r0", 10.0, 15.0)], 10.0)
    again = nav.step([ProgressReport("r0", 10.0, 15.0)], 10.0)
    assert one[0] == again[0]
    assert nav.progress["r0"] == 0.0
    assert nav.time == 0.0


@given(
    seed=st.integers(0, 10_000), lost=st.floats(0.0, 0.4), late=st.integers(0, 5),
    margin=st.sampled_from([0.0, 0.05]),
)  # fmt: skip
@settings(max_examples=3, deadline=None)
def test_carts_that_obey_stay_apart_and_arrive_however_messages_are_lost_or_late(
    seed: int, lost: float, late: int, margin: float
) -> None:
    """The carts' own law of motion; what is said arrives up to half a second late, or not."""
    lines = timed_lines(seed, 4)
    random = np.random.default_rng(seed)
    nav = FleetNavigator.of(driven_on(lines), margin_m=margin)
    carts = carts_of(nav)
    under_way: list[tuple[int, ProgressReport]] = []
    last: dict[str, FleetCommand] = {}
    for tick in range(3000):
        under_way += [
            (tick + int(random.integers(late + 1)), cart.report(0.1 * tick))
            for cart in carts
            if random.uniform() >= lost
        ]
        due = [report for when, report in under_way if when <= tick]
        under_way = [(when, report) for when, report in under_way if when > tick]
        commands, nav = nav.step(due, 0.1 * tick)
        assert not [event for event in nav.events if event.kind == "refused"]
        for cart in carts:
            if random.uniform() >= lost:
                last[cart.name] = commands[cart.name]
                cart.hear(last[cart.name])
                cart.drive(last[cart.name])
            else:  # it stops, as it doesn't know how to go on
                slower = max(cart.speed - 0.1, 0.0)
                cart.place = min(cart.place + 0.05 * (cart.speed + slower), cart.holds)
                cart.speed = slower
        places = np.array(
            [
                np.array(a) + cart.place / cart.length * (np.array(b) - np.array(a))
                for cart, (a, b) in zip(carts, lines, strict=True)
            ]
        )
        gaps = np.hypot(*np.moveaxis(places[:, None] - places[None], -1, 0))
        assert (gaps + 9.0 * np.eye(len(lines))).min() >= 2.0 * REACH
        if nav.reached:
            break
    assert nav.reached


@given(seed=st.integers(0, 10_000), long=st.integers(50, 400))
@example(seed=10, long=200)  # two of them waited for each other for ever
@settings(max_examples=4, deadline=None)
def test_carts_that_never_say_what_they_take_themselves_to_be_let_arrive(
    seed: int, long: int
) -> None:
    """As somebody has it who reports a place and a speed alone, and obeys; each halts once."""
    nav = FleetNavigator.of(driven_on(timed_lines(seed, 4)))
    carts, random = carts_of(nav), np.random.default_rng(seed)
    halts = {cart.name: int(random.integers(0, 200)) for cart in carts}
    for tick in range(4000):
        reports = [replace(cart.report(0.1 * tick), holds=None, heard=None) for cart in carts]
        commands, nav = nav.step(reports, 0.1 * tick)
        for cart in carts:
            command = commands[cart.name]
            if cart.place + cart.speed**2 / 2 <= command.granted:
                cart.holds = command.granted  # less than it had, too
            if 0 <= tick - halts[cart.name] < long:
                cart.place = min(cart.place + 0.5 * cart.speed**2, cart.holds)
                cart.speed = 0.0
            else:
                cart.drive(command)
        if nav.reached:
            break
    assert nav.reached


def test_who_leaves_the_world_has_left_every_crossing() -> None:
    lines = [((0.0, 0.0), (20.0, 0.0)), ((20.0, -20.0), (20.0, 20.0))]
    nav = FleetNavigator.of(driven_on(lines, vanish=True))
    commands, nav = nav.step([ProgressReport("r0", 12.0, 19.99)], 12.0)
    assert commands["r1"].waits_for == "r0"
    assert commands["r1"].opens_at == math.inf
    commands, nav = nav.step([ProgressReport("r0", 12.1, 20.0, arrived=True)], 12.1)
    assert commands["r1"].waits_for is None
    assert [(event.kind, event.name) for event in nav.events] == [("arrived", "r0")]


def test_the_fleet_of_none_has_nothing_to_do() -> None:
    commands, nav = FleetNavigator.of(driven_on([((0.0, 0.0), (9.0, 0.0))])).step([], 0.0)
    assert list(commands) == ["r0"]
    assert commands["r0"].granted == 9.0
    assert not nav.reached
    assert nav.expected()["r0"] == pytest.approx(6.5)


def test_expected_arrivals_are_those_of_robots_that_never_wait_longer_than_they_must() -> None:
    _, nav = start().step([], 0.0)
    expected = nav.expected()
    assert expected["r0"] == pytest.approx(22.0)
    assert 22.5 < expected["r1"] < 25.0
    _, late = nav.step([ProgressReport("r0", 50.0, 0.0), ProgressReport("r1", 50.0, 0.0)], 50.0)
    assert late.expected()["r0"] == pytest.approx(72.0)
