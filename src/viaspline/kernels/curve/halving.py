"""Pieces of a span on a stack: each a row of four control points and the parameters of its ends.

Tested through ``curve/test_certificate``.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined


@inlined
def halve_piece(stack: Floats, top: int, d: int) -> None:
    """Replace the piece at ``top`` of the stack by its right half, its left half above it."""
    for axis in range(d):
        p0 = stack[top, axis]
        p1 = stack[top, d + axis]
        p2 = stack[top, 2 * d + axis]
        p3 = stack[top, 3 * d + axis]
        q0 = 0.5 * (p0 + p1)
        q1 = 0.5 * (p1 + p2)
        q2 = 0.5 * (p2 + p3)
        r0 = 0.5 * (q0 + q1)
        r1 = 0.5 * (q1 + q2)
        middle = 0.5 * (r0 + r1)
        stack[top + 1, axis] = p0
        stack[top + 1, d + axis] = q0
        stack[top + 1, 2 * d + axis] = r0
        stack[top + 1, 3 * d + axis] = middle
        stack[top, axis] = middle
        stack[top, d + axis] = r1
        stack[top, 2 * d + axis] = q2
        stack[top, 3 * d + axis] = p3
    middle = 0.5 * (stack[top, 4 * d] + stack[top, 4 * d + 1])
    stack[top + 1, 4 * d] = stack[top, 4 * d]
    stack[top + 1, 4 * d + 1] = middle
    stack[top, 4 * d] = middle


@inlined
def load_span(stack: Floats, spans: Floats, span: int, d: int) -> None:
    """Begin with a whole span: its control points, and the parameters of its ends."""
    for k in range(4):
        for axis in range(d):
            stack[0, k * d + axis] = spans[span, k, axis]
    stack[0, 4 * d] = 0.0
    stack[0, 4 * d + 1] = 1.0
