"""When something that moves is as near to a place as it comes there, or nearer than is said.

Tested through ``robot/simulation/test_standstills``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.motion import packed_motion as columns
from viaspline.kernels.motion.packed_motion import PackedMotion
from viaspline.world.moving_obstacles import MovingObstacles

RESOLUTION_S = 1.0
"""What isn't known to be far for so short a time is taken to be near [s];"""

ROUND_RESOLUTION_S = 0.01
"""for so short a time where it is so in every round of a motion that goes on and on [s]."""

SETTLES_S = 60.0
"""What stands from some time on is near for no longer than this: nothing changes any more [s]."""

MOST_PARTS = 500_000
"""Where so many parts of a time would have to be looked at, all of it counts as near."""

Gaps = Callable[[Floats], Floats]
"""How far something is from a body that stands, at times [s], (n,): [m], (n,)."""


@dataclass(frozen=True, eq=False)
class _Parts:
    """Parts of a time, in each of which something goes on without a jump.

    Attributes:
        begins: [s], (n,).
        ends: [s], (n,).
        rates: By how much its distance changes at most [m/s], (n,).
    """

    begins: Floats
    ends: Floats
    rates: Floats

    def some(self, wanted: Flags) -> _Parts:
        """Those of them that are wanted, (n,) of bool."""
        return _Parts(self.begins[wanted], self.ends[wanted], self.rates[wanted])

    def halved(self) -> _Parts:
        """Each as two."""
        middles = 0.5 * (self.begins + self.ends)
        return _Parts(
            np.concatenate((self.begins, middles)), np.concatenate((middles, self.ends)),
            np.concatenate((self.rates, self.rates)),
        )  # fmt: skip


def near_times(
    moving: MovingObstacles, index: int, gaps: Gaps, begin: float, end: float,
    within: float | None = None,
) -> list[tuple[float, float]]:  # fmt: skip
    """Times in which one of what moves may be near, in no order; in all others it is not.

    Args:
        moving: All that moves.
        index: Which of them.
        gaps: Its distances; what it may be off is taken off them.
        begin: From when on it is looked at [s].
        end: Until when [s].
        within: What is nearer is near [m]; None: what is as near as it comes, and what touches.
    """
    packed = moving.packed
    period = float(packed.rounds[index, 1])
    if not 0.0 < 3.0 * period < end - begin:
        found, _ = _near_parts(_parts(packed, index, begin, end), gaps, within, RESOLUTION_S)
        return found
    # all rounds are like one of them, but that what grows less certain comes nearer in each
    grows = float(packed.errors[index, columns.GROWTH]) > 0.0
    since, until = (end - 2.0 * period, end) if grows else (begin, begin + 2.0 * period)
    parts = _parts(packed, index, since, until)
    found, touches = _near_parts(parts, gaps, within, ROUND_RESOLUTION_S)
    return [(begin, end)] if touches or (within is not None and found) else found


def _parts(packed: PackedMotion, index: int, begin: float, end: float) -> _Parts:
    """The pieces of a motion between two times."""
    rows = packed.pieces[packed.first_piece[index] : packed.first_piece[index + 1]]
    began, period = packed.rounds[index].tolist()
    starts = rows[:, columns.BEGINS]
    rates = np.hypot(rows[:, columns.SPEED_X], rows[:, columns.SPEED_Y])
    rates = rates + packed.reaches[index] * np.abs(rows[:, columns.TURNING])
    rates += packed.errors[index, columns.GROWTH]
    if period > 0.0:
        first, last = (math.floor((time - began) / period) for time in (begin, end))
        rounds = np.arange(first, last + 1)
        starts = (starts + period * rounds[:, None]).ravel()
        rates = np.tile(rates, len(rounds))
    starts = np.clip(starts, begin, end)
    ends = np.append(starts[1:], end)
    return _Parts(starts, ends, rates).some(ends > starts)


def _near_parts(
    parts: _Parts, gaps: Gaps, within: float | None, resolution: float
) -> tuple[list[tuple[float, float]], bool]:
    """Those in which something is near, as short as the resolution [s], and whether it touches."""
    least, touches = math.inf if within is None else within, False
    found: list[tuple[float, float]] = []
    while len(parts.begins):
        if len(parts.begins) > MOST_PARTS:
            return [(float(parts.begins.min()), float(parts.ends.max())), *found], True
        # at its end begins what comes after it
        late = 1e-9 + 1e-12 * np.abs(parts.ends)
        lasts = np.maximum(parts.ends - late, parts.begins)
        first, last = np.split(gaps(np.concatenate((parts.begins, lasts))), 2)
        if within is None:
            least = min(least, float(first.min()), float(last.min()))
        bounds = 0.5 * (first + last - parts.rates * (parts.ends - parts.begins + 2.0 * late))
        is_far = (bounds >= least) & ((bounds > 0.0) | (within is not None))
        stands = ~is_far & (parts.rates == 0.0)
        settled = np.minimum(parts.ends, parts.begins + SETTLES_S)
        if within is None:
            settled = np.where(first > 0.0, parts.begins, settled)
        is_short = ~(is_far | stands) & (parts.ends - parts.begins <= resolution)
        touches = touches or bool((bounds[stands | is_short] <= 0.0).any())
        found += zip(parts.begins[stands].tolist(), settled[stands].tolist(), strict=True)
        found += zip(parts.begins[is_short].tolist(), parts.ends[is_short].tolist(), strict=True)
        parts = parts.some(~(is_far | stands | is_short)).halved()
    return found, touches
