"""Passive safety, in the simulator: whatever moves, the robot stands before it is touched."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.robot.yielding import certified_stop, stoppable
from viaspline.tracks.patience import FROZEN
from viaspline.trajectory.passive_safety import passive_law
from viaspline.trajectory.retime import braking
from viaspline.trajectory.trajectory import Trajectory

TOP_MPS = 1.5


def among(seed: int, safety: str, *, goal: float = 24.0, **robot: Any) -> vs.Mission:
    """Discs that turn at will every second or two, none faster than ``TOP_MPS``."""
    random = np.random.default_rng(seed)
    unseen = []
    for i in range(7):
        place, time = random.uniform((3, -6), (21, 6)), 0.0
        frames = [[time, *place.tolist()]]
        while time < 40.0:
            lasts, angle = float(random.uniform(1.0, 2.5)), float(random.uniform(0, 2 * np.pi))
            speed = float(random.uniform(0.2, TOP_MPS))
            place = place + speed * lasts * np.array([np.cos(angle), np.sin(angle)])
            time += lasts
            frames.append([time, *place.tolist()])
        shape = {"circle": {"center": [0, 0], "radius": 0.4}}
        unseen.append({**shape, "name": f"d{i}", "motion": {"keyframes": frames, "after": "stay"}})
    return vs.Mission.model_validate(
        {
            "world": {"unseen": unseen},
            "robot": {
                "radius_m": 0.25,
                "clearance_m": 0.05,
                "sensor": {"range_m": 8},
                "moving": {"max_speed_mps": TOP_MPS, "safety": safety},
                **robot,
            },
            "route": {"start": [0, 0], "goal": [goal, 0]},
        }
    )


@pytest.mark.parametrize("seed", range(2))
def test_nothing_touches_a_robot_that_moves(seed: int) -> None:
    run = vs.simulate(among(seed, "passive"), step=0.1)
    assert run.encounters is not None
    assert [contact for contact in run.encounters.contacts if contact.robot_speed > 0.0] == []
    assert run.speeds.max() <= 2.0 + 1e-9


def test_nothing_touches_one_with_a_limit_of_the_jerk_and_a_delay() -> None:
    drive = {"differential": {"track_m": 0.4}, "delay_s": 0.3}
    asked = among(1, "passive", goal=9.0, max_jerk_mps3=2.0, drive=drive)
    run = vs.simulate(asked, step=0.2)
    assert run.encounters is not None
    assert [contact for contact in run.encounters.contacts if contact.robot_speed > 0.0] == []


def test_who_stands_for_what_crosses_sets_off_when_it_is_gone_and_not_before() -> None:
    """It crept into its way before: a law that waits was taken for one that goes at once."""
    motion = {"keyframes": [[0, 1.6, -6], [12, 1.6, 6]], "after": "stay"}
    thing = {"name": "cart", "circle": {"center": [0, 0], "radius": 1.2}, "motion": motion}
    data = among(0, "passive").model_dump(by_alias=True, exclude_defaults=True)
    data["world"] = {"unseen": [thing]}
    run = vs.simulate(vs.Mission.model_validate(data), step=0.1)
    assert run.reached
    assert run.encounters is not None
    assert run.encounters.contacts == ()
    assert run.encounters.clearance > 0.0


def test_a_stop_that_was_proven_is_driven_on_its_path_and_what_was_seen_is_not_forgotten(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A new path on which no law is proven isn't taken: then it braked on it, by no proof."""
    data = among(0, "passive").model_dump(by_alias=True, exclude_defaults=True)
    data["world"] = {"unseen": [{"name": "rock", "circle": {"center": [14, 0.2], "radius": 0.5}}]}
    planned = vs.plan(vs.Mission.model_validate(data))
    unproven: list[float] = []

    def doubtful(path: Any, upper: Any, *rest: Any) -> tuple[Any, bool]:
        law, proven = passive_law(path, upper, *rest)
        if path is planned.path or len(unproven) >= 5:
            return law, proven
        unproven.append(float(law.start_time))
        return law, False

    monkeypatch.setattr(certified_stop, "passive_law", doubtful)
    run = vs.simulate(planned.mission, plan=planned, step=0.1)
    assert len(unproven) == 5
    assert run.reached
    assert run.replans
    assert all(replan.time > max(unproven) for replan in run.replans)
    assert [event for event in run.events if "its stop is proven" in event.message]
    assert run.certificate.clearance >= 0.05 - 1e-6


def test_who_does_without_drives_as_if_nothing_came_from_out_of_sight() -> None:
    calm, bold = (
        vs.simulate(among(3, safety, goal=16.0), step=0.2) for safety in ("passive", "none")
    )
    assert bold.duration <= calm.duration


def test_one_that_no_step_is_proven_safe_for_says_so_and_does_not_stand_for_ever() -> None:
    data = among(0, "passive").model_dump(by_alias=True, exclude_defaults=True)
    data["world"], data["robot"]["sensor"] = {"unseen": []}, {"range_m": 0.35}
    run = vs.simulate(vs.Mission.model_validate(data), step=0.5)
    assert not run.reached
    assert run.duration == pytest.approx(stoppable.MAX_FROZEN_S, abs=1.0)
    assert "no step of it was proven safe" in run.events[-1].message
    assert np.abs(run.positions).max() < 1e-6


def test_one_that_sees_little_creeps_on_and_is_not_frozen() -> None:
    """It stood: no step of 0.1 m with the stop after it was proven, but shorter ones are."""
    data = among(0, "passive").model_dump(by_alias=True, exclude_defaults=True)
    data["world"], data["robot"]["sensor"] = {"unseen": []}, {"range_m": 0.6}
    data["route"]["goal"] = [0.5, 0.0]
    run = vs.simulate(vs.Mission.model_validate(data), step=0.1)
    assert run.reached
    assert run.speeds.max() * TOP_MPS < 0.3  # at rest before what comes from 0.3 m beyond its body


@pytest.mark.parametrize(("proven_m", "looks"), [(1e-4, 1), (1.2e-3, 1), (0.02, 12)])
def test_who_gets_on_by_hairs_stands_and_gives_up(
    monkeypatch: pytest.MonkeyPatch, proven_m: float, looks: int
) -> None:
    """It crept on for ever: every hair of a step began its patience anew, or every centimetre."""
    count = 0

    def hairs(asked: certified_stop.StopAsked) -> Trajectory:
        nonlocal count
        count += 1
        here, speed, _ = (float(value) for value in asked.upper.state_at(asked.now))
        if (speed > 0.0 and looks == 1) or count % 300 >= looks:
            return braking(here, speed, asked.limits[1], asked.now)
        places = here + np.array([0.0, 0.5, 1.0]) * proven_m
        squares = np.array([0.0, proven_m, 0.0])
        return Trajectory.through(places, squares, max_accel=1.0, start_time=asked.now)

    monkeypatch.setattr(stoppable, "certified_stop", hairs)
    data = among(0, "passive").model_dump(by_alias=True, exclude_defaults=True)
    data["world"] = {}
    run = vs.simulate(vs.Mission.model_validate(data))
    assert run.reason is not None
    assert run.reason.startswith(FROZEN)
    assert run.path.length < 0.1
    assert run.duration < 61.0


def test_who_waits_for_gaps_in_between_is_frozen_all_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It stood for ever: each wait for what went to and fro before it began its patience anew."""

    def nothing(asked: certified_stop.StopAsked) -> Trajectory:
        here, speed, _ = (float(value) for value in asked.upper.state_at(asked.now))
        return braking(here, speed, asked.limits[1], asked.now)

    def half_the_time(law: Trajectory, now: float) -> float:
        return now + 9.0 if now % 10.0 < 5.0 else now

    monkeypatch.setattr(stoppable, "certified_stop", nothing)
    monkeypatch.setattr(stoppable, "_stands_until", half_the_time)
    data = among(0, "passive").model_dump(by_alias=True, exclude_defaults=True)
    data["world"] = {}
    run = vs.simulate(vs.Mission.model_validate(data), step=0.5)
    assert run.reason is not None
    assert run.reason.startswith(FROZEN)
    assert run.path.length < 0.1
    assert run.duration == pytest.approx(2.0 * stoppable.MAX_FROZEN_S, abs=10.0)
