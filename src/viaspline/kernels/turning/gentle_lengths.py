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
def _price_of_line(first: float, second: float, before: float, after: float, room: float,
                   price: float) -> float:  # fmt: skip
    """The least price of a line at which the turns at its ends leave each other room.

    Args:
        first: The turn before it [rad].
        second: The turn after it [rad].
        before: Price of the turn before it, without that of this line.
        after: The same of the turn after it.
        room: That there is for the lengths of both [m].
        price: A guess.
    """
    for _ in range(MAX_NEWTON_STEPS):  # 1 / length² is nearly straight and concave: from below
        one, two = _length(first, before + price), _length(second, after + price)
        both = one + two
        if both <= (1.0 + SETTLED) * room and (price == 0.0 or both >= (1.0 - SETTLED) * room):
            break
        slope = one / (before + price) if one > 0.0 else 0.0
        slope += two / (after + price) if two > 0.0 else 0.0
        price = max(price + both * ((both / room) ** 2 - 1.0) / slope, 0.0)
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
    least = np.empty(count)
    for k in range(count):
        least[k] = (turns[k] / top) ** 2
    for _ in range(MAX_SWEEPS):
        moved = 0.0
        for j in range(last):
            k = (j + 1) % count
            before, after = least[j], least[k]
            if j > 0 or closed:
                before += lines[(j - 1) % count]
            if k < last and k != j:
                after += lines[k]
            price = _price_of_line(turns[j], turns[k], before, after, rooms[j], lines[j])
            moved = max(moved, abs(price - lines[j]) / max(price, lines[j], 1e-300))
            lines[j] = price
        if moved < SETTLED:
            break
    for k in range(count):
        price = least[k]
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
