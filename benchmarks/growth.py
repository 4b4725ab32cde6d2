"""How the time of a plan grows with the number of obstacles and with the cells of a map.

    python benchmarks/growth.py [PICTURE]

Circles stand equally dense in ever larger worlds, blobs as in ``grids.py`` on ever larger maps;
plans go from corner to corner, so that ways grow with the root of both. Exponents are fitted to the
upper half.
"""

from __future__ import annotations

import sys

import matplotlib
import numpy as np
from grids import blobs, mission
from scipy.ndimage import label
from timing import in_turn

import viaspline as vs

matplotlib.use("Agg")
from matplotlib import pyplot as plt

CIRCLES = (10, 30, 100, 300, 1000, 3000, 10_000)
SIDES = (64, 128, 256, 512, 1024, 2048, 4096)
AREA = 100.0  # for each circle [m²]
RADIUS, ROUNDS, SEEDS = 0.3, 3, 3


def circles(count: int, seed: int) -> vs.Mission:
    """Circles of 0.5 to 3 m, apart from each other, from corner to corner."""
    random = np.random.default_rng(seed)
    side = float(np.sqrt(AREA * count)) + 4.0
    ends = np.array(((1.0, 1.0), (side - 1.0, side - 1.0)))
    centres, radii = np.empty((count, 2)), np.empty(count)
    n = 0
    while n < count:
        centre, radius = random.uniform(3, side - 3, 2), random.uniform(0.5, 3.0)
        apart = np.hypot(*(centres[:n] - centre).T) - radii[:n] - radius
        if (apart > 0.3).all() and (np.hypot(*(ends - centre).T) > radius + 1.0).all():
            centres[n], radii[n] = centre, radius
            n += 1
    known = [
        vs.Obstacle(circle={"center": c, "radius": r})
        for c, r in zip(centres.tolist(), radii.tolist(), strict=True)
    ]
    return vs.Mission.model_validate(
        {
            "world": {"bounds": [0, 0, side, side], "known": known},
            "robot": {"radius_m": RADIUS, "clearance_m": 0},
            "route": {"start": ends[0].tolist(), "goal": ends[1].tolist()},
        }
    )


def squares(side: int, seed: int) -> vs.Mission:
    """A map whose corners are joined."""
    while True:
        cells = blobs(seed, side)
        areas, _ = label(~cells)
        if areas[5, 5] == areas[side - 6, side - 6]:
            return mission(cells, (5, 5), (side - 6, side - 6))
        seed += 100


def measured(make, sizes) -> np.ndarray:
    """Medians of the times of plans [s], one for each size."""
    found = []
    for size in sizes:
        times = []
        for seed in range(SEEDS):
            task = make(size, seed)
            try:
                vs.plan(task)
            except vs.PlanningError as error:
                print(f"{make.__name__} {size}, seed {seed}: {error}")
                continue
            spent, plans = in_turn({"plan": lambda task=task: vs.plan(task)}, ROUNDS)
            assert plans["plan"].certificate.holds
            times.append(spent["plan"])
        found.append(np.median(times))
        print(f"{make.__name__} {size}: {1e3 * found[-1]:.2f} ms, {len(times)} worlds", flush=True)
    return np.array(found)


def exponent(sizes, times: np.ndarray) -> float:
    """Slope of the upper half on logarithmic axes."""
    half = len(times) // 2
    return float(np.polyfit(np.log(sizes[half:]), np.log(times[half:]), 1)[0])


def main(picture: str) -> None:
    rows = (
        ("circles", CIRCLES, measured(circles, CIRCLES), "C0o-"),
        ("cells", tuple(side**2 for side in SIDES), measured(squares, SIDES), "C1s-"),
    )
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    for name, sizes, times, style in rows:
        power = exponent(sizes, times)
        print(f"{name}: time grows with the power {power:.2f} of their number")
        axes.loglog(sizes, 1e3 * times, style, label=f"{name}: power {power:.2f}")
    axes.set_xlabel("number of circles, number of cells")
    axes.set_ylabel("whole plan, certified [ms]")
    axes.grid(which="major", color="0.88")
    axes.legend(frameon=False)
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "growth.png")
