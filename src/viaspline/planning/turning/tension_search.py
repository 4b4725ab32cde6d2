"""The search for the least tension at which a strip takes hardly longer than it must.

The less tension, the less it bends and the longer it is. Where the robot drives corners at full
speed, longer is later; where it slows down for them, wide turns are sooner up to a point: over the
logarithm of the tension the time is a valley, whose floor is sought first.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.curve.measure import bending
from viaspline.planning.turning.tense_strip import TenseStrip

GENTLE_SHARE = 2e-3  # of the time, that may be spent
LEAST_GENTLER = 0.02  # of the bending, that has to be saved
TIME_KNOWN = 1e-3  # of a driven time: it is known so well
FINER_GENTLER = 0.02  # of its bending, that a strip in the open has less with more places, at most
FINER_SOONER, FINER_BLUNTER = 5e-4, 0.05  # the same, of its time and of its sharpest curvature
FIRST, LEAST_OVER = 0.1, 0.5  # of that at which what was laid would be a strip; see ``first``
STEPPED = 10.0  # at most, of the tension from one that is tried to the next, where that is foretold
LOOSENED = 4.0  # where it isn't
NEAR_TENSION = 1.5  # of one that is too loose, at which the least that isn't is near enough
MOSTLY_SPENT, NEARLY_SPENT = 0.7, 0.8  # of what may be: enough of it
WANTED, FORETOLD = 0.85, 0.93  # the same, that is aimed at
LEAST_SPENT = 0.05  # the same, from which on a power of the tension tells
LATE = 1.01  # of the least time: what takes longer is slowed down by corners
SLOWED = 2.0  # over the radius that is driven at full speed: squared, a tension that is soon then
MUCH_SOONER = 5e-3  # of the time, for which a run may bend more than what was laid
LEAST_SOONER = 5e-4  # of the time, that has to be saved by another tension


@dataclass(frozen=True)
class RunPrice:
    """What a run of a path may be exchanged for.

    Attributes:
        time_of: The time in which spans (m, 4, 2) [m] are driven [s], via points at joints (n,).
        time: That of what was laid [s].
        bending: Of what was laid [1/m].
        least: No run on the same sides takes less time [s].
        slowing: Curvature beyond which the robot slows down [1/m], infinite where it never does.
        pointed: Curvature beyond which a blunter run is tried as well [1/m], infinite if never.
        sharp: Curvature beyond which a run isn't taken unless it is sooner [1/m].
        limit: Curvature beyond which a run that is sharper than what was laid isn't taken [1/m].
    """

    time_of: Callable[[Floats, Ints], float]
    time: float
    bending: float
    least: float
    slowing: float
    pointed: float
    sharp: float
    limit: float

    @property
    def sooner(self) -> float:
        """The longest time in which a run is driven that is much sooner than what was laid [s]."""
        return (1.0 - MUCH_SOONER) * self.time

    def is_gentler(self, bending: float) -> bool:
        """Whether a run with a bending [1/m] bends less than what was laid."""
        return bending < (1.0 - LEAST_GENTLER) * self.bending

    def is_sooner(self, spans: Floats, joints: Ints) -> bool:
        """Whether a run is driven much sooner than what was laid; see ``time_of``."""
        return self.time_of(spans, joints) <= self.sooner

    def is_better(self, bending: float, time: float) -> bool:
        """Whether a run with a bending [1/m] bends less than what was laid, or is much sooner."""
        return self.is_gentler(bending) or time <= self.sooner


@dataclass(frozen=True)
class Tried:
    """A strip at a tension.

    Attributes:
        tension: [1/m²].
        strip: It.
        time: In which it is driven [s].
        bending: Of it [1/m].
    """

    tension: float
    strip: TenseStrip
    time: float
    bending: float


@dataclass(frozen=True)
class TensionSearch:
    """What is known so far.

    Attributes:
        price: What the run may be exchanged for.
        length: Of what was laid [m].
        tried: The tensest last.
    """

    price: RunPrice
    length: float
    tried: tuple[Tried, ...] = ()

    def having(self, one: Tried) -> TensionSearch:
        """With one more that was tried."""
        return replace(self, tried=tuple(sorted((*self.tried, one), key=lambda one: one.tension)))

    @property
    def first(self) -> float:
        """The tension to begin with, times the length of what was laid [1/m].

        The bending of a strip that bends freely round a corner is its tension times what it is
        longer than the corner. Where the robot slows down for corners tenser ones are sooner.
        """
        if LATE * self.price.least < self.price.time and math.isfinite(self.price.slowing):
            return (SLOWED * self.price.slowing) ** 2 * self.length
        over = max(self.price.time - self.price.least, LEAST_OVER * GENTLE_SHARE * self.price.time)
        return FIRST * self.price.bending * self.price.time / over

    @cached_property
    def chosen(self) -> Tried | None:
        """The least tension that takes no more than may be spent, if there is one."""
        return next((one for one in self._better if self._spent(one) <= 1.0), None)

    @property
    def may_be_taken_finer(self) -> bool:
        """Whether one with more places may be taken, if nothing stands beside any: it is alike."""
        price = self.price
        gentler = (
            one
            for one in self.tried
            if price.is_better((1.0 - FINER_GENTLER) * one.bending, (1.0 - FINER_SOONER) * one.time)
        )
        times = ((one, (1.0 - FINER_SOONER) * one.time) for one in gentler)
        return any(
            time <= price.sooner
            or (
                time <= (1.0 + GENTLE_SHARE) * price.time
                and (1.0 - FINER_BLUNTER) * bending(one.strip.spans)[1] <= price.sharp
            )
            for one, time in times
        )

    @property
    def others(self) -> list[Tried]:
        """Those that bend less and are sooner than what was laid, but for the chosen one."""
        sooner = (one for one in self._better if one.time < self.price.time)
        return sorted((one for one in sooner if one is not self.chosen), key=lambda one: one.time)

    @property
    def following(self) -> tuple[TenseStrip, float] | None:
        """With what to begin at which tension next; None where there is no need to."""
        chosen, better = self.chosen, self._better
        if not better:
            return self.tried[0].strip, self.tried[0].tension / LOOSENED
        if chosen is None:
            return self._tenser(better[-1])
        return (self._sooner if self._is_late else None) or self._looser(chosen)

    @cached_property
    def _better(self) -> tuple[Tried, ...]:
        return tuple(one for one in self.tried if self.price.is_better(one.bending, one.time))

    @cached_property
    def _known(self) -> float:
        """What times are held against [s]: the least, if one is near it, else the least known."""
        best = min([self.price.time, *(one.time for one in self._better)])
        return self.price.least if best <= (1.0 + GENTLE_SHARE) * self.price.least else best

    @property
    def _is_late(self) -> bool:
        """Whether none is known that is nearly as soon as the least: it slows down for corners.

        Where it doesn't, what is spent falls by the root of the tension.
        """
        return self._known > self.price.least

    def _spent(self, one: Tried) -> float:
        """Of what may be."""
        return (one.time / self._known - 1.0) / GENTLE_SHARE

    @property
    def _sooner(self) -> tuple[TenseStrip, float] | None:
        """A tension that is likely to be sooner than any that was tried; None where none is."""
        better = self._better
        best = min(range(len(better)), key=lambda k: better[k].time)
        soonest = better[best]
        if best == len(better) - 1:
            return self._tenser(soonest) if self._may_be_sooner_tense else None
        if best == 0:
            return None  # looser ones are tried anyway
        return _at_lowest(better[best - 1], soonest, better[best + 1])

    @property
    def _may_be_sooner_tense(self) -> bool:
        """Whether one that is tenser than any that bends less may be sooner, and bend less too."""
        better = self._better
        if len(better) < 2:
            return True
        looser, tensest = better[-2:]
        if tensest.time > (1.0 - LEAST_SOONER) * looser.time:
            return False
        steps = math.log(LOOSENED) / math.log(tensest.tension / looser.tension)
        foretold = tensest.bending * (tensest.bending / looser.bending) ** steps
        return self.price.is_better(foretold, tensest.time)

    def _tenser(self, tensest: Tried) -> tuple[TenseStrip, float] | None:
        """Tenser than the tensest that bends less, less tense than what bends more."""
        tenser = [one for one in self.tried if one.tension > tensest.tension]
        if tenser:
            between = tenser[0].tension / tensest.tension
            is_near = between < NEAR_TENSION
            return None if is_near else (tensest.strip, tensest.tension * math.sqrt(between))
        if self._is_late:
            return tensest.strip, tensest.tension * LOOSENED
        over = (tensest.time / self.price.least - 1.0) / GENTLE_SHARE
        return tensest.strip, tensest.tension * min((over / FORETOLD) ** 2, STEPPED)

    def _looser(self, chosen: Tried) -> tuple[TenseStrip, float] | None:
        """Between what is chosen and what is too loose, or looser yet if that saves bending."""
        spent = self._spent(chosen)
        if spent > (MOSTLY_SPENT if self._is_late else NEARLY_SPENT):
            return None
        looser = [one for one in self.tried if one.tension < chosen.tension]
        if looser:
            between = chosen.tension / looser[-1].tension
            is_near = between < NEAR_TENSION or _saves_little(chosen, looser[-1])
            return None if is_near else (chosen.strip, self._between(looser[-1], chosen))
        tenser = [one for one in self._better if one.tension > chosen.tension]
        if tenser and _saves_little(tenser[0], chosen):
            return None
        step = LOOSENED if self._is_late else min((FORETOLD / max(spent, 1e-6)) ** 2, STEPPED)
        return chosen.strip, chosen.tension / step

    def _between(self, looser: Tried, chosen: Tried) -> float:
        """The tension at which as much is spent as is wanted, as what is spent falls by its log.

        Or by a power of it, where the robot doesn't slow down for corners.
        """
        most, least = self._spent(looser), self._spent(chosen)
        if self._is_late:
            share = (WANTED - least) / (most - least)
        else:
            least = max(least, LEAST_SPENT)
            share = math.log(FORETOLD / least) / math.log(most / least)
        share = min(max(share, 0.0), 1.0)
        tension = chosen.tension * math.pow(looser.tension / chosen.tension, share)
        apart = math.sqrt(NEAR_TENSION)
        return min(max(tension, apart * looser.tension), chosen.tension / apart)


def _saves_little(one: Tried, looser: Tried) -> bool:
    return one.bending < (1.0 + LEAST_GENTLER) * looser.bending


def _at_lowest(looser: Tried, soonest: Tried, tenser: Tried) -> tuple[TenseStrip, float] | None:
    """Where a parabola of the time over the logarithm of the tension is lowest.

    None where that is near to what was tried, or saves little.
    """
    low, high = (math.log(one.tension / soonest.tension) for one in (looser, tenser))
    more = [(one.time - soonest.time) / soonest.time for one in (looser, tenser)]
    slopes = more[0] / low, more[1] / high
    bend = (slopes[1] - slopes[0]) / (high - low)
    if not bend > 0.0:
        return None
    lowest = 0.5 * (high - slopes[1] / bend)
    saved = bend * lowest**2
    nearest = min(abs(lowest - low), abs(lowest), abs(high - lowest))
    if saved < LEAST_SOONER or nearest < 0.5 * math.log(NEAR_TENSION):
        return None
    return soonest.strip, soonest.tension * math.exp(lowest)
