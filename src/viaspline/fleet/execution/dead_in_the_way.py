"""Where a robot that stands for ever may be in the way, and who is kept out of there.

A robot that dies may have come beyond what it was granted: it slipped, or its brakes failed. Where
it may stand in a crossing then the other robot must not count on passing first any more, even if
it was let in already: what it has been granted can't be taken away, but it is asked to do without.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.fleet_run import FleetEvent
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.open_bars import open_bars


def died(state: FleetProgressState, robot: int, until: float) -> FleetProgressState:
    """The state in which a robot stands for ever between its progress and a place [m].

    It passes first wherever it may be in the way, and last everywhere else. Events tell who may be
    there already, by what it was granted.
    """
    state = replace(state.copied(state.time), events=state.events)
    packed, orders = state.packed, state.orders.packed
    packed.fixed[robot] = state.out[robot] = True
    packed.promised[robot] = max(until, packed.progress[robot])
    crossings, others, is_near = _crossed(state, robot)
    asked = np.isin(packed.recall, crossings)  # to let it pass first, or it to let others
    packed.recall[asked], packed.recall_place[asked] = -1, np.inf
    before = packed.leaders[crossings]
    packed.leaders[crossings] = np.where(before < 0, before, np.where(is_near, robot, others))
    kept = np.unique(others[is_near & (before == others)])
    packed.head[kept] = orders.first[kept]  # some of their bars count now
    packed.recalled_at[kept] = state.time
    open_bars(orders, packed)
    let_in = kept[_closed_at(state)[kept] < packed.promised[kept]]
    events = _told(state, robot, let_in)
    return replace(state, events=(*state.events, *events))


def _told(state: FleetProgressState, robot: int, let_in: Ints) -> list[FleetEvent]:
    """What is told of a dead robot, and of those that were let in where it may be."""
    names, now = state.orders.names, state.time
    name = names[robot]
    events = [FleetEvent("dead", now, name, f"{name} is dead and stands in the way")]
    for other in let_in.tolist():
        words = f"{names[other]} was let in where {name} may stand, and is asked to stop"
        events.append(FleetEvent("stops", now, names[other], words, name))
    return events


def let_past_dead(state: FleetProgressState) -> None:
    """Who has come past a dead robot waits for it no more.

    Args:
        state: It is written to.
    """
    packed = state.packed
    is_dead = packed.fixed & (packed.progress < np.inf)
    for robot in np.flatnonzero(is_dead).tolist():
        crossings, others, is_near = _crossed(state, robot)
        past = ~is_near & (packed.leaders[crossings] == robot)
        packed.leaders[crossings[past]] = others[past]


def hold_before_closed(state: FleetProgressState) -> None:
    """Ask robots to stop before what they were granted, where they are to pass no more.

    What they say that they hold counts from then on, and not what they were granted before.

    Args:
        state: It is written to.
    """
    packed = state.packed
    closed = _closed_at(state)
    is_let = ~packed.fixed & (closed < packed.promised)
    packed.halt[is_let] = np.minimum(packed.halt, closed)[is_let]


def _crossed(state: FleetProgressState, robot: int) -> tuple[Ints, Ints, Flags]:
    """The crossings of a dead robot, with whom, and whether it may be in that one's way.

    It may be where it has come as far as a bar of its own, and the other one hasn't passed yet;
    who begins in a crossing is in it.

    Returns:
        Crossings, the other robots, and whether it may be in their way, (k,) each.
    """
    packed, orders = state.packed, state.orders.packed
    own = slice(int(orders.first[robot]), int(orders.first[robot + 1]))
    place, other = orders.place[own], orders.other[own]
    may_be_in = (place < packed.promised[robot]) | (place <= 0.0)
    may_be_in &= packed.progress[other] < orders.passed[own]
    crossings, index = np.unique(orders.crossing[own].astype(np.int64), return_inverse=True)
    is_near = np.zeros(len(crossings), np.bool_)
    is_near[index[may_be_in]] = True
    others = np.zeros(len(crossings), np.int64)
    others[index] = other
    return crossings, others, is_near


def _closed_at(state: FleetProgressState) -> Floats:
    """The place of each robot's first bar that isn't open; infinite: all are, (n,) [m]."""
    head, orders = state.packed.head, state.orders.packed
    found = np.full(len(head), np.inf)
    has = np.flatnonzero(head < orders.first[1:])
    found[has] = orders.place[head[has]]
    return found
