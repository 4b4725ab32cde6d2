"""Fitting a drive to a log: least squares of what was driven over short times, and its spread.

What a robot drives over half a second is compared with what its model drives in that time by the
same commands. So drift doesn't add up, and noise of poses stays small beside what was driven. The
spread is a bootstrap over blocks of the log, each refitted by a Gauss–Newton step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.identify.drive_log import DriveLog, DriveLogError
from viaspline.identify.drive_response import (
    ChannelLimits,
    fine_times,
    held,
    response,
    summed,
)
from viaspline.identify.fit_noise import FittedNoise, fit_noise
from viaspline.identify.identified_drive import Estimate, IdentifiedDrive
from viaspline.kernels.arrays import Floats, Ints

WINDOW_S = 0.5
"""What is driven in so long is compared [s]."""

BLOCK_S, RESAMPLES = 2.0, 200
"""Blocks of the bootstrap [s], and how often they are drawn."""

SPREAD_MARGIN = 1.5
"""By which a spread is wider than the bootstrap's: of few blocks that is too narrow, and what the
limits are that the fit has to guess adds to it. So estimates are about one spread off."""

MAX_DELAY_S, MAX_LAG_S = 2.0, 3.0
"""A delay or a lag that is longer is looked for in vain [s]."""

START_DELAYS, START_LAGS = (0.0, 0.1, 0.25, 0.5, 1.0), (0.05, 0.3, 0.8)
"""From which it is fitted."""

LEAST_DRIVEN = 0.2
"""Metres, and radians, that have to be driven at least."""

ACTIVE_SHARE = 0.01
"""A limit shows in a log if it holds in so much of it."""

DELAY, LAG, SPEED_SHARE, YAW_SHARE, TOP, ACCEL, YAW_ACCEL = range(7)
PARAMETERS = 7


@dataclass(frozen=True)
class _Problem:
    """A log, prepared.

    Attributes:
        log: It.
        times: Fine ones [s].
        step: Between them [s].
        told: Commanded speed and yaw rate at those.
        first: Speed and yaw rate at first.
        starts: Rows at which windows begin.
        ends: Rows at which they end.
        driven: Along and turned in each window.
        scale: By which both are divided.
    """

    log: DriveLog
    times: Floats
    step: float
    told: tuple[Floats, Floats]
    first: tuple[float, float]
    starts: Ints
    ends: Ints
    driven: tuple[Floats, Floats]
    scale: tuple[float, float]

    def motion(self, p: Floats) -> tuple[Floats, Floats]:
        """Speed and yaw rate without delay, fine."""
        speed = ChannelLimits(float(p[SPEED_SHARE]), float(p[ACCEL]), float(p[TOP]))
        yaw = ChannelLimits(float(p[YAW_SHARE]), float(p[YAW_ACCEL]))
        lag = float(p[LAG])
        return (
            response(self.told[0], self.step, lag, speed, self.first[0]),
            response(self.told[1], self.step, lag, yaw, self.first[1]),
        )

    def modelled(self, p: Floats) -> tuple[Floats, Floats]:
        """What the model drives along and turns, at every row of the log."""
        late = self.log.times - p[DELAY]
        before = np.minimum(late - self.times[0], 0.0)  # as it was at first
        along, turned = (
            np.interp(late, self.times, summed(one, self.step)) + before * first
            for one, first in zip(self.motion(p), self.first, strict=True)
        )
        return along, turned

    def residuals(self, p: Floats) -> Floats:
        """Of both, in every window, shape (2 w,)."""
        rest = [
            (one[self.ends] - one[self.starts] - driven) / scale
            for one, driven, scale in zip(self.modelled(p), self.driven, self.scale, strict=True)
        ]
        return np.concatenate(rest)


def fit_drive(log: DriveLog, seed: int = 0) -> IdentifiedDrive:
    """What a log shows of its robot's drive.

    Args:
        log: Of a drive with changes of speed and of yaw rate.
        seed: Of the resamples.

    Raises:
        DriveLogError: When the log shows too little: the robot hardly moves or hardly turns, its
            commands never change, or nothing that it does follows from them.
    """
    problem = _prepared(log)
    p, free = _fitted(problem)
    residual = problem.residuals(p)
    _check_fit(problem, residual)
    jacobian = _jacobian(problem, p, free)
    spread = _bootstrap(problem, residual, jacobian, free, np.random.default_rng(seed))
    along, turned = problem.modelled(p)
    moves = np.abs(np.gradient(along, log.times)) > 0.1
    noises = (
        fit_noise(log.times, log.along - along, moves, seed),
        fit_noise(log.times, log.headings - turned, moves, seed),
    )
    return _identified(problem, p, spread, noises)


def _prepared(log: DriveLog) -> _Problem:
    along, turned = log.along, log.headings - log.headings[0]
    far, angle = float(np.abs(np.diff(along)).sum()), float(np.ptp(turned))
    changes = np.ptp(log.speeds), np.ptp(log.yaw_rates)
    if far < LEAST_DRIVEN or angle < LEAST_DRIVEN or min(changes) == 0.0:
        raise DriveLogError(
            f"the log shows {far:.2f} m and {angle:.2f} rad of driving, with commands of "
            f"{log.speeds.min():.2g} to {log.speeds.max():.2g} m/s, {log.yaw_rates.min():.2g} to "
            f"{log.yaw_rates.max():.2g} rad/s: that is too little to fit a drive; drive the "
            "commands that viaspline identify --drive writes"
        )
    times = fine_times(log)
    starts = np.flatnonzero(log.times <= log.times[-1] - WINDOW_S)
    ends = np.searchsorted(log.times, log.times[starts] + WINDOW_S - 1e-9)
    driven = tuple(one[ends] - one[starts] for one in (along, turned))
    soon = int(np.searchsorted(log.times, log.times[0] + 0.15))
    first = tuple(
        float((one[soon] - one[0]) / (log.times[soon] - log.times[0])) for one in (along, turned)
    )
    scale = tuple(float(np.sqrt(np.mean(one**2))) + 1e-9 for one in driven)
    return _Problem(
        log, times, float(times[1] - times[0]),
        (held(log, log.speeds, times), held(log, log.yaw_rates, times)),
        (first[0], first[1]), starts, ends, (driven[0], driven[1]), (scale[0], scale[1]),
    )  # fmt: skip


def _fitted(problem: _Problem) -> tuple[Floats, list[int]]:
    """The parameters, and which of them the log shows."""
    from scipy.optimize import least_squares

    shares = np.array([0.0, 0.0, 1.0, 1.0, np.inf, np.inf, np.inf])

    def solved(start: Floats, free: list[int], low: list[float], high: list[float]) -> Floats:
        def rest(values: Floats) -> Floats:
            p = start.copy()
            p[free] = values
            return problem.residuals(p)

        begin = np.clip(start[free], np.array(low) + 1e-6, np.array(high) - 1e-6)
        found = least_squares(
            rest, begin, bounds=(low, high), x_scale=np.maximum(np.abs(begin), 0.05),
            diff_step=[1e-3], loss="soft_l1", f_scale=0.1,
            xtol=1e-5, ftol=1e-6, max_nfev=40,
        )  # fmt: skip
        p = start.copy()
        p[free] = found.x
        return p

    free = [DELAY, LAG, SPEED_SHARE, YAW_SHARE]
    low, high = [0.0, 0.0, 0.05, 0.05], [MAX_DELAY_S, MAX_LAG_S, 2.0, 2.0]
    grid = [(d, t) for d in START_DELAYS for t in START_LAGS]
    costs = []
    for delay, lag in grid:
        shares[[DELAY, LAG]] = delay, lag
        costs.append(float(np.sum(problem.residuals(shares) ** 2)))
    shares[[DELAY, LAG]] = grid[int(np.argmin(costs))]
    p = solved(shares, free, low, high)
    for extra, values in _limits_to_try(problem, p):
        with_limit = p.copy()
        with_limit[extra] = values[1]
        tried = solved(
            with_limit, [*free, extra], [*low, values[0]], [*high, values[2]]
        )  # fmt: skip
        if _is_better(problem, tried, p) and _is_active(problem, tried, extra):
            p, free = tried, [*free, extra]
            low, high = [*low, values[0]], [*high, values[2]]
    return p, free


def _limits_to_try(problem: _Problem, p: Floats) -> list[tuple[int, tuple[float, float, float]]]:
    """Each limit with the least, a likely and the greatest value."""
    speed, yaw = problem.motion(p)
    slope, turn = (float(np.abs(np.diff(one)).max()) / problem.step for one in (speed, yaw))
    top = float(np.abs(speed).max())
    return [
        (ACCEL, (0.02 * slope, 0.4 * slope, slope)),
        (YAW_ACCEL, (0.02 * turn, 0.4 * turn, turn)),
        (TOP, (0.2 * top, 0.9 * top, top)),
    ]


def _is_better(problem: _Problem, one: Floats, other: Floats) -> bool:
    """Whether one more parameter fits clearly better (Akaike, for windows that overlap)."""
    costs = [float(np.sum(problem.residuals(p) ** 2)) for p in (one, other)]
    apart = 2.0 * problem.log.seconds / WINDOW_S
    return apart * math.log(max(costs[1], 1e-300) / max(costs[0], 1e-300)) > 6.0


def _is_active(problem: _Problem, p: Floats, which: int) -> bool:
    speed, yaw = problem.motion(p)
    if which == TOP:
        held_back = np.abs(speed) > 0.99 * p[TOP]
    else:
        one, slope = (speed, p[ACCEL]) if which == ACCEL else (yaw, p[YAW_ACCEL])
        held_back = np.abs(np.diff(one)) > 0.99 * slope * problem.step
    return float(held_back.mean()) > ACTIVE_SHARE


def _check_fit(problem: _Problem, residual: Floats) -> None:
    if float(np.sqrt(np.mean(residual**2))) > 0.6:
        raise DriveLogError(
            "what the robot does doesn't follow from its commands; check that both are of the same "
            "clock, that speeds are in m/s and yaw rates in rad/s, left turns positive"
        )


def _jacobian(problem: _Problem, p: Floats, free: list[int]) -> Floats:
    columns = []
    for i in free:
        step = 1e-3 * max(abs(float(p[i])), 0.05)
        high, low = p.copy(), p.copy()
        high[i] += step
        low[i] = max(p[i] - step, 0.0)
        columns.append((problem.residuals(high) - problem.residuals(low)) / (high[i] - low[i]))
    return np.column_stack(columns)


def _bootstrap(
    problem: _Problem,
    residual: Floats,
    jacobian: Floats,
    free: list[int],
    chance: np.random.Generator,
) -> Floats:
    """The standard deviation of every parameter, 0 where the log doesn't show it."""
    block = ((problem.log.times[problem.starts] - problem.log.times[0]) / BLOCK_S).astype(int)
    blocks = int(block[-1]) + 1
    found = []
    ridge = 1e-9 * np.trace(jacobian.T @ jacobian) * np.eye(len(free))
    for _ in range(RESAMPLES):
        drawn = np.bincount(chance.integers(0, blocks, blocks), minlength=blocks).astype(float)
        w = np.tile(drawn[block], 2)
        normal = jacobian.T @ (w[:, None] * jacobian) + ridge
        found.append(np.linalg.solve(normal, jacobian.T @ (w * residual)))
    spread = np.zeros(PARAMETERS)
    spread[free] = SPREAD_MARGIN * np.std(np.array(found), axis=0)
    return spread


def _identified(
    problem: _Problem, p: Floats, spread: Floats, noises: tuple[FittedNoise, FittedNoise]
) -> IdentifiedDrive:
    def figure(i: int) -> Estimate:
        # commands are held from row to row: when one arrives is known no better than the steps
        least = 0.25 * problem.step if i in (DELAY, LAG) else 0.0
        return Estimate(float(p[i]), math.hypot(float(spread[i]), least))

    def limit(i: int) -> Estimate | None:
        return figure(i) if math.isfinite(p[i]) else None

    along, turned = noises
    fastest = float(np.abs(problem.motion(p)[0]).max())
    return IdentifiedDrive(
        delay=figure(DELAY),
        lag=figure(LAG),
        speed_share=figure(SPEED_SHARE),
        yaw_share=figure(YAW_SHARE),
        top_speed=limit(TOP),
        accel=limit(ACCEL),
        yaw_accel=limit(YAW_ACCEL),
        speed_noise=along.driven,
        yaw_noise=turned.driven,
        position_noise=along.measured,
        heading_noise=turned.measured,
        fastest=fastest,
        seconds=problem.log.seconds,
    )
