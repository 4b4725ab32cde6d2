"""Where a curve is cut into few straight lines: each as long as a test lets it be."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

_FINENESS: Final = 1.0 / 64.0
"""Of a line's length: how much longer it might have been."""

_LEAST: Final = 1e-7
"""Shortest piece in parameters of a span."""


def sparse_parameters(
    fixed: Sequence[float], may_join: Callable[[float, float], bool]
) -> list[float]:
    """Parameters between which a curve is taken for straight lines, few of them.

    From each one the next is as far off as the test allows. Where a test that allows a piece allows
    its parts, no fewer would do, but for the sixty-fourth to which the farthest is sought.

    Args:
        fixed: Parameters that are among them, increasing: at least the first and the last.
        may_join: Whether the curve may be straight from one parameter to another one. Pieces of
            1e-7 are taken whatever it says.

    Returns:
        The parameters, increasing.

    Example:
        >>> [round(u, 1) for u in sparse_parameters([0, 10], lambda a, b: b - a <= 4.01)]
        [0.0, 4.0, 8.0, 10.0]
    """
    found = [float(fixed[0])]
    step = 1.0
    for goal in map(float, fixed[1:]):
        while found[-1] < goal:
            u = found[-1]
            found.append(_farthest(u, goal, step, may_join))
            step = found[-1] - u
    return found


def _farthest(
    u: float, goal: float, step: float, may_join: Callable[[float, float], bool]
) -> float:
    """The farthest parameter up to the goal that may be joined with u."""
    low, high = 0.0, step
    while may_join(u, min(u + high, goal)):
        if u + high >= goal:
            return goal
        low, high = high, 2.0 * high
    while high - low > max(_FINENESS * low, _LEAST):
        middle = 0.5 * (low + high)
        if may_join(u, min(u + middle, goal)):
            low = middle
        else:
            high = middle
    return min(u + max(low, _LEAST), goal)
