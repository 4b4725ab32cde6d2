"""Laws that take over under way with a limit of the jerk: how often all is kept, how long it takes.

C2 curves through random points under three sets of limits. At random times the rest of the path is
planned again, with the speed and the acceleration of the law that is driven.
"""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline

import viaspline as vs

LIMITS = {
    "bends": vs.Limits(max_speed=3, max_accel=0.8, max_brake=1.2, max_lateral_accel=0.5),
    "axes": vs.Limits(max_speed=4, max_accel=2, axis_speed=1.5, axis_accel=0.5),
    "yaw": vs.Limits(max_speed=4, max_accel=2, max_yaw_rate=0.5, max_yaw_accel=0.3),
}
SEEDS, TIMES, JERK = 8, 6, 0.5


def smooth(seed: int) -> vs.PiecewiseCubic:
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(0, 8, (5, 2)), axis=0)
    at = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    a, b, c, p = CubicSpline(at, points).c
    h = np.diff(at)[:, None]
    inner = (p + c * h / 3, p + 2 * c * h / 3 + b * h * h / 3)
    return vs.PiecewiseCubic(np.stack([p, *inner, p + c * h + b * h * h + a * h**3], axis=1))


def main() -> None:
    rng = np.random.default_rng(0)
    print("| limits | all kept | beyond for at most 1 m | beyond for longer | median | longest |")
    print("|---|---|---|---|---|---|")
    for name, plain in LIMITS.items():
        limits, beyond, spent = replace(plain, max_jerk=JERK), [], []
        for seed in range(SEEDS):
            path = smooth(seed)
            old = vs.retime(path, limits)
            for now in rng.uniform(0.0, old.duration, TIMES):
                s, v, a = (float(x) for x in old.state_at(now))
                begin = time.perf_counter()
                law = vs.retime(
                    path, limits, start=s, start_speed=v, start_accel=a, start_time=float(now),
                    replaces=old,
                )  # fmt: skip
                spent.append(time.perf_counter() - begin)
                until = max(law.over_limit_until or s, law.over_jerk_until or s)
                beyond.append(until - s)
        far = np.array(beyond)
        print(
            f"| {name} | {np.sum(far <= 0)} of {far.size} | {np.sum((far > 0) & (far <= 1))} "
            f"| {np.sum(far > 1)} | {np.median(spent):.2f} s | {max(spent):.1f} s |"
        )


if __name__ == "__main__":
    main()
