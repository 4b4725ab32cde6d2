"""How long a step of the navigator takes, over random drives of every kind of robot.

    pip install ".[bench]" && python benchmarks/steps.py [DRIVES [SEED [PART ...]]]

Counted is the processor's time of every ``Navigator.step`` of a navigator that is warmed. A step of
a robot that stands may take longer: nothing happens to it meanwhile, so it may search on with more.
With parts (``lidar``, ``jerk``, ``yaw``, ``zones``) all drives have these besides. An interrupt
ends it with what was measured by then.
"""

from __future__ import annotations

import sys
import time
from collections import defaultdict
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np
from random_drives import drives

import viaspline as vs
from viaspline.precompile import compile_curves, compile_driving
from viaspline.robot.warmed import warm_up


@dataclass
class Steps:
    """What was measured of some drives."""

    under_way: list[float] = field(default_factory=list)
    standing: list[float] = field(default_factory=list)
    drives: int = 0
    reached: int = 0
    replans: int = 0


def measured(mission: vs.Mission, plan: vs.Plan, into: list[Steps]) -> vs.Run:
    """A drive of which every step is timed."""
    step = vs.Navigator.step

    def timed(nav, state, sensed, now):
        begin = time.thread_time()
        found = step(nav, state, sensed, now)
        spent = time.thread_time() - begin
        for steps in into:
            (steps.under_way if state.speed > 1e-3 else steps.standing).append(spent)
        return found

    warm_up(mission, None)
    vs.Navigator.step = timed
    try:
        return vs.simulate(mission, plan=plan)
    finally:
        vs.Navigator.step = step


def row(name: str, steps: Steps) -> str:
    moving = 1e3 * np.array(steps.under_way or [0.0])
    still = 1e3 * np.array(steps.standing or [0.0])
    return (
        f"| {name} | {steps.drives} | {steps.reached} | {steps.replans} | {len(moving)} | "
        f"{np.median(moving):.1f} | {np.percentile(moving, 99):.1f} | {moving.max():.0f} | "
        f"{still.max():.0f} |"
    )


def main(count: int, seed: int, parts: Sequence[str]) -> None:
    compile_curves()
    compile_driving()
    _, (_, first), *_ = drives(3, seed, parts)
    vs.simulate(first)  # what is left to be compiled
    tables: dict[str, Steps] = defaultdict(Steps)
    refused = 0
    with suppress(KeyboardInterrupt):
        for k, (family, mission) in enumerate(drives(count, seed, parts)):
            sensor = "lidar" if mission.robot.sensor.lidar else "range sensor"
            jerk = [] if mission.robot.max_jerk_mps3 is None else ["limit of the jerk"]
            into = [tables[name] for name in (family, sensor, *jerk, "all")]
            try:
                run = measured(mission, vs.plan(mission), into)
            except vs.ViasplineError:
                refused += 1
                continue
            for steps in into:
                steps.drives += 1
                steps.reached += run.reached
                steps.replans += len(run.replans)
            slowest = max(max(s.under_way, default=0.0) for s in into[:1])
            print(f"{k + 1}: {family}, {sensor}, slowest so far {1e3 * slowest:.0f} ms",
                  file=sys.stderr)  # fmt: skip
    head = "drives | reached | re-plans | steps under way | median ms | 99 % ms | most ms"
    print(f"| robot | {head} | most ms standing |\n|{'---|' * 9}")
    for name in sorted(tables, key=lambda name: name == "all"):
        print(row(name, tables[name]))
    print(f"{refused} missions without a plan were left out")


if __name__ == "__main__":
    numbers = [int(argument) for argument in sys.argv[1:3]]
    main(*(numbers + [200, 1][len(numbers) :]), sys.argv[3:])
