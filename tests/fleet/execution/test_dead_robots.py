"""Fleets in which a robot dies: those whom it keeps waiting go round it, or are named."""

from __future__ import annotations

import numpy as np
import pytest
from stepped_fleets import APART_M, ASIDE, CROSS, member, start

from viaspline.errors import GaveUpError
from viaspline.fleet.execution import fleet_under_way, ways_from_rest
from viaspline.fleet.execution.fleet_under_way import FleetUnderWay


def test_who_waits_for_a_dead_robot_goes_round_it() -> None:
    drive = start(*CROSS, ASIDE)
    while drive.place["r0"] < 20.0:
        drive.step()
    drive.take(drive.nav.dead("r0", drive.place["r0"]))
    assert drive.nav.blocked == {"r1": "r0"}
    drive.until(40.0, dead=("r0",))
    assert not drive.nav.reached
    place = drive.place["r1"]
    drive.take(drive.nav.replanned())
    assert drive.nav.blocked == {}
    event = drive.nav.events[-1]
    assert (event.kind, event.name, event.at_m) == ("re-planned", "r1", pytest.approx(place))
    begins = np.asarray(drive.nav.paths["r1"].path.at_distance(0.0))
    assert begins == pytest.approx([20.0, -20.0 + place])
    drive.until(100.0, dead=("r0",))
    assert drive.nav.reached
    assert drive.nearest >= APART_M - 1e-6
    assert drive.at["r1"] == pytest.approx([20.0, 20.0])


@pytest.mark.parametrize("others", [0, 1])
def test_nobody_rests_in_the_way_of_one_that_waits_for_a_dead_robot(others: int) -> None:
    """The dead one may be carried off, and the other goes on: it touched who rested there.

    Once another had joined, it was taken never to come (found by strange_fleet_runs.py: 912667).
    """
    drive = start(*CROSS)
    while drive.place["r0"] < 20.0:
        drive.step()
    drive.take(drive.nav.dead("r0", drive.place["r0"]))
    assert drive.nav.blocked == {"r1": "r0"}
    for _ in range(others):
        drive.take(drive.nav.with_robot(member("far", {"start": [60, 40], "goal": [70, 40]})))
    drive.take(drive.nav.with_robot(member("new", {"start": [30, 10], "goal": [20, 10]})))
    assert drive.nav.blocked == {"r1": "r0", "new": "r1"}
    drive.until(60.0, dead=("r0",))
    drive.take(drive.nav.without("r0"))
    while not drive.nav.reached:
        drive.step(dead=("r0",))
        assert np.hypot(*(drive.where()["r1"] - drive.at["new"])) >= APART_M - 1e-6
        assert drive.time < 120.0


def test_a_robot_joins_though_another_waits_for_a_dead_one_that_is_to_wait_for_it_farther_on() -> (
    None
):
    """The dead one stands where both paths meet first; where they meet again it isn't yet."""
    there_and_back = {"start": [20, -12], "via": [[20, 8], [23, 8]], "goal": [23, -12]}
    routes = ({"start": [0, 0], "goal": [40, 0]}, {**there_and_back, "depart_s": 15})
    drive = start(*routes, spline={"tension": 1})
    while drive.place["r0"] < 19.5:
        drive.step()
    drive.take(drive.nav.dead("r0", drive.place["r0"]))
    assert drive.nav.blocked == {"r1": "r0"}
    drive.take(drive.nav.with_robot(member("new", {"start": [0, 40], "goal": [40, 40]})))
    drive.until(60.0, dead=("r0",))
    assert drive.place["new"] >= 40.0 - 1e-6


def test_who_is_still_on_its_way_to_where_it_has_to_wait_is_left_for_later() -> None:
    drive = start(*CROSS)
    drive.until(2.0)
    drive.take(drive.nav.dead("r0", 40.0))  # it may be anywhere
    assert drive.nav.blocked == {"r1": "r0"}
    same = drive.nav.replanned()
    assert same.blocked == {"r1": "r0"}
    assert same.paths["r1"] is drive.nav.paths["r1"]


def test_who_has_no_way_round_a_dead_robot_stays_and_is_named(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    walls = [
        [[-2, 2], [42, 2], [42, 3], [-2, 3]],
        [[-2, -3], [42, -3], [42, -2], [-2, -2]],
        [[42, -3], [43, -3], [43, 3], [42, 3]],
    ]
    world = {"known": [{"polygon": one} for one in walls]}
    one = {"start": [2, 0], "goal": [40, 0]}
    drive = start(one, {"start": [-8, 0], "goal": [36, 0], "depart_s": 1}, world=world)
    drive.until(8.0)
    drive.take(drive.nav.dead("r0", drive.place["r0"]))
    drive.until(60.0, dead=("r0",))
    nav = drive.nav.replanned()
    assert nav.blocked == {"r1": "r0"}
    event = nav.events[-1]
    assert (event.kind, event.name) == ("has no way", "r1")
    assert "r0" in event.message
    with monkeypatch.context() as patch:  # as long as nothing is otherwise it isn't sought again
        patch.delattr(fleet_under_way, "laid_now")
        drive.take(nav)
        drive.until(62.0, dead=("r0",))
        assert drive.nav.replanned().events[-1].message == event.message
    drive.take(drive.nav.without("r0"))  # it is carried off
    drive.place["r0"] = 0.0
    drive.until(120.0, dead=("r0",))
    assert drive.nav.reached


def test_who_has_to_get_to_where_a_dead_robot_may_be_is_told_so_before_it_is_laid(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    through = {"start": [20, -20], "via": [[20, 0]], "goal": [20, 20], "depart_s": 1}
    drive = start({"start": [0, 0], "goal": [40, 0]}, through)
    drive.until(2.0)
    drive.take(drive.nav.dead("r0"))
    drive.until(60.0, dead=("r0",))
    assert drive.nav.blocked == {"r1": "r0"}
    monkeypatch.delattr(ways_from_rest, "lay_among_rests")
    event = drive.nav.replanned().events[-1]
    assert (event.kind, event.name) == ("has no way", "r1")
    assert "round 'r0'" in event.message


def test_robots_in_each_others_way_dont_take_turns_for_ever(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Seed 447 of the crowds: one had no way, and who stood behind it got one again and again."""
    behind = {"start": [20, -24], "goal": [24, 24], "depart_s": 2}
    drive = start(*CROSS, behind)
    drive.until(2.0)
    drive.take(drive.nav.dead("r0", 40.0))
    drive.until(60.0, dead=("r0",))
    assert drive.nav.blocked == {"r1": "r0", "r2": "r1"}
    laid: list[str] = []

    def laid_anew(fleet: FleetUnderWay, name: str) -> FleetUnderWay:
        laid.append(name)
        if name == "r1":
            raise GaveUpError("'r2' is in its way", where=np.zeros(2), remedy="", tried=())
        return fleet

    monkeypatch.setattr(FleetUnderWay, "_laid_anew", laid_anew)
    events = drive.nav.replanned().events
    assert laid == ["r1", "r2", "r1"]
    assert [(one.kind, one.name) for one in events if one.name == "r1"] == [("has no way", "r1")]
