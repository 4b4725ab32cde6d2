"""Hunts for faults: missions by their seeds, each in a process of its own, and what is told."""

from __future__ import annotations

import argparse
import math
import sys
import traceback
from collections import Counter
from collections.abc import Callable, Iterable

from work_pool import done

Job = tuple[int, tuple[str, ...], bool]
"""A seed, the kinds that take turns, and whether what is planned is driven."""

Found = tuple[str, str, list[tuple[str, str]]]
"""The kind of a mission, how it ended, and its faults."""


def told_of(looks: Iterable[str | tuple[str, str]]) -> tuple[str, list[tuple[str, str]]]:
    """How a mission ended, and its faults; whatever isn't foreseen is one."""
    outcome, faults = "", []
    try:
        for found in looks:
            if isinstance(found, str):
                outcome = found
            else:
                faults.append(found)
    except Exception as error:  # a defect of the planner, or of what looks
        where = traceback.extract_tb(error.__traceback__)[-1]
        return "defect", [*faults, ("defect", f"{error!r} in {where.filename}:{where.lineno}")]
    return outcome, faults


def hunt(description: str, kinds: tuple[str, ...], run: Callable[[Job], Found]) -> None:
    """Run the missions that the command line asks for, and tell of each."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("missions", type=int, nargs="?", default=100)
    parser.add_argument("first", type=int, nargs="?", default=0)
    parser.add_argument("--kind", choices=kinds, nargs="*", default=kinds)
    parser.add_argument("--limit", type=float, default=120.0, help="seconds for a mission")
    parser.add_argument("--plans", action="store_true", help="only plan, drive none")
    parser.add_argument("--here", action="store_true", help="in this process, without a limit")
    asked = parser.parse_args()
    seeds = range(asked.first, asked.first + asked.missions)
    jobs = [(seed, tuple(asked.kind), not asked.plans) for seed in seeds]
    ended: dict[str, Counter[str]] = {kind: Counter() for kind in asked.kind}
    faults: Counter[str] = Counter()
    pool = (
        ((job, run(job)) for job in jobs)
        if asked.here
        else done(run, jobs, 1, math.inf, asked.limit)
    )
    for (seed, turns, _), found in pool:
        kind, outcome, told = found or (turns[seed % len(turns)], "too slow", [("too slow", "")])
        ended[kind][outcome] += 1
        print(f"{seed} {kind}: {outcome}", file=sys.stderr, flush=True)
        for word, what in told:
            faults[word] += 1
            print(f"{seed} {kind}: {word}: {what}", flush=True)
    for kind, counts in ended.items():
        print(f"{kind}: " + ", ".join(f"{count} {word}" for word, count in counts.items()))
    print("faults: " + (", ".join(f"{n} x {word}" for word, n in faults.items()) or "none"))
