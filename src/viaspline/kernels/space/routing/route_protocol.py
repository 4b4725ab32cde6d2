"""What a search for a route asks of a space, whichever space it is.

As with ``clearance/world_protocol``: numba compiles a search anew for each packed type that it is
given, and takes that type's answers.

    @answers_route(is_free, PackedBalls)
    def _free(space, x, y, z, dx, dy, dz, radius): ...

Tested through ``kernels/space/routing/test_lazy_theta`` and
``kernels/space/routing/test_shape_moves``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.clearance.world_protocol import asked_of
from viaspline.kernels.jit import inlined, inner

_Answer = TypeVar("_Answer", bound=Callable[..., Any])

NORMAL_X, NORMAL_Y, NORMAL_Z, OFFSET, WHERE = range(5)
"""Columns of contacts: a plane's normal, which points to the free side, its offset [m], and where
on the segment the solid that it touches is nearest, 0 to 1."""

_MIDDLE = 13  # the bit of a place itself among its neighbours


class PlaceLattice(NamedTuple):
    """Places in rows, columns and layers.

    Attributes:
        frame: The least of them [m] and the step to the next [m], (4,).
        counts: How many along x, y and z, (3,).
    """

    frame: Floats
    counts: Ints


@inlined
def is_place(lattice: PlaceLattice, i: int, j: int, k: int) -> bool:
    """Whether a lattice has such a place."""
    counts = lattice.counts
    return 0 <= i < counts[0] and 0 <= j < counts[1] and 0 <= k < counts[2]


@inlined
def neighbours(lattice: PlaceLattice, i: int, j: int, k: int) -> int:
    """Which of its 26 neighbours a place of a lattice has; bits as of ``open_moves``."""
    found = 0
    for move in range(27):
        if move != _MIDDLE and is_place(
            lattice, i + move // 9 - 1, j + move // 3 % 3 - 1, k + move % 3 - 1
        ):
            found |= 1 << move
    return found


def answers_route(question: Any, packed: type) -> Callable[[_Answer], _Answer]:
    """Let a function answer a question for one packed type; it may make arrays of its own.

    Args:
        question: ``is_free``, ``open_moves``, ``could_hold`` or ``touched``.
        packed: The NamedTuple of arrays that is the space's packed form.
    """

    def register(answer: _Answer) -> _Answer:
        question.register(packed, answer)
        question.compiled[packed] = inner(answer)
        return answer

    return register


def _no_space(space: Any) -> TypeError:
    return TypeError(f"{type(space).__name__} is no space for a route; see route_protocol")


@asked_of
def is_free(
    space: Any, x: float, y: float, z: float, dx: float, dy: float, dz: float, radius: float
) -> bool:
    """Whether a straight way [m] keeps a radius [m] from everything, and within all limits."""
    raise _no_space(space)


@asked_of
def is_open(space: Any, x: float, y: float, z: float, radius: float) -> bool:
    """Whether a place of a lattice [m] may be free; False only where it isn't."""
    raise _no_space(space)


@asked_of
def open_moves(space: Any, lattice: PlaceLattice, i: int, j: int, k: int, radius: float) -> int:
    """To which of its 26 neighbours a straight way may lead from a free place of a lattice.

    Returns:
        Bit 9 (a + 1) + 3 (b + 1) + c + 1 is for (i + a, j + b, k + c); it is 0 where there is no
        such place, and may be where the way there isn't free.
    """
    raise _no_space(space)


@asked_of
def could_hold(space: Any, lattice: PlaceLattice, i: int, j: int, k: int, radius: float) -> bool:
    """Whether the cell about a place of a lattice could hold a place that is free."""
    raise _no_space(space)


@asked_of
def touched(
    space: Any,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
    radius: float,
    reach: float,
    planes: Floats,
    count: int,
) -> int:
    """Planes between a straight way and the solids next to it.

    Beyond its plane a way keeps the radius from a solid that is convex.

    Args:
        space: What stands about.
        x: Where the way begins [m].
        y: Where it begins [m].
        z: Where it begins [m].
        dx: Where it goes [m].
        dy: Where it goes [m].
        dz: Where it goes [m].
        radius: What it keeps [m].
        reach: Solids no further than this beyond the radius are of interest [m].
        planes: Rows are added to these, see ``NORMAL_X``, (n, 5).
        count: How many rows there are.

    Returns:
        How many there are then.
    """
    raise _no_space(space)
