"""A day's patrol: laps of a round on which things appear; what a step costs, and what is kept.

    python benchmarks/day.py [--hours H] [--finds N] [--seed S]

A point robot that sees 20 m far goes round 1.3 km, lap after lap, in a loop of 10 Hz; things come
up beside the round and on it while the robot is elsewhere, 2,000 in 24 hours. The sensor is the
benchmark's own and isn't timed: timed is ``Navigator.step`` alone, by the processor time that it
takes. Memory is that of the whole process; the discs are all made before it starts.
"""

from __future__ import annotations

import argparse
import gc
import resource
import time
from collections.abc import Iterator

import numpy as np

import viaspline as vs

ROUND_M, VIAS = 1300.0, 26
"""Length of the round [m], and how many via points it has."""

SPEED_MPS, PERIOD_S, RANGE_M = 2.0, 0.1, 20.0
"""How fast the robot is [m/s], the time from step to step [s], and how far it sees [m]."""

SPREAD_M, RADII_M = 8.0, (0.2, 0.5)
"""Finds stand so far beside the round (one standard deviation) [m], and are so large [m]."""

REHEARSED_STEPS = 8000
"""Of a lap that is driven before, with everything there at once."""

FINDS_PER_HOUR = 2000 / 24


def patrol(hours: float) -> vs.Mission:
    """A wavy round that is driven for so long [h]."""
    angles = np.linspace(0.0, 2.0 * np.pi, VIAS, endpoint=False)
    radii = ROUND_M / (2.0 * np.pi) * (1.0 + 0.05 * np.cos(5.0 * angles)) * 0.965
    points = np.column_stack((radii * np.cos(angles), radii * np.sin(angles))).round(3).tolist()
    laps = int(np.ceil(3600.0 * hours * SPEED_MPS / ROUND_M)) + 1
    return vs.Mission.model_validate(
        {
            "robot": {
                "max_speed_mps": SPEED_MPS, "max_accel_mps2": 1, "clearance_m": 0.5,
                "sensor": {"range_m": RANGE_M},
            },
            "route": {"start": points[0], "via": points[1:], "closed": True, "laps": laps},
        }
    )  # fmt: skip


def finds(
    mission: vs.Mission, count: int, hours: float, seed: int
) -> tuple[list[vs.Obstacle], np.ndarray]:
    """Discs beside the round, no via point inside their clearance, and when they come up [s]."""
    random = np.random.default_rng(seed)
    once = mission.route.model_copy(update={"laps": 1})
    lap = vs.plan(mission.model_copy(update={"route": once})).path
    vias = np.array([via.at for via in lap.vias])
    discs: list[vs.Obstacle] = []
    while len(discs) < count:
        u = float(lap.parameter(random.uniform(0.0, lap.length)))
        normal = np.asarray(lap.tangent(u))[::-1] * (-1.0, 1.0)
        centre = lap.evaluate(u) + random.normal(0.0, SPREAD_M) * normal
        radius = random.uniform(*RADII_M)
        if np.hypot(*(vias - centre).T).min() > radius + 1.0:
            disc = {"center": centre.round(3).tolist(), "radius": round(radius, 3)}
            discs.append(vs.Obstacle(circle=disc, name=f"find {len(discs) + 1}"))
    return discs, np.sort(random.uniform(0.0, 3600.0 * hours, count))


def steps(
    mission: vs.Mission, discs: list[vs.Obstacle], since: np.ndarray, count: int
) -> Iterator[tuple[vs.Navigator, float]]:
    """So many steps of a drive: the navigator after each, and what that took [s]."""
    centers = np.array([disc.circle.center for disc in discs]).reshape(-1, 2)
    radii = np.array([disc.circle.radius for disc in discs])
    there = np.zeros(len(discs), bool)
    nav = vs.Navigator(mission)
    for tick in range(count):
        now = tick * PERIOD_S
        state = nav.reference(now)
        gaps = np.hypot(*(centers - state.position).T) - radii
        there |= (since <= now) & (gaps > RANGE_M)
        sensed = [discs[k] for k in np.flatnonzero(there & (gaps <= RANGE_M)).tolist()]
        begin = time.thread_time()
        _, nav = nav.step(state, sensed, now)
        yield nav, time.thread_time() - begin
        if nav.finished:
            print(f"over after {now:.0f} s: {nav.reason}")
            return


def drive(mission: vs.Mission, discs: list[vs.Obstacle], since: np.ndarray, hours: float) -> None:
    """Drive for so long [h] and print a line an hour, or ten in all."""
    for _ in steps(mission, discs, np.zeros(len(discs)), REHEARSED_STEPS):
        pass  # then all kernels are loaded
    count, replans = round(3600.0 * hours / PERIOD_S), 0
    spent = np.full(count, np.nan)  # in memory from the start
    every = max(min(count // 10, round(3600.0 / PERIOD_S)), 1)
    print("| hours | laps | finds known | re-plans | spans | median | 99 % | greatest | memory |")
    print("|---|---|---|---|---|---|---|---|---|")
    gc.collect()
    gc.freeze()  # what was loaded stays: no step has to look through it for garbage
    for tick, (nav, taken) in enumerate(steps(mission, discs, since, count), start=1):
        spent[tick - 1] = taken
        replans += len(nav.replans)
        if tick % every == 0:
            _report(tick * PERIOD_S / 3600.0, nav, replans, spent[tick - every : tick])
    print("\nall of it:")
    _report(hours, nav, replans, spent)


def _report(hour: float, nav: vs.Navigator, replans: int, spent: np.ndarray) -> None:
    p50, p99, most = (1e3 * np.percentile(spent, (50, 99, 100))).tolist()
    with open("/proc/self/statm") as statm:
        memory = int(statm.read().split()[1]) * resource.getpagesize() / 1e6
    laps = (nav.driven + nav.distance) / nav.plan.path.length * nav.mission.route.laps
    print(
        f"| {hour:.2f} | {laps:.1f} | {len(nav.world)} | {replans} | {len(nav.path.spans)} | "
        f"{p50:.3f} ms | {p99:.2f} ms | {most:.1f} ms | {memory:.1f} MB |",
        flush=True,
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--hours", type=float, default=24.0)
    parser.add_argument("--finds", type=int, default=None)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    number = given.finds if given.finds is not None else round(FINDS_PER_HOUR * given.hours)
    asked = patrol(given.hours)
    things, appear = finds(asked, number, given.hours, given.seed)
    drive(asked, things, appear, given.hours)
