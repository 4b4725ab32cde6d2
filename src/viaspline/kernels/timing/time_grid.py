"""Where the nodes of a time law lie: at ends of cells, at stops, and ever closer to these."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel

_GRADED = 1e-3 * 1.5 ** np.arange(12)
"""Nodes beside a rest, as parts of the shortest way to full speed."""

MIN_STRETCHES = 16
"""Stretches between two places where the robot stops, at least."""


@kernel
def marks(
    along: Floats, stops: Floats, edges: Floats, graded: bool, ramp: float, slip: float
) -> Floats:
    """Places that have to be nodes, and nodes for where the cells are too long.

    These are a few between stops, and ever closer ones beside a stop: a zone or a bend may keep the
    speed so low that the robot is up to it within a small part of a cell. The few are multiples of
    a power of two, so from a start farther on they are the same or finer ones, and a profile that
    was found from farther back can still be driven.

    Args:
        along: Ends of the cells [m], not decreasing, shape (c + 1,).
        stops: The start, where the robot rests, and the end [m], increasing, shape (k,), k >= 2.
        edges: Other places that have to be nodes [m], increasing, between the start and the end.
        graded: Whether the robot may rest at the start.
        ramp: The shortest way to full speed [m].
        slip: No node is nearer to one of these places [m].

    Returns:
        Nodes [m], increasing.
    """
    legs, grades, last = stops.shape[0] - 1, _GRADED.shape[0], along.shape[0] - 1
    found = np.empty(legs * (2 * MIN_STRETCHES + 2 * grades + 4) + edges.shape[0] + 1)
    count, edge, cell = 0, 0, 1
    for leg in range(legs):
        low, high = stops[leg], stops[leg + 1]
        # stops that only rounding keeps apart: a step that is less than rounding never ends
        step = 2.0 ** np.floor(np.log2(max(high - low, slip) / MIN_STRETCHES))
        even = step * (np.floor(low / step) + 1.0)
        up = 0 if graded or leg > 0 else grades
        down = grades - 1
        found[count] = low
        count += 1
        while True:
            before = found[count - 1]
            while edge < edges.shape[0] and edges[edge] <= low:
                edge += 1
            after = min(high, edges[edge]) if edge < edges.shape[0] else high
            held = before  # the last place that has to be a node
            while True:
                rise = low + ramp * _GRADED[up] if up < grades else np.inf
                fall = high - ramp * _GRADED[down] if down >= 0 else np.inf
                free = min(even, rise, fall)
                if free >= after:
                    break
                if even <= free:
                    even += step
                if rise <= free:
                    up += 1
                if fall <= free:
                    down -= 1
                gap = min(free - held, after - free)
                while cell < last and along[cell] < free:
                    cell += 1
                apart = 0.1 * min(along[cell] - along[cell - 1], gap)
                near = along[cell] - free <= apart or free - along[cell - 1] <= apart
                if gap > slip and not near and free > found[count - 1]:
                    found[count] = free
                    count += 1
            if after >= high:
                break
            found[count] = after
            count += 1
            edge += 1
    found[count] = stops[legs]
    return found[: count + 1]


@kernel
def divide(along: Floats, marks: Floats, slip: float) -> tuple[Floats, NDArray[np.int64], Floats]:
    """Nodes at all marks and at all ends of cells between them.

    Args:
        along: Ends of the cells [m], not decreasing, shape (c + 1,).
        marks: First node, places that have to be nodes, last node [m], increasing, shape (k,).
        slip: An end of a cell that is nearer to a mark is left out [m].

    Returns:
        The nodes [m], shape (n + 1,); the cell of every stretch (n,), and which part of it the
        stretch is, in [0, 1], shape (n, 2).
    """
    c, k = along.shape[0] - 1, marks.shape[0]
    line = np.empty(c + 1 + k)
    line[0], count, j = marks[0], 1, 1
    for i in range(c + 1):
        while j < k and marks[j] <= along[i] + slip:
            line[count] = marks[j]
            count += 1
            j += 1
        if j < k and along[i] > line[count - 1] + slip and along[i] < marks[j] - slip:
            line[count] = along[i]
            count += 1
    while j < k:
        line[count] = marks[j]
        count += 1
        j += 1
    cell, ends, now = np.empty(count - 1, np.int64), np.empty((count - 1, 2)), 0
    for i in range(count - 1):
        middle = 0.5 * (line[i] + line[i + 1])
        while now < c - 1 and along[now + 1] <= middle:
            now += 1
        width = max(along[now + 1] - along[now], 1e-300)
        cell[i] = now
        ends[i, 0] = min(max((line[i] - along[now]) / width, 0.0), 1.0)
        ends[i, 1] = min(max((line[i + 1] - along[now]) / width, 0.0), 1.0)
    return line[:count], cell, ends


@kernel
def refined(
    line: Floats, squares: Floats, over: float, scale: float, gate: float, share: float, most: int
) -> Floats:
    """Nodes for a second look, more where the acceleration should change within a stretch.

    Within a stretch it can't, so about half of the step from one to the next is lost on each. Steps
    through 0 are left out: there the robot would have to brake sooner or later anyway.

    Args:
        line: Nodes [m], increasing, shape (n + 1,).
        squares: The fastest v² there [m²/s²], shape (n + 1,).
        over: Up to here it is above the limits [m]; the start if it never is.
        scale: Of the accelerations [m/s²].
        gate: Part of the time that may be lost.
        share: Part of the time that is lost at most where it was more.
        most: Pieces that a stretch is cut into, at most; all into so many where the robot begins
            by braking.

    Returns:
        The nodes [m]; the same if they lose little enough.
    """
    n = line.shape[0] - 1
    spent, losses = np.zeros(n), np.zeros(n)
    before, whole, lost, roots = 0.0, 0.0, 0.0, 0.0
    for i in range(n):
        width = line[i + 1] - line[i]
        both = np.sqrt(squares[i]) + np.sqrt(squares[i + 1])
        spent[i] = 2.0 * width / both if both > 0.0 else 0.0
        now = 0.5 * (squares[i + 1] - squares[i]) / width
        if before * now > 0.0:
            step = 0.125 * abs(now - before) / scale
            losses[i - 1] += step
            losses[i] += step
        before = now
    for i in range(n):
        losses[i] *= spent[i]
        whole += spent[i]
        lost += losses[i]
        roots += np.sqrt(losses[i])
    fast = over > line[0]
    if lost <= gate * whole and not fast:
        return line
    pieces, size = np.ones(n, np.int64), 1
    for i in range(n):
        fast = fast and (line[i] < over or squares[i + 1] < squares[i])
        wanted = most if fast else int(np.sqrt(losses[i]) * roots / (share * whole)) + 1
        pieces[i] = min(wanted, most)
        size += pieces[i]
    finer, count = np.empty(size), 0
    for i in range(n):
        for k in range(pieces[i]):
            finer[count] = line[i] + (line[i + 1] - line[i]) * (k / pieces[i])
            count += 1
    finer[count] = line[n]
    return finer
