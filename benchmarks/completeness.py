"""If there is a way, it is found; if there is none, it is refused: looked for at random.

    python benchmarks/completeness.py [cells] [thin] [--plans N] [--budget S] [--seed N]
        [--only KIND] [--processes N] [--limit S] [--reasons]

Oracles that share no code with the planner tell whether there is a way (``connectivity.py``) and
how near a path comes (``path_room.py``). Every failure is printed with its seed; to see it again:
``completeness.py SET --seed SEED --plans 1``, with ``--only KIND`` if that was given before.
"""

from __future__ import annotations

import argparse
import os
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from cell_worlds import KINDS as CELL_KINDS
from cell_worlds import cell_problem
from connectivity import Verdict, verdict
from path_room import CHORD_ERROR_M, ends_missed, least_room
from problems import Problem
from thin_worlds import KINDS as THIN_KINDS
from thin_worlds import thin_problem
from timing import clock
from work_pool import done

import viaspline as vs

PROOF_SLACK_M = 1e-6  # that the package allows itself
TOLERANCE_M = CHORD_ERROR_M + 2 * PROOF_SLACK_M
SETS: dict[str, Callable[[int], Problem]] = {"cells": cell_problem, "thin": thin_problem}
KINDS = {"cells": tuple(dict.fromkeys(CELL_KINDS)), "thin": tuple(THIN_KINDS)}


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What came of one plan.

    Attributes:
        kind: Of the problem.
        truth: What the oracle says.
        result: ``planned``, ``refused``, ``gave up`` or ``error``.
        wrong: What is wrong with it; empty if nothing is.
        seconds: Of the planner [s].
        telling: Of finding the reason of a refusal [s].
        words: The error's, or the path's length.
    """

    kind: str
    truth: Verdict
    result: str
    wrong: str
    seconds: float
    telling: float = 0.0
    words: str = ""


def tried(problem: Problem, *, reasons: bool = False) -> Outcome:
    """A problem planned, and held against the oracles.

    Args:
        problem: What is planned.
        reasons: Whether the reason of a refusal is asked for, which is found out only then.
    """
    mission = problem.mission()
    seconds, result = clock(lambda: _planned(mission))
    truth = verdict(problem)
    outcome = partial(Outcome, kind=problem.kind, truth=truth, seconds=seconds)
    if isinstance(result, vs.Plan):
        wrong = wrong_path(result, problem, truth)
        return outcome(result="planned", wrong=wrong, words=f"{result.path.length:.3f} m")
    telling, words = 0.0, type(result).__name__
    if reasons or not isinstance(result, vs.PlanningError):
        telling, words = clock(lambda: f"{type(result).__name__}: {result}")
    elif isinstance(result, vs.GaveUpError):
        words = f"GaveUpError: tried {'; '.join(result.tried)}"
    named = {vs.NoPathError: "refused", vs.GaveUpError: "gave up"}
    name = next((n for kind, n in named.items() if isinstance(result, kind)), "error")
    wrong = {"error": "error", "gave up": "gave up"}.get(name, "")
    if name == "refused" and truth == "open":
        wrong = "wrong refusal"
    return outcome(result=name, wrong=wrong, telling=telling, words=words)


def _planned(mission: vs.Mission):
    try:
        return vs.plan(mission)
    except Exception as error:  # whatever it is, it is counted
        return error


def wrong_path(plan: vs.Plan, problem: Problem, truth: Verdict) -> str:
    """What is wrong with a path; empty if nothing is."""
    if truth == "closed":
        return "path where there is none"
    lacks = problem.required - least_room(plan.path.spans, problem)
    if lacks > TOLERANCE_M:
        return f"too near by {lacks:.2e} m"
    if not plan.certificate.holds or ends_missed(plan.path.spans, problem) > PROOF_SLACK_M:
        return "not certified, or beside its ends"
    return ""


def job_done(job: tuple[str, int], *, reasons: bool) -> Outcome:
    """The problem of a set and a seed; kernels are loaded before the first is timed."""
    _warm()
    name, seed = job
    return tried(SETS[name](seed), reasons=reasons)


_warmed: list[bool] = []


def _warm() -> None:
    if _warmed:
        return
    _warmed.append(True)
    for seed in range(6):
        _planned(thin_problem(seed).mission())
    _planned(cell_problem(0).mission())


def seeds_of(name: str, first: int, count: int, only: str | None) -> list[tuple[str, int]]:
    """Jobs of a set, of one kind if asked for."""
    kinds = CELL_KINDS if name == "cells" else KINDS[name]
    jobs: list[tuple[str, int]] = []
    seed = first
    while len(jobs) < count:
        if only is None or kinds[seed % len(kinds)] == only:
            jobs.append((name, seed))
        seed += 1
    return jobs


def _shown(job: tuple[str, int], outcome: Outcome | None, limit: float) -> None:
    what = outcome.wrong if outcome else f"took longer than {limit:g} s, or died"
    about = f"{outcome.truth}: {outcome.words}" if outcome else ""
    problem = SETS[job[0]](job[1])
    size = f"{problem.kind}, {problem.note}, radius {problem.radius:.4f} m"
    print(f"  {job[0]} --seed {job[1]}: {what} ({about}) [{size}]"[:500], flush=True)


HEAD = ("plans", "open", "closed", "planned", "refused", "wrong refusals", "wrong paths", "gave up",
        "errors", "too long", "median ms", "99 %", "worst", "reason worst")  # fmt: skip


def _row(name: str, outcomes: list[Outcome | None]) -> str:
    known = [o for o in outcomes if o is not None]
    wrong = [o.wrong for o in known]
    seconds = 1e3 * np.array([o.seconds for o in known] or [np.nan])
    cells = (
        len(outcomes),
        sum(o.truth == "open" for o in known),
        sum(o.truth == "closed" for o in known),
        sum(o.result == "planned" for o in known),
        sum(o.result == "refused" for o in known),
        wrong.count("wrong refusal"),
        sum(o.result == "planned" and bool(o.wrong) for o in known),
        wrong.count("gave up"),
        wrong.count("error"),
        outcomes.count(None),
        *(f"{v:.1f}" for v in (np.median(seconds), np.quantile(seconds, 0.99), seconds.max())),
        f"{1e3 * max((o.telling for o in known), default=0.0):.0f}",
    )
    return f"| {name} | " + " | ".join(map(str, cells)) + " |"


def main() -> None:
    asked = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    asked.add_argument("sets", nargs="*", default=list(SETS))
    asked.add_argument("--plans", type=int, default=60, help="of each set")
    asked.add_argument("--budget", type=float, default=120.0, help="of each set [s]")
    asked.add_argument("--limit", type=float, default=60.0, help="of each plan [s]")
    asked.add_argument("--seed", type=int, default=0, help="the first one")
    asked.add_argument("--only", help="problems of this kind: " + str(KINDS))
    asked.add_argument("--reasons", action="store_true", help="ask refusals for their reasons")
    asked.add_argument("--processes", type=int, default=1, choices=(1, 2))
    given = asked.parse_args()
    for name in given.sets:
        found: dict[str, list[Outcome | None]] = defaultdict(list)
        jobs = seeds_of(name, given.seed, given.plans, given.only)
        do = partial(job_done, reasons=given.reasons)
        for job, outcome in done(do, jobs, given.processes, given.budget, given.limit):
            found["all"].append(outcome)
            found[SETS[name](job[1]).kind].append(outcome)
            if outcome is None or outcome.wrong or given.plans == 1:
                _shown(job, outcome, given.limit)
        print(f"\n| {name} | " + " | ".join(HEAD) + " |\n" + "|---" * (len(HEAD) + 1) + "|")
        for kind in sorted(found):
            print(_row(kind, found[kind]))


if __name__ == "__main__":
    os.nice(10)
    main()
