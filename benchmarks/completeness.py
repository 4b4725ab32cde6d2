"""If there is a way, it is found; if there is none, it is refused: looked for at random.

    python benchmarks/completeness.py [cells] [thin] [maps] [radii] [reasons] [--plans N]
        [--budget S] [--seed N] [--only KIND] [--maps FOLDER] [--processes N] [--limit S] [--tcod]

Oracles that share no code with the planner tell whether there is a way (``connectivity.py``) and
how near a path comes (``path_room.py``). The sets:

- ``cells``: maps of random cells; ``maps``: MovingAI's; ``thin``: thin walls at odd angles;
- ``radii``: worlds of cells and thin walls for ever fatter robots, which may not find more;
- ``reasons``: what refusals tell, and whether their remedies serve.

Every failure is printed with its seed. To see one again: ``completeness.py SET --seed SEED --plans
1``, with ``--only KIND`` if that was given before. ``--tcod`` (``pip install ".[bench]"``) also has
tcod's A* search the same maps.
"""

from __future__ import annotations

import argparse
import os
from collections import defaultdict
from collections.abc import Callable, Iterator
from functools import partial
from itertools import count, islice
from typing import NamedTuple

import numpy as np
from cell_worlds import KINDS as CELL_KINDS
from cell_worlds import cell_problem
from map_worlds import map_problem
from problems import Problem
from refused_worlds import large_problem, pocket_problem
from thin_worlds import KINDS as THIN_KINDS
from thin_worlds import thin_problem
from timing import clock
from trials import Outcome, plan_tried, planned, radii_tried, refusal_tried
from work_pool import done

SMALL = 100  # cells aside, of maps that are searched again and again
STRIDE = 1009  # of their seeds
LARGE_EVERY = 40  # seeds of refusals is one on a large map


class Job(NamedTuple):
    """A problem by its set and seed, and the folder of maps."""

    name: str
    seed: int
    maps: str


def small_problem(seed: int) -> Problem:
    """Thin walls for two seeds, cells of a small map for the next."""
    if seed % 3:
        return thin_problem(seed // 3 * 2 + seed % 3 - 1)
    found = (cell_problem(s) for s in count(STRIDE * seed))
    return next(p for p in found if p.cells is not None and len(p.cells) <= SMALL)


def refused_problem(seed: int) -> Problem:
    """A pocket for every fourth seed, a large map now and then, else a small problem."""
    if seed % LARGE_EVERY == 3:
        return large_problem(seed)
    return pocket_problem(seed) if seed % 4 == 3 else small_problem(seed)


def problem_of(job: Job) -> Problem:
    """The problem of a job."""
    if job.name == "maps":
        return map_problem(job.seed, job.maps)
    made: dict[str, Callable[[int], Problem]] = {"cells": cell_problem, "thin": thin_problem,
                                                "reasons": refused_problem}  # fmt: skip
    return made.get(job.name, small_problem)(job.seed)


TRIALS: dict[str, Callable[[Problem], Outcome]] = {
    "cells": plan_tried,
    "thin": plan_tried,
    "maps": plan_tried,
    "radii": radii_tried,
    "reasons": refusal_tried,
}


def job_done(job: Job, *, tcod: bool) -> tuple[Outcome, float]:
    """A trial, and how long tcod takes for it [s]; kernels are loaded before the first is timed."""
    _warm()
    problem = problem_of(job)
    outcome = TRIALS[job.name](problem)
    return outcome, tcod_seconds(problem) if tcod and problem.cells is not None else np.nan


_warmed: list[bool] = []


def _warm() -> None:
    if not _warmed:
        _warmed.append(True)
        for seed in range(len(THIN_KINDS)):
            planned(thin_problem(seed).mission())
        planned(cell_problem(0).mission())


def tcod_seconds(problem: Problem) -> float:
    """How long tcod's A* takes from cell to cell, its graph made before [s]."""
    try:
        from grids import tcod_graph, tcod_path
    except ImportError as error:
        raise SystemExit(f'{error}; pip install ".[bench]"') from None
    graph = tcod_graph(problem.cells)
    start, goal = (
        (int(y / problem.resolution), int(x / problem.resolution))
        for x, y in (problem.start, problem.goal)
    )
    seconds, _ = clock(lambda: tcod_path(graph, start, goal))
    return seconds


def jobs_of(name: str, first: int, only: str | None, maps: str) -> Iterator[Job]:
    """The jobs of a set from a seed on, of one kind if asked for."""
    kinds = {"cells": CELL_KINDS, "thin": tuple(THIN_KINDS)}.get(name, ())
    if only is not None and only not in kinds:
        raise SystemExit(f"{only!r} is no kind of {name}; there are {', '.join(kinds) or 'none'}")
    for seed in count(first):
        if only is None or kinds[seed % len(kinds)] == only:
            yield Job(name, seed, maps)


def _show(job: Job, problem: Problem, outcome: Outcome | None, limit: float) -> None:
    size = f"{problem.kind}, {problem.note}, radius {problem.radius:.4f} m + {problem.clearance:g}"
    what = f"took longer than {limit:g} s, or died"
    if outcome is not None:
        what = f"{outcome.wrong or outcome.result} ({outcome.truth}) {outcome.words}"
    print(f"  {job.name} --seed {job.seed} [{size}]: {what}"[:700], flush=True)


HEAD = ("plans", "open", "closed", "planned", "refused", "wrong refusals", "wrong paths", "gave up",
        "errors", "else wrong", "too long", "median ms", "99 %", "worst", "reason worst",
        "tcod median")  # fmt: skip


def _row(kind: str, found: list[tuple[Outcome, float] | None]) -> str:
    known = [one[0] for one in found if one is not None]
    tcod = [1e3 * one[1] for one in found if one is not None and np.isfinite(one[1])]
    seconds = 1e3 * np.array([o.seconds for o in known] or [np.nan])
    results, wrong = [o.result for o in known], [o for o in known if o.wrong]
    counts = {
        "wrong refusals": sum(o.wrong == "wrong refusal" for o in wrong),
        "wrong paths": sum(o.result == "planned" and o.truth != "unknown" for o in wrong),
        "gave up": results.count("gave up"),
        "errors": results.count("error"),
    }
    cells = (
        len(found),
        sum(o.truth == "open" for o in known),
        sum(o.truth == "closed" for o in known),
        results.count("planned"),
        results.count("refused"),
        *counts.values(),
        max(len(wrong) - sum(counts.values()), 0),
        found.count(None),
        *(f"{v:.1f}" for v in (np.median(seconds), np.quantile(seconds, 0.99), seconds.max())),
        f"{1e3 * max((o.telling for o in known), default=0.0):.0f}",
        f"{np.median(tcod):.1f}" if tcod else "",
    )
    return f"| {kind} | " + " | ".join(map(str, cells)) + " |"


def _asked() -> argparse.Namespace:
    asked = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    asked.add_argument("sets", nargs="*", choices=[*TRIALS, []], help="cells and thin if none")
    asked.add_argument("--plans", type=int, default=60, help="of each set")
    asked.add_argument("--budget", type=float, default=120.0, help="of each set [s]")
    asked.add_argument("--limit", type=float, default=60.0, help="of each plan [s]")
    asked.add_argument("--seed", type=int, default=0, help="the first one")
    asked.add_argument("--only", help=f"cells: {set(CELL_KINDS)}, thin: {set(THIN_KINDS)}")
    asked.add_argument("--maps", default=".", help="folder of MovingAI's .map files")
    asked.add_argument("--processes", type=int, default=1, choices=(1, 2))
    asked.add_argument("--tcod", action="store_true", help="have tcod's A* search the maps as well")
    return asked.parse_args()


def main() -> None:
    given = _asked()
    do = partial(job_done, tcod=given.tcod)
    for name in given.sets or ("cells", "thin"):
        found: dict[str, list[tuple[Outcome, float] | None]] = defaultdict(list)
        jobs = islice(jobs_of(name, given.seed, given.only, given.maps), given.plans)
        for job, one in done(do, jobs, given.processes, given.budget, given.limit):
            problem = problem_of(job)
            found["all"].append(one)
            found[problem.kind].append(one)
            if one is None or one[0].wrong or given.plans == 1:
                _show(job, problem, one and one[0], given.limit)
        print(f"\n| {name} | " + " | ".join(HEAD) + " |\n" + "|---" * (len(HEAD) + 1) + "|")
        for kind in sorted(found):
            print(_row(kind, found[kind]), flush=True)


if __name__ == "__main__":
    os.nice(10)
    main()
