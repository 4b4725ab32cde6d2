"""Fleets whose messages are late: what is still on its way to a robot counts as well."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from stepped_fleets import fleet

import viaspline as vs
from viaspline import ProgressReport


def test_no_order_is_swapped_while_a_grant_is_on_its_way_to_the_first() -> None:
    """Seed 320075 of harsh_fleet_drives.py: for a station farther on what it held was believed."""
    robots = [
        {"start": [0, 0], "via": [{"at": [50, 0], "dwell_s": 5}], "goal": [60, 0], "depart_s": 7},
        {"start": [10, -20], "goal": [10, 20]},
        {"start": [20, -30], "goal": [20, 30], "depart_s": 6},
    ]
    priorities = {"r0": 0.0, "r1": 2.0, "r2": -1.0}
    asked = fleet(*robots)
    members = [replace(one, priority=priorities[one.name]) for one in asked.members]
    nav = vs.FleetNavigator(vs.plan_fleet(vs.Fleet.of(members, asked.separation_m)), period=0.5)
    commands, nav = nav.step([], 0.0)
    first, second = (commands[name].granted for name in ("r0", "r2"))
    assert (commands["r0"].waits_for, commands["r2"].waits_for) == ("r1", "r0")

    def waits(time: float) -> ProgressReport:
        return ProgressReport("r0", time, first - 0.01, holds=first, heard=time - 1.0)

    for time in np.arange(14.0, 21.5, 0.5).tolist():
        commands, nav = nav.step([waits(time)], time)
    commands, nav = nav.step([waits(21.5), ProgressReport("r1", 21.5, 30.0)], 21.5)
    assert commands["r0"].granted == 50.0
    commands, nav = nav.step([waits(22.0), ProgressReport("r2", 22.0, second)], 22.0)
    assert commands["r2"].granted == second  # r0 may be on its way by the command before
    assert commands["r0"].waits_for == "r2"  # it is asked to let it pass
    commands, nav = nav.step([replace(waits(23.0), heard=22.0)], 23.0)
    assert [one.kind for one in nav.events] == ["swapped"]
    assert commands["r2"].granted == 60.0


def test_reports_that_are_wrong_by_no_more_than_the_margin_are_believed() -> None:
    plan = vs.plan_fleet(fleet({"start": [0, 0], "goal": [40, 0]}))
    nav = vs.FleetNavigator(plan, margin_m=0.5, warm=False)
    wrong, law = np.random.default_rng(1), plan.plans["r0"].trajectory
    for time in np.arange(0.0, law.end_time, 0.1).tolist():
        says = float(law.distance_at(time) + wrong.uniform(-0.5, 0.5))
        _, nav = nav.step([ProgressReport("r0", time, says)], time)
        assert [one for one in nav.events if one.kind in ("refused", "ignored")] == []
