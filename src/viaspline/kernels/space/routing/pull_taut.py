"""Pulling a way taut, whatever it turns at: edges of buildings, cubes, cables, balls.

Vertex by vertex, until little is gained: a vertex goes if its neighbours see each other; else it
goes to the best place beyond the planes of what it touches (see ``vertex_move``), as far as the
way stays free. Where it turns much, a corner is cut off: twice the vertices, and nearer to the
round edge. That is done only where it gains at least a given cost, or else a round edge would take
thousands of vertices. Where a way is held in the midst of a straight line, it gets a vertex there.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.space.routing.route_protocol import (
    NORMAL_X,
    NORMAL_Y,
    NORMAL_Z,
    OFFSET,
    WHERE,
    is_free,
    touched,
)
from viaspline.kernels.space.routing.side_gates import gates_allow
from viaspline.kernels.space.routing.taut_string import (
    TautString,
    drop_vertex,
    insert_vertex,
    line_length,
)
from viaspline.kernels.space.routing.vertex_move import (
    best_place,
    beyond_plane,
    cost_through,
    pulled_cost,
)

_PLANES = 32
_HALVINGS = 8
_LEAST_GAIN = 1e-5  # of the cost: what a sweep gains at least, or it was the last
_OWN = 0.25  # of a line: what is touched nearer to its far end than this holds the far vertex
_LIFT = 2.0  # of the reach: by how much a further vertex is put off from what it touches
_MIDST = 40.0  # of the reach: what is touched farther from both ends is touched in the midst
_SWEEPS, _ROUNDS = 12, 4


@inner
def _sees(
    space: Any,
    gates: Floats,
    radius: float,
    rows: Floats,
    i: int,
    x: float,
    y: float,
    z: float,
) -> bool:
    """Whether the straight way from a row to a place is free."""
    dx = x - rows[i, 0]
    dy = y - rows[i, 1]
    dz = z - rows[i, 2]
    return gates_allow(gates, rows[i, 0], rows[i, 1], rows[i, 2], dx, dy, dz) and is_free(
        space, rows[i, 0], rows[i, 1], rows[i, 2], dx, dy, dz, radius
    )


@inner
def _fits(
    space: Any, gates: Floats, radius: float, rows: Floats, here: int, x: float, y: float, z: float
) -> bool:
    """Whether a vertex can be put at a place."""
    return _sees(space, gates, radius, rows, here - 1, x, y, z) and _sees(
        space, gates, radius, rows, here + 1, x, y, z
    )


@inner
def _touched_between(
    space: Any, radius: float, string: TautString, i: int, j: int, count: int
) -> int:
    """Write what the line between two vertices touches; how many planes there are."""
    rows = string.rows
    return touched(
        space,
        rows[i, 0],
        rows[i, 1],
        rows[i, 2],
        rows[j, 0] - rows[i, 0],
        rows[j, 1] - rows[i, 1],
        rows[j, 2] - rows[i, 2],
        radius,
        string.reach,
        string.planes,
        count,
    )


@inner
def _held_by(space: Any, radius: float, string: TautString, here: int) -> int:
    """Write the planes that hold a vertex; how many there are.

    What a line touches at its other end holds the vertex there. Rounding may put a plane a hair
    before the vertex.
    """
    rows = string.rows
    planes = string.planes
    kept = 0
    for side in range(2):
        other = here - 1 if side == 0 else here + 1
        count = _touched_between(space, radius, string, other, here, kept)
        for k in range(kept, count):
            if planes[k, WHERE] < _OWN:
                continue
            for column in range(5):
                planes[kept, column] = planes[k, column]
            beyond = beyond_plane(planes, kept, rows[here, 0], rows[here, 1], rows[here, 2])
            planes[kept, OFFSET] += min(beyond, 0.0)
            kept += 1
    return kept


@inner
def _moved(
    space: Any, gates: Floats, norm: Floats, radius: float, string: TautString, here: int
) -> float:
    """Put a vertex where it is best, as far as the way stays free; what that gains."""
    rows = string.rows
    best = string.best
    count = _held_by(space, radius, string, here)
    if not best_place(norm, rows, here, string.planes, count, best):
        return 0.0
    x = rows[here, 0]
    y = rows[here, 1]
    z = rows[here, 2]
    now = cost_through(norm, rows, here - 1, here + 1, x, y, z)
    if now - cost_through(norm, rows, here - 1, here + 1, best[0], best[1], best[2]) <= 1e-9 * now:
        return 0.0
    dx = best[0] - x
    dy = best[1] - y
    dz = best[2] - z
    share = 1.0
    if not _fits(space, gates, radius, rows, here, best[0], best[1], best[2]):
        share = 0.0
        step = 0.5
        for _ in range(_HALVINGS):
            t = share + step
            if _fits(space, gates, radius, rows, here, x + t * dx, y + t * dy, z + t * dz):
                share = t
            step *= 0.5
    if share == 0.0:
        return 0.0
    rows[here, 0] = x + share * dx
    rows[here, 1] = y + share * dy
    rows[here, 2] = z + share * dz
    after = cost_through(
        norm, rows, here - 1, here + 1, rows[here, 0], rows[here, 1], rows[here, 2]
    )
    return now - after


@inner
def _swept(
    space: Any, gates: Floats, norm: Floats, radius: float, string: TautString, drops: bool
) -> float:
    """Pull at every vertex once; what that gains."""
    rows = string.rows
    gain = 0.0
    here = 1
    while here < string.size[0] - 1:
        x = rows[here, 0]
        y = rows[here, 1]
        z = rows[here, 2]
        after = here + 1
        if drops and _sees(
            space, gates, radius, rows, here - 1, rows[after, 0], rows[after, 1], rows[after, 2]
        ):
            gain += cost_through(norm, rows, here - 1, after, x, y, z) - pulled_cost(
                norm,
                rows[after, 0] - rows[here - 1, 0],
                rows[after, 1] - rows[here - 1, 1],
                rows[after, 2] - rows[here - 1, 2],
            )
            drop_vertex(string, here)
            here = max(1, here - 1)
            continue
        gain += _moved(space, gates, norm, radius, string, here)
        here += 1
    return gain


@inner
def _cost(norm: Floats, string: TautString) -> float:
    cost = 0.0
    for row in range(string.size[0] - 1):
        cost += pulled_cost(
            norm,
            string.rows[row + 1, 0] - string.rows[row, 0],
            string.rows[row + 1, 1] - string.rows[row, 1],
            string.rows[row + 1, 2] - string.rows[row, 2],
        )
    return cost


@inner
def _cut_off(
    space: Any,
    gates: Floats,
    norm: Floats,
    radius: float,
    string: TautString,
    here: int,
    least: float,
) -> bool:
    """Cut a corner off, if that gains the least; whether it did."""
    rows = string.rows
    before = line_length(rows, here - 1, here)
    after = line_length(rows, here, here + 1)
    whole = 0.5 * min(before, after)
    if whole <= 0.0:
        return False
    ax = (rows[here - 1, 0] - rows[here, 0]) / before
    ay = (rows[here - 1, 1] - rows[here, 1]) / before
    az = (rows[here - 1, 2] - rows[here, 2]) / before
    bx = (rows[here + 1, 0] - rows[here, 0]) / after
    by = (rows[here + 1, 1] - rows[here, 1]) / after
    bz = (rows[here + 1, 2] - rows[here, 2]) / after
    spared = pulled_cost(norm, -ax, -ay, -az) + pulled_cost(norm, bx, by, bz)
    spared -= pulled_cost(norm, bx - ax, by - ay, bz - az)
    if whole * spared < least:
        return False
    cut = 0.0
    step = whole
    for _ in range(_HALVINGS):
        s = cut + step
        x = rows[here, 0] + s * ax
        y = rows[here, 1] + s * ay
        z = rows[here, 2] + s * az
        dx = s * (bx - ax)
        dy = s * (by - ay)
        dz = s * (bz - az)
        if (
            s <= whole
            and gates_allow(gates, x, y, z, dx, dy, dz)
            and is_free(space, x, y, z, dx, dy, dz, radius)
        ):
            cut = s
        step *= 0.5
    if cut * spared < least:
        return False
    x = rows[here, 0] + cut * ax
    y = rows[here, 1] + cut * ay
    z = rows[here, 2] + cut * az
    rows[here, 0] += cut * bx
    rows[here, 1] += cut * by
    rows[here, 2] += cut * bz
    insert_vertex(string, here, x, y, z)
    return True


@inner
def _held_between(space: Any, gates: Floats, radius: float, string: TautString, here: int) -> bool:
    """Put a vertex where the line before one is held in its midst; whether it did."""
    rows = string.rows
    planes = string.planes
    count = _touched_between(space, radius, string, here - 1, here, 0)
    length = line_length(rows, here - 1, here)
    best = -1
    for k in range(count):
        t = planes[k, WHERE]
        if min(t, 1.0 - t) * length > _MIDST * string.reach and (
            best < 0 or abs(t - 0.5) < abs(planes[best, WHERE] - 0.5)
        ):
            best = k
    if best < 0:
        return False
    t = planes[best, WHERE]
    lift = _LIFT * string.reach
    x = rows[here - 1, 0] + t * (rows[here, 0] - rows[here - 1, 0]) + lift * planes[best, NORMAL_X]
    y = rows[here - 1, 1] + t * (rows[here, 1] - rows[here - 1, 1]) + lift * planes[best, NORMAL_Y]
    z = rows[here - 1, 2] + t * (rows[here, 2] - rows[here - 1, 2]) + lift * planes[best, NORMAL_Z]
    if not _sees(space, gates, radius, rows, here - 1, x, y, z):
        return False
    if not _sees(space, gates, radius, rows, here, x, y, z):
        return False
    insert_vertex(string, here, x, y, z)
    return True


@inner
def _refined(
    space: Any, gates: Floats, norm: Floats, radius: float, string: TautString, least: float
) -> bool:
    """Cut corners off, and put vertices where lines are held; whether there are more then."""
    room = string.rows.shape[0]
    before = string.size[0]
    here = 1
    while here < string.size[0] - 1 and string.size[0] < room:
        if _cut_off(space, gates, norm, radius, string, here, least):
            here += 1
        here += 1
    here = 1
    while here < string.size[0] and string.size[0] < room:
        if _held_between(space, gates, radius, string, here):
            here += 1
        here += 1
    return string.size[0] > before


@inner
def _pulled(
    space: Any, gates: Floats, norm: Floats, radius: float, string: TautString, drops: bool
) -> None:
    """Pull until little is gained."""
    for _ in range(_SWEEPS):
        gain = _swept(space, gates, norm, radius, string, drops)
        if gain <= _LEAST_GAIN * _cost(norm, string):
            break


@kernel
def taut_way(
    space: Any,
    gates: Floats,
    norm: Floats,
    way: Floats,
    radius: float,
    reach: float,
    least: float,
) -> Floats:
    """A way pulled taut.

    Args:
        space: Answers ``is_free`` and ``touched``.
        gates: See ``side_gates``, (g, 8).
        norm: See ``travel_norm``, (3,).
        way: A free way [m], (n, 3).
        radius: What it keeps from everything [m], above 0.
        reach: What is no further beyond that counts as touched [m]; a twentieth of the size of
            the body, say.
        least: What a cut corner has to gain [m or s].

    Returns:
        A free way between the same ends that costs no more [m], (m, 3).
    """
    room = 4 * way.shape[0] + 64
    string = TautString(
        np.empty((room, 3)),
        np.empty(1, np.int64),
        np.empty((_PLANES, 5)),
        np.empty(3),
        reach,
    )
    string.size[0] = way.shape[0]
    for row in range(way.shape[0]):
        for axis in range(3):
            string.rows[row, axis] = way[row, axis]
    _pulled(space, gates, norm, radius, string, True)
    for _ in range(_ROUNDS):
        if not _refined(space, gates, norm, radius, string, least):
            break
        _pulled(space, gates, norm, radius, string, False)
        _pulled(space, gates, norm, radius, string, True)
    taut = np.empty((string.size[0], 3))
    for row in range(string.size[0]):
        for axis in range(3):
            taut[row, axis] = string.rows[row, axis]
    return taut
