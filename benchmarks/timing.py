"""Clocks for calls made side by side.

Counted is what the processor spends on the calling thread, so that others on the machine lengthen
nothing by making it wait. What waits for a child process or uses several threads needs another.
"""

from __future__ import annotations

import time

import numpy as np


def clock(work):
    """Seconds that a call takes, and what it returns."""
    begin = time.thread_time()
    result = work()
    return time.thread_time() - begin, result


def in_turn(calls: dict, rounds: int) -> tuple[dict[str, float], dict]:
    """Medians of calls made in turn [s], so that the machine's load falls on all alike; results."""
    spent: dict[str, list[float]] = {name: [] for name in calls}
    results: dict = {}
    for _ in range(rounds):
        for name, call in calls.items():
            seconds, results[name] = clock(call)
            spent[name].append(seconds)
    return {name: float(np.median(values)) for name, values in spent.items()}, results
