"""The ways of legs that have been found already: a leg that nobody has moved isn't searched again.

Tested through ``studio/space/test_leg_memory``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final, TypeAlias

from viaspline.curve.certificate import Certificate
from viaspline.kernels.arrays import Floats
from viaspline.space.leg_router import LegRouter
from viaspline.space.weighed_ways import TautWay

LegKey: TypeAlias = tuple[bytes, bytes, str | None]
"""From where to where, and past what."""

KnownWays: TypeAlias = Mapping[LegKey, Sequence[TautWay]]

MAX_KNOWN_LEGS: Final = 2000


class RememberedWays:
    """All ways of the legs of a mission; those that are known aren't looked for again.

    Args:
        router: Finds the ways of others.
        known: What was found before, in the same world for the same robot.
    """

    def __init__(self, router: LegRouter, known: KnownWays) -> None:
        self._router = router
        self.known = dict(known)

    def gates(self, leg: int) -> Floats:
        """What a leg has to pass on which sides, (g, 8)."""
        return self._router.gates(leg)

    def ways(self, leg: int, proof: Certificate) -> Sequence[TautWay]:
        """All ways of a leg; see `LegRouter.ways`.

        Raises:
            NoPathError: There is none, proven.
            GaveUpError: None was found.
        """
        key = self._key(leg, proof)
        if key not in self.known:
            found = self._router.ways(leg, proof)
            while len(self.known) >= MAX_KNOWN_LEGS:
                del self.known[next(iter(self.known))]
            self.known[key] = found
        return self.known[key]

    def defers(self, proof: Certificate) -> bool:
        """Whether ways on other sides are looked for only to be told of."""
        return self._router.defers(proof)

    def others(self, leg: int, proof: Certificate) -> Sequence[TautWay]:
        """These; see `LegRouter.others`."""
        return self._router.others(leg, proof)

    def pulled(self, leg: int, way: Floats) -> Floats | None:
        """The corners of a way (n, 3) [m] of a leg pulled taut, (k, 3); None: it isn't free."""
        return self._router.pulled(leg, way)

    def _key(self, leg: int, proof: Certificate) -> LegKey:
        problem = self._router.problem
        first, last = problem.vias[leg], problem.vias[leg + 1]
        return first.at.tobytes(), last.at.tobytes(), None if proof.holds else proof.obstacle


class CheapestWays(RememberedWays):
    """As that, but of a leg that isn't known yet only the cheapest way is looked for.

    Attributes:
        alone: How many legs have only their cheapest way.
    """

    def __init__(self, router: LegRouter, known: KnownWays) -> None:
        super().__init__(router, known)
        self.alone = 0

    def ways(self, leg: int, proof: Certificate) -> Sequence[TautWay]:
        """All ways of a leg if they are known, else the cheapest.

        Raises:
            NoPathError: There is none, proven.
            GaveUpError: None was found.
        """
        key = self._key(leg, proof)
        if key in self.known:
            return self.known[key]
        self.alone += 1
        return [self._router.cheapest(leg, proof)]

    def defers(self, proof: Certificate) -> bool:
        """Whether others wait until they are told of: nobody waits for them here."""
        return False
