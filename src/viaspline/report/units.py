"""Lengths, times and speeds as people say them."""

from __future__ import annotations

import math

from viaspline.presentable.rounded_number import LEAST_TOLD, rounded

JUST_TOUCHING_M = 1e-6  # as ``PROOF_SLACK_M``, which takes numba to import [m]


def metres(value: float | None, digits: int = 2) -> str:
    """A length.

    Example:
        >>> metres(0.5), metres(812.345, 1), metres(23456.7), metres(float("inf")), metres(None)
        ('0.50 m', '812.3 m', '23.46 km', 'unlimited', '–')
        >>> metres(0.183, 1), metres(0.0046), metres(0.00002)
        ('0.18 m', '0.0046 m', '2e-05 m')
    """
    if value is None or math.isnan(value):
        return "–"
    if math.isinf(value):
        return "unlimited"
    if abs(value) >= 10_000:
        return f"{value / 1000:.2f} km"
    if 0.0 < abs(value) < LEAST_TOLD:
        return f"{value:.1g} m"
    return f"{rounded(value, digits)} m"


def down(value: float) -> str:
    """A proven clearance: rounded down, so that it promises no more than was proven.

    But for the micrometre that a proof may lack: what just touches 0.5 m keeps 0.5 m.

    Example:
        >>> down(0.5059), down(0.49999), down(0.4999999), down(49.4999), down(float("inf"))
        ('0.505 m', '0.499 m', '0.500 m', '49.4 m', 'unlimited')
        >>> down(0.00467)
        '0.0046 m'
    """
    if not math.isfinite(value):
        return metres(value)
    digits = 1 if value >= 10 else 4 if LEAST_TOLD <= value < 0.01 else 3
    return metres(math.floor((value + JUST_TOUCHING_M) * 10**digits) / 10**digits, digits)


def asked_words(value: float, tracking_error: float = 0.0) -> str:
    """A clearance that was asked for, and what is kept in addition for tracking.

    Example:
        >>> asked_words(0.5), asked_words(0.1362, 0.0362), asked_words(0.125)
        ('0.50 m', '0.10 m and 0.036 m for tracking', '0.125 m')
    """
    clearance = value - tracking_error
    digits = 2 if abs(clearance - round(clearance, 2)) < 1e-6 else 3
    if not tracking_error > 0.0:
        return metres(clearance, digits)
    return f"{metres(clearance, digits)} and {metres(tracking_error, 3)} for tracking"


def seconds(value: float | None) -> str:
    """A time.

    Example:
        >>> seconds(4.25), seconds(0.043), seconds(512.3), seconds(7384), seconds(None)
        ('4.2 s', '0.043 s', '8 min 32 s', '2 h 03 min', '–')
    """
    if value is None or not math.isfinite(value):
        return "–"
    if value < 100:
        return f"{rounded(value, 1)} s"
    minutes, rest = divmod(round(value), 60)
    if minutes < 100:
        return f"{minutes} min {rest:02d} s"
    hours, minutes = divmod(round(value / 60), 60)
    return f"{hours} h {minutes:02d} min"


def curvature(value: float | None) -> str:
    """A curvature with the radius that it means.

    Example:
        >>> curvature(0.25), curvature(0.0)
        ('0.25 1/m (radius 4.00 m)', '0 1/m (straight)')
    """
    if value is None or not math.isfinite(value):
        return "–"
    if abs(value) < 1e-9:
        return "0 1/m (straight)"
    return f"{value:.3g} 1/m (radius {metres(1 / abs(value))})"


def place(point: tuple[float, ...] | None) -> str:
    """A position in metres: to the centimetre, within a metre of the origin more exactly.

    Example:
        >>> place((12.345, -0.0)), place((0.1004, 0.0607))
        ('(12.35, 0.00)', '(0.100, 0.061)')
    """
    if point is None:
        return "–"
    far = max(map(abs, point))
    digits = 2 if far >= 1.0 or far < LEAST_TOLD else 2 - math.floor(math.log10(far))
    return "(" + ", ".join(f"{round(x, digits) + 0.0:.{digits}f}" for x in point) + ")"


def nice(value: float) -> float:
    """The smallest of 1, 2, 5 times a power of ten that is at least ``value``.

    Example:
        >>> nice(0.13), nice(34), nice(1000)
        (0.2, 50.0, 1000.0)
    """
    exponent = math.floor(math.log10(value) + 1e-9)
    for factor in (1, 2, 5, 10):
        candidate = float(f"{factor}e{exponent}")
        if candidate >= value * (1 - 1e-9):
            return candidate
    return 10.0 ** (exponent + 1)
