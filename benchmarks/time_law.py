"""The time law beside toppra: the same path, the same limits of every axis, the same grid.

A wavy path of 1,000 points, a cubic spline through them, rest to rest, at most 2 m/s and 1 m/s²
along either axis. toppra (seidel solver) has the points as its grid. What is exceeded is looked for
at 20,001 times, from the derivatives of the spline and those of the time law.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from functools import partial

import numpy as np
import toppra
import toppra.algorithm
import toppra.constraint
from scipy.interpolate import CubicSpline
from timing import in_turn

import viaspline as vs

logging.disable(logging.CRITICAL)

SPEED, ACCEL, ROUNDS, REPEATS, TIMES = 2.0, 1.0, 21, 5, 20_001


def wavy() -> tuple[np.ndarray, np.ndarray]:
    x = np.linspace(0, 100, 1000)
    points = np.c_[x, 8 * np.sin(x / 6) + 3 * np.sin(x / 2.3)]
    return np.r_[0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))], points


def cubic(spline: CubicSpline) -> vs.PiecewiseCubic:
    """The same curve by its Bézier control polygons."""
    a, b, c, p = spline.c
    h = np.diff(spline.x)[:, None]
    inner = (p + c * h / 3, p + 2 * c * h / 3 + b * h * h / 3)
    return vs.PiecewiseCubic(np.stack([p, *inner, p + c * h + b * h * h + a * h**3], axis=1))


class Sampled:
    """The spline as any curve that can be evaluated."""

    def __init__(self, spline: CubicSpline) -> None:
        self.domain = (float(spline.x[0]), float(spline.x[-1]))
        self.evaluate = spline


def by_toppra(s: np.ndarray, path: toppra.SplineInterpolator, scheme: str) -> object:
    kind = getattr(toppra.constraint.DiscretizationType, scheme)
    bounds = np.array([[-1.0, 1.0]] * 2)
    limits = [
        toppra.constraint.JointVelocityConstraint(SPEED * bounds),
        toppra.constraint.JointAccelerationConstraint(ACCEL * bounds, discretization_scheme=kind),
    ]
    problem = toppra.algorithm.TOPPRA(
        limits, path, gridpoints=s, parametrizer="ParametrizeConstAccel", solver_wrapper="seidel"
    )
    return problem.compute_trajectory(0, 0)


def felt(curve: vs.PiecewiseCubic, law: vs.Trajectory) -> tuple[float, float]:
    s, v, a = law.state_at(np.linspace(0, law.duration, TIMES))
    u = curve.parameter(np.clip(s, 0, curve.length))
    q1, q2 = curve.evaluate(u, 1), curve.evaluate(u, 2)
    size = np.linalg.norm(q1, axis=1)
    rate, change = v / size, a / size - (q1 * q2).sum(1) / size**4 * v**2
    speed = q1 * rate[:, None]
    return np.abs(speed).max(), np.abs(q2 * (rate**2)[:, None] + q1 * change[:, None]).max()


def often(call: Callable[[], object]) -> object:
    """Five times, so that what the peers left in the processor's caches counts little."""
    return [call() for _ in range(REPEATS)][-1]


def main() -> None:
    s, points = wavy()
    spline = CubicSpline(s, points)
    path, curve = toppra.SplineInterpolator(s, points), cubic(spline)
    limits = vs.Limits(max_speed=100, max_accel=100, axis_speed=SPEED, axis_accel=ACCEL)
    calls = {
        "viaspline": partial(vs.retime, curve, limits),
        "viaspline, sampled": partial(vs.retime, Sampled(spline), limits),
        "toppra, Interpolation": partial(by_toppra, s, path, "Interpolation"),
        "toppra, Collocation": partial(by_toppra, s, path, "Collocation"),
    }
    for call in calls.values():
        call()
    spent, found = in_turn({name: partial(often, call) for name, call in calls.items()}, ROUNDS)
    print(
        "| time law | time | ratio | duration | speed | acceleration |\n|---|---|---|---|---|---|"
    )
    for name, law in found.items():
        if isinstance(law, vs.Trajectory):
            speed, accel = felt(curve, law)
        else:
            at = np.linspace(0, law.duration, TIMES)
            speed, accel = np.abs(law(at, 1)).max(), np.abs(law(at, 2)).max()
        print(
            f"| {name} | {spent[name] / REPEATS * 1e3:.2f} ms "
            f"| {spent[name] / spent['viaspline']:.1f} "
            f"| {law.duration:.3f} s | {speed / SPEED - 1:+.4%} | {accel / ACCEL - 1:+.4%} |"
        )


if __name__ == "__main__":
    main()
