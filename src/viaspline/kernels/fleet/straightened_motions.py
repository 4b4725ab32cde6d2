"""Motions of many robots made straighter, so that no two come nearer each other than before.

A motion is a place at every step, with an even straight drive in between. A robot may go straight
from its place at one step to that at another where this is clear of the world, and far enough from
all others at every instant as they move by then. So who passes first stays as it is.

Tested through ``fleet/lattice_order/test_lattice_paths``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, inner, kernel, uncounted
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.segment import nearest_to_segment

NOBODY: Final = -1
"""No robot."""
CHUNK: Final = 16
"""Steps whose places are in one box."""
SHRINK: Final = 0.8
"""By which a straight drive that isn't clear is shortened."""


@inlined
def closest(ax: float, ay: float, bx: float, by: float) -> float:
    """The least distance to the origin of what goes straight from a to b [m]."""
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    along = 0.0 if square == 0.0 else min(max(-(ax * dx + ay * dy) / square, 0.0), 1.0)
    return math.hypot(ax + along * dx, ay + along * dy)


@inner
def _boxes(places: Floats, robot: int, boxes: Floats) -> None:
    """Reckon the boxes round a robot's places anew."""
    steps = places.shape[1]
    for c in range(boxes.shape[0]):
        x0 = y0 = np.inf
        x1 = y1 = -np.inf
        for t in range(c * CHUNK, min((c + 1) * CHUNK + 1, steps)):
            x0, x1 = min(x0, places[robot, t, 0]), max(x1, places[robot, t, 0])
            y0, y1 = min(y0, places[robot, t, 1]), max(y1, places[robot, t, 1])
        boxes[c, robot, 0], boxes[c, robot, 1] = x0, y0
        boxes[c, robot, 2], boxes[c, robot, 3] = x1, y1


@uncounted
def _keeps_away_from(
    places: Floats, apart: float, robot: int, other: int, a: int, b: int, begin: int, end: int
) -> bool:
    """Whether a straight drive from step a to step b is far enough from another robot's motion.

    Between steps ``begin`` and ``end``, which lie in between.
    """
    ax, ay = places[robot, a, 0], places[robot, a, 1]
    vx = (places[robot, b, 0] - ax) / (b - a)
    vy = (places[robot, b, 1] - ay) / (b - a)
    for t in range(begin, end):
        now = closest(
            places[other, t, 0] - (ax + (t - a) * vx),
            places[other, t, 1] - (ay + (t - a) * vy),
            places[other, t + 1, 0] - (ax + (t + 1 - a) * vx),
            places[other, t + 1, 1] - (ay + (t + 1 - a) * vy),
        )  # fmt: skip
        if now < apart:
            return False
    return True


@uncounted
def _in_the_way(
    places: Floats, boxes: Floats, reach: Floats, margin: float, robot: int, a: int, b: int
) -> int:
    """A robot that a straight drive from step a to step b isn't far enough from, or ``NOBODY``."""
    ax, ay = places[robot, a, 0], places[robot, a, 1]
    vx = (places[robot, b, 0] - ax) / (b - a)
    vy = (places[robot, b, 1] - ay) / (b - a)
    for c in range(a // CHUNK, (b - 1) // CHUNK + 1):
        t0, t1 = max(a, c * CHUNK), min(b, (c + 1) * CHUNK)
        x0, x1 = ax + (t0 - a) * vx, ax + (t1 - a) * vx
        y0, y1 = ay + (t0 - a) * vy, ay + (t1 - a) * vy
        x0, x1, y0, y1 = min(x0, x1), max(x0, x1), min(y0, y1), max(y0, y1)
        for other in range(places.shape[0]):
            apart = reach[robot] + reach[other] + margin
            if (
                boxes[c, other, 0] - apart > x1
                or boxes[c, other, 2] + apart < x0
                or boxes[c, other, 1] - apart > y1
                or boxes[c, other, 3] + apart < y0
                or other == robot
            ):
                continue
            if not _keeps_away_from(places, apart, robot, other, a, b, t0, t1):
                return other
    return NOBODY


@uncounted
def _can_go(world: PackedWorld, kept: Floats, places: Floats, robot: int, a: int, b: int) -> bool:
    """Whether the straight way from where a robot is at step a to where it is at step b is free."""
    distance, _ = nearest_to_segment(
        world, places[robot, a, 0], places[robot, a, 1], places[robot, b, 0], places[robot, b, 1],
        kept[robot],
    )  # fmt: skip
    return distance >= kept[robot]


@inner
def _straighten(places: Floats, robot: int, a: int, b: int) -> None:
    """Drive straight and evenly from step a to step b."""
    for axis in range(2):
        begin, end = places[robot, a, axis], places[robot, b, axis]
        for t in range(a + 1, b):
            places[robot, t, axis] = begin + (end - begin) * (t - a) / (b - a)


@inner
def _pass(
    world: PackedWorld, kept: Floats, places: Floats, boxes: Floats, reach: Floats, margin: float,
    robot: int, begin: int, end: int,
) -> bool:  # fmt: skip
    """Go straight from step to step, each time as far as it can; whether something changed.

    Who was in the way of a longer drive is looked at first: mostly it is in that of a shorter one.
    """
    changed = False
    a, met = begin, NOBODY
    while a < end - 1:
        span = end - a
        while span > 1:
            b = a + span
            if met != NOBODY:
                apart = reach[robot] + reach[met] + margin
                if _keeps_away_from(places, apart, robot, met, a, b, a, b):
                    met = NOBODY
            if met == NOBODY and _can_go(world, kept, places, robot, a, b):
                met = _in_the_way(places, boxes, reach, margin, robot, a, b)
                if met == NOBODY:
                    _straighten(places, robot, a, b)
                    changed = True
                    break
            span = int(span * SHRINK)
        a += max(span, 1)
    if changed:
        _boxes(places, robot, boxes)
    return changed


@inner
def _ride_along(
    points: Floats, along: Floats, start: float, pace: float, t: int, place: Floats
) -> None:
    """Where a robot is at a step that sets out along a line at another one."""
    gone = min(max((t - start) * pace, 0.0), along[along.size - 1])
    k = min(max(np.searchsorted(along, gone) - 1, 0), along.size - 2)
    width = along[k + 1] - along[k]
    share = (gone - along[k]) / width if width > 0.0 else 0.0
    for axis in range(2):
        place[axis] = points[k, axis] + share * (points[k + 1, axis] - points[k, axis])


@kernel
def along_its_line(
    places: Floats, reach: Floats, margin: float, robot: int, points: Floats, along: Floats,
    pace: float, soonest: int, latest: int,
) -> int:  # fmt: skip
    """Let a robot drive along a line, at the first step at which it meets nobody on its way.

    Args:
        places: Where each robot is at each step [m], (n, steps, 2); written to if there is one.
        reach: Of each robot [m], (n,); two are to be the sum of theirs apart.
        margin: And so much more.
        robot: Which.
        points: Of the line, (k, 2), k >= 2.
        along: Their distances along it [m], (k,).
        pace: How far it drives in a step [m].
        soonest: The first step at which it may set out.
        latest: The last step at which it may set out.

    Returns:
        The step at which it sets out; -1 if it meets somebody whenever it does.
    """
    steps = places.shape[1]
    tried = np.empty((steps, 2))
    for t in range(steps):
        _ride_along(points, along, soonest, pace, t, tried[t])
    met = NOBODY
    for start in range(soonest, latest + 1):
        if start + along[along.size - 1] / pace > steps - 1:
            break
        if start > soonest:  # the same a step later
            for t in range(steps - 1, 0, -1):
                tried[t, 0], tried[t, 1] = tried[t - 1, 0], tried[t - 1, 1]
        if met != NOBODY and _meets(places, reach[robot] + reach[met] + margin, met, tried, pace):
            continue
        met = _who_is_met(places, reach, margin, robot, tried, pace)
        if met == NOBODY:
            for t in range(steps):
                places[robot, t, 0], places[robot, t, 1] = tried[t, 0], tried[t, 1]
            return start
    return -1


@uncounted
def _meets(places: Floats, apart: float, other: int, tried: Floats, pace: float) -> bool:
    """Whether a motion comes too near to that of a robot, which drives no faster."""
    steps = places.shape[1]
    t = 0
    while t < steps - 1:
        ax, ay = places[other, t, 0] - tried[t, 0], places[other, t, 1] - tried[t, 1]
        bx = places[other, t + 1, 0] - tried[t + 1, 0]
        by = places[other, t + 1, 1] - tried[t + 1, 1]
        if closest(ax, ay, bx, by) < apart:
            return True
        t += max(int((math.hypot(ax, ay) - apart) / (2.0 * pace)), 1)
    return False


@uncounted
def _who_is_met(
    places: Floats, reach: Floats, margin: float, robot: int, tried: Floats, pace: float
) -> int:
    """The first robot that a motion of this one comes too near to, or ``NOBODY``."""
    for other in range(places.shape[0]):
        apart = reach[robot] + reach[other] + margin
        if other != robot and _meets(places, apart, other, tried, pace):
            return other
    return NOBODY


@kernel
def straightened_motions(
    world: PackedWorld, kept: Floats, places: Floats, reach: Floats, margin: float,
    departs: Ints, arrives: Ints, rounds: int,
) -> None:  # fmt: skip
    """Make the motions of robots straighter.

    Args:
        world: What stands.
        kept: What the centre of each robot keeps of it [m], (n,).
        places: Where each robot is at each step [m], (n, steps, 2); written to.
        reach: Of each robot [m], (n,); two are to be the sum of theirs apart.
        margin: And so much more where a drive is made straighter [m].
        departs: The last step at which a robot stands at its start, (n,).
        arrives: The first step from which on it stays at its goal, (n,).
        rounds: How often to try. In later rounds drives begin inside of those that there are.
    """
    chunks = (places.shape[1] - 2) // CHUNK + 1
    boxes = np.empty((max(chunks, 1), places.shape[0], 4))
    for robot in range(places.shape[0]):
        _boxes(places, robot, boxes)
    for k in range(rounds):
        for robot in range(places.shape[0]):
            begin, end = departs[robot], arrives[robot]
            if k > 0:
                begin += (k * (end - begin)) // (2 * rounds)
            _pass(world, kept, places, boxes, reach, margin, robot, begin, end)
