"""Fleets that change under way: robots die, are taken out, added, sent elsewhere."""

from __future__ import annotations

import numpy as np
import pytest
from straight_drives import CROSS, driven_on

from viaspline.errors import GeometryError
from viaspline.fleet.execution.fleet_messages import ProgressReport
from viaspline.fleet.execution.fleet_navigator import FleetNavigator

ASIDE = ((0.0, 30.0), (40.0, 30.0))
LATER = ((30.0, -38.0), (30.0, 20.0))


def under_way(lines, place: float = 10.0) -> FleetNavigator:  # type: ignore[no-untyped-def]
    """r0 has come to a place, the others stand."""
    _, nav = FleetNavigator.of(driven_on(lines)).step([], 0.0)
    return nav.step([ProgressReport("r0", 30.0, place)], 30.0)[1]


def test_nobody_waits_for_a_robot_that_was_taken_out() -> None:
    nav = under_way(CROSS).without("r0")
    assert (nav.events[-1].kind, nav.events[-1].name) == ("taken out", "r0")
    commands, nav = nav.step([ProgressReport("r0", 31.0, 11.0)], 31.0)
    assert list(commands) == ["r1"]
    assert commands["r1"].granted == 40.0
    assert [event.kind for event in nav.events] == ["ignored"]
    with pytest.raises(GeometryError, match="no robot 'r7'"):
        nav.without("r7")


def test_who_dies_before_a_crossing_is_passed_by_the_others() -> None:
    nav = under_way(CROSS).dead("r0", until_m=10.5)
    assert nav.blocked == {}
    commands, nav = nav.step([], 31.0)
    assert commands["r1"].granted == 40.0
    assert "r0" not in commands


def test_who_dies_in_a_crossing_stops_the_others_before_it() -> None:
    nav = under_way([*CROSS, ASIDE], place=20.0).dead("r0", until_m=20.0)
    assert nav.blocked == {"r1": "r0"}
    commands, nav = nav.step([], 31.0)
    assert 17.0 <= commands["r1"].granted <= 18.0
    assert commands["r1"].waits_for == "r0"
    assert commands["r2"].granted == 40.0
    assert nav.expected()["r1"] == np.inf


def test_where_it_is_not_known_how_far_a_dead_robot_came_it_is_as_far_as_it_was_let() -> None:
    nav = under_way(CROSS).dead("r0")
    assert nav.blocked == {"r1": "r0"}
    with pytest.raises(GeometryError, match=r"until_m is 41\.0"):
        under_way(CROSS).dead("r0", until_m=41.0)


def test_those_behind_one_that_is_blocked_are_blocked_too() -> None:
    lines = [*CROSS, ((-30.0, 10.0), (40.0, 10.0))]  # r2 comes to r1's way late, beyond r0's
    nav = under_way(lines, place=20.0).dead("r0", until_m=20.0)
    assert nav.blocked == {"r1": "r0", "r2": "r1"}


def test_a_robot_that_is_added_changes_nothing_for_those_whose_way_it_does_not_cross() -> None:
    nav = under_way(CROSS)
    before, _ = nav.step([], 31.0)
    more = nav.with_fleet(driven_on([*CROSS, ASIDE]))
    commands, more = more.step([], 31.0)
    assert {name: commands[name] for name in before} == before
    assert commands["r2"].granted == 40.0
    assert more.progress == {"r0": 10.0, "r1": 0.0, "r2": 0.0}


def test_a_robot_that_is_added_waits_for_those_that_were_there() -> None:
    more = under_way(CROSS).with_fleet(driven_on([*CROSS, LATER]))
    commands, _ = more.step([], 31.0)
    assert commands["r2"].waits_for == "r0"
    assert 35.0 <= commands["r2"].granted <= 36.0


def test_a_robot_can_not_be_put_before_one_that_was_let_into_the_crossing() -> None:
    nav = under_way(CROSS)
    with pytest.raises(GeometryError, match=r"r2 is to pass before r0, which may have gone beyond"):
        nav.with_fleet(driven_on([*CROSS, ((30.0, -20.0), (30.0, 20.0))], [2, 0, 1]))


def test_orders_that_were_swapped_stay_swapped_in_the_next_plan() -> None:
    nav = under_way(CROSS).dead("r0", until_m=10.0)  # which swaps its order with r1
    assert nav._state.packed.leaders.tolist() == [1]
    more = nav.with_fleet(driven_on([*CROSS, ASIDE]))
    assert more._state.packed.leaders.tolist() == [1]
    commands, more = more.step([], 31.0)
    assert "r0" not in commands
    assert commands["r1"].granted == 40.0


def test_a_dead_robot_is_let_no_farther_and_others_join_in_its_way_later() -> None:
    nav = under_way(CROSS).dead("r0", until_m=10.0)
    _, nav = nav.step([], 31.0)
    assert nav._state.packed.promised.tolist() == [10.0, 40.0]
    more = nav.with_fleet(driven_on([*CROSS, ASIDE]))
    assert more._state.packed.leaders.tolist() == [1]


def test_who_dies_at_its_start_is_in_the_way_of_one_that_is_to_rest_there() -> None:
    """It was taken to be before a crossing that begins where its path does: a contact."""
    follower = ((40.0, -40.0), (20.0, -20.0))  # to where r1 starts
    fleet = driven_on([CROSS[1], follower])
    _, nav = FleetNavigator.of(fleet).step([], 0.0)
    nav = nav.dead("r0", until_m=0.0)
    assert nav.blocked == {"r1": "r0"}
    commands, nav = nav.step([], 1.0)
    stands = fleet.place_at(1, commands["r1"].granted)
    assert np.hypot(*(stands - np.array([20.0, -20.0]))) >= 2.0


def test_a_dead_robot_a_little_beyond_where_it_was_let_refuses_no_other_change() -> None:
    _, nav = FleetNavigator.of(driven_on(CROSS)).step([], 0.0)
    let = nav.step([], 0.1)[0]["r1"].granted
    nav = nav.dead("r1", until_m=let + 0.05)
    more = nav.with_fleet(driven_on([*CROSS, ASIDE]))
    assert more.step([], 1.0)[0]["r2"].granted == 40.0
    with pytest.raises(GeometryError, match=r"r2 is to pass before r1, which may have gone beyond"):
        nav.with_fleet(driven_on([*CROSS, ((10.0, -2.5), (60.0, -2.5))], [2, 0, 1]))


def test_who_gets_another_path_begins_it_at_its_start() -> None:
    nav = under_way([*CROSS, ASIDE], place=10.0)
    rest = ((10.0, 0.0), (10.0, 25.0))  # from where it is
    more = nav.with_fleet(driven_on([rest, CROSS[1], ASIDE]))
    assert more.progress == {"r0": 0.0, "r1": 0.0, "r2": 0.0}
    commands, _ = more.step([ProgressReport("r0", 31.0, 1.0)], 31.0)
    assert commands["r0"].granted == 25.0
    assert commands["r1"].granted == 40.0
