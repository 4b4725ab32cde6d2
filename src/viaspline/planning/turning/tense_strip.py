"""A strip under tension between what stands beside it: places on rays across it.

Tested through ``planning/methods/test_bent_gently``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.turning.bent_strip import bent_strip
from viaspline.kernels.turning.strip_places import sharpest_step, strip_normals, strip_places
from viaspline.kernels.turning.strip_room import strip_room
from viaspline.kernels.turning.strip_spans import strip_spans
from viaspline.planning.turning.bendable_run import BendableRun, LaidRun
from viaspline.world.world import World

STEP = 6.0  # between places, in required distances, at most
LEAST_PLACES, MOST_PLACES = 16, 400  # of a leg, of the path
TURN_RAD = 0.2  # from place to place, at most
FINE = 2.0  # of both: where a strip is laid in the end
SLACK = 1e-3  # of what is required, that is kept beyond it
LEAST_ROOM_M = 1e-5  # between bounds, where there is none
TOUCHES = 5e-3  # of what is required: less room than that is a touch
MOST_TURNED = 0.3  # that a step is turned by at once [rad]
KINK_RAD = 1.0  # from step to step
LITTLE_TURNED = 0.03  # the same, for which places need not be laid anew [rad]


@dataclass(frozen=True, eq=False)
class TenseStrip:
    """A strip, and what is known of the room on both sides of it.

    Attributes:
        run: The run of a path that it began as.
        world: What to keep clear of.
        required: What is kept from it [m].
        fineness: By how much nearer to each other places are than usual.
        places: [m], (n, 2).
        joints: Which of them are via points, (k,).
        fixed: Which of them stay, (n,): via points, and those beside given ends, which the spline
            lays.
        normals: Along which they move, to the left, (n, 2).
        spans: The curve through them: Bézier control polygons [m], (n - 1, 4, 2).
        low: How far to the left each has to move at least [m], (n,).
        high: How far at most [m], (n,).
        reach: How far at once, either way [m], (n,).
        rooms: The room beyond what is required about each of them [m], (n,).
    """

    run: BendableRun
    world: World
    required: float
    fineness: float
    places: Floats
    joints: Ints
    fixed: Flags
    normals: Floats
    spans: Floats
    low: Floats
    high: Floats
    reach: Floats
    rooms: Floats

    @classmethod
    def along(cls, run: BendableRun, world: World, required: float) -> TenseStrip:
        """A strip as a run of a path lies."""
        return cls._placed(run, world, required, 1.0, run.laid.spans, run.laid.joints)

    @classmethod
    def _placed(
        cls, run: BendableRun, world: World, required: float, fineness: float, spans: Floats,
        joints: Ints,
    ) -> TenseStrip:  # fmt: skip
        """A strip as a curve lies, without what was known of the room beside it."""
        places, joints = strip_places(
            spans, joints, STEP * required / fineness, TURN_RAD / fineness, LEAST_PLACES,
            MOST_PLACES,
        )  # fmt: skip
        low, high = np.full(len(places), -np.inf), np.full(len(places), np.inf)
        normals = strip_normals(places, run.closed)
        fixed: Flags = np.zeros(len(places), np.bool_)
        fixed[joints] = True
        for beside, end in ((1, run.ends[0]), (-2, run.ends[1])):
            fixed[beside] |= not math.isnan(end[0])
        known = run, world, required, fineness
        return cls._looking(*known, places, joints, fixed, normals, low, high)

    @classmethod
    def _looking(
        cls, run: BendableRun, world: World, required: float, fineness: float, places: Floats,
        joints: Ints, fixed: Flags, normals: Floats, low: Floats, high: Floats,
    ) -> TenseStrip:  # fmt: skip
        """A strip at places, with a look at the room that it has there."""
        spans = strip_spans(places, normals, run.ends, run.closed)
        reach, rooms = np.empty(len(places)), np.empty(len(places))
        strip_room(
            world.packed, places, normals, spans, (1.0 + SLACK) * required, low, high, reach, rooms
        )
        return cls(run, world, required, fineness, places, joints, fixed, normals, spans, low, high,
                   reach, rooms)  # fmt: skip

    def finer(self) -> TenseStrip:
        """It with places nearer to each other."""
        return self._placed(self.run, self.world, self.required, FINE, self.spans, self.joints)

    @property
    def room(self) -> float:
        """The least room beyond what is required [m]."""
        return float(self.rooms.min())

    @property
    def has_kink(self) -> bool:
        """Whether it turns so much from step to step that it is no curve any more."""
        return not float(sharpest_step(self.places)) < KINK_RAD

    @property
    def laid(self) -> LaidRun:
        """It as a run of a path, with a detour via point wherever it touches something."""
        around = np.r_[np.inf, self.rooms, np.inf]
        lowest = (self.rooms < around[:-2]) & (self.rooms <= around[2:])
        touches = np.flatnonzero(lowest & (self.rooms < TOUCHES * self.required))
        return LaidRun(self.spans, self.joints, touches[touches < len(self.spans)])

    def bent(self, tension: float) -> tuple[TenseStrip, float]:
        """It with its places moved to where that costs least.

        Args:
            tension: What a metre of length is priced at [1/m²].

        Returns:
            It, and by how much it moved at most [m].
        """
        lower, upper = np.maximum(self.low, -self.reach), np.minimum(self.high, self.reach)
        tight = lower > upper - LEAST_ROOM_M
        middle = 0.5 * (lower[tight] + upper[tight])
        lower[tight], upper[tight] = middle - LEAST_ROOM_M, middle + LEAST_ROOM_M
        moved, _, turned = bent_strip(
            self.places, self.normals, lower, upper, self.fixed, self.run.closed, tension
        )
        moved *= min(1.0, MOST_TURNED / max(turned, 1e-12))
        most, places = float(np.abs(moved).max()), self.places + moved[:, None] * self.normals
        known = self.run, self.world, self.required, self.fineness
        if turned > LITTLE_TURNED:
            spans = strip_spans(places, self.normals, self.run.ends, self.run.closed)
            return self._placed(*known, spans, self.joints), most
        low, high = self.low - moved, self.high - moved
        at = self.joints, self.fixed, self.normals
        return self._looking(*known, places, *at, low, high), most
