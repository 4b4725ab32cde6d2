"""A path that bends less: one strip under tension in the place of lines and turns.

Lines and turns bend where corners are and nowhere else, each turn as long before it as after. What
bends least for a part of the length is a strip under tension that lies against what it goes round:
its curvature dies away on both sides of where it touches, as slowly as the next touch lets it. Its
places move across the path to where that costs least, between what stands on either side; free
ways are looked at anew until nothing moves.

Tested through ``planning/methods/test_bent_gently``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.turning.bent_strip import bent_strip, strip_spans
from viaspline.kernels.turning.strip_room import strip_room
from viaspline.world.world import World

GENTLE_SHARE = 2e-3  # of the taut length, that may be spent
STEP = 6.0  # between places, in required distances, at most
LEAST_PLACES, MOST_PLACES = 16, 400  # of a leg, of the path
TURN_RAD = 0.2  # from place to place, at most
SPAN_SAMPLES = np.linspace(0.0, 1.0, 5)[:-1]
MAX_ROUNDS = 14
FIRST_REACH = 12.0  # the length, over that on which curvature dies away, at first
RETENSIONED = 10.0  # at most, of the tension from one round to the next
SLACK = 1e-3  # of what is required, that is kept beyond it
SETTLED = 0.02  # of what is required: places move by less in the last round
LEAST_ROOM_M = 1e-5  # between bounds, where there is none
TOUCHES = 5e-3  # of what is required: less room than that is a touch


@dataclass(frozen=True, eq=False)
class GentleStrip:
    """A path that bends less.

    Attributes:
        spans: Bézier control polygons [m], (m, 4, 2).
        joints: The span that begins at each via point, m at its end, (n,).
        touches: The spans that begin where it touches what it goes round, (k,).
    """

    spans: Floats
    joints: Ints
    touches: Ints


def gentle_strip(
    spans: Floats, joints: Ints, world: World, required: float, taut: float
) -> GentleStrip | None:
    """Bend a path less, through the same via points and past the same things.

    Args:
        spans: The planar path, without jumps of its heading [m], (m, 4, 2).
        joints: The span that begins at each via point; m at its end, (n,).
        world: What to keep clear of.
        required: What is kept from it [m].
        taut: Length of the shortest path [m].

    Returns:
        None where it doesn't settle.
    """
    places, joints, length = _places(spans, joints, required)
    budget = max((1.0 + GENTLE_SHARE) * taut, length)
    strip = _Strip(places, joints, world, required)
    tension = 2.0 * (FIRST_REACH / length) ** 2
    for _ in range(MAX_ROUNDS):
        moved, room = strip.bend(tension)
        longer = strip.length - taut
        over = max(longer, 1e-6 * taut) / (budget - taut)
        if moved < SETTLED * required and room > -SLACK * required and over < 1.0 + SETTLED:
            touches = np.flatnonzero(_lowest(strip.rooms) & (strip.rooms < TOUCHES * required))
            return GentleStrip(strip.spans, joints, touches)
        tension *= min(max(over * over, 1.0 / RETENSIONED), RETENSIONED)
    return None


class _Strip:
    """Places on rays across a path, and what is known of the room on each."""

    def __init__(self, places: Floats, joints: Ints, world: World, required: float) -> None:
        along = np.gradient(places, axis=0)
        along /= np.hypot(*along.T)[:, None]
        self.places = places
        self.normals = np.column_stack((-along[:, 1], along[:, 0]))
        self.fixed: Flags = np.zeros(len(places), np.bool_)
        self.fixed[joints] = True
        self.world, self.required = world, required
        self.low, self.high = np.full(len(places), -np.inf), np.full(len(places), np.inf)
        self.rooms, self.reach = np.empty(len(places)), np.empty(len(places))
        self._look()

    @property
    def length(self) -> float:
        """[m]."""
        return float(np.hypot(*np.diff(self.places, axis=0).T).sum())

    def bend(self, tension: float) -> tuple[float, float]:
        """Move the places; returns by how much at most, and the least room there is then [m]."""
        lower, upper = np.maximum(self.low, -self.reach), np.minimum(self.high, self.reach)
        tight = lower > upper - LEAST_ROOM_M
        middle = 0.5 * (lower + upper)
        lower[tight], upper[tight] = middle[tight] - LEAST_ROOM_M, middle[tight] + LEAST_ROOM_M
        moved, _ = bent_strip(self.places, self.normals, lower, upper, self.fixed, tension)
        self.places = self.places + moved[:, None] * self.normals
        self.low -= moved
        self.high -= moved
        self._look()
        return float(np.abs(moved).max()), float(self.rooms.min())

    def _look(self) -> None:
        """Look how much room there is now."""
        self.spans = strip_spans(self.places)
        kept = (1.0 + SLACK) * self.required
        strip_room(
            self.world.packed, self.places, self.normals, self.spans, kept, self.low, self.high,
            self.reach, self.rooms,
        )  # fmt: skip


def _along(spans: Floats, at: Floats) -> Floats:
    """Places at parameters of a curve [m], (k, 2)."""
    first = np.clip(at.astype(np.int64), 0, len(spans) - 1)
    w = (at - first)[:, None]
    a, b, c, d = np.moveaxis(spans[first], 1, 0)
    v = 1.0 - w
    found: Floats = v * v * (v * a + 3.0 * w * b) + w * w * (3.0 * v * c + w * d)
    return found


def _places(spans: Floats, joints: Ints, required: float) -> tuple[Floats, Ints, float]:
    """Places along a path, close where it turns, via points among them.

    Returns:
        [m], (k, 2); which of them are the via points; the length of the path [m].
    """
    at = (np.arange(len(spans))[:, None] + SPAN_SAMPLES).ravel()
    points = np.vstack((_along(spans, at), spans[-1:, 3]))
    steps = np.diff(points, axis=0)
    long = np.hypot(*steps.T)
    headings = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    turns = np.abs(np.diff(headings))
    turning = 0.5 * (np.r_[0.0, turns] + np.r_[turns, 0.0])
    length = float(long.sum())
    wanted = np.cumsum(np.r_[0.0, long / (STEP * required) + turning / TURN_RAD])
    wanted *= min(1.0, MOST_PLACES / wanted[-1])
    rows, begins = [], [0]
    for first, last in zip(
        joints[:-1] * len(SPAN_SAMPLES), joints[1:] * len(SPAN_SAMPLES), strict=True
    ):
        count = max(LEAST_PLACES, math.ceil(wanted[last] - wanted[first]))
        at = np.linspace(wanted[first], wanted[last], count + 1)[:-1]
        rows.append(
            np.column_stack(
                [
                    np.interp(at, wanted[first : last + 1], points[first : last + 1, k])
                    for k in (0, 1)
                ]
            )
        )
        begins.append(begins[-1] + count)
    places = np.vstack((*rows, points[-1:]))
    return places, np.array(begins), length


def _lowest(rooms: Floats) -> Flags:
    """Of which there is less than before and no more than after."""
    around = np.r_[np.inf, rooms, np.inf]
    found: Flags = (rooms < around[:-2]) & (rooms <= around[2:])
    return found
