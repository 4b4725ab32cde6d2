"""A path as points close together: places on it, and how far beside it a robot is.

Tested through ``machine/test_trial_drive``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.arclength import panel_of
from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.tracking.drive_model import clip


class ReferencePath(NamedTuple):
    """A path as points close together; a corner has two at the same distance.

    Attributes:
        distance: Along the path [m], not decreasing, shape (n,).
        x: [m], shape (n,).
        y: [m], shape (n,).
        heading: Without jumps of a whole turn [rad], shape (n,).
        curvature: [1/m], shape (n,).
    """

    distance: Floats
    x: Floats
    y: Floats
    heading: Floats
    curvature: Floats


@inner
def on_reference(reference: ReferencePath, s: float) -> tuple[float, float, float, float]:
    """Place, heading and curvature at a distance along a path; at a corner those after it."""
    i = panel_of(reference.distance, s)
    width = reference.distance[i + 1] - reference.distance[i]
    if width <= 0.0:
        return (
            reference.x[i + 1],
            reference.y[i + 1],
            reference.heading[i + 1],
            reference.curvature[i + 1],
        )
    w = clip((s - reference.distance[i]) / width, 0.0, 1.0)
    first, last = reference.heading[i], reference.heading[i + 1]
    a, b = w * (1.0 - w) * (1.0 - w) * width, -w * w * (1.0 - w) * width
    c = w * w * (3.0 - 2.0 * w)
    x = (
        reference.x[i]
        + c * (reference.x[i + 1] - reference.x[i])
        + a * math.cos(first)
        + b * math.cos(last)
    )
    y = (
        reference.y[i]
        + c * (reference.y[i + 1] - reference.y[i])
        + a * math.sin(first)
        + b * math.sin(last)
    )
    bend = reference.curvature[i] + w * (reference.curvature[i + 1] - reference.curvature[i])
    return x, y, first + w * (last - first), bend


@inner
def nearest_on(
    reference: ReferencePath, s: float, x: float, y: float, low: float, high: float
) -> float:
    """The distance along a path of the place nearest to a point, sought from ``s`` on."""
    s = clip(s, low, high)
    for _ in range(12):
        px, py, heading, curvature = on_reference(reference, s)
        cosine, sine = math.cos(heading), math.sin(heading)
        along = (x - px) * cosine + (y - py) * sine
        aside = (y - py) * cosine - (x - px) * sine
        step = along / max(1.0 - curvature * aside, 0.5)
        to = clip(s + clip(step, -0.5, 0.5), low, high)
        if abs(to - s) < 1e-8:
            return to
        s = to
    return s


@inner
def beside(reference: ReferencePath, s: float, x: float, y: float) -> tuple[float, float]:
    """How far to the left of its place on a path a robot is, and the path's heading there."""
    px, py, tangent, _ = on_reference(reference, s)
    aside = (y - py) * math.cos(tangent) - (x - px) * math.sin(tangent)
    return aside, tangent


@inlined
def heading_error(heading: float, wanted: float) -> float:
    """A heading less another one, from -π to π [rad]."""
    error = heading - wanted
    return error - 2.0 * math.pi * math.floor(error / (2.0 * math.pi) + 0.5)
