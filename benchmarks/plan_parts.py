"""What the parts of a plan cost: maps of cells and worlds of thin walls, by processor time.

    python benchmarks/plan_parts.py KIND [--plans N] [--seed N]

KIND is one of ``completeness.py``'s: "thin 100", "wide 512", maze ... What a part calls that is a
part of its own is taken off. A first plan of each kind loads kernels and is not counted.
"""

from __future__ import annotations

import argparse
import time
from collections import defaultdict
from collections.abc import Callable
from typing import Any

import numpy as np
from cell_worlds import KINDS as CELL_KINDS
from completeness import jobs_of, problem_of, tcod_seconds

import viaspline as vs
from viaspline import whole_plan
from viaspline.planning import plan_path
from viaspline.planning.methods import bent_gently
from viaspline.planning.methods.clear_spline import ClearSpline
from viaspline.planning.methods.other_sides import OtherSides
from viaspline.planning.methods.turns_on_shortest import TurnsOnShortest
from viaspline.planning.routing.router import Router
from viaspline.planning.turning import turn_path, wide_turns
from viaspline.world.world import World

PARTS: dict[str, tuple[Any, str]] = {
    "world": (World, "known"),
    "routes": (Router, "find"),
    "spline led round": (ClearSpline, "lay"),
    "lines and turns settled": (turn_path, "needed_turns"),
    "turns joined": (wide_turns, "joins_worth_it"),
    "turns on the shortest way, the rest": (TurnsOnShortest, "lay"),
    "other sides, the rest": (OtherSides, "lay"),
    "bent gently": (bent_gently, "gentler_path"),
    "proof": (plan_path, "proven"),
    "time law": (whole_plan, "retime"),
}


class PartTimes:
    """Seconds of each part, without the parts in it."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = defaultdict(float)
        self._inside: list[float] = []

    def timed(self, part: str, work: Callable[..., Any]) -> Callable[..., Any]:
        """The same, timed."""

        def done(*given: Any, **named: Any) -> Any:
            begin = time.process_time()
            self._inside.append(0.0)
            try:
                return work(*given, **named)
            finally:
                took = time.process_time() - begin
                self.seconds[part] += took - self._inside.pop()
                if self._inside:
                    self._inside[-1] += took

        return done


def measured(missions: list[vs.Mission]) -> list[dict[str, float]]:
    """The parts of every mission that is planned [s]."""
    times, rows = PartTimes(), []
    for part, (home, name) in PARTS.items():
        work = times.timed(part, getattr(home, name))
        setattr(home, name, staticmethod(work) if name == "known" else work)
    for k, mission in enumerate([missions[0], *missions]):
        times.seconds.clear()
        begin = time.process_time()
        try:
            vs.plan(mission)
        except vs.PlanningError:
            continue
        whole = time.process_time() - begin
        found = {**times.seconds, "else": whole - sum(times.seconds.values()), "all": whole}
        rows += [found] if k else []
    return rows


def main() -> None:
    asked = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    asked.add_argument("kind")
    asked.add_argument("--plans", type=int, default=20)
    asked.add_argument("--seed", type=int, default=0)
    given = asked.parse_args()
    name = "cells" if given.kind in CELL_KINDS else "thin"
    jobs = jobs_of(name, given.seed, given.kind, ".")
    problems = [problem_of(job) for job, _ in zip(jobs, range(given.plans), strict=False)]
    rows = measured([problem.mission() for problem in problems])
    print(f"| {given.kind}, {len(rows)} plans | median ms | mean ms |\n|---|---|---|")
    for part in (*PARTS, "else", "all"):
        took = 1e3 * np.array([row.get(part, 0.0) for row in rows])
        print(f"| {part} | {np.median(took):.2f} | {took.mean():.2f} |")
    if name == "cells":
        tcod = 1e3 * np.array([tcod_seconds(problem) for problem in problems])
        print(f"| tcod's A*, of all {len(problems)} | {np.median(tcod):.2f} | {tcod.mean():.2f} |")


if __name__ == "__main__":
    main()
