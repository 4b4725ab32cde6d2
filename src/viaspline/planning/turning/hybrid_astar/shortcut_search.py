"""The shortcuts of a chain that was found, as they are looked for: stopped, and gone on with."""

from __future__ import annotations

import math
from copy import copy

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.collision_cache import CollisionCache
from viaspline.kernels.turning.segment_chain import (
    TO_STATE,
    Shortcuts,
    look_for_shortcuts,
    merged,
    shortcut_states,
    with_shortcuts,
)

MAX_SHORTCUT_PASSES = 4
LEAST_PASS_GAIN = 1e-3  # share of its length that a pass has to save for another one
SHORTCUT_SPACING = 0.5  # between states on a line that shortcuts begin and end at, in radii,
MAX_SHORTCUT_STATES = 40  # but not many more than these
FIRST_SLICE, SLICE = 100, 2500  # efforts between which it can be stopped


class ShortcutSearch:
    """Passes over a chain, each of which shortens what the one before has left.

    Attributes:
        segments: The chain as the last pass has left it; see ``collision_cache``, (n, 3).
        length: Of the chain [m].
        is_over: Whether another pass isn't worth it.
        effort: What is done next, at most; see ``look_for_shortcuts``.
    """

    def __init__(
        self, cache: CollisionCache, start: Floats, goal: Floats, segments: Floats, rho: float,
        ramp: float,
    ) -> None:  # fmt: skip
        """Begin.

        Args:
            cache: Where the body may be.
            start: x, y, heading, (3,).
            goal: The same; a heading of NaN is free, (3,).
            segments: What was found, (n, 3).
            rho: The least radius [m].
            ramp: Length of the ramps [m].
        """
        self.segments, self.length, self.is_over = segments, math.inf, False
        self.effort = FIRST_SLICE
        self._cache, self._start, self._goal = cache, start, goal
        self._rho, self._ramp = rho, ramp
        self._passes = 0
        self._begin_pass()

    def _begin_pass(self) -> None:
        spacing = max(
            SHORTCUT_SPACING * self._rho, float(self.segments[:, 2].sum()) / MAX_SHORTCUT_STATES
        )
        segments = merged(self.segments, self._rho)
        self._parts, self._poses, self._begins = shortcut_states(
            self._start, self._goal, segments, spacing
        )
        count = len(self._poses)
        self._found = Shortcuts(
            np.zeros(count), np.zeros(count, np.int64), np.zeros((count, 2)), np.array([1, 0])
        )

    def copy(self) -> ShortcutSearch:
        """As far as it came: it and this one go on each by itself; one that is over is the same."""
        if self.is_over:
            return self
        search = copy(self)
        search._cache = self._cache.copied()
        costs, before, sides, cursor = self._found
        search._found = Shortcuts(costs.copy(), before.copy(), sides.copy(), cursor.copy())
        return search

    def go_on(self) -> None:
        """Try some more shortcuts."""
        effort, self.effort = self.effort, min(2 * self.effort, SLICE)
        look_for_shortcuts(
            self._cache, self._goal, self._poses, self._found, self._rho, self._ramp, effort
        )
        if self._found.cursor[TO_STATE] < len(self._poses):
            return
        self.segments = with_shortcuts(
            self._goal, self._parts, self._poses, self._begins, self._found, self._rho, self._ramp
        )
        self._passes += 1
        before, self.length = self.length, float(self.segments[:, 2].sum())
        has_gained = self.length <= (1.0 - LEAST_PASS_GAIN) * before
        self.is_over = not has_gained or self._passes == MAX_SHORTCUT_PASSES
        if not self.is_over:
            self._begin_pass()
