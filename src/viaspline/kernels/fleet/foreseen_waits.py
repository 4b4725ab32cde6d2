"""How long robots will wait for each other where no order is settled yet, foreseen from afar.

Of two orders the one that holds up less now may be the one that leads into more. What lies ahead is
reckoned by when robots are in each other's passages, not by their boxes; it proves nothing.

Tested through ``kernels/fleet/test_first_come_laws``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.expected_wait import expected_wait
from viaspline.kernels.fleet.order_state import OPEN, TOUCHED, OrderState
from viaspline.kernels.fleet.random_numbers import random_below
from viaspline.kernels.fleet.yielding_ride import RideScene
from viaspline.kernels.jit import inner, uncounted

SPREAD_S = 2.0
"""So much sooner or later robots come to a meeting than they do as yet: standard deviation [s]."""
NEAR_S = 8.0
"""Meetings that one of two robots misses by more are none [s]."""
LONG_S = 12.0
"""Nor are those of two that both drive along one stretch for longer: boxes say more of them [s]."""
STEPS = 1000
"""Chance is cut into so many steps to either side."""


class SeenAhead(NamedTuple):
    """What lies ahead, and how much it counts.

    Attributes:
        share: What a foreseen second counts beside one of lateness; 0: nothing is foreseen.
        chance: Up to so much that one order holds up more than another is passed over [s].
        known: What each robot will wait, or be waited for, by its law as it was kept [s], (n,).
        random: The state of the random numbers, (1,): written to.
    """

    share: float
    chance: float
    known: Floats
    random: Ints


@uncounted
def foreseen_wait(scene: RideScene, state: OrderState, robot: int) -> float:
    """What a robot will wait where no order is settled, or others for it, in the mean [s]."""
    courses, passages, laws = scene.courses, scene.passages, scene.laws
    first, last = courses.first[robot], courses.first[robot + 1] - 1
    total = 0.0
    for p in range(passages.first[robot], passages.first[robot + 1]):
        if state.rank[p] != OPEN:
            continue
        entry, after = passages.entry[p], passages.exit[p] + 1
        comes = laws.arrive[entry] if entry > first else -np.inf
        late = state.window[p, 1] - comes
        if late < -NEAR_S:
            continue
        goes = laws.arrive[after] if after < last else laws.leave[last]
        other_late = goes - state.window[p, 0]
        if other_late >= -NEAR_S and late + other_late <= LONG_S:
            total += expected_wait(late, other_late, SPREAD_S)
    return total


@uncounted
def more_foreseen(scene: RideScene, state: OrderState, sight: SeenAhead) -> float:
    """What a try counts for what then lies ahead of the robots that have other laws by it."""
    if sight.share <= 0.0:
        return 0.0
    total = 0.0
    for i in range(state.counts[TOUCHED]):
        robot = state.touched[i]
        if state.has_law[robot]:
            total += foreseen_wait(scene, state, robot) - sight.known[robot]
    return sight.share * total


@uncounted
def foresee_all(scene: RideScene, state: OrderState, movable: Flags, sight: SeenAhead) -> None:
    """Note what lies ahead of all robots that may be timed."""
    if sight.share > 0.0:
        for robot in range(movable.size):
            if movable[robot]:
                sight.known[robot] = foreseen_wait(scene, state, robot)


@uncounted
def foresee_touched(scene: RideScene, state: OrderState, sight: SeenAhead) -> None:
    """Note what lies ahead of the robots that a try touched, before it is kept."""
    if sight.share > 0.0:
        for i in range(state.counts[TOUCHED]):
            robot = state.touched[i]
            sight.known[robot] = foreseen_wait(scene, state, robot)


@inner
def chance_of(sight: SeenAhead) -> float:
    """By how much another order may hold up more this time, and be taken all the same [s]."""
    if sight.chance <= 0.0:
        return 0.0
    return sight.chance * (random_below(sight.random, 2 * STEPS + 1) - STEPS) / STEPS
