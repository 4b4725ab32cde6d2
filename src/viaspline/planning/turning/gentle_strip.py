"""A path that bends less: one strip under tension in the place of lines and turns.

Lines and turns bend where corners are and nowhere else, each turn as long before it as after. What
bends least for a part of the time is a strip under tension that lies against what it goes round:
its curvature dies away on both sides of where it touches, as slowly as the next touch lets it. The
less tension, the less it bends and the longer it is; in wide turns it is faster for all that.

Tested through ``planning/methods/test_bent_gently``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from viaspline.kernels.curve.measure import bending
from viaspline.kernels.turning.swept_sides import StripBody
from viaspline.planning.turning.bendable_run import BendableRun, LaidRun
from viaspline.planning.turning.tense_strip import TenseStrip
from viaspline.planning.turning.tension_search import RunPrice, TensionSearch, Tried
from viaspline.world.world import World

FINENESSES = 1.0, 4.0  # of places, in the order in which they are tried
MOST_TENSIONS = 8  # that are tried
MOST_RESTLESS = 1  # of them, at which places don't come to rest: no more are tried
MOST_OTHERS = 2  # than the chosen one, that are laid where that can't be driven
SHARP = 0.5  # of the sharpest curvature, from which on more is dearer
NEAR_LIMIT = 0.9  # of the sharpest that may be, from which on more is dearer
LIMIT_PARTS = (NEAR_LIMIT, 0.6)  # the same, where it is laid in the end
LEAST_BLUNTER = 0.01  # of the sharpest curvature, that has to be saved
SETTLED, NEARLY_SETTLED = 0.02, 0.1  # of what is required: places move by less in the last round


def gentle_strips(
    run: BendableRun, world: World, body: StripBody, price: RunPrice
) -> Iterator[LaidRun]:
    """Bend a run of a path less, through the same via points and past the same things.

    Args:
        run: The run.
        world: What to keep clear of.
        body: What drives along it.
        price: What it may be exchanged for.

    Yields:
        That of the least tension that takes hardly longer than it, or than the fastest: with places
        near to each other, then as it was found, which is less smooth. Then those of other tensions
        that are sooner than the run, and all of it with more places. Only those that rest, and bend
        less than the run.
    """
    for strip in _finer_and_finer(run, world, body):
        search = _searched(strip, price)
        for tried in _promising(search):
            for found in _as_fine_as_it_rests(tried, price):
                one = found.with_places_apart
                if one.is_settled and (
                    price.is_gentler(bending(one.spans)[0])
                    or price.is_sooner(one.spans, one.joints)
                ):
                    yield one.laid
        if _is_clear(search) and not search.may_be_taken_finer:
            return


def _finer_and_finer(run: BendableRun, world: World, body: StripBody) -> Iterator[TenseStrip]:
    """A strip as a run lies, then one with more places: in a gap that just fits those are needed.

    One place by itself can't keep clear of what stands on either side of it, one a little before
    and one a little behind.
    """
    count = 0
    for fineness in FINENESSES:
        strip = TenseStrip.along(run, world, body, fineness)
        if len(strip.strip.places) > count:
            yield strip
        count = len(strip.strip.places)


def _is_clear(search: TensionSearch) -> bool:
    """Whether strips came to rest at all tensions, and nothing stands beside any of them."""
    rest = (one.strip.is_settled and one.strip.is_open for one in search.tried)
    return bool(search.tried) and all(rest)


def _searched(strip: TenseStrip, price: RunPrice) -> TensionSearch:
    """The search for the tension of a strip, as far as it gets."""
    search = TensionSearch(price, strip.run.length)
    if strip.has_kink:
        return search
    tension, restless = search.first / strip.run.length, 0
    for _ in range(MOST_TENSIONS):
        moved = _no_sharper(strip.settled(tension, NEARLY_SETTLED), tension, price)
        search = search.having(_tried(strip, moved, tension, price))
        restless += not (moved.is_settled or moved.has_kink)  # less tension draws to no kink
        following = search.following
        if following is None or restless > MOST_RESTLESS:
            break
        strip, tension = following
    return search


def _no_sharper(strip: TenseStrip, tension: float, price: RunPrice) -> TenseStrip:
    """A strip at a tension; moved so that it is no sharper than it may be, where that can be."""
    if not bending(strip.spans)[1] > price.limit:
        return strip
    blunter = strip.settled(tension, NEARLY_SETTLED, NEAR_LIMIT * price.limit)
    return blunter if blunter.is_settled else strip


def _promising(search: TensionSearch) -> Iterator[Tried]:
    """The strip of the least tension that takes hardly longer, then others, the soonest first."""
    if search.chosen is not None:
        yield search.chosen
        yield from search.others[:MOST_OTHERS]


def _as_fine_as_it_rests(chosen: Tried, price: RunPrice) -> Iterator[TenseStrip]:
    """A strip with its places nearer to each other, then as it was found: that may rest alone.

    Blunter first, where that is sooner, and after it where it is sharper than it may be.
    """
    fine = chosen.strip.finer().settled(chosen.tension, SETTLED)
    blunter = _blunter(fine, chosen.tension, price)
    if blunter is not None:
        yield blunter
    yield fine
    if bending(fine.spans)[1] > price.limit:
        yield from (
            fine.settled(chosen.tension, SETTLED, part * price.limit) for part in LIMIT_PARTS
        )
    yield chosen.strip


def _blunter(fine: TenseStrip, tension: float, price: RunPrice) -> TenseStrip | None:
    """A strip that is less sharp where the robot slows down; None where that isn't sooner."""
    sharpest = bending(fine.spans)[1]
    if not sharpest > price.pointed:
        return None
    blunter = fine.settled(tension, SETTLED, max(price.pointed, SHARP * sharpest))
    if not blunter.is_settled or bending(blunter.spans)[1] > (1.0 - LEAST_BLUNTER) * sharpest:
        return None
    times = [price.time_of(one.spans, one.joints) for one in (blunter, fine)]
    return blunter if times[0] < times[1] else None


def _tried(strip: TenseStrip, moved: TenseStrip, tension: float, price: RunPrice) -> Tried:
    """A strip moved at a tension; as it was, and of no use, where that drew it to a kink."""
    if moved.has_kink:
        return Tried(tension, strip, math.inf, math.inf)
    return Tried(tension, moved, price.time_of(moved.spans, moved.joints), bending(moved.spans)[0])
