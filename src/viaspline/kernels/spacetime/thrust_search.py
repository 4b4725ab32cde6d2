"""The drive that arrives first among evenly driven thrusts: a search over places, speeds and times.

In every step the robot speeds up evenly along one of a few vectors, so places and speeds stay on a
lattice; from near the goal a cubic leads to rest on it. States that share a cell of places at one
time and speed count as one, so what isn't found may be there all the same.

Tested through ``spacetime/test_searched_paths``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.growable import new_ints
from viaspline.kernels.heap import Heap, pop, push
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.spacetime.thrust_clear import (
    KeptClear,
    Thrust,
    cubic_is_clear,
    keeps_limits,
    near_ones,
    thrust_between,
    thrust_is_clear,
)
from viaspline.kernels.timing.yielding.near_miss import standing_conflict

PX: Final = 0  # a state: its place in pitches from the start,
PY: Final = 1
KX: Final = 2  # its speed in quanta,
KY: Final = 3
STEP: Final = 4  # how many steps from the beginning it is,
FROM: Final = 5  # and the state before it
STATE_COLUMNS: Final = 6

SHORTEST_S = 1e-3  # no drive lasts less [s]
CONNECT_S = 4.0  # from so near the goal it is tried to get to rest on it [s]
STRETCHES = (1.1, 1.25, 1.5)  # in so many times the shortest time
JOINED = 8  # so many thrusts are driven as one at most
PLACE_BITS, SPEED_BITS, STEP_BITS = 14, 7, 12  # of a key


class ThrustLattice(NamedTuple):
    """Steps, places and speeds.

    Attributes:
        begin: When the robot is at rest at the start [s].
        step: From one instant to the next [s].
        quantum: Of speed [m/s].
        levels: The largest speed, in quanta.
        reach: The largest change of the speed in a step, in quanta.
        cell: Bits of a place within which states are one.
    """

    begin: float
    step: float
    quantum: float
    levels: int
    reach: int
    cell: int


class Thrusts(NamedTuple):
    """A drive that was found.

    Attributes:
        states: Time [s], x, y [m], vx, vy [m/s], in the order of time, (n, 5); none: no drive.
        expanded: How many states were looked at.
    """

    states: Floats
    expanded: int


@inlined
def _to_rest(far: float, speed: float, hardest: float, top: float) -> float:
    """The shortest time to come to rest so far ahead from a speed towards it [s]."""
    late = 0.0
    if speed < 0.0:
        late = -speed / hardest
        far += 0.5 * speed * speed / hardest
        speed = 0.0
    over = 0.5 * speed * speed / hardest - far
    if over > 0.0:
        return late + speed / hardest + 2.0 * math.sqrt(over / hardest)
    peak = math.sqrt(hardest * far + 0.5 * speed * speed)
    if peak <= top:
        return late + (2.0 * peak - speed) / hardest
    cruise = far - (top * top - 0.5 * speed * speed) / hardest
    return late + (2.0 * top - speed) / hardest + cruise / top


@inlined
def _left(dx: float, dy: float, vx: float, vy: float, hardest: float, top: float) -> float:
    """No drive to rest at (dx, dy) takes less time [s]."""
    far = math.sqrt(dx * dx + dy * dy)
    if far <= 1e-12:
        return math.sqrt(vx * vx + vy * vy) / hardest
    along, across = (vx * dx + vy * dy) / far, (vx * dy - vy * dx) / far
    return max(_to_rest(far, along, hardest, top), abs(across) / hardest)


@inlined
def _seen_before(table: Ints, key: int) -> bool:
    """Whether a key stands in a table (2^n, 1); it is put there."""
    mask = table.shape[0] - 1
    at = (key * 0x9E3779B97F4A7C1 >> 20) & mask
    while table[at, 0] != -1:
        if table[at, 0] == key:
            return True
        at = (at + 1) & mask
    table[at, 0] = key
    return False


@inlined
def _key(state: Ints, cell: int) -> int:
    """What is one for states that count as one."""
    key = (state[PX] >> cell) + (1 << (PLACE_BITS - 1))
    key = (key << PLACE_BITS) + (state[PY] >> cell) + (1 << (PLACE_BITS - 1))
    key = (key << SPEED_BITS) + state[KX] + (1 << (SPEED_BITS - 1))
    key = (key << SPEED_BITS) + state[KY] + (1 << (SPEED_BITS - 1))
    return (key << STEP_BITS) + state[STEP]


@inlined
def _has_key(state: Ints, cell: int) -> bool:
    """Whether a state lies within what keys tell apart."""
    far = 1 << (PLACE_BITS + cell - 1)
    return -far <= state[PX] < far and -far <= state[PY] < far and state[STEP] < 1 << STEP_BITS


@inner
def _onto_goal(
    around: KeptClear, start: Thrust, goal: Floats, least: float, hardest: float, top: float,
    stay: float, near: Ints,
) -> float:  # fmt: skip
    """For how long a robot drives a cubic to rest on the goal [s]; infinite: it can't."""
    for k in range(len(STRETCHES)):
        lasts = max(least, SHORTEST_S) * STRETCHES[k]
        thrust = thrust_between(start, lasts, goal[0], goal[1], 0.0, 0.0)
        if not keeps_limits(thrust, hardest, top):
            continue
        if not cubic_is_clear(around, thrust, top, near):
            continue
        end = start.begin + lasts
        until, _ = standing_conflict(
            around.motion, around.to_moving, goal[0], goal[1], end, end + stay
        )
        if until == np.inf:
            return lasts
    return np.inf


@inner
def _states_to(
    nodes: Ints, last: int, lattice: ThrustLattice, start: Floats, goal: Floats, lasts: float
) -> Floats:
    """The states on the way to one, and the goal so long after it."""
    count = 1
    node = last
    while nodes[node, FROM] >= 0:
        node = nodes[node, FROM]
        count += 1
    pitch = 0.5 * lattice.quantum * lattice.step
    states = np.empty((count + 1, 5))
    node = last
    for k in range(count - 1, -1, -1):
        states[k, 0] = lattice.begin + nodes[node, STEP] * lattice.step
        states[k, 1] = start[0] + pitch * nodes[node, PX]
        states[k, 2] = start[1] + pitch * nodes[node, PY]
        states[k, 3] = lattice.quantum * nodes[node, KX]
        states[k, 4] = lattice.quantum * nodes[node, KY]
        node = nodes[node, FROM]
    states[count, 0] = states[count - 1, 0] + lasts
    states[count, 1], states[count, 2] = goal[0], goal[1]
    states[count, 3], states[count, 4] = 0.0, 0.0
    return states


@inner
def _joined(around: KeptClear, states: Floats, hardest: float, top: float, near: Ints) -> Floats:
    """The states that are left where several thrusts are driven as one cubic in the same time.

    From rest a cubic may bend on the spot: what begins or ends at rest stays as it is.
    """
    count = states.shape[0]
    kept = np.empty(count, np.int64)
    kept[0] = 0
    size, first = 1, 0
    while first < count - 1:
        last = first + 1
        begin = states[first]
        start = Thrust(begin[0], 0.0, begin[1], begin[2], begin[3], begin[4], 0.0, 0.0, 0.0, 0.0)
        if begin[3] != 0.0 or begin[4] != 0.0:
            for k in range(first + 2, min(first + JOINED, count - 1)):
                end = states[k]
                if end[3] == 0.0 and end[4] == 0.0:
                    break
                lasts = end[0] - begin[0]
                thrust = thrust_between(start, lasts, end[1], end[2], end[3], end[4])
                if not keeps_limits(thrust, hardest, top):
                    continue
                if cubic_is_clear(around, thrust, top, near):
                    last = k
        kept[size] = last
        size += 1
        first = last
    joined = np.empty((size, states.shape[1]))
    for k in range(size):
        for column in range(states.shape[1]):
            joined[k, column] = states[kept[k], column]
    return joined


@kernel
def search_thrusts(
    around: KeptClear, lattice: ThrustLattice, start: Floats, goal: Floats, stay: float,
    weight: float, most: int,
) -> Thrusts:  # fmt: skip
    """The drive from rest at the start to rest at the goal that arrives first, as the lattice sees.

    Args:
        around: What is kept clear of.
        lattice: ThrustLattice.
        start: [m], (2,).
        goal: [m], (2,).
        stay: For how long the goal has to stay free after arrival [s].
        weight: Of what is left to drive; more than 1 is quicker, and arrives later.
        most: So many states are looked at, at most.
    """
    step, quantum = lattice.step, lattice.quantum
    pitch = 0.5 * quantum * step
    hardest, top = lattice.reach * quantum / step, lattice.levels * quantum
    room = (2 * lattice.reach + 1) ** 2 * (most + 1)
    nodes = new_ints(room, STATE_COLUMNS)
    heap = Heap(np.empty(2 * room), np.empty(2 * room, np.int64), np.zeros(1, np.int64))
    size = 1
    while size < 2 * room:
        size *= 2
    table = np.full((size, 1), -1, np.int64)
    onto = np.full(room, np.inf)
    near = np.empty(around.motion.first_piece.size, np.int64)
    for column in range(STATE_COLUMNS):
        nodes[0, column] = 0
    nodes[0, FROM] = -1
    left = _left(goal[0] - start[0], goal[1] - start[1], 0.0, 0.0, hardest, top)
    push(heap, weight * left, 0)
    count, expanded = 1, 0
    while heap.size[0] > 0 and expanded < most:
        item = pop(heap)
        if item < 0:  # an arrival
            found = -1 - item
            states = _states_to(nodes, found, lattice, start, goal, onto[found])
            return Thrusts(_joined(around, states, hardest, top, near), expanded)
        expanded += 1
        state = nodes[item]
        kx, ky = state[KX], state[KY]
        x, y = start[0] + pitch * state[PX], start[1] + pitch * state[PY]
        vx, vy = quantum * kx, quantum * ky
        now = lattice.begin + step * state[STEP]
        left = _left(goal[0] - x, goal[1] - y, vx, vy, hardest, top)
        if left <= CONNECT_S:
            here = Thrust(now, 0.0, x, y, vx, vy, 0.0, 0.0, 0.0, 0.0)
            lasts = _onto_goal(around, here, goal, left, hardest, top, stay, near)
            if lasts < np.inf:
                onto[item] = lasts
                push(heap, now - lattice.begin + lasts, -1 - item)
        close = near_ones(around, x, y, now, step, top, near)
        for i in range(-lattice.reach, lattice.reach + 1):
            for j in range(-lattice.reach, lattice.reach + 1):
                faster = (kx + i) ** 2 + (ky + j) ** 2
                if i * i + j * j > lattice.reach**2 or faster > lattice.levels**2:
                    continue
                other = nodes[count]
                other[PX], other[PY] = state[PX] + 2 * kx + i, state[PY] + 2 * ky + j
                other[KX], other[KY] = kx + i, ky + j
                other[STEP], other[FROM] = state[STEP] + 1, item
                if not _has_key(other, lattice.cell) or _seen_before(
                    table, _key(other, lattice.cell)
                ):
                    continue
                thrust = Thrust(
                    now, step, x, y, vx, vy, i * quantum / step, j * quantum / step, 0.0, 0.0
                )
                if not thrust_is_clear(around, thrust, near, close):
                    continue
                left = _left(
                    goal[0] - start[0] - pitch * other[PX], goal[1] - start[1] - pitch * other[PY],
                    quantum * other[KX], quantum * other[KY], hardest, top,
                )  # fmt: skip
                push(heap, step * other[STEP] + weight * left, count)
                count += 1
    return Thrusts(np.empty((0, 5)), expanded)
