"""A strip under tension between what stands beside it: its places are moved until they rest.

Tested through ``planning/methods/test_bent_gently``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.turning.bent_strip import bent_strip
from viaspline.kernels.turning.strip_places import has_kink, strip_normals, strip_places
from viaspline.kernels.turning.strip_room import is_open_strip, open_room, strip_room
from viaspline.kernels.turning.strip_spans import strip_spans
from viaspline.kernels.turning.swept_sides import StripBody, swept_sides
from viaspline.kernels.world.packed import PackedWorld

STEP = 6.0  # between places, in required distances, at most
LEAST_PLACES, MOST_PLACES = 16, 400  # of a leg, of the path
TURN_RAD = 0.2  # from place to place, at most
LEAST_ROOM_M = 1e-5  # between bounds, where there is none
MOST_TURNED = 0.3  # that a step is turned by at once [rad]
LITTLE_TURNED = 0.03  # the same, for which places need not be laid anew [rad]
MOST_ROUNDS = 10  # of moving places
MISSING = 50.0  # of what places may still move where they rest: as many slacks may be missing


class StripPlaces(NamedTuple):
    """Places on rays across a path, and what is known of the room on both sides of it.

    Attributes:
        closed: Whether it is a round, whose last place is its first.
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

    closed: bool
    places: Floats
    joints: Ints
    fixed: Flags
    normals: Floats
    spans: Floats
    low: Floats
    high: Floats
    reach: Floats
    rooms: Floats


@inner
def _looking(
    world: PackedWorld, body: StripBody, ends: Floats, closed: bool, places: Floats, joints: Ints,
    fixed: Flags, normals: Floats, low: Floats, high: Floats,
) -> StripPlaces:  # fmt: skip
    """A strip at places, with a look at the room that it has there.

    The curve through them is left out in the open, where nobody looks at it: see ``_laid``.
    """
    spans = np.empty((0, 4, 2))
    has_free_ends = closed or (math.isnan(ends[0, 0]) and math.isnan(ends[1, 0]))
    if body.outline.shape[0] > 0 or not has_free_ends:  # given ends move the places beside them
        spans = strip_spans(places, normals, ends, closed)
    reach, rooms = np.empty(low.size), np.empty(low.size)
    beside, kept = np.empty(low.size), np.empty(low.size)
    swept_sides(world, body, closed, places, normals, spans, beside, kept)
    kept *= 1.0 + body.slack
    if spans.shape[0] == 0 and is_open_strip(world, places, beside, kept):
        open_room(places, kept, reach, rooms)
    else:
        if spans.shape[0] == 0:
            spans = strip_spans(places, normals, ends, closed)
        strip_room(world, places, normals, spans, beside, kept, low, high, reach, rooms)
    return StripPlaces(closed, places, joints, fixed, normals, spans, low, high, reach, rooms)


@inner
def _laid(strip: StripPlaces, ends: Floats) -> StripPlaces:
    """A strip with the curve through its places."""
    if strip.spans.shape[0] > 0:
        return strip
    spans = strip_spans(strip.places, strip.normals, ends, strip.closed)
    return StripPlaces(
        strip.closed, strip.places, strip.joints, strip.fixed, strip.normals, spans, strip.low,
        strip.high, strip.reach, strip.rooms,
    )  # fmt: skip


@inner
def _placed(
    world: PackedWorld, body: StripBody, ends: Floats, closed: bool, fineness: float, spans: Floats,
    joints: Ints,
) -> StripPlaces:  # fmt: skip
    """See ``placed_strip``; the curve may be left out."""
    step, turn = STEP * body.required / fineness, TURN_RAD / fineness
    places, at = strip_places(spans, joints, step, turn, LEAST_PLACES, MOST_PLACES)
    count = places.shape[0]
    low, high = np.full(count, -np.inf), np.full(count, np.inf)
    fixed = np.zeros(count, np.bool_)
    fixed[at] = True
    fixed[1] |= not math.isnan(ends[0, 0])
    fixed[count - 2] |= not math.isnan(ends[1, 0])
    normals = strip_normals(places, closed)
    return _looking(world, body, ends, closed, places, at, fixed, normals, low, high)


@kernel
def placed_strip(
    world: PackedWorld, body: StripBody, ends: Floats, closed: bool, fineness: float, spans: Floats,
    joints: Ints,
) -> StripPlaces:  # fmt: skip
    """A strip as a curve lies, with nothing known of the room beside it but what it sees there.

    Args:
        world: What to keep clear of.
        body: What drives along it.
        ends: Directions in which it leaves its start and comes to its end, unit vectors, nan where
            it is free or a round, (2, 2).
        closed: Whether it is a round, which goes on at its end where it begins.
        fineness: By how much nearer to each other places are than usual.
        spans: The curve: Bézier control polygons [m], (m, 4, 2).
        joints: The span that begins at each via point, its start among them; m at its end, (k,).
    """
    return _laid(_placed(world, body, ends, closed, fineness, spans, joints), ends)


@inner
def _moved(
    world: PackedWorld,
    body: StripBody,
    ends: Floats,
    fineness: float,
    strip: StripPlaces,
    tension: float,
    sharp: float,
) -> tuple[StripPlaces, float]:
    """A strip with its places moved to where that costs least, and by how much at most [m]."""
    count = strip.low.size
    lower, upper = np.maximum(strip.low, -strip.reach), np.minimum(strip.high, strip.reach)
    for j in range(count):
        if lower[j] > upper[j] - LEAST_ROOM_M:
            middle = 0.5 * (lower[j] + upper[j])
            lower[j], upper[j] = middle - LEAST_ROOM_M, middle + LEAST_ROOM_M
    moved, _, turned = bent_strip(
        strip.places, strip.normals, lower, upper, strip.fixed, strip.closed, tension,
        sharp,
    )  # fmt: skip
    moved *= min(1.0, MOST_TURNED / max(turned, 1e-12))
    places, low, high = strip.places.copy(), strip.low - moved, strip.high - moved
    most = 0.0
    for j in range(count):
        most = max(most, abs(moved[j]))
        for axis in range(2):
            places[j, axis] += moved[j] * strip.normals[j, axis]
    if turned > LITTLE_TURNED:
        spans = strip_spans(places, strip.normals, ends, strip.closed)
        return _placed(world, body, ends, strip.closed, fineness, spans, strip.joints), most
    looked = _looking(
        world, body, ends, strip.closed, places, strip.joints, strip.fixed, strip.normals, low, high
    )  # fmt: skip
    return looked, most


@kernel
def settled_strip(
    world: PackedWorld, body: StripBody, ends: Floats, fineness: float, strip: StripPlaces,
    tension: float, sharp: float, settled: float,
) -> tuple[StripPlaces, bool]:  # fmt: skip
    """A strip at a tension after some rounds of moving its places.

    Args:
        world: What to keep clear of.
        body: What drives along it.
        ends: See ``placed_strip``.
        fineness: By how much nearer to each other places are than usual.
        strip: As it is.
        tension: What a metre of length is priced at [1/m²].
        sharp: Curvature beyond which bending is dearer [1/m]; see ``bent_strip``.
        settled: It rests where no place moves by more, in required distances.

    Returns:
        It, and whether it rests; where it doesn't it may have a kink.
    """
    for _ in range(MOST_ROUNDS):
        strip, most = _moved(world, body, ends, fineness, strip, tension, sharp)
        if has_kink(strip.places):
            return _laid(strip, ends), False
        missing = settled * MISSING * body.slack * body.required
        if most < settled * body.required and strip.rooms.min() > -missing:
            return _laid(strip, ends), True
    return _laid(strip, ends), False
