"""Fitting a drive to a log: least squares of what was driven over short times, and its spread.

What a robot drives over half a second is compared with what its model drives in that time by the
same commands. So drift doesn't add up, and noise of poses stays small beside what was driven. The
spread is a bootstrap over blocks of the log, each refitted by a Gauss–Newton step.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.identify.drive_log import DriveLog, DriveLogError
from viaspline.identify.fit_noise import FittedNoise, fit_noise
from viaspline.identify.fit_parameters import fitted_parameters
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
    YAW_SHARE,
    FitProblem,
    fit_problem,
    has_wheels,
)
from viaspline.identify.identified_drive import Estimate, IdentifiedDrive, IdentifiedSteering
from viaspline.kernels.arrays import Floats

BLOCK_S, RESAMPLES = 2.0, 200
"""Blocks of the bootstrap [s], and how often they are drawn."""

SPREAD_MARGIN = 1.5
"""By which a spread is wider than the bootstrap's: of few blocks that is too narrow, and what the
limits are that the fit has to guess adds to it. So estimates are about one spread off."""

SEED = 0  # of the resamples: a log gives the same keys every time


def fit_drive(log: DriveLog, wheelbase: float = 0.0) -> IdentifiedDrive:
    """What a log shows of its robot's drive.

    Args:
        log: Of a drive with changes of speed and of yaw rate.
        wheelbase: Of a robot whose front wheels steer [m]; 0: its wheels don't.

    Raises:
        DriveLogError: When the log shows too little: the robot hardly moves or hardly turns, its
            commands never change, or nothing that it does follows from them.
    """
    problem = fit_problem(log, wheelbase)
    p, free = fitted_parameters(problem)
    residual = problem.residuals(p)
    _check_fit(problem, residual)
    jacobian = _jacobian(problem, p, free)
    spread = _bootstrap(problem, residual, jacobian, free, np.random.default_rng(SEED))
    along, turned = problem.modelled(p)
    moves = np.abs(np.gradient(along, log.times)) > 0.1
    noises = (
        fit_noise(log.times, log.along - along, moves, SEED),
        fit_noise(log.times, log.headings - turned, moves, SEED),
    )
    return _identified(problem, p, spread, noises)


def _check_fit(problem: FitProblem, residual: Floats) -> None:
    if float(np.sqrt(np.mean(residual**2))) > 0.6:
        raise DriveLogError(
            "what the robot does doesn't follow from its commands; check that both are of the same "
            "clock, that speeds are in m/s and yaw rates in rad/s, left turns positive"
        )


def _jacobian(problem: FitProblem, p: Floats, free: list[int]) -> Floats:
    columns = []
    for i in free:
        step = 1e-3 * max(abs(float(p[i])), 0.05)
        high, low = p.copy(), p.copy()
        high[i] += step
        low[i] = max(p[i] - step, 0.0)
        columns.append((problem.residuals(high) - problem.residuals(low)) / (high[i] - low[i]))
    return np.column_stack(columns)


def _bootstrap(
    problem: FitProblem,
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
    problem: FitProblem, p: Floats, spread: Floats, noises: tuple[FittedNoise, FittedNoise]
) -> IdentifiedDrive:
    def figure(i: int) -> Estimate:
        # commands are held from row to row: when one arrives is known no better than the steps
        least = 0.25 * problem.step if i in (DELAY, LAG) else 0.0
        return Estimate(float(p[i]), math.hypot(float(spread[i]), least))

    def limit(i: int) -> Estimate | None:
        return figure(i) if math.isfinite(p[i]) else None

    accel, turn_slope = limit(ACCEL), limit(TURN_SLOPE)
    if has_wheels(p):
        accel = figure(WHEEL_ACCEL)
        turn_slope = _quotient(accel, figure(ARM))
    steering = None
    if problem.wheelbase > 0.0:
        steering = _steering(problem, p, limit(TURN_MOST), turn_slope)
    along, turned = noises
    fastest, fastest_turn = (float(np.abs(one).max()) for one in problem.motion(p))
    return IdentifiedDrive(
        delay=figure(DELAY),
        lag=figure(LAG),
        speed_share=figure(SPEED_SHARE),
        yaw_share=figure(YAW_SHARE),
        top_speed=limit(TOP),
        accel=accel,
        yaw_accel=turn_slope if steering is None else None,
        accels_are_shared=has_wheels(p),
        steering=steering,
        speed_noise=along.driven,
        yaw_noise=turned.driven,
        position_noise=along.measured,
        heading_noise=turned.measured,
        fastest=fastest,
        fastest_turn=fastest_turn,
        seconds=problem.log.seconds,
    )


def _steering(
    problem: FitProblem, p: Floats, most: Estimate | None, rate: Estimate | None
) -> IdentifiedSteering:
    """Angles as the robot turns by them: one that slips out of its turns steers less than told."""
    share = float(p[YAW_SHARE])

    def acting(angle: float) -> float:
        return math.atan(share * math.tan(angle))

    widest = acting(float(np.abs(problem.channels(p)[1]).max()))
    if most is not None:
        most = Estimate(acting(most.value), most.spread)
    return IdentifiedSteering(problem.wheelbase, most, widest, rate)


def _quotient(one: Estimate, other: Estimate) -> Estimate:
    relative = math.hypot(one.spread / one.value, other.spread / other.value)
    return Estimate(one.value / other.value, one.value / other.value * relative)
