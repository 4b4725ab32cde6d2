"""One period for all patrols."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from viaspline.errors import GaveUpError
from viaspline.fleet.patrols import patrol_rhythm as rhythm_module
from viaspline.fleet.patrols.patrol_rhythm import PatrolRhythm, patrol_rhythm
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import plan


def rhythm_of(*robots: dict[str, Any], **more: Any) -> PatrolRhythm:
    named = [{"name": f"r{k}", **robot} for k, robot in enumerate(robots)]
    fleet = Fleet.model_validate({"fleet": named, **more})
    laps = {one.name: plan(one.mission) for one in fleet.members}
    return patrol_rhythm(fleet.members, laps, fleet.separation_m)


def patrol(*points: list[float], **more: Any) -> dict[str, Any]:
    return {"route": {"start": points[0], "via": list(points[1:]), "closed": True}, **more}


def test_a_single_patrol_has_its_lap_for_a_period() -> None:
    found = rhythm_of(patrol([0, 0], [20, 0], [20, 20]))
    assert found.period == pytest.approx(found.laws["r0"].duration)
    assert found.laps == {"r0": 1}


def test_patrols_that_do_not_meet_have_the_longest_lap_for_a_period() -> None:
    found = rhythm_of(patrol([0, 0], [20, 0]), patrol([0, 30], [60, 30]))
    assert found.period == pytest.approx(found.laws["r1"].duration)
    assert found.laps == {"r0": 2, "r1": 1}
    assert found.laws["r0"].duration <= found.period


def test_a_patrol_sets_out_when_it_may_whatever_the_period() -> None:
    found = rhythm_of(patrol([0, 0], [20, 0]), patrol([0, 30], [60, 30], depart_s=1000))
    assert found.laws["r1"].start_time == pytest.approx(1000.0)


def test_who_has_priority_is_not_held_up() -> None:
    ways = patrol([0, 0], [20, 0]), patrol([10, 9], [10, -14])
    alone = [rhythm_of(one).period for one in ways]
    for favoured in (0, 1):
        robots = [{**way, "priority": int(k == favoured)} for k, way in enumerate(ways)]
        found = rhythm_of(*robots)
        assert found.laws[f"r{favoured}"].duration == pytest.approx(
            alone[favoured] * found.laps[f"r{favoured}"]
        )


def test_a_period_that_gets_too_long_is_given_up_with_who_is_in_the_way(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ways = patrol([0, 4], [0, 0], [40, 0], [0, 0.5]), patrol([40, 4], [40, 0], [1, 0], [40, 0.5])
    assert rhythm_of(*ways).period > 0.0
    monkeypatch.setattr(rhythm_module, "LONGEST_SHARE", 0.5)
    with pytest.raises(GaveUpError) as caught:
        rhythm_of(*ways)
    assert set(caught.value.obstacles) <= {"r0", "r1"}


@pytest.mark.parametrize("seed", range(4))
def test_patrols_whose_ways_all_cross_in_one_place_find_a_short_period(seed: int) -> None:
    random = np.random.default_rng(seed)
    ways = []
    for angle in 2 * np.pi * np.arange(10) / 10 + random.uniform(0, 0.15, 10):
        along = np.array([np.cos(angle), np.sin(angle)])
        aside = np.array([-along[1], along[0]])
        home = random.uniform(16, 30) * along
        across = random.uniform(-9, -4) * along + random.uniform(-4, 4) * aside
        ways.append(patrol(home.tolist(), across.tolist(), (0.6 * home + 1.5 * aside).tolist()))
    found = rhythm_of(*ways)
    assert found.period <= 0.3 * sum(law.duration for law in found.laws.values())


def test_a_robot_that_turns_on_the_spot_has_time_for_it_between_two_laps() -> None:
    robot = {"max_yaw_rate_degps": 20, "turn_on_spot": "vias"}
    route = {"start": [0, 0], "via": [[20, 0], [20, 20]], "closed": True}
    fleet = Fleet.model_validate(
        {"robots": {"cart": robot}, "spline": {"tension": 1.0},
         "fleet": [{"name": "r0", "robot": "cart", "route": route}]}
    )  # fmt: skip
    (member,) = fleet.members
    lap = plan(member.mission)
    found = patrol_rhythm(fleet.members, {"r0": lap}, 0.5)
    assert found.period > lap.trajectory.duration + 2.0


@pytest.mark.parametrize("seed", [67, 163])
def test_who_finds_no_time_is_timed_before_the_others(
    monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    """The period got longer by 8 % where another order would do."""
    random = np.random.default_rng(seed)
    cart = {"radius_m": 0.3, "clearance_m": 0.1, "max_speed_mps": 1.5, "max_accel_mps2": 1}
    kinds: dict[str, Any] = {"separation_m": 0.3, "robots": {"cart": cart}}
    robots = []
    for k in range(6):
        way = np.pi * k / 3 + random.uniform(-0.2, 0.2)
        home = [20.0 * np.cos(way), 20.0 * np.sin(way)]
        vias = random.uniform(-12, 12, (3, 2)).tolist()
        robots.append({**patrol(home, *vias), "robot": "cart"})
    in_some_order = rhythm_of(*robots, **kinds).period
    monkeypatch.setattr(rhythm_module, "MOST_TIMED", 0)  # in the order of their lengths alone
    assert rhythm_of(*robots, **kinds).period > 1.05 * in_some_order
