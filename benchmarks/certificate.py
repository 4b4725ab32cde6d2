"""The certificate of a zigzag among circles, beside samples every centimetre checked by shapely.

    python benchmarks/certificate.py [ROUNDS]

The samples prove less (nothing is known between them) and are given their index for free.
"""

from __future__ import annotations

import sys
import time

import numpy as np
import shapely

import viaspline as vs

GAPS = 90  # circles that stand beside the path, in a small world and in a large one
CLEARANCE = 1.0


def zigzag() -> vs.CardinalSpline:
    """About 1.9 km of survey lines."""
    rows = [(30 + 20 * k, y) for k in range(10) for y in ((50, 220) if k % 2 == 0 else (220, 50))]
    return vs.CardinalSpline(rows, tension=0.5)


def circles(curve: vs.CardinalSpline, count: int) -> np.ndarray:
    """``GAPS`` circles close beside the path, the others away from it, (count, 3)."""
    random = np.random.default_rng(0)
    _, _, points = curve.sample(0.25)
    line = shapely.LineString(points)
    found: list[tuple[float, float, float]] = []
    side = 260.0 * max(1.0, np.sqrt(count / 400))
    while len(found) < count:
        radius = random.uniform(1, 4)
        centre = random.uniform(0, 260 if len(found) < GAPS else side, 2)
        gap = line.distance(shapely.Point(centre)) - radius
        close = CLEARANCE + 0.05 < gap < 6
        if close if len(found) < GAPS else gap > 6:
            found.append((*centre, radius))
    return np.array(found)


def median_seconds(calls: dict[str, object], rounds: int) -> dict[str, float]:
    """Medians of calls made in turn, so that the machine's load falls on all alike."""
    spent: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds):
        for name, call in calls.items():
            begin = time.perf_counter()
            call()
            spent[name].append(time.perf_counter() - begin)
    return {name: float(np.median(values)) for name, values in spent.items()}


def samples(curve: vs.CardinalSpline, tree: shapely.STRtree) -> bool:
    """Whether a sample every centimetre keeps its distance from all circles."""
    points = shapely.points(curve.sample(0.01)[2])
    return tree.query(points, predicate="dwithin", distance=CLEARANCE).size == 0


def main(rounds: int) -> None:
    curve = zigzag()
    worlds, calls = {}, {}
    for count in (GAPS, 10_000):
        rows = circles(curve, count)
        worlds[count] = vs.World(
            vs.Obstacle(circle={"center": (x, y), "radius": r}) for x, y, r in rows.tolist()
        )
        certificate = vs.certify(curve, worlds[count], CLEARANCE)
        discs = shapely.buffer(shapely.points(rows[:, :2]), rows[:, 2], quad_segs=16)
        tree = shapely.STRtree(discs)
        print(f"{count} circles: {curve.length:.0f} m, clearance {certificate.clearance:.4f} m, "
              f"holds: {certificate.holds}")  # fmt: skip
        calls[f"certificate, {count} circles"] = lambda world=worlds[count]: vs.certify(
            curve, world, CLEARANCE
        )
        if count == GAPS:
            calls["shapely, samples at 1 cm"] = lambda tree=tree: samples(curve, tree)
    few = median_seconds(calls, rounds)
    base = few[f"certificate, {GAPS} circles"]
    for name, value in few.items():
        print(f"{name:28s} {value * 1e6:12.1f} us   x {value / base:8.1f}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
