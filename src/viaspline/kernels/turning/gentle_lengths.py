"""How long turns are that bend least, where each two that follow each other share a line.

A turn by t with ramps alone, of the length l, bends by 4 t² / 3 l, and is longer than the corner
that it touches by t² l / 40. Without lines that are too short, the same l is best for all turns.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel

LONGER = 40.0  # a turn by t, t² l over this is what it is longer than its corner
ENOUGH = 0.95  # of what may be spent
MAX_SPENDING_ROUNDS = 6
MOST_RAISED = 3.0  # from one of them to the next
MAX_SWEEPS = 20
MAX_NEWTON_STEPS = 12
SETTLED = 1e-6  # of a price's or a length's relative change


@inner
def _length(turn: float, price: float) -> float:
    """Of a turn, as every metre of it is priced."""
    return turn / math.sqrt(price) if turn > 0.0 else 0.0


@inner
def _price_of_line(turns: Floats, prices: Floats, i: int, k: int, room: float) -> float:
    """The least price of a line at which the turns at its ends leave each other room.

    Args:
        turns: [rad], (n,).
        prices: Of the turns without that of this line, (n,).
        i: The turn before it.
        k: The turn after it.
        room: That there is for the lengths of both [m].
    """
    price = 0.0
    for _ in range(MAX_NEWTON_STEPS):  # 1 / length² is nearly straight and concave: from below
        before, after = prices[i] + price, prices[k] + price
        first, second = _length(turns[i], before), _length(turns[k], after)
        both = first + second
        if both <= (1.0 + SETTLED) * room:
            break
        slope = first / before if first > 0.0 else 0.0
        slope += second / after if second > 0.0 else 0.0
        price += both * ((both / room) ** 2 - 1.0) / slope
    return price


@inner
def _shared(turns: Floats, rooms: Floats, closed: bool, top: float, lines: Floats,
            lengths: Floats) -> None:  # fmt: skip
    """The lengths of turns that bend least, none longer than ``top``; the lines' prices are kept.

    Args:
        turns: [rad], none negative, (n,).
        rooms: What the turns before and after each line may be long together [m], (m,).
        closed: Whether the last turn is followed by the first.
        top: [m].
        lines: Prices of the lines, (m,); changed.
        lengths: [m], (n,); filled.
    """
    count, last = turns.shape[0], rooms.shape[0]
    prices = np.empty(count)
    for _ in range(MAX_SWEEPS):
        moved = 0.0
        for j in range(last):
            k = (j + 1) % count
            for at in (j, k):
                prices[at] = (turns[at] / top) ** 2
                if at < last and at != j:
                    prices[at] += lines[at]
                if (at > 0 or closed) and (at - 1) % count != j:
                    prices[at] += lines[(at - 1) % count]
            price = _price_of_line(turns, prices, j, k, rooms[j])
            moved = max(moved, abs(price - lines[j]) / max(price, lines[j], 1e-300))
            lines[j] = price
        if moved < SETTLED:
            break
    for k in range(count):
        price = (turns[k] / top) ** 2
        if k < last:
            price += lines[k]
        if k > 0 or closed:
            price += lines[(k - 1) % count]
        lengths[k] = _length(turns[k], price)


@kernel
def gentle_lengths(turns: Floats, rooms: Floats, closed: bool, spent: float) -> Floats:
    """The lengths with which turns bend least together.

    Args:
        turns: By how much the path turns [rad], none negative, (n,).
        rooms: What the turns before and after each line may be long together [m], more than 0,
            (n - 1,), or (n,) when closed.
        closed: Whether the last turn is followed by the first.
        spent: By how much the path may be longer than its corners [m].

    Returns:
        [m], (n,); 0 where it doesn't turn.
    """
    lengths, lines = np.zeros(turns.shape[0]), np.zeros(rooms.shape[0])
    square = 0.0
    for k in range(turns.shape[0]):
        square += turns[k] ** 2
    if square == 0.0 or rooms.shape[0] == 0:
        return lengths
    top = LONGER * spent / square
    for _ in range(MAX_SPENDING_ROUNDS):
        _shared(turns, rooms, closed, top, lines, lengths)
        longer = 0.0
        for k in range(turns.shape[0]):
            longer += turns[k] ** 2 * lengths[k] / LONGER
        if longer >= ENOUGH * spent or longer == 0.0:
            break
        top *= min(spent / longer, MOST_RAISED)
    return lengths
