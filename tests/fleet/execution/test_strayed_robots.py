"""Robots that come farther than they were let, or are pushed back: they are believed."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from stepped_fleets import APART_M, ASIDE, CROSS, fleet, member
from straying_fleets import BODIES_M, straying

import viaspline as vs
from viaspline import ProgressReport
from viaspline.fleet.execution.changed_plans import add_robot


def stepped(nav: vs.FleetNavigator, time: float, **places: float) -> Any:
    """Robots that stand at places and have heard all that they were told."""
    reports = [
        ProgressReport(name, time, place, holds=place, heard=nav.time)
        for name, place in places.items()
    ]
    return nav.step(reports, time)


def crossing() -> tuple[vs.FleetNavigator, float]:
    """Two robots at their starts, and how far the second one may go."""
    nav = vs.FleetNavigator(vs.plan_fleet(fleet(*CROSS)), warm=False)
    commands, nav = stepped(nav, 0.0, r0=0.0, r1=0.0)
    assert commands["r1"].waits_for == "r0"
    return nav, commands["r1"].granted


def kinds(nav: vs.FleetNavigator) -> list[tuple[str, str]]:
    return [(event.kind, event.name) for event in nav.events]


def test_one_that_overshoots_passes_first_once_the_other_says_that_it_keeps_out() -> None:
    nav, granted = crossing()
    commands, nav = stepped(nav, 20.0, r0=5.0, r1=granted + 0.3)
    assert kinds(nav)[0] == ("strayed", "r1")
    assert f"may go to {granted:.2f} m only" in nav.events[0].message
    assert commands["r1"].granted == granted  # it stands
    assert commands["r0"].granted < 18.5  # it was let to its goal, and is asked to wait
    assert commands["r0"].waits_for == "r1"
    commands, nav = stepped(nav, 21.0, r0=5.0, r1=granted + 0.3)
    assert kinds(nav) == [("swapped", "r1")]
    commands, nav = stepped(nav, 22.0, r0=5.0, r1=granted + 0.3)
    assert commands["r1"].granted == 40.0
    assert nav.progress["r1"] == pytest.approx(granted + 0.3)


def test_one_that_overshoots_while_the_other_is_in_waits_for_it_and_goes_on_then() -> None:
    nav, granted = crossing()
    _, nav = stepped(nav, 20.0, r0=18.5, r1=granted)
    commands, nav = stepped(nav, 21.0, r0=18.5, r1=granted + 0.3)
    assert kinds(nav) == [("strayed", "r1"), ("too near", "r0")]
    said = float(nav.events[1].message.split(" at ")[1].split(" m")[0])
    centres = min(np.hypot(20.0 - x, granted + 0.3 - 20.0) for x in np.arange(18.5, 40.0, 0.01))
    assert centres < APART_M
    assert BODIES_M + said == pytest.approx(centres, abs=0.06)
    assert BODIES_M + said <= centres
    assert (commands["r0"].granted, commands["r1"].granted) == (40.0, granted)
    _, nav = stepped(nav, 30.0, r0=30.0, r1=granted + 0.3)
    assert kinds(nav) == []
    commands, nav = stepped(nav, 31.0, r0=30.0, r1=granted + 0.3)
    assert commands["r1"].granted == 40.0


def test_one_that_slips_to_where_it_may_be_touched_stops_the_other_until_it_backs_off() -> None:
    nav, granted = crossing()
    _, nav = stepped(nav, 20.0, r0=17.9, r1=granted)
    _, nav = stepped(nav, 20.5, r0=18.2, r1=granted)
    commands, nav = stepped(nav, 21.8, r0=18.2, r1=20.0)
    assert kinds(nav) == [("strayed", "r1"), ("stops", "r0")]
    assert "without('r1')" in nav.events[1].message
    assert 18.2 <= commands["r0"].granted < 20.0 - BODIES_M
    commands, nav = stepped(nav, 22.0, r0=18.2, r1=20.0)
    assert commands["r0"].granted < 20.0 - BODIES_M
    _, nav = stepped(nav, 30.0, r0=18.2, r1=granted - 0.1)
    assert kinds(nav)[0] == ("strayed", "r1")
    _, nav = stepped(nav, 30.5, r0=18.2, r1=granted - 0.1)
    assert kinds(nav) == []
    commands, nav = stepped(nav, 31.0, r0=18.2, r1=granted - 0.1)
    assert commands["r0"].granted == 40.0


def test_bodies_that_may_have_touched_are_told_of() -> None:
    nav, granted = crossing()
    _, nav = stepped(nav, 20.0, r0=19.1, r1=granted)
    _, nav = stepped(nav, 21.0, r0=19.1, r1=granted + 2.0)
    assert kinds(nav) == [("strayed", "r1"), ("too near", "r0")]
    assert "may have touched" in nav.events[1].message


def test_one_that_is_pushed_back_shuts_what_it_had_opened() -> None:
    nav, granted = crossing()
    commands, nav = stepped(nav, 20.0, r0=25.0, r1=granted)
    assert commands["r1"].granted == 40.0
    _, nav = stepped(nav, 21.0, r0=20.0, r1=granted)
    assert kinds(nav) == [("strayed", "r0"), ("too near", "r0")]  # r1 may be on its way
    assert "has been at 25.00 m" in nav.events[0].message
    assert nav.progress["r0"] == 20.0
    _, nav = stepped(nav, 22.0, r0=20.0, r1=granted)
    commands, nav = stepped(nav, 22.5, r0=20.0, r1=granted)
    assert (commands["r0"].granted, commands["r1"].granted) == (40.0, granted)
    assert commands["r1"].waits_for == "r0"
    _, nav = stepped(nav, 25.0, r0=25.0, r1=granted)
    commands, nav = stepped(nav, 26.0, r0=25.0, r1=granted)
    assert commands["r1"].granted == 40.0


@pytest.mark.parametrize("change", ["joins", "other plan"])
def test_a_fleet_is_changed_while_one_of_its_robots_is_where_it_was_not_let(change: str) -> None:
    """All changes were refused: "r0 is to pass before r1, which may have gone beyond"."""
    nav, granted = crossing()
    _, nav = stepped(nav, 20.0, r0=18.5, r1=granted)
    before, nav = stepped(nav, 21.0, r0=18.5, r1=granted + 0.3)
    newcomer = member("new", ASIDE)
    if change == "joins":
        nav = nav.with_robot(newcomer)
    else:
        nav = nav.with_plan(add_robot(vs.plan_fleet(fleet(*CROSS)), newcomer))
    commands, nav = stepped(nav, 22.0, r0=18.5, r1=granted + 0.3)
    assert commands["new"].granted == 40.0
    assert {name: commands[name].granted for name in before} == {"r0": 40.0, "r1": granted}
    commands, nav = stepped(nav, 31.0, r0=30.0, r1=granted + 0.3)
    commands, nav = stepped(nav, 32.0, r0=30.0, r1=granted + 0.3)
    assert commands["r1"].granted == 40.0


@pytest.mark.parametrize("goes_on", [True, False])
def test_one_that_goes_on_saying_that_it_is_farther_than_it_can_drive_is_believed(
    goes_on: bool,
) -> None:
    """Pushed on by 0.5 m at full speed, it wasn't believed for the rest of its way."""
    nav, _ = crossing()
    _, nav = stepped(nav, 5.0, r0=8.0, r1=0.0)
    pushed = 0.5 if goes_on else 0.0
    _, nav = stepped(nav, 5.5, r0=9.5, r1=0.0)
    assert kinds(nav) == [("refused", "r0")]
    _, nav = stepped(nav, 6.0, r0=10.0 + pushed, r1=0.0)
    assert kinds(nav) == ([("refused", "r0")] if goes_on else [])
    _, nav = stepped(nav, 6.5, r0=11.0 + pushed, r1=0.0)
    assert kinds(nav) == ([("strayed", "r0")] if goes_on else [])
    assert nav.progress["r0"] == 11.0 + pushed
    _, nav = stepped(nav, 7.0, r0=12.0 + pushed, r1=0.0)
    assert kinds(nav) == []
    assert nav.progress["r0"] == 12.0 + pushed


def test_who_is_pushed_off_its_start_before_it_departs_is_where_it_says() -> None:
    late = {**CROSS[1], "depart_s": 60.0}
    nav = vs.FleetNavigator(vs.plan_fleet(fleet(CROSS[0], late)), warm=False)
    _, nav = nav.step([], 0.0)
    for time in (1.0, 1.5):
        _, nav = stepped(nav, time, r0=0.0, r1=0.4)
        assert kinds(nav) == [("refused", "r1")]
    _, nav = stepped(nav, 2.0, r0=0.0, r1=0.4)
    assert kinds(nav) == [("strayed", "r1")]
    assert nav.progress["r1"] == 0.4


@given(seed=st.integers(0, 100_000), margin=st.sampled_from([0.0, 0.1]))
@example(seed=1000, margin=0.1)
@settings(max_examples=5, deadline=None)
def test_robots_that_stray_once_never_touch_and_all_arrive(seed: int, margin: float) -> None:
    """Each slips on or back by up to 0.45 m: less than half of the separation of 1 m."""
    found = straying(seed, 0.45, margin)
    if found is None:
        return
    assert found.nearest > BODIES_M
    assert found.nav.reached
    if found.nearest < APART_M - 0.12 - 2.0 * margin:
        assert "too near" in {event.kind for event in found.events}
