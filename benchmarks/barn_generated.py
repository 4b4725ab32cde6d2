"""New BARN worlds, unseen: does a robot with a lidar get through all that a way leads through?

    python benchmarks/barn_generated.py [--first SEED] [--worlds N] [--noise M]

The worlds are those of ``barn_worlds``, the robot and its lidar those of ``barn_unseen``. Whether
there is a way is told by a flood that knows neither the planner nor the robot: once for the body
alone, and once for a body that is larger by what a robot that only has a lidar keeps beyond it (the
discs on surfaces, and twice the noise). Where the flood gets through with the larger body the
robot has to reach the goal; where it doesn't with the body alone, to say that it can't.

Contacts are looked for by shapely on the path that was driven, sample by sample. Re-plans are timed
by what the processor spends on them, so that the machine's load doesn't count.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import shapely
from barn_unseen import mission
from barn_worlds import RADIUS_M, is_there_a_way, posts

import viaspline as vs
from viaspline.robot import navigator_step
from viaspline.robot.perception.belief import Belief
from viaspline.warming.spared_collections import spare_collections

SAMPLES_PER_M = 4000
WARM_UP_SEEDS = (13, 28, 47)  # in these every kind of search is asked: it is compiled and loaded


@dataclass(frozen=True)
class Outcome:
    """What came of one world."""

    seed: int
    way: str
    reached: bool
    kept: float
    duration: float
    replans: int
    reason: str | None
    spent: tuple[float, ...]

    def line(self) -> str:
        end = "reached" if self.reached else self.reason
        return (f"world {self.seed} ({self.way}): {self.duration:.1f} s, {self.replans} re-plans, "
                f"clear by {1e3 * self.kept:.1f} mm, longest {1e3 * max(self.spent, default=0):.0f}"
                f" ms: {end}")  # fmt: skip


def drive(seed: int, noise: float) -> Outcome:
    """Drive through one world."""
    middles = posts(seed)
    task = mission([(x, y, RADIUS_M) for x, y in middles.tolist()], noise)
    run = vs.simulate(task, seed=seed)
    samples = max(int(SAMPLES_PER_M * run.path.length), 2)
    line = shapely.LineString(run.path.evaluate(np.linspace(*run.path.domain, samples))[:, :2])
    radius = task.robot.outer_radius
    kept = float(shapely.distance(line, shapely.points(middles)).min()) - RADIUS_M - radius
    return Outcome(
        seed, way(middles, task), run.reached, kept, run.duration, len(run.replans), run.reason,
        run.compute_times,
    )  # fmt: skip


def way(middles: np.ndarray, task: vs.Mission) -> str:
    """``open``: for the body and what it keeps beyond; ``tight``: hardly; ``none``; ``unsure``."""
    radius, noise = task.robot.outer_radius, task.robot.sensor.lidar.noise_m
    spare = Belief.at_start(vs.World(), task.robot).cell_size + 2.0 * noise + 1e-3
    if is_there_a_way(middles, radius + spare) == "open":
        return "open"
    return {"open": "tight", "closed": "none", "unsure": "unsure"}[is_there_a_way(middles, radius)]


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--first", type=int, default=0, help="seed of the first world")
    parser.add_argument("--worlds", type=int, default=100)
    parser.add_argument("--noise", type=float, default=0.0, help="of a measured distance [m]")
    parser.add_argument("--only", type=int, nargs="*", help="these seeds")
    options = parser.parse_args()
    navigator_step.clock = SimpleNamespace(perf_counter=time.thread_time)
    for seed in WARM_UP_SEEDS:
        drive(seed, options.noise)
    spare_collections()  # as for a navigator that is warmed
    outcomes = []
    try:
        for seed in options.only or range(options.first, options.first + options.worlds):
            outcomes.append(drive(seed, options.noise))
            slow = max(outcomes[-1].spent, default=0.0) > 0.1
            if options.only or slow or not outcomes[-1].reached or outcomes[-1].kept < 0.0:
                print(outcomes[-1].line(), flush=True)
    except KeyboardInterrupt:
        print("interrupted: this is the table of the worlds up to there")
    print_table(outcomes)


def print_table(outcomes: list[Outcome]) -> None:
    worlds, reached = (
        Counter(o.way for o in outcomes),
        Counter(o.way for o in outcomes if o.reached),
    )
    for kind in ("open", "tight", "unsure", "none"):
        print(f"{kind}: {worlds[kind]} worlds, {reached[kind]} reached")
    print(f"contacts: {sum(o.kept < 0.0 for o in outcomes)}, "
          f"the nearest kept {1e3 * min(o.kept for o in outcomes):.1f} mm; "
          f"most re-plans {max(o.replans for o in outcomes)}")  # fmt: skip
    spent = [seconds for o in outcomes for seconds in o.spent]
    times = 1e3 * np.percentile(spent or [0.0], (50, 99, 100))
    print(f"{len(spent)} re-plans: median {times[0]:.1f} ms, 99 % {times[1]:.1f} ms, "
          f"longest {times[2]:.0f} ms")  # fmt: skip


if __name__ == "__main__":
    main()
