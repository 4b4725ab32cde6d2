"""Motion along a path, piece by piece, in closed form.

A piece begins with the speed v and the acceleration a. Either the acceleration changes with the
distance, a + k x (k = 0: it is constant), which is a linear differential equation; or it changes
with time, a + j t, at the very start and end of a motion that is limited in jerk.

Tested through ``trajectory/test_retime``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats

_SERIES_LIMIT = 1e-4  # below this a series of two terms is exact to rounding


def after(late: Floats, v: Floats, a: Floats, k: Floats, j: Floats) -> tuple[Floats, ...]:
    """Distance, speed and acceleration so long after the beginning of pieces.

    Args:
        late: [s], shape (n,), as all of these.
        v: Speed at the beginning [m/s].
        a: Acceleration there [m/s²].
        k: Its change with the distance [1/s²].
        j: Its change with time [m/s³]; where it isn't 0, k is.
    """
    odd = late * _slope(k * late * late)  # sinh(√k t) / √k
    even = 0.5 * (late * _slope(0.25 * k * late * late)) ** 2  # (cosh(√k t) - 1) / k
    distance = v * odd + a * even + j * late**3 / 6.0
    speed = v * (1.0 + k * even) + a * odd + 0.5 * j * late * late
    return distance, speed, a + k * distance + j * late


def _slope(square: Floats) -> Floats:
    """sinh(x) / x for x² = square, which may be negative: then it is sin(|x|) / |x|."""
    x = np.sqrt(np.abs(square))
    small = x < _SERIES_LIMIT
    y = np.where(small, 1.0, x)
    curved = np.where(square < 0.0, np.sin(y), np.sinh(np.minimum(y, 700.0))) / y
    return np.asarray(np.where(small, 1.0 + square / 6.0, curved))


def speed_into(x: Floats, width: Floats, v: Floats, a: Floats, k: Floats, j: Floats) -> Floats:
    """The speed at a distance into pieces [m/s].

    Pieces that change with time begin or end at rest and without acceleration.
    """
    plain = np.sqrt(np.maximum(v * v + 2.0 * a * x + k * x * x, 0.0))
    stroke = _stroke(x, width, v, j)
    return np.where(j > 0.0, 0.5 * j * stroke * stroke, plain)


def time_into(x: Floats, width: Floats, v: Floats, speed: Floats, k: Floats, j: Floats) -> Floats:
    """The time that pieces take up to a distance into them [s], where the speed is known [m/s]."""
    sums = v + speed
    ratio = np.divide(x, sums, out=np.zeros_like(x), where=sums > 0.0)
    y = np.sqrt(np.abs(k)) * ratio
    small = y < _SERIES_LIMIT
    z = np.where(small, 0.5, y)
    curved = np.where(k < 0.0, np.arctan(z), np.arctanh(np.minimum(z, 1.0 - 1e-16))) / z
    plain = 2.0 * ratio * np.where(small, 1.0 + k * ratio * ratio / 3.0, curved)
    stroke = _stroke(x, width, v, j)
    whole = np.cbrt(6.0 * width / np.where(j > 0.0, j, 1.0))
    return np.where(j > 0.0, np.where(v > 0.0, whole - stroke, stroke), plain)


def _stroke(x: Floats, width: Floats, v: Floats, j: Floats) -> Floats:
    """How long a piece that changes with time is away from its end at rest [s]."""
    away = np.where(v > 0.0, width - x, x)
    return np.asarray(np.cbrt(6.0 * np.maximum(away, 0.0) / np.where(j > 0.0, j, 1.0)))
