"""Where a robot without inertia could be, whatever it does: if that is nowhere, there is no law.

Every place stands for what lies within half a pitch of it. It counts as blocked if something is
nearer to it than required by a pitch, so all that it stands for is blocked, with another half of a
pitch for how finely shapes are told. In a step the robot goes on by any number of places up to what
its largest speed allows.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.motion.packed_motion import PackedMotion
from viaspline.kernels.timing.yielding.bit_rows import (
    NONE,
    ONE,
    Words,
    has_place,
    remove_places,
)
from viaspline.kernels.timing.yielding.blocked_places import Driving, PlaceGrid, block_places
from viaspline.kernels.timing.yielding.near_miss import standing_conflict
from viaspline.kernels.timing.yielding.path_tree import PathTree

CHUNK_STEPS: Final = 64
LOOK_WORDS: Final = 32  # what a look at what moves costs, in words


class Reached(NamedTuple):
    """How far a robot without inertia has come.

    Attributes:
        can_arrive: Whether it may come to the last place and stay there.
        last_alive: The last step at which it may be anywhere.
        places: Where it may be then, (1, w).
        step: The step that is walked next; behind all of them when the walk is over.
        taken_until: Until when the last place is known to be taken [s].
        work: Words that were looked at.
    """

    can_arrive: bool
    last_alive: int
    places: Words
    step: int
    taken_until: float
    work: int

    @property
    def ends(self) -> tuple[int, int]:
        """The first place where it may be and the last; -1 and -1: there is none."""
        bits = np.unpackbits(self.places.astype("<u8").view(np.uint8), bitorder="little")
        there = np.flatnonzero(bits)
        return (int(there[0]), int(there[-1])) if there.size else (-1, -1)


def unmoved(count: int) -> Reached:
    """The walk before its first step, at place 0 of 0 to count."""
    places = np.zeros((1, (count >> 6) + 1), np.uint64)
    places[0, 0] = ONE
    return Reached(False, -1, places, 0, -np.inf, 0)


@inner
def _spread(places: Words, spare: Words, by: int) -> None:
    """Let every place of a row (1, w) reach as many of the following ones."""
    count = places.shape[1]
    reached = 0
    while reached < by:
        more = min(reached + 1, by - reached)
        whole, part = more >> 6, more & 63
        for w in range(count):
            spare[0, w] = NONE
            if w - whole >= 0:
                spare[0, w] = places[0, w - whole] << np.uint64(part)
            if w - whole - 1 >= 0:
                spare[0, w] |= (places[0, w - whole - 1] >> ONE) >> np.uint64(63 - part)
        for w in range(count):
            places[0, w] |= spare[0, w]
        reached += more


@kernel
def reachable_places(
    motion: PackedMotion, required: float, tree: PathTree, begin: float, step: float,
    origin: float, pitch: float, count: int, ahead: int, behind: Floats, front: Floats,
    goal: Floats, stay: float, reached: Reached, limit: int,
) -> tuple[bool, int, int, float, int]:  # fmt: skip
    """Where a robot without inertia may be, step by step, some steps on.

    What it returns is a plain tuple: numba crashes where it is interrupted making any other.

    Args:
        motion: What moves.
        required: From the robot's centre to every shape [m].
        tree: The path; its misses with the other sign.
        begin: The first instant [s].
        step: From one to the next [s].
        origin: Place 0, as a distance along the path [m].
        pitch: From one place to the next [m].
        count: The last place.
        ahead: How many places it goes on in a step at most.
        behind: At every instant no law is less far along the path than this [m], (n,).
        front: Or farther [m], (n,).
        goal: Where the last place is [m], (2,).
        stay: For how long it has to stay there [s].
        reached: Of the steps before; ``unmoved`` at first. Its places become those of the last
            step at which the robot may be anywhere.
        limit: No more steps are begun once so many words were looked at in all; at least
            ``CHUNK_STEPS`` are walked.

    Returns:
        What changes of ``reached`` besides, in its order.
    """
    width = (count >> 6) + 1
    places, spare = reached.places.copy(), np.zeros((1, width), np.uint64)
    kept = reached.places
    blocked = np.empty((CHUNK_STEPS, width), np.uint64)
    driving = Driving(required - pitch - 1e-8, 0.0, 0.0, 0.0, 0.0)
    last_alive, taken_until, work = reached.last_alive, reached.taken_until, reached.work
    end = origin + (count + 1) * pitch
    for n in range(reached.step, behind.size):
        row = n % CHUNK_STEPS
        now = begin + n * step
        if row == 0:
            if n > reached.step and work > limit:
                return False, last_alive, n, taken_until, work
            for r in range(CHUNK_STEPS):
                for w in range(width):
                    blocked[r, w] = NONE
            grid = PlaceGrid(now, step, origin, pitch, 0.0, np.zeros(CHUNK_STEPS, np.int64))
            work += LOOK_WORDS * block_places(
                motion, driving, tree, origin - pitch, end, grid, blocked
            )
            work += CHUNK_STEPS * width * (ahead + 4)
        if n > 0:
            _spread(places, spare, ahead)
        remove_places(places, 0, 0, int(np.floor((behind[n] - origin) / pitch - 0.5 - 1e-6)))
        far = int(np.ceil((front[n] - origin) / pitch + 0.5 + 1e-6))
        remove_places(places, 0, far, 64 * width)
        remove_places(places, 0, count + 1, 64 * width)
        alive = False
        for w in range(width):
            places[0, w] &= ~blocked[row, w]
            alive = alive or places[0, w] != NONE
        if not alive:
            break
        last_alive = n
        for w in range(width):
            kept[0, w] = places[0, w]
        if now > taken_until and has_place(places[0], count):
            taken_until, _ = standing_conflict(
                motion, driving.required, goal[0], goal[1], now, now + stay
            )
            if taken_until == np.inf:
                return True, n, behind.size, taken_until, work
    return False, last_alive, behind.size, taken_until, work
