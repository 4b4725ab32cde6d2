"""Length of the shortest way of a car that only drives forwards, in the open.

L. E. Dubins: "On curves of minimal length with a constraint on average curvature", 1957; the
closed forms of the six words are those of A. Shkel and V. Lumelsky, 2001. With a free heading at
the end: X.-N. Bui et al., "Shortest path synthesis for Dubins non-holonomic robot", 1994.
"""

from __future__ import annotations

import math

from viaspline.kernels.jit import inner

WHOLE_TURN_RAD = 2.0 * math.pi
CLOSED_TURN_RAD = 1e-9  # an angle that is short of a whole turn by less is none [rad]
ON_CIRCLE = 1e-12  # a place that is so little inside of the turning circle is on it, in its square


@inner
def positive(angle: float) -> float:
    """The angle plus whole turns, in [0, 2 pi); what rounding makes a whole turn is 0."""
    turned = angle - WHOLE_TURN_RAD * math.floor(angle / WHOLE_TURN_RAD)
    return 0.0 if turned > WHOLE_TURN_RAD - CLOSED_TURN_RAD else turned


@inner
def _line_between(dx: float, dy: float, start: float, goal: float, s1: float, s2: float) -> float:
    """Turn to one side, line, turn to the same or the other side; lengths in radii."""
    gap_x = dx - s2 * math.sin(goal) + s1 * math.sin(start)  # between the circles' middles
    gap_y = dy + s2 * math.cos(goal) - s1 * math.cos(start)
    gap, offset = math.hypot(gap_x, gap_y), s2 - s1
    if gap < abs(offset):
        return math.inf
    line = start
    if gap > 0.0:
        line = math.atan2(gap_y, gap_x) - math.asin(offset / gap)
    turns = positive(s1 * (line - start)) + positive(s2 * (goal - line))
    return turns + math.sqrt(gap * gap - offset * offset)


@inner
def _turn_between(dx: float, dy: float, start: float, goal: float, side: float) -> float:
    """Turn, turn to the other side, turn; lengths in radii."""
    gap_x = dx - side * (math.sin(goal) - math.sin(start))
    gap_y = dy + side * (math.cos(goal) - math.cos(start))
    gap = math.hypot(gap_x, gap_y)
    if gap > 4.0:
        return math.inf
    axis, aside = math.atan2(gap_y, gap_x), math.acos(0.25 * gap)
    quarter = 0.5 * side * math.pi
    best = math.inf
    for way in (1.0, -1.0):
        first, last = axis + way * aside + quarter, axis + math.pi - way * aside + quarter
        turns = positive(side * (first - start)) + positive(side * (goal - last))
        best = min(best, turns + positive(side * (first - last)))
    return best


@inner
def dubins_length(dx: float, dy: float, start: float, goal: float, rho: float) -> float:
    """Length of the shortest way from one pose to another [m].

    Args:
        dx: From the start to the goal [m].
        dy: The same.
        start: Heading there [rad].
        goal: The same.
        rho: The least radius [m].
    """
    x, y = dx / rho, dy / rho
    best = math.inf
    for s1 in (1.0, -1.0):
        best = min(best, _turn_between(x, y, start, goal, s1))
        for s2 in (1.0, -1.0):
            best = min(best, _line_between(x, y, start, goal, s1, s2))
    return rho * best


@inner
def length_to_place(dx: float, dy: float, heading: float, rho: float) -> float:
    """Length of the shortest way to a place, with whatever heading [m]; see ``dubins_length``."""
    c, s = math.cos(heading), math.sin(heading)
    x = (c * dx + s * dy) / rho
    y = abs(c * dy - s * dx) / rho
    squared = x * x + (y - 1.0) * (y - 1.0)
    if squared >= 1.0 - ON_CIRCLE:  # a turn to its side, and the tangent
        line = math.sqrt(max(squared - 1.0, 0.0))
        turn = math.atan2(x, 1.0 - y) - math.atan2(line, 1.0)
        return rho * (positive(turn) + line)
    far = math.hypot(x, y + 1.0)  # it is too near: first to the other side
    aside = math.acos(min(1.0, max(-1.0, (3.0 + far * far) / (4.0 * far))))
    best = math.inf
    for side in (1.0, -1.0):
        middle = math.atan2(y + 1.0, x) + side * aside
        center_x, center_y = 2.0 * math.cos(middle), 2.0 * math.sin(middle) - 1.0
        first = positive(0.5 * math.pi - middle)
        last = positive(math.atan2(y - center_y, x - center_x) - middle - math.pi)
        best = min(best, first + last)
    return rho * best
