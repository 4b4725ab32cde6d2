"""Evaluate a curve of 1,000 spans at a million parameters, beside scipy's CubicHermiteSpline.

Both run in this process, in turn, on the same parameters, and give the same points; what is
compared is the ratio of the medians. Run: ``python benchmarks/evaluate.py [rounds]``.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from viaspline.curve.cardinal import CardinalSpline

Floats = NDArray[np.float64]

SPANS = 1000
PARAMETERS = 1_000_000
AT_LEAST = {"sorted": 5.0, "shuffled": 15.0}


def seconds(call: Callable[[], Floats]) -> tuple[float, Floats]:
    start = time.perf_counter()
    points = call()
    return time.perf_counter() - start, points


def side_by_side(
    ours: Callable[[], Floats], theirs: Callable[[], Floats], rounds: int
) -> tuple[float, float, float]:
    """Medians of both [s], and the largest difference of their answers [m]."""
    taken = np.empty((rounds, 2))
    difference = float(np.abs(ours() - theirs()).max())
    for row in taken:
        row[0], _ = seconds(ours)
        row[1], _ = seconds(theirs)
    mine, peer = np.median(taken, axis=0)
    return float(mine), float(peer), difference


def main() -> int:
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 15
    rng = np.random.default_rng(0)
    vias = np.cumsum(rng.uniform((0, -1), (2, 1), (SPANS + 1, 2)), axis=0)
    spline = CardinalSpline(vias)
    joints = np.arange(SPANS + 1.0)
    peer = CubicHermiteSpline(joints, vias, spline.evaluate(joints, 1))
    parameters = np.sort(rng.uniform(0, SPANS, PARAMETERS))
    orders = {"sorted": parameters, "shuffled": rng.permutation(parameters)}
    print(f"{PARAMETERS:,} points on {SPANS:,} spans, 2-D; medians of {rounds} rounds in turn")
    print(f"{'order':10}{'viaspline':>12}{'scipy':>12}{'ratio':>9}{'bar':>7}{'difference':>13}")
    met = True
    for order, u in orders.items():
        mine, other, difference = side_by_side(
            lambda u=u: spline.evaluate(u),  # type: ignore[misc]
            lambda u=u: peer(u),  # type: ignore[misc]
            rounds,
        )
        ratio = other / mine
        met &= ratio >= AT_LEAST[order] and difference < 1e-9
        times = f"{mine * 1e3:9.2f} ms{other * 1e3:9.1f} ms"
        print(f"{order:10}{times}{ratio:9.1f}{AT_LEAST[order]:7.0f}{difference:11.1e} m")
    return 0 if met else 1


if __name__ == "__main__":
    raise SystemExit(main())
