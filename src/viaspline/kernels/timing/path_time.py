"""How long a curve takes to be driven: two passes over places along it.

An estimate, for comparing curves: what its places miss between them is a part in a thousand. What
is driven is timed by the exact law.

Tested through ``planning/checking/test_driving_time``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.curve.cubic import first_derivative, second_derivative
from viaspline.kernels.jit import inlined, inner, kernel

PLACES_PER_SPAN = 6
CLEARLY = 1.0 - 1e-9  # below what is known of a product but for rounding


@inlined
def _place(
    spans: Floats, k: int, w: float, limits: tuple[float, float, float], velocity: Floats,
    bend: Floats,
) -> tuple[float, float]:  # fmt: skip
    """Speed of the parametrisation at a parameter of a span, and the largest v² there.

    Most places don't bend so much that it tells: there two products settle it.

    Args:
        spans: See ``path_time``.
        k: The span.
        w: Where on it.
        limits: The largest speed, v² times curvature, and v times curvature.
        velocity: Room for a derivative, (d,).
        bend: The same.
    """
    top, lateral, yaw_rate = limits
    square, cap = 0.0, top * top
    for j in range(spans.shape[2]):
        velocity[j] = first_derivative(spans, k, j, w)
        bend[j] = second_derivative(spans, k, j, w)
        square += velocity[j] * velocity[j]
    cross = 0.0
    for i in range(spans.shape[2]):
        for j in range(i + 1, spans.shape[2]):
            area = velocity[i] * bend[j] - velocity[j] * bend[i]
            cross += area * area
    speed = math.sqrt(square)
    if speed <= 0.0:
        return 0.0, min(cap, lateral / np.inf, (yaw_rate / np.inf) ** 2)
    cubed = CLEARLY * square * square * square
    if cross * cap * cap < lateral * lateral * cubed and cross * cap < yaw_rate * yaw_rate * cubed:
        return speed, cap
    curvature = math.sqrt(cross) / (speed * square)
    if curvature > 0.0:
        cap = min(cap, lateral / curvature, (yaw_rate / curvature) ** 2)
    return speed, cap


@inner
def _step_time(
    first: float, last: float, roots: tuple[float, float], cap: float, step: float, accel: float,
    brake: float,
) -> float:  # fmt: skip
    """The time of a step between two v² below a largest one: speed up, go on, slow down [s].

    Args:
        first: v² where it begins [m²/s²].
        last: v² where it ends.
        roots: Of both.
        cap: The largest v².
        step: Its length [m].
        accel: See ``path_time``.
        brake: The same.
    """
    a, b = roots
    if step <= 0.0:
        return 0.0
    if first == cap and last == cap:
        return step / a
    peak = (2.0 * accel * brake * step + brake * first + accel * last) / (accel + brake)
    peak = max(min(peak, cap), first, last)
    v = math.sqrt(peak)
    on_ramps = (peak - first) / (2.0 * accel) + (peak - last) / (2.0 * brake)
    return (v - a) / accel + (v - b) / brake + max(step - on_ramps, 0.0) / v


@kernel
def path_time(
    spans: Floats, rests: Flags, tops: Floats, accel: float, brake: float, lateral: float,
    yaw_rate: float,
) -> float:  # fmt: skip
    """The time from the first place to the last [s].

    Args:
        spans: Bézier control polygons [m], (m, 4, d).
        rests: Whether the robot stands at each joint, (m + 1,); where it doesn't at an end, it
            comes and goes as fast as it may.
        tops: Largest speed on each span [m/s], (m,).
        accel: Largest acceleration along the curve [m/s²].
        brake: Largest deceleration [m/s²].
        lateral: Largest v² times curvature [m/s²].
        yaw_rate: Largest v times curvature [rad/s].
    """
    m, d = spans.shape[0], spans.shape[2]
    count = PLACES_PER_SPAN * m
    steps, caps, squares = np.empty(count), np.empty(count), np.empty(count + 1)
    velocity, bend = np.empty(d), np.empty(d)
    for k in range(count):
        i, place = k // PLACES_PER_SPAN, (k % PLACES_PER_SPAN + 0.5) / PLACES_PER_SPAN
        limits = (tops[i], lateral, yaw_rate)
        speed, caps[k] = _place(spans, i, place, limits, velocity, bend)
        steps[k] = speed / PLACES_PER_SPAN
    squares[count] = 0.0 if rests[m] else caps[count - 1]
    for k in range(count - 1, -1, -1):
        rests_here = k % PLACES_PER_SPAN == 0 and rests[k // PLACES_PER_SPAN]
        cap = 0.0 if rests_here else min(caps[k], caps[max(k - 1, 0)])
        squares[k] = min(cap, squares[k + 1] + 2.0 * brake * steps[k])
    total, root = 0.0, math.sqrt(squares[0])
    for k in range(count):
        squares[k + 1] = min(squares[k + 1], squares[k] + 2.0 * accel * steps[k])
        before, root = root, math.sqrt(squares[k + 1])
        total += _step_time(
            squares[k], squares[k + 1], (before, root), caps[k], steps[k], accel, brake
        )  # fmt: skip
    return total
