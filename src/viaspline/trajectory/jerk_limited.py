"""The fastest v² along a path with a limit of the jerk.

Jerk is the change of the acceleration along the path with time. On a grid w = v² is a quadratic
spline: the acceleration a = w'/2 is continuous and linear in the distance on every stretch, and the
jerk is a'v. The unknowns are the middle Bernstein coefficients of w on the stretches; at both ends
and in between every limit but the jerk is linear in them, and a polynomial lies below its largest
coefficient, so the limits hold between the points as well. Beside a rest the jerk is constant:
v1² = 3/2 a1 h there, which is linear again. Where it begins at a speed, that and the acceleration
there give the coefficient of the first stretch. On a lap the stretch before the first is the last.

The time is convex. Jerk bounds a' by J / v, which is not, so what is found is a local optimum: a
barrier keeps every limit strictly from a crawl on, and Newton's method with a banded matrix takes
it as near to the limits as it says.

Source: the same problem as in L. Consolini, M. Locatelli and A. Minari, "A sequential algorithm
for jerk limited speed planning", IEEE T-ASE 2022.

Tested through ``trajectory/test_jerk``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing.crawl import slowed_to_crawl
from viaspline.trajectory.interior_point import SpeedProblem
from viaspline.trajectory.motion_ends import Even, Moving, Rest, Rows, Seam

GUESS_STEPS = 400  # of the guess
GUESSES = ((0.5, 0.6), (0.95, 0.95))
"""Parts of the braking and of the jerk that a first guess brakes with."""


JERK_SHARE = 0.99
"""Part of the jerk that is planned with; the rest is for a robot that is re-planned under way."""

MAX_DURATION_RATIO = 1.3
"""Times what a motion takes without a limit of the jerk that it may take; else there's another."""

ROUNDING_EXCESS = 1e-7  # an excess that is rounding


class JerkLimitedMotion(NamedTuple):
    """A motion in pieces.

    Attributes:
        speeds: At the ends of the pieces [m/s], shape (n + 1,).
        accelerations: At the beginning of each [m/s²], shape (n,).
        changes: Of the acceleration with the distance [1/s²], shape (n,).
        jerks: With time, beside rests [m/s³], shape (n,), 0 elsewhere.
    """

    speeds: Floats
    accelerations: Floats
    changes: Floats
    jerks: Floats


def smoothest(widths: Floats, rows: Rows, jerk: float, end: Rest | Even) -> JerkLimitedMotion:
    """The fastest motion over stretches from rest.

    Args:
        widths: Of the stretches [m], shape (n,), n >= 4.
        rows: Their limits; those of a stretch beside a rest are asked of the a and w of the end
            that moves alone.
        jerk: [m/s³].
        end: How it ends.
    """
    problem = SpeedProblem.of(widths, rows.spared(), JERK_SHARE * jerk, Rest(), end)
    return _motion(problem, problem.fastest(problem.crawl()), widths, Rest(), end)


def smoothest_lap(widths: Floats, rows: Rows, jerk: float) -> JerkLimitedMotion:
    """The fastest motion over stretches that begins as it ends, without a rest.

    Args:
        widths: Of the stretches [m], shape (n,), n >= 5.
        rows: Their limits.
        jerk: [m/s³].
    """
    problem = SpeedProblem.of(widths, rows.spared(), JERK_SHARE * jerk, Seam(), Seam())
    return _motion(problem, problem.fastest(problem.crawl()), widths, Seam(), Seam())


class UnderWay(NamedTuple):
    """A motion that begins at a speed.

    Attributes:
        motion: The motion.
        beyond: By what part of it a limit other than the jerk is exceeded at most.
        over: After how many of the stretches all limits but the jerk are kept.
        harsh: The same of the jerk.
        time: How long it takes [s].
    """

    motion: JerkLimitedMotion
    beyond: float
    over: int
    harsh: int
    time: float


def smoothest_from(
    widths: Floats,
    rows: Rows,
    jerk: float,
    start: Moving,
    end: Rest | Even,
    brake: float,
    quick: float,
    hint: Floats | None = None,
) -> UnderWay:
    """The fastest motion over stretches from a speed and an acceleration.

    Where none is found that keeps every limit, they are widened, by little.

    Args:
        widths: Of the stretches [m], shape (n,), n >= 4.
        rows: Their limits; what they ask of the start alone is not asked.
        jerk: [m/s³].
        start: How it begins.
        end: How it ends.
        brake: Largest deceleration [m/s²].
        quick: How long the motion takes without a limit of the jerk [s].
        hint: v² of a motion that may do, at the ends of the stretches and in their middles
            [m²/s²], shape (2 n + 1,).
    """
    true = SpeedProblem.of(widths, rows, jerk, start, end)
    tight = SpeedProblem.of(widths, rows.spared(), JERK_SHARE * jerk, start, end)
    found = None
    guesses = [_guess(widths, start, end, part * brake, rate * jerk) for part, rate in GUESSES]
    if hint is not None:
        guess = 2.0 * hint[1::2] - 0.5 * (hint[:-1:2] + hint[2::2])
        guesses.insert(0, np.maximum(guess, guesses[0].min()))
    sought = [guess[1 : tight.widths.size + 1] for guess in guesses]
    for guess in sorted(sought, key=tight.lacks):  # what is nearly right takes a part of the time
        problem, m = tight.settled(guess)
        m = problem.fastest(m)
        linear, steep = problem.excess(m, true)
        over, harsh = _passed(linear), _passed(steep)
        one = UnderWay(
            _motion(problem, m, widths, start, end),
            float(linear.max()),
            over,
            harsh,
            problem.time(m),
        )
        if found is None or (one.over, one.harsh, one.time) < (found.over, found.harsh, found.time):
            found = one
        if not (found.over or found.harsh) and found.time < MAX_DURATION_RATIO * quick:
            break
    assert found is not None
    if _first_jerk(found.motion) > (1.0 + ROUNDING_EXCESS) * jerk:
        found = found._replace(harsh=max(found.harsh, 1))
    return found


def _first_jerk(motion: JerkLimitedMotion) -> float:
    """The largest jerk on the first stretch of a motion that begins at a speed [m/s³]."""
    return float(abs(motion.changes[0]) * motion.speeds[:2].max())


def _passed(excess: Floats) -> int:
    """After how many stretches nothing is exceeded any more; the first one is not among these."""
    off = np.flatnonzero(excess > ROUNDING_EXCESS)
    return int(off[-1]) + 2 if off.size else 0


def _guess(widths: Floats, start: Moving, end: Rest | Even, brake: float, jerk: float) -> Floats:
    """Coefficients of a robot that brakes to a crawl, and to rest where it has to, shape (n,)."""
    places = np.concatenate(([0.0], np.cumsum(widths)))
    middles = 0.5 * (places[1:] + places[:-1])
    v, length = float(np.sqrt(start.square)), float(places[-1])
    step = (v / brake + (brake + abs(start.accel)) / jerk) * 2.0 / GUESS_STEPS
    line, squares = slowed_to_crawl(
        v, start.accel, 1e-2 * v, length, brake, jerk, step, 4 * GUESS_STEPS
    )
    at, amid = np.interp(places, line, squares), np.interp(middles, line, squares)
    if isinstance(end, Rest):
        back, rest = _risen(v, length, brake, jerk)
        at = np.minimum(at, np.interp(length - places, back, rest))
        amid = np.minimum(amid, np.interp(length - middles, back, rest))
    least = 1e-4 * min(start.square, (4.5 * widths[-1] ** 2 * jerk) ** (2.0 / 3.0))
    return np.asarray(np.maximum(2.0 * amid - 0.5 * (at[1:] + at[:-1]), least))


def _risen(top: float, length: float, brake: float, jerk: float) -> tuple[Floats, Floats]:
    """Distances back from a rest and v² of a robot that brakes as hard as it can to it."""
    late = np.linspace(0.0, brake / jerk + 2.0 * top / brake, GUESS_STEPS)
    ramp = np.minimum(late, brake / jerk)
    after = late - ramp
    v = 0.5 * jerk * ramp**2 + brake * after
    s = jerk * ramp**3 / 6.0 + 0.5 * jerk * ramp**2 * after + 0.5 * brake * after**2
    return s, v * v


def _motion(
    problem: SpeedProblem, m: Floats, widths: Floats, start: Rest | Moving | Seam,
    end: Rest | Even | Seam,
) -> JerkLimitedMotion:  # fmt: skip
    """The motion with these coefficients."""
    known = problem.known(m)
    values = np.einsum("nzc,nc->nz", problem.ends, known)
    squares = np.append(values[:, 2], values[-1, 4])
    accelerations, changes = values[:, 0], np.einsum("nc,nc->n", problem.change, known)
    if isinstance(start, Rest):
        squares, accelerations = np.append(0.0, squares), np.append(0.0, accelerations)
        changes = np.append(0.0, changes)
    elif isinstance(start, Moving):
        change = (accelerations[0] - start.accel) / widths[0]
        squares, changes = np.append(start.square, squares), np.append(change, changes)
        accelerations = np.append(start.accel, accelerations)
    if isinstance(end, Rest):
        last = -squares[-1] / (1.5 * widths[-1])
        squares, changes = np.append(squares, 0.0), np.append(changes, 0.0)
        accelerations = np.append(accelerations, last)
    speeds, jerks = np.sqrt(squares), np.zeros(widths.size)
    beside = [(0, 1)] if isinstance(start, Rest) else []
    beside += [(-1, -2)] if isinstance(end, Rest) else []
    for k, moving in beside:
        jerks[k] = 2.0 * speeds[moving] ** 3 / (9.0 * widths[k] ** 2)
    return JerkLimitedMotion(speeds, accelerations, changes, jerks)
