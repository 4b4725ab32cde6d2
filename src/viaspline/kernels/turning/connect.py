"""Two turns with ramps and the line between them, from one pose to another or to a place.

The same shape as a swing of two bends. Everything follows from the heading of the line, and that
is the zero of one function: how far the line from the end of the first turn misses the start of
the second.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner
from viaspline.kernels.turning.clothoid import arc_and_ramp, shape_of
from viaspline.kernels.turning.collision_cache import FROM, LENGTH, TO

MAX_NEWTON_ROUNDS = 12
MAX_BACK_TURN_RAD = 0.5  # a turn may go to the other side by as much [rad]
MAX_SEGMENTS = 7  # segments
NO_TURN_RAD = 1e-10  # [rad]


@inner
def _turned(angle: float, side: float) -> float:
    """A turn by an angle plus whole turns, from ``-BACK`` to nearly a whole turn to a side."""
    angle *= side
    angle -= 2.0 * math.pi * math.floor((angle + MAX_BACK_TURN_RAD) / (2.0 * math.pi))
    return side * angle


@inner
def _chord(heading: float, turn: float, rho: float, ramp: float) -> tuple[float, float]:
    """From the start to the end of a turn [m]."""
    theta = abs(turn)
    if theta < NO_TURN_RAD:
        return 0.0, 0.0
    radius, shift, lead = shape_of(theta, rho, ramp)
    middle = heading + 0.5 * turn
    length = 2.0 * lead * math.cos(0.5 * turn) + 2.0 * (radius + shift) * math.sin(0.5 * theta)
    return length * math.cos(middle), length * math.sin(middle)


@inner
def _miss(
    x: float, y: float, start: float, goal: float, line: float, s1: float, s2: float,
    rho: float, ramp: float,
) -> tuple[float, float, float, float]:  # fmt: skip
    """How the line with a heading misses: (aside, its length, first turn, second turn)."""
    first = _turned(line - start, s1)
    dx, dy = _chord(start, first, rho, ramp)
    x -= dx
    y -= dy
    second = 0.0
    if not math.isnan(goal):
        second = _turned(goal - line, s2)
        dx, dy = _chord(line, second, rho, ramp)
        x -= dx
        y -= dy
    c, s = math.cos(line), math.sin(line)
    return c * y - s * x, c * x + s * y, first, second


@inner
def _first_guess(x: float, y: float, start: float, goal: float, s1: float, s2: float, rho: float,
                 ramp: float) -> float:  # fmt: skip
    """Heading of the line if both turns have an arc; that of the chord if there is no such line."""
    radius, shift, lead = shape_of(ramp / rho, rho, ramp)
    touch = radius + shift
    c, s = math.cos(start), math.sin(start)
    x -= lead * c - s1 * touch * s
    y -= lead * s + s1 * touch * c
    offset = -s1 * touch
    if not math.isnan(goal):
        c, s = math.cos(goal), math.sin(goal)
        x += -lead * c - s2 * touch * s
        y += -lead * s + s2 * touch * c
        offset += s2 * touch
    gap = math.hypot(x, y)
    if gap <= abs(offset):
        return math.atan2(y, x)
    return math.atan2(y, x) - math.asin(offset / gap)


@inner
def _add_turn(turn: float, rho: float, ramp: float, segments: Floats, count: int) -> int:
    """Append the segments of a turn; returns how many there are."""
    if abs(turn) < NO_TURN_RAD:
        return count
    radius, ramp = arc_and_ramp(abs(turn), rho, ramp)
    bend = math.copysign(1.0 / radius, turn)
    arc = radius * abs(turn) - ramp
    segments[count, FROM], segments[count, TO], segments[count, LENGTH] = 0.0, bend, ramp
    count += 1
    if arc > 1e-9 * radius:
        segments[count, FROM], segments[count, TO], segments[count, LENGTH] = bend, bend, arc
        count += 1
    segments[count, FROM], segments[count, TO], segments[count, LENGTH] = bend, 0.0, ramp
    return count + 1


@inner
def connection(
    x: float, y: float, start: float, goal: float, s1: float, s2: float, rho: float, ramp: float,
    segments: Floats,
) -> tuple[int, float]:  # fmt: skip
    """Turn, line, turn from the origin.

    Args:
        x: The goal [m].
        y: The same.
        start: Heading in the origin [rad].
        goal: Heading at the goal [rad]; NaN if it is free: there is no second turn then.
        s1: Side of the first turn, 1 is left. A small turn may come out to the other one.
        s2: The same of the second turn.
        rho: The least radius [m].
        ramp: Length of the ramps [m].
        segments: Room for ``MAX_SEGMENTS`` rows, see ``cache``; filled.

    Returns:
        How many segments there are, 0 if there is no such way, and their length [m].
    """
    scale = abs(x) + abs(y) + rho
    line = _first_guess(x, y, start, goal, s1, s2, rho, ramp)
    aside, length, first, second = _miss(x, y, start, goal, line, s1, s2, rho, ramp)
    before, before_aside = line, aside
    if abs(aside) > 1e-13 * scale:
        line += math.atan2(aside, max(length, 0.5 * rho))
        for _ in range(MAX_NEWTON_ROUNDS):
            aside, length, first, second = _miss(x, y, start, goal, line, s1, s2, rho, ramp)
            if abs(aside) <= 1e-13 * scale or aside == before_aside:
                break
            step = -aside * (line - before) / (aside - before_aside)
            before, before_aside = line, aside
            line += min(max(step, -0.5), 0.5)
    if abs(aside) > 1e-10 * scale or length < 0.0:
        return 0, math.inf
    count = _add_turn(first, rho, ramp, segments, 0)
    if length > 1e-9 * scale:
        segments[count, FROM], segments[count, TO], segments[count, LENGTH] = 0.0, 0.0, length
        count += 1
    count = _add_turn(second, rho, ramp, segments, count)
    total = 0.0
    for k in range(count):
        total += segments[k, LENGTH]
    return count, total
