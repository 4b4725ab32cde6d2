"""Flights among balls that wander into their way and aren't on the map.

    python benchmarks/unseen_flights.py [--flights 40] [--first 0] [--top 3]

A ball of 0.5 m flies 80 m by 5 m/s and 2 m/s², with 1 m of clearance asked for and a sensor of 20 m
that tells velocities to 0.2 m/s. One to three balls of 0.3 to 1.5 m go from place to place about
its way, never faster than ``--top`` and without any regard for it, so some run it down. Each flight
is flown relying on what is foreseen, and with passive safety. Gaps are looked at by formulas of
their own, every 2 ms.
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import numpy as np

import viaspline as vs

RADIUS_M, SPEED_MPS, ACCEL_MPS2, REACH_M, NOISE_MPS = 0.5, 5.0, 2.0, 20.0, 0.2
AWAY_M = 5.0  # of what moves from the start, at first
LOOKED_S = 0.002
STANDS_MPS = 0.02  # who is slower stands, as places are interpolated here


def wanderer(random: np.random.Generator, name: str, top: float) -> dict[str, Any]:
    """A ball on its way from place to place."""
    at, now = random.uniform((10, -30, 4), (90, 30, 16)), 0.0
    rows = [(0.0, *at)]
    for _ in range(int(random.integers(2, 7))):
        to = random.uniform((0, -6, 8), (80, 6, 12))
        now += max(float(np.linalg.norm(to - at)) / (random.uniform(0.3, 0.99) * top), 0.5)
        at = to
        rows.append((now, *at))
    frames = [[round(t, 3), round(x, 3), round(y, 3), 0, round(z, 3)] for t, x, y, z in rows]
    ball = {"center": [0, 0, 0], "radius": float(random.uniform(0.3, 1.5))}
    return {"name": name, "ball": ball, "motion": {"keyframes": frames, "after": "stay"}}


def mission(moving: list[dict[str, Any]], safety: str, top: float) -> vs.Mission:
    """Straight on among these."""
    return vs.Mission.model_validate(
        {
            "world": {"ground": {"flat_m": 0}, "unseen": moving,
                      "altitude": {"min_m": 2, "max_m": 60, "above": "home"}},
            "robot": {"radius_m": RADIUS_M, "clearance_m": 1, "max_speed_mps": SPEED_MPS,
                      "max_accel_mps2": ACCEL_MPS2, "max_climb_mps": 2,
                      "moving": {"max_speed_mps": top, "safety": safety},
                      "sensor": {"range_m": REACH_M, "velocity_noise_mps": NOISE_MPS}},
            "route": {"start": [0, 0, 10], "goal": [80, 0, 10]},
        }
    )  # fmt: skip


def least_gap_under_way(run: vs.SpatialRun, one: dict[str, Any]) -> float:
    """The least free space to a ball while the robot moves [m]."""
    rows = np.array(one["motion"]["keyframes"])
    times = np.arange(run.times[0], run.times[-1], LOOKED_S)
    at = np.column_stack([np.interp(times, rows[:, 0], rows[:, k]) for k in (1, 2, 4)])
    here = np.column_stack([np.interp(times, run.times, run.positions[:, k]) for k in range(3)])
    gaps = np.linalg.norm(here - at, axis=1) - one["ball"]["radius"] - RADIUS_M
    moves = np.interp(times, run.times, run.speeds) > STANDS_MPS
    return float(gaps[moves].min(initial=np.inf))


def main() -> None:
    """Fly, and say what came of it."""
    asked = argparse.ArgumentParser(description=__doc__)
    asked.add_argument("--flights", type=int, default=40)
    asked.add_argument("--first", type=int, default=0)
    asked.add_argument("--top", type=float, default=3.0)
    told = asked.parse_args()
    heads = ("safety", "flights", "reached", "least gap under way", "contacts under way, in time",
             "too late", "while it hovers", "later, mean", "CPU")  # fmt: skip
    print(f"| {' | '.join(heads)} |")
    print("|---|---|---|---|---|---|---|---|---|")
    for safety in ("none", "passive"):
        flown, least, late = [], np.inf, []
        begin = time.process_time()
        for seed in range(told.first, told.first + told.flights):
            random = np.random.default_rng(seed)
            moving = [
                wanderer(random, f"m{k}", told.top) for k in range(int(random.integers(1, 4)))
            ]
            moving = [
                one for one in moving
                if np.linalg.norm(np.take(one["motion"]["keyframes"][0], (1, 2, 4)) - (0, 0, 10))
                > AWAY_M
            ]  # fmt: skip
            plan = vs.plan(mission(moving, safety, told.top))
            run = vs.fly(plan, seed=seed)
            flown.append(run)
            least = min([least, *(least_gap_under_way(run, one) for one in moving)])
            late.append(run.duration - plan.trajectory.duration)
        cpu = (time.process_time() - begin) / told.flights
        met = [one for run in flown for one in run.encounters.contacts]
        under_way = [one for one in met if one.robot_speed > 0.0]
        too_late = sum(one.appeared_within_braking_time for one in under_way)
        hovering = len(met) - len(under_way)
        row = (safety, told.flights, sum(run.reached for run in flown), f"{least:.2f} m",
               len(under_way) - too_late, too_late, hovering, f"{np.mean(late):.1f} s",
               f"{cpu:.1f} s")  # fmt: skip
        print(f"| {' | '.join(map(str, row))} |", flush=True)


if __name__ == "__main__":
    main()
