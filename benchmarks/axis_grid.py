"""What the grid of the time law costs under limits of the axes: the default beside finer ones.

Closed cardinal splines of about 70 m from rest to rest, at most 0.5 m/s² along either axis.
"""

from __future__ import annotations

import time

import numpy as np

import viaspline as vs

LIMITS = vs.Limits(max_speed=3, max_accel=0.8, axis_accel=0.5)
REPEATS = 20


def ring(seed: int) -> vs.CardinalSpline:
    rng = np.random.default_rng(seed)
    angles = np.linspace(0, 2 * np.pi, 13)[:-1]
    points = rng.uniform(5, 15, 12)[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    return vs.CardinalSpline(points, closed=True, knots="centripetal")


def main() -> None:
    print("| path | cells | nodes | time | duration over the finest |\n|---|---|---|---|---|")
    for seed in (3, 5, 10212912):
        path = ring(seed)
        finest = vs.retime(path, LIMITS, grid=64_000).duration
        for grid in (None, 2_000, 8_000):
            begin = time.perf_counter()
            for _ in range(REPEATS):
                law = vs.retime(path, LIMITS, grid=grid)
            spent = (time.perf_counter() - begin) / REPEATS * 1e3
            name = "by default" if grid is None else f"at least {grid:,}"
            print(
                f"| ring {seed} | {name} | {law.distances.size} | {spent:.2f} ms "
                f"| {law.duration / finest - 1:+.3%} |"
            )


if __name__ == "__main__":
    main()
