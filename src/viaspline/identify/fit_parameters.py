"""The parameters of a drive that fit a log best, and which limits the log shows at all.

Tested through ``identify/test_fit_drive``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.identify.fit_problem import (
    ACCEL,
    DELAY,
    LAG,
    SPEED_SHARE,
    TOP,
    WINDOW_S,
    YAW_ACCEL,
    YAW_SHARE,
    FitProblem,
)
from viaspline.kernels.arrays import Floats

MAX_DELAY_S, MAX_LAG_S = 2.0, 3.0
"""A delay or a lag that is longer is looked for in vain [s]."""

START_DELAYS, START_LAGS = (0.0, 0.1, 0.25, 0.5, 1.0), (0.05, 0.3, 0.8)
"""From which it is fitted."""

SHORT_LAG_S = 0.1
"""A lag from which a limit is fitted too: without the limit it was taken for a long one [s]."""

ACTIVE_SHARE = 0.01
"""A limit shows in a log if it holds in so much of it."""

ALWAYS = {DELAY: (0.0, MAX_DELAY_S), LAG: (0.0, MAX_LAG_S), SPEED_SHARE: (0.05, 2.0),
          YAW_SHARE: (0.05, 2.0)}  # fmt: skip
"""What is fitted to every log, with the least and the greatest value."""


def fitted_parameters(problem: FitProblem) -> tuple[Floats, list[int]]:
    """The parameters, and which of them the log shows.

    Limits are added one by one, always the one that fits best. One that made no difference may
    make one when another is known, so each is tried again then.
    """
    p = np.array([0.0, 0.0, 1.0, 1.0, np.inf, np.inf, np.inf])
    grid = [(delay, lag) for delay in START_DELAYS for lag in START_LAGS]
    costs = []
    for delay, lag in grid:
        p[[DELAY, LAG]] = delay, lag
        costs.append(_cost(problem, p))
    p[[DELAY, LAG]] = grid[int(np.argmin(costs))]
    bounds = dict(ALWAYS)
    p = _solved(problem, p, bounds)
    while True:
        found = [
            (_cost(problem, tried), which, tried)
            for which in (ACCEL, YAW_ACCEL, TOP)
            if which not in bounds
            for tried in _with_limit(problem, p, bounds, which)
        ]
        if not found:
            return p, list(bounds)
        _, which, tried = min(found, key=lambda one: one[0])
        bounds[which] = _likely(problem, p, which)[::2]
        p = tried


def _with_limit(
    problem: FitProblem, p: Floats, bounds: dict[int, tuple[float, float]], which: int
) -> list[Floats]:
    """Parameters with one more limit, as far as the log shows it."""
    low, likely, high = _likely(problem, p, which)
    found = []
    for lag in sorted({float(p[LAG]), min(float(p[LAG]), SHORT_LAG_S)}):
        start = p.copy()
        start[[which, LAG]] = likely, lag
        tried = _solved(problem, start, {**bounds, which: (low, high)})
        if _is_better(problem, tried, p) and _is_active(problem, tried, which):
            found.append(tried)
    return found


def _solved(problem: FitProblem, start: Floats, bounds: dict[int, tuple[float, float]]) -> Floats:
    from scipy.optimize import least_squares

    free = list(bounds)
    low, high = np.array(list(bounds.values())).T

    def rest(values: Floats) -> Floats:
        p = start.copy()
        p[free] = values
        return problem.residuals(p)

    begin = np.clip(start[free], low + 1e-6, high - 1e-6)
    found = least_squares(
        rest, begin, bounds=(low, high), x_scale=np.maximum(np.abs(begin), 0.05),
        diff_step=[1e-3], loss="soft_l1", f_scale=0.1,
        xtol=1e-5, ftol=1e-6, max_nfev=40,
    )  # fmt: skip
    p = start.copy()
    p[free] = found.x
    return p


def _likely(problem: FitProblem, p: Floats, which: int) -> tuple[float, float, float]:
    """The least, a likely and the greatest value of a limit that isn't known yet."""
    speed, yaw = problem.motion(p)
    if which == TOP:
        top = float(np.abs(speed).max())
        return 0.2 * top, 0.9 * top, top
    slope = float(np.abs(np.diff(speed if which == ACCEL else yaw)).max()) / problem.step
    return 0.02 * slope, 0.4 * slope, slope


def _cost(problem: FitProblem, p: Floats) -> float:
    return float(np.sum(problem.residuals(p) ** 2))


def _is_better(problem: FitProblem, one: Floats, other: Floats) -> bool:
    """Whether one more parameter fits clearly better (Akaike, for windows that overlap)."""
    costs = [_cost(problem, p) for p in (one, other)]
    apart = 2.0 * problem.log.seconds / WINDOW_S
    return apart * math.log(max(costs[1], 1e-300) / max(costs[0], 1e-300)) > 6.0


def _is_active(problem: FitProblem, p: Floats, which: int) -> bool:
    speed, yaw = problem.motion(p)
    if which == TOP:
        held_back = np.abs(speed) > 0.99 * p[TOP]
    else:
        one, slope = (speed, p[ACCEL]) if which == ACCEL else (yaw, p[YAW_ACCEL])
        held_back = np.abs(np.diff(one)) > 0.99 * slope * problem.step
    return float(held_back.mean()) > ACTIVE_SHARE
