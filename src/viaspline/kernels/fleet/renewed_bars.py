"""The bars of a fleet of which some crossings are others than before, in one pass over all bars.

Both are in order, and no crossing is in both: they are merged, not sorted, and what is known of
those that stay isn't reckoned again.

Tested through ``fleet/execution/test_grown_orders``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Ints
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.growable import new_floats, new_steps
from viaspline.kernels.jit import inlined, inner, kernel


@inner
def _changes(old: PackedOrders, number: Ints, fresh: PackedOrders) -> Flags:
    """Which robots have other bars than before, (n,)."""
    changed = np.empty(fresh.first.size - 1, np.bool_)
    for robot in range(changed.size):
        changed[robot] = fresh.first[robot + 1] > fresh.first[robot]
    for c in range(number.size):
        if number[c] < 0:
            changed[old.robots[c, 0]] = changed[old.robots[c, 1]] = True
    return changed


@inner
def _bar_counts(old: PackedOrders, number: Ints, fresh: PackedOrders, changed: Flags) -> Ints:
    """Where the bars of each robot begin, (n + 1,)."""
    first = np.zeros(changed.size + 1, np.int64)
    for robot in range(changed.size):
        count = fresh.first[robot + 1] - fresh.first[robot]
        if robot < old.first.size - 1:
            begin, end = old.first[robot], old.first[robot + 1]
            if not changed[robot]:
                count += end - begin
            else:
                for i in range(begin, end):
                    if number[old.crossing[i]] >= 0:
                        count += 1
        first[robot + 1] = first[robot] + count
    return first


@inlined
def _put(to: PackedOrders, at: int, source: PackedOrders, i: int, crossing: int) -> None:
    to.place[at], to.other[at] = source.place[i], source.other[i]
    to.passed[at], to.crossing[at] = source.passed[i], crossing
    to.comes[at], to.other_comes[at] = source.comes[i], source.other_comes[i]


@inner
def _put_all(to: PackedOrders, old: PackedOrders, number: Ints, robot: int) -> None:
    """Copy the bars of a robot that keeps them all, an array after the other."""
    begin, end = old.first[robot], old.first[robot + 1]
    at, behind = to.first[robot], to.first[robot + 1]
    to.place[at:behind] = old.place[begin:end]
    to.other[at:behind] = old.other[begin:end]
    to.passed[at:behind] = old.passed[begin:end]
    to.comes[at:behind] = old.comes[begin:end]
    to.other_comes[at:behind] = old.other_comes[begin:end]
    for i in range(begin, end):
        to.crossing[at + i - begin] = number[old.crossing[i]]


@inner
def _merge(
    to: PackedOrders, old: PackedOrders, number: Ints, fresh: PackedOrders, changed: Flags
) -> None:
    """Put the bars of all robots in their order."""
    for robot in range(changed.size):
        if not changed[robot]:
            if robot < old.first.size - 1:
                _put_all(to, old, number, robot)
            continue
        at, j, news = to.first[robot], fresh.first[robot], fresh.first[robot + 1]
        begin, end = 0, 0
        if robot < old.first.size - 1:
            begin, end = old.first[robot], old.first[robot + 1]
        for i in range(begin, end):
            crossing = number[old.crossing[i]]
            if crossing < 0:
                continue
            while j < news and (
                fresh.place[j] < old.place[i]
                or (fresh.place[j] == old.place[i] and fresh.crossing[j] < crossing)
            ):
                _put(to, at, fresh, j, fresh.crossing[j])
                at, j = at + 1, j + 1
            _put(to, at, old, i, crossing)
            at += 1
        while j < news:
            _put(to, at, fresh, j, fresh.crossing[j])
            at, j = at + 1, j + 1


@kernel
def renewed_bars(old: PackedOrders, number: Ints, fresh: PackedOrders) -> PackedOrders:
    """The bars of a fleet: those of crossings that stay, and those of others.

    Args:
        old: PackedOrders, from before.
        number: What number each crossing of these has now; -1 if its bars don't stay, (c,).
        fresh: PackedOrders of the fleet as it is with the other bars alone; robots that weren't
            there before come behind the others.

    Returns:
        What ``fresh`` says, with all bars.
    """
    changed = _changes(old, number, fresh)
    first = _bar_counts(old, number, fresh, changed)
    bars = first[first.size - 1]
    to = PackedOrders(
        first, new_floats(bars, 1)[:, 0], new_steps(bars, 1)[:, 0], new_floats(bars, 1)[:, 0],
        new_steps(bars, 1)[:, 0], new_floats(bars, 1)[:, 0], new_floats(bars, 1)[:, 0],
        fresh.robots, fresh.final, fresh.most, fresh.may_lead, fresh.length, fresh.vanishes,
        fresh.short,
    )  # fmt: skip
    _merge(to, old, number, fresh, changed)
    return to
