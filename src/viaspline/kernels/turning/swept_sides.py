"""How far a body reaches beside the path that it drives along, to the left and to the right.

A body whose heading is along its path sweeps what a disc does whose middle goes beside that path,
and whose radius changes: outside of a bend its corners swing out, inside its flank is nearest.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.footprint_pose import outer_radius
from viaspline.kernels.jit import kernel, uncounted
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld

ROUNDS = 2  # of looking where along its path the body reaches a place
NEAR = 1.1  # of the circle round a body: farther off it doesn't matter how far it reaches
LEAST_STEP_M = 1e-12


class StripBody(NamedTuple):
    """What drives along a strip.

    Attributes:
        required: Distance that its path keeps, a disc's as it is, at least in the one in it [m].
        kept: Free space that is kept [m].
        slack: Of what is kept, that is kept beyond it: what it reaches is known at places alone.
        outline: Places on its outline, in order, x forward and y left, (k, 2) [m]; none of a disc.
    """

    required: float
    kept: float
    slack: float
    outline: Floats


@uncounted
def _flanks(outline: Floats) -> tuple[float, float]:
    """How far a body reaches to the left and to the right of its reference point [m]."""
    left, right = 0.0, 0.0
    before = outline.shape[0] - 1
    for k in range(outline.shape[0]):
        x0, y0, x1, y1 = outline[before, 0], outline[before, 1], outline[k, 0], outline[k, 1]
        before = k
        if (x0 < 0.0) != (x1 < 0.0):
            y = y0 - x0 * (y1 - y0) / (x1 - x0)
            left, right = max(left, y), max(right, -y)
    return left, right


@uncounted
def _axis(spans: Floats, k: int, w: float, axis: int) -> tuple[float, float]:
    """A coordinate on a span [m], and a third of its derivative there."""
    a, b, c, d = spans[k, 0, axis], spans[k, 1, axis], spans[k, 2, axis], spans[k, 3, axis]
    v = 1.0 - w
    at = v * v * v * a + 3.0 * v * v * w * b + 3.0 * v * w * w * c + w * w * w * d
    return at, v * v * (b - a) + 2.0 * v * w * (c - b) + w * w * (d - c)


@uncounted
def _pose(spans: Floats, along: Floats, at: float, first: int) -> tuple[float, float, float, float]:
    """Where a curve is, and its direction, so far along the chords of its spans [m].

    Args:
        spans: Bézier control polygons [m], (m, 4, 2).
        along: Where each begins, and the last ends [m], (m + 1,).
        at: From the first to the last of these.
        first: A span near there.
    """
    k = first
    while k > 0 and along[k] > at:
        k -= 1
    while k < spans.shape[0] - 1 and along[k + 1] < at:
        k += 1
    w = (at - along[k]) / max(along[k + 1] - along[k], LEAST_STEP_M)
    x, tx = _axis(spans, k, w, 0)
    y, ty = _axis(spans, k, w, 1)
    long = max(math.hypot(tx, ty), LEAST_STEP_M)
    return x, y, tx / long, ty / long


@uncounted
def _reached(
    outline: Floats, closed: bool, places: Floats, normals: Floats, spans: Floats, along: Floats,
    j: int,
) -> tuple[float, float]:  # fmt: skip
    """How far an outline reaches to the left and to the right of a place that it comes by [m]."""
    left, right = _flanks(outline)
    nx, ny = normals[j]
    for k in range(outline.shape[0]):
        at, beyond, across = along[j], outline[k, 0], 0.0
        for _ in range(ROUNDS):
            at -= beyond
            if closed:
                at -= along[-1] * math.floor(at / along[-1])
            if not 0.0 <= at <= along[-1]:
                break
            x, y, tx, ty = _pose(spans, along, at, min(j, spans.shape[0] - 1))
            x += tx * outline[k, 0] - ty * outline[k, 1] - places[j, 0]
            y += ty * outline[k, 0] + tx * outline[k, 1] - places[j, 1]
            beyond, across = x * ny - y * nx, x * nx + y * ny
        left, right = max(left, across), max(right, -across)
    return left, right


@kernel
def swept_sides(
    world: PackedWorld, body: StripBody, closed: bool, places: Floats, normals: Floats,
    spans: Floats, beside: Floats, half: Floats,
) -> None:  # fmt: skip
    """How far to the left of each place the middle of what a body sweeps is, and half its width.

    Where nothing is near, that is the circle round the body.

    Args:
        world: What stands there.
        body: It, its reference point on the curve and its heading along it.
        closed: Whether the curve goes on at its end where it begins.
        places: Of the curve [m], (n, 2).
        normals: Unit vectors to the left of it, (n, 2).
        spans: The curve through the places [m], (n - 1, 4, 2).
        beside: [m], (n,); filled.
        half: With what is kept [m], (n,); filled.
    """
    count, outline = places.shape[0], body.outline
    beside[:] = 0.0
    half[:] = body.required
    if outline.shape[0] == 0:
        return
    around = outer_radius(outline) + body.kept
    along = np.zeros(count)
    for j in range(count - 1):
        dx, dy = places[j + 1, 0] - places[j, 0], places[j + 1, 1] - places[j, 1]
        along[j + 1] = along[j] + math.hypot(dx, dy)
    for j in range(count):
        step = along[min(j + 1, count - 1)] - along[max(j - 1, 0)]
        gap, _ = nearest(world, places[j, 0], places[j, 1], NEAR * around + step)
        if gap >= NEAR * around + step:
            half[j] = around
            continue
        left, right = _reached(outline, closed, places, normals, spans, along, j)
        beside[j], half[j] = 0.5 * (left - right), 0.5 * (left + right) + body.kept
