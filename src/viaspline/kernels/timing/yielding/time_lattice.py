"""The earliest arrival on a lattice of times, speeds and places, by sets of places.

In one step of time the speed changes by whole quanta, and in a step that begins with k of them and
changes by d the robot goes on by 2k + d pitches: so places stay on a lattice, and what can be
reached at an instant with a speed is a row of bits. A step shifts rows.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.motion.packed_motion import PackedMotion
from viaspline.kernels.timing.yielding.bit_rows import (
    NONE,
    ONE,
    Words,
    add_places,
    has_place,
    remove_places,
)
from viaspline.kernels.timing.yielding.blocked_places import Driving, PlaceGrid, block_places
from viaspline.kernels.timing.yielding.near_miss import standing_conflict
from viaspline.kernels.timing.yielding.path_tree import PathTree

CHUNK: Final = 32  # for so many steps blocked places are found at once
PAD: Final = 2  # empty words on both sides of what is shifted


class TimeLattice(NamedTuple):
    """Instants, speeds and places.

    Attributes:
        begin: The first instant [s].
        step: From one to the next [s].
        origin: Place 0, as a distance along the path [m].
        pitch: From one place to the next [m]; half a quantum of the speed times a step.
        last: The last place, where the robot comes to rest.
        levels: The largest speed, in quanta.
        ups: By how many quanta it speeds up at most in a step.
        downs: By how many it slows down at most.
    """

    begin: float
    step: float
    origin: float
    pitch: float
    last: int
    levels: int
    ups: int
    downs: int


class Tube(NamedTuple):
    """What of the lattice is looked at: at each instant a run of places and of speeds.

    Attributes:
        words: Word of the first place, (n + 1,).
        slowest: Level, (n + 1,).
        fastest: Level, (n + 1,).
        width: Number of words of places.
    """

    words: Ints
    slowest: Ints
    fastest: Ints
    width: int


class Visited(NamedTuple):
    """What was reached.

    Attributes:
        rows: Places at each instant with each speed from which the next step can be begun,
            (n + 1, levels + 1, width).
        bands: First word of a row that isn't empty and the one after its last, equal if all are,
            (n + 1, levels + 1, 2).
        found: Steps at which the robot comes to rest at the last place and can stay, one for each
            time for which that is free, as far as there are any, (n + 1,).
        arrived: So many of them there are.
        steps: How many steps were taken.
        work: Words that were looked at.
        last_alive: The last step at which anything was reached.
        free_until: Until when the last place is known to be free [s],
        taken_until: and until when to be taken [s].
        is_over: Whether there is nothing more to be found, or to be spent.
    """

    rows: Words
    bands: Ints
    found: Ints
    arrived: int
    steps: int
    work: int
    last_alive: int
    free_until: float
    taken_until: float
    is_over: bool

    @property
    def arrivals(self) -> Ints:
        """Those that were found, (k,)."""
        return self.found[: self.arrived]


def unvisited(lattice: TimeLattice, tube: Tube) -> Visited:
    """The walk over a lattice before its first step."""
    steps = tube.words.size - 1
    bands = np.empty((steps + 1, lattice.levels + 1, 2), np.int64)
    bands[0] = 0  # those of a later step are made by the step before
    return Visited(
        np.empty((steps + 1, lattice.levels + 1, tube.width), np.uint64), bands,
        np.empty(steps + 1, np.int64), 0, 0, 0, -1, -np.inf, -np.inf, False,
    )  # fmt: skip


@kernel
def allowed_steps(lattice: TimeLattice, line: Floats, caps: Floats) -> Words:
    """The places from which a step with a speed and a change of it keeps the largest speeds.

    Args:
        lattice: TimeLattice.
        line: Ends of stretches of the path [m], increasing, (n + 1,).
        caps: The largest speed on each [m/s], (n,).

    Returns:
        (levels + 1, downs + ups + 1, w).
    """
    width = (lattice.last >> 6) + 1
    changes = lattice.downs + lattice.ups + 1
    room = np.zeros((lattice.levels + 1, changes, width), np.uint64)
    quantum = 2.0 * lattice.pitch / lattice.step
    for k in range(lattice.levels + 1):
        for c in range(changes):
            after = k + c - lattice.downs
            if 0 <= after <= lattice.levels:
                add_places(room[k], c, 0, lattice.last - k - after)
    for i in range(caps.size):
        slowest = int(np.floor(caps[i] / quantum + 1e-9)) + 1
        first = int(np.floor((line[i] - lattice.origin) / lattice.pitch + 1e-9))
        last = int(np.ceil((line[i + 1] - lattice.origin) / lattice.pitch - 1e-9))
        for k in range(max(slowest - lattice.ups, 0), lattice.levels + 1):
            for c in range(changes):
                after = k + c - lattice.downs
                if 0 <= after <= lattice.levels and max(k, after) >= slowest:
                    remove_places(room[k], c, first - k - after + 1, last - 1)
    return room


@inlined
def _leave(rows: Words, bands: Ints, n: int, tube: Tube, blocked: Words, middle: int) -> int:
    """Keep what isn't blocked in the middle of the step from n on; how many words were seen."""
    seen = 0
    row, line = np.uint64(n), np.uint64(middle)  # unsigned: numba then doesn't look for indices < 0
    for k in range(tube.slowest[n], tube.fastest[n] + 1):
        first, last = bands[n, k, 0], bands[n, k, 1]
        level, by = np.uint64(k), np.uint64(first + (k >> 6))
        right, left = np.uint64(k & 63), np.uint64(63 - (k & 63))
        begin = np.uint64(first)
        for i in range(np.uint64(last - first)):
            over = blocked[line, by + i] >> right
            over |= (blocked[line, by + i + ONE] << ONE) << left
            rows[row, level, begin + i] &= ~over
        seen += last - first
    return seen


@inlined
def _carry(
    rows: Words, n: int, before: int, k: int, low: int, high: int, room: int, apart: int,
    allowed: Words, change: int, base: int, buffer: Words,
) -> None:  # fmt: skip
    """Add to level k of step n + 1 what words low to high of a level of step n become.

    Args:
        rows: Of ``Visited``.
        n: The step.
        before: The level.
        k: The level after it.
        low: First word.
        high: The word after the last.
        room: Words of the row that is added to.
        apart: By so many words the later row begins farther on.
        allowed: Of ``allowed_steps``.
        change: Column of the change of the speed there.
        base: Where the earlier row begins, in words.
        buffer: Room for a row and ``PAD`` words on both sides.
    """
    whole = ((before + k) >> 6) - apart
    left, right = np.uint64((before + k) & 63), np.uint64(63 - ((before + k) & 63))
    now, then = np.uint64(n), np.uint64(n + 1)
    source, target, column = np.uint64(before), np.uint64(k), np.uint64(change)
    start, ahead, into = np.uint64(low), np.uint64(base + low), np.uint64(low + PAD)
    for i in range(np.uint64(high - low)):
        buffer[into + i] = rows[now, source, start + i] & allowed[source, column, ahead + i]
    buffer[low + PAD - 1] = NONE
    buffer[high + PAD] = NONE
    first = max(low + whole, 0)
    last = min(high + whole + 1, room)
    at, onto = np.uint64(first - whole + PAD), np.uint64(first)
    for i in range(np.uint64(max(last - first, 0))):
        word = (buffer[at + i] << left) | ((buffer[at + i - ONE] >> ONE) >> right)
        rows[then, target, onto + i] |= word


@inlined
def _arrive(
    rows: Words, bands: Ints, n: int, allowed: Words, lattice: TimeLattice, tube: Tube,
    blocked: Words, middle: int, buffer: Words,
) -> int:  # fmt: skip
    """Fill the rows of step n + 1 from those of step n; how many words were seen."""
    seen = 0
    room = min(tube.width, allowed.shape[2] - tube.words[n + 1])
    apart = tube.words[n + 1] - tube.words[n]
    then, line = np.uint64(n + 1), np.uint64(middle)
    for k in range(lattice.levels + 1):
        bands[n + 1, k, 0] = 0
        bands[n + 1, k, 1] = 0
    for k in range(tube.slowest[n + 1], tube.fastest[n + 1] + 1):
        slowest, fastest = max(k - lattice.ups, 0), min(k + lattice.downs, lattice.levels)
        low, high = room, 0
        for before in range(slowest, fastest + 1):
            if bands[n, before, 0] < bands[n, before, 1]:
                whole = ((before + k) >> 6) - apart
                low = min(low, bands[n, before, 0] + whole)
                high = max(high, bands[n, before, 1] + whole + 1)
        low, high = max(low, 0), min(high, room)
        if low >= high:
            continue
        for w in range(low, high):
            rows[n + 1, k, w] = NONE
        for before in range(slowest, fastest + 1):
            a, b = bands[n, before, 0], bands[n, before, 1]
            if a < b:
                seen += b - a
                _carry(
                    rows, n, before, k, a, b, room, apart, allowed, k - before + lattice.downs,
                    tube.words[n], buffer,
                )  # fmt: skip
        level, begin = np.uint64(k), np.uint64(low)
        for i in range(np.uint64(high - low)):
            rows[then, level, begin + i] &= ~blocked[line, begin + i]
        while low < high and rows[n + 1, k, low] == NONE:
            low += 1
        while low < high and rows[n + 1, k, high - 1] == NONE:
            high -= 1
        bands[n + 1, k, 0] = low
        bands[n + 1, k, 1] = high
    return seen


@inner
def _look_ahead(
    motion: PackedMotion, driving: Driving, tree: PathTree, lattice: TimeLattice, tube: Tube,
    n: int, blocked: Words,
) -> int:  # fmt: skip
    """Find what is blocked from step n on, for a chunk of steps."""
    for r in range(blocked.shape[0]):
        for w in range(blocked.shape[1]):
            blocked[r, w] = NONE
    bases = np.empty(2 * CHUNK + 1, np.int64)
    last = tube.words.size - 1
    lowest, highest = 1 << 60, 0
    for r in range(bases.size):
        bases[r] = 64 * tube.words[min(n + r // 2, last)]
        lowest, highest = min(lowest, bases[r]), max(highest, bases[r])
    widen = 0.25 * lattice.pitch * max(lattice.ups, lattice.downs)
    grid = PlaceGrid(
        lattice.begin + n * lattice.step, driving.step, lattice.origin, lattice.pitch, widen, bases
    )
    first = lattice.origin + (lowest - 1) * lattice.pitch
    end = lattice.origin + (highest + 64 * blocked.shape[1] + 1) * lattice.pitch
    end = min(end, lattice.origin + (lattice.last + 1) * lattice.pitch)
    return block_places(motion, driving, tree, first, end, grid, blocked)


@inner
def _begin(rows: Words, bands: Ints, n: int, level: int) -> None:
    """Add place 0 with a speed to what is reached at step n."""
    if bands[n, level, 0] == bands[n, level, 1]:
        bands[n, level, 1] = 1
        rows[n, level, 0] = NONE
    elif bands[n, level, 0] > 0:
        for w in range(bands[n, level, 0]):
            rows[n, level, w] = NONE
    bands[n, level, 0] = 0
    rows[n, level, 0] |= ONE


@kernel
def earliest_arrivals(
    motion: PackedMotion, driving: Driving, tree: PathTree, lattice: TimeLattice, tube: Tube,
    allowed: Words, begins: Flags, level: int, goal: Floats, stay: float, most: int, limit: int,
    visited: Visited, pause: int,
) -> tuple[int, int, int, int, float, float, bool]:  # fmt: skip
    """Walk on over the lattice until the robot has come to rest at its end.

    What it returns is a plain tuple: numba crashes where it is interrupted making any other.

    Args:
        motion: What moves.
        driving: What the law keeps, checked every half step.
        tree: The path.
        lattice: TimeLattice.
        tube: What of it is looked at.
        allowed: Of ``allowed_steps``.
        begins: At which steps it may begin, (n + 1,).
        level: With which speed it begins.
        goal: Where the last place is [m], (2,).
        stay: For how long it has to stay there [s].
        most: After so many arrivals it is enough.
        limit: Of the words that are looked at.
        visited: Of the steps before, to whose arrays those of the next are added; ``unvisited`` at
            first.
        pause: After so many words the walk stops, to be gone on with.

    Returns:
        What changes of ``visited`` besides its arrays, in its order.
    """
    rows, bands, arrivals = visited.rows, visited.bands, visited.found
    steps = tube.words.size - 1
    blocked = np.empty((2 * CHUNK + 1, tube.width + (lattice.levels >> 6) + 1), np.uint64)
    buffer = np.zeros(tube.width + 2 * PAD, np.uint64)
    found, work, last_alive, n = visited.arrived, visited.work, visited.last_alive, visited.steps
    free_until, taken_until = visited.free_until, visited.taken_until
    last_begin, is_over = -1, True
    for i in range(begins.size):
        if begins[i]:
            last_begin = i
    while n <= steps and work <= limit:
        if n % CHUNK == 0:
            if n > visited.steps and work > pause:
                is_over = False
                break
            work += 32 * _look_ahead(motion, driving, tree, lattice, tube, n, blocked)
        row = 2 * (n % CHUNK)
        if begins[n] and tube.words[n] == 0 and not has_place(blocked[row], 0):
            _begin(rows, bands, n, level)
        alive = False
        for k in range(tube.slowest[n], tube.fastest[n] + 1):
            alive = alive or bands[n, k, 0] < bands[n, k, 1]
        if alive:
            last_alive = n
        elif n >= last_begin:
            break
        at = lattice.last - 64 * tube.words[n]
        now = lattice.begin + n * lattice.step
        is_there = bands[n, 0, 0] <= at >> 6 < bands[n, 0, 1] and has_place(rows[n, 0], at)
        if is_there and now > free_until and now > taken_until:
            until, _ = standing_conflict(
                motion, driving.required, goal[0], goal[1], now, now + stay
            )
            if until == np.inf:
                arrivals[found] = n
                found += 1
                if found == most:
                    break
                free_until, _ = standing_conflict(
                    motion, driving.required, goal[0], goal[1], now,
                    lattice.begin + (steps + 1) * lattice.step,
                )  # fmt: skip
            else:
                taken_until = until
        if n < steps:
            work += _leave(rows, bands, n, tube, blocked, row + 1)
            work += _arrive(
                rows, bands, n, allowed, lattice, tube, blocked, row + 2, buffer
            )  # fmt: skip
        n += 1
    return found, n, work, last_alive, free_until, taken_until, is_over
