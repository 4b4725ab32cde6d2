"""Going through 4 cells aside from the nearest on, without a stack.

Trees of 4 x 4 (x 4) cells are walked depth first. In which order the cells of a node come depends
on where the place is that is asked for, along each axis by itself; so from a cell alone it is known
which one comes after it, and nothing has to be kept of the way down. (A stack is an array, and
what a certificate asks of a world must make none.)

Tested through ``kernels/space/test_space_distance``.
"""

from __future__ import annotations

from viaspline.kernels.jit import inlined


@inlined
def nearest_of_four(value: float, first: int, size: float) -> int:
    """Which of the cells ``first`` to ``first + 3`` of a size a coordinate lies in, or next to."""
    return int(min(max(value / size - first, 0.0), 3.0))


@inlined
def cell_at(nearest: int, step: int) -> int:
    """The cell, 0 to 3, that comes at a step: 0123, 1023, 2310 or 3210."""
    order = 228 if nearest == 0 else 225 if nearest == 1 else 30 if nearest == 2 else 27
    return (order >> (2 * step)) & 3


@inlined
def step_of(nearest: int, cell: int) -> int:
    """The step at which a cell comes: the inverse of ``cell_at``."""
    steps = 228 if nearest == 0 else 225 if nearest == 1 else 75 if nearest == 2 else 27
    return (steps >> (2 * cell)) & 3
