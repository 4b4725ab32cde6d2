"""A strip under tension in the place of a run of a path.

Tested through ``planning/methods/test_bent_gently``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.turning.settled_strip import StripPlaces, placed_strip, settled_strip
from viaspline.kernels.turning.strip_places import has_kink, places_apart
from viaspline.kernels.turning.strip_spans import strip_spans
from viaspline.kernels.turning.swept_sides import StripBody
from viaspline.planning.turning.bendable_run import BendableRun, LaidRun
from viaspline.world.world import World

FINE = 2.0  # by how much nearer to each other places are where a strip is laid in the end
TOUCHES = 5e-3  # of what is required: less room than that is a touch


@dataclass(frozen=True, eq=False)
class TenseStrip:
    """A strip in a world.

    Attributes:
        run: The run of a path that it began as.
        world: What to keep clear of.
        body: What drives along it.
        fineness: By how much nearer to each other its places are than usual.
        strip: Its places, and what is known of the room on both sides of it.
        is_settled: Whether its places rest.
    """

    run: BendableRun
    world: World
    body: StripBody
    fineness: float
    strip: StripPlaces
    is_settled: bool = False

    @classmethod
    def along(
        cls, run: BendableRun, world: World, body: StripBody, fineness: float
    ) -> TenseStrip:  # fmt: skip
        """A strip as a run of a path lies."""
        laid = run.laid
        strip = placed_strip(
            world.packed, body, run.ends, run.closed, fineness, laid.spans, laid.joints
        )  # fmt: skip
        return cls(run, world, body, fineness, strip)

    def finer(self) -> TenseStrip:
        """It with places nearer to each other."""
        run, fineness = self.run, FINE * self.fineness
        strip = placed_strip(
            self.world.packed, self.body, run.ends, run.closed, fineness, self.spans, self.joints
        )  # fmt: skip
        return TenseStrip(run, self.world, self.body, fineness, strip)

    def settled(self, tension: float, settled: float, sharp: float = math.inf) -> TenseStrip:
        """It with its places moved to where that costs least, for some rounds at most.

        Args:
            tension: What a metre of length is priced at [1/m²].
            settled: It rests where no place moves by more, in required distances.
            sharp: Curvature beyond which bending is dearer [1/m].
        """
        strip, is_settled = settled_strip(
            self.world.packed, self.body, self.run.ends, self.fineness, self.strip, tension, sharp,
            settled,
        )  # fmt: skip
        return TenseStrip(self.run, self.world, self.body, self.fineness, strip, is_settled)

    @property
    def spans(self) -> Floats:
        """The curve through its places: Bézier control polygons [m], (n - 1, 4, 2)."""
        return self.strip.spans

    @property
    def joints(self) -> Ints:
        """Which of its places are via points, (k,)."""
        return self.strip.joints

    @property
    def has_kink(self) -> bool:
        """Whether it turns so much from step to step that it is no curve any more."""
        return bool(has_kink(self.strip.places))

    @property
    def with_places_apart(self) -> TenseStrip:
        """It without places that lie on others: the curve would turn to and fro between them.

        Between via points that are closer together than a turn they may come to lie so. As it is
        where there are none.
        """
        strip = self.strip
        left = places_apart(strip.places, strip.joints, self.body.required)
        if len(left) == len(strip.places):
            return self
        places, normals = strip.places[left], strip.normals[left]
        apart = strip._replace(
            places=places,
            joints=np.searchsorted(left, strip.joints),
            fixed=strip.fixed[left],
            normals=normals,
            spans=strip_spans(places, normals, self.run.ends, strip.closed),
            low=strip.low[left],
            high=strip.high[left],
            reach=strip.reach[left],
            rooms=strip.rooms[left],
        )
        return replace(self, strip=apart)

    @property
    def is_open(self) -> bool:
        """Whether nothing that stands beside it keeps any of its places from moving."""
        low, high, fixed = self.strip.low, self.strip.high, self.strip.fixed
        return bool((fixed | ((low == -np.inf) & (high == np.inf))).all())

    @property
    def laid(self) -> LaidRun:
        """It as a run of a path, with a detour via point wherever it touches something."""
        rooms = self.strip.rooms
        around = np.full(len(rooms) + 2, np.inf)
        around[1:-1] = rooms
        lowest = (rooms < around[:-2]) & (rooms <= around[2:])
        touches = np.flatnonzero(lowest & (rooms < TOUCHES * self.body.required))
        return LaidRun(self.spans, self.joints, touches[touches < len(self.spans)])
