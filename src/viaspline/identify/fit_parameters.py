"""The parameters of a drive that fit a log best, and which limits the log shows at all.

Tested through ``identify/test_fit_drive``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.identify.fit_problem import (
    ACCEL,
    ARM,
    DELAY,
    LAG,
    PARAMETERS,
    SPEED_SHARE,
    TOP,
    TURN_MOST,
    TURN_SLOPE,
    WHEEL_ACCEL,
    WINDOW_S,
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

START_ARMS, ARM_RANGE = (0.05, 0.15, 0.5), (0.01, 2.0)
"""Arms of the wheels, as shares of the metres driven for each radian turned: from which one is
fitted, and within which one is looked for."""

ALWAYS = {DELAY: (0.0, MAX_DELAY_S), LAG: (0.0, MAX_LAG_S), SPEED_SHARE: (0.05, 2.0),
          YAW_SHARE: (0.05, 2.0)}  # fmt: skip
"""What is fitted to every log, with the least and the greatest value."""


def fitted_parameters(problem: FitProblem) -> tuple[Floats, list[int]]:
    """The parameters, and which of them the log shows.

    Both ways to limit changes are fitted: the speed's and the yaw rate's apart, and the wheels'.
    """
    if problem.wheelbase > 0.0:
        return _steered(problem)
    p = _solved(problem, _begun(problem), ALWAYS)
    apart = _with_limits(problem, p, ALWAYS, (ACCEL, TURN_SLOPE, TOP))
    wheels = _on_wheels(problem, p)
    best = min(wheels, key=lambda one: _cost(problem, one[0]), default=apart)
    more = max(len(best[1]) - len(apart[1]), 1)
    return best if _is_better(problem, best[0], apart[0], more) else apart


def _steered(problem: FitProblem) -> tuple[Floats, list[int]]:
    """Those of a robot that steers.

    Where it was told to turn more tightly than it can all the time, a lock explains what it did as
    well as wheels that turn it by a share of what they should: then it is the lock.
    """
    limits = (ACCEL, TURN_SLOPE, TURN_MOST, TOP)
    exact = {which: of for which, of in ALWAYS.items() if which != YAW_SHARE}
    begun = _begun(problem)
    locked, shared = (
        _with_limits(problem, _solved(problem, begun, bounds), bounds, limits)
        for bounds in (exact, ALWAYS)
    )
    return shared if _is_better(problem, shared[0], locked[0]) else locked


def _begun(problem: FitProblem) -> Floats:
    """Parameters without any limits to begin with: the best of some delays and lags."""
    p = np.full(PARAMETERS, np.inf)
    p[[SPEED_SHARE, YAW_SHARE]] = 1.0
    grid = [(delay, lag) for delay in START_DELAYS for lag in START_LAGS]
    costs = []
    for delay, lag in grid:
        p[[DELAY, LAG]] = delay, lag
        costs.append(_cost(problem, p))
    p[[DELAY, LAG]] = grid[int(np.argmin(costs))]
    return p


def _with_limits(
    problem: FitProblem,
    p: Floats,
    bounds: dict[int, tuple[float, float]],
    limits: tuple[int, ...],
) -> tuple[Floats, list[int]]:
    """Parameters with all limits that a log shows, and which are fitted then.

    Limits are added one by one, always the one that fits best. One that made no difference may
    make one when another is known, so each is tried again then.
    """
    bounds = dict(bounds)
    while True:
        found = [
            (_cost(problem, tried), which, tried)
            for which in limits
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
        if which == TURN_MOST:  # without it the share was taken for less
            start[YAW_SHARE] = 1.0
        tried = _solved(problem, start, {**bounds, which: (low, high)})
        if _is_better(problem, tried, p) and _is_active(problem, tried, which):
            found.append(tried)
    return found


def _on_wheels(problem: FitProblem, p: Floats) -> list[tuple[Floats, list[int]]]:
    """Parameters with the limits of wheels where the log shows those, and which are fitted then.

    Args:
        problem: What is fitted.
        p: Its parameters without any limits.
    """
    least, likely, most = _likely(problem, p, ACCEL)
    metres = problem.scale[0] / problem.scale[1]
    low, high = (metres * share for share in ARM_RANGE)
    limited = {**ALWAYS, WHEEL_ACCEL: (least, most), ARM: (low, high)}
    found = []
    for share in START_ARMS:
        start = p.copy()
        start[[WHEEL_ACCEL, ARM]] = likely, metres * share
        start[LAG] = min(float(p[LAG]), SHORT_LAG_S)
        tried = _solved(problem, start, limited)
        if _is_active(problem, tried, WHEEL_ACCEL):
            found.append(_with_limits(problem, tried, limited, (TOP,)))
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
    speed, turn = problem.channels(p)
    one = speed if which in (TOP, ACCEL) else turn
    if which in (TOP, TURN_MOST):
        top = float(np.abs(one).max())
        return 0.2 * top, 0.9 * top, top
    slope = float(np.abs(np.diff(one)).max()) / problem.step
    return 0.02 * slope, 0.4 * slope, slope


def _cost(problem: FitProblem, p: Floats) -> float:
    return float(np.sum(problem.residuals(p) ** 2))


def _is_better(problem: FitProblem, one: Floats, other: Floats, more: int = 1) -> bool:
    """Whether more parameters fit clearly better (Akaike, for windows that overlap)."""
    costs = [_cost(problem, p) for p in (one, other)]
    apart = 2.0 * problem.log.seconds / WINDOW_S
    return apart * math.log(max(costs[1], 1e-300) / max(costs[0], 1e-300)) > 6.0 * more


def _is_active(problem: FitProblem, p: Floats, which: int) -> bool:
    speed, turn = problem.channels(p)
    one = speed if which in (TOP, ACCEL) else turn
    if which in (TOP, TURN_MOST):
        held_back = np.abs(one) > 0.99 * p[which]
    elif which == WHEEL_ACCEL:
        most = np.abs(np.diff(speed)) + p[ARM] * np.abs(np.diff(turn))
        held_back = most > 0.99 * p[WHEEL_ACCEL] * problem.step
    else:
        held_back = np.abs(np.diff(one)) > 0.99 * p[which] * problem.step
    return float(held_back.mean()) > ACTIVE_SHARE
