"""The account of a search: every group that was met, drawn up when it is asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from viaspline.detour.brief import Brief
from viaspline.detour.laid import Laid
from viaspline.detour.ledger import LedgerEntry
from viaspline.detour.measure import measure
from viaspline.detour.passing import Passed
from viaspline.world.world import World


@dataclass(frozen=True)
class Account:
    """What a search did, leg by leg.

    Among many groups the way that was taken is known to be the shortest before the other sides
    of the groups have been looked at; they are looked at when the ledger is read.

    Attributes:
        laid: The course as it was laid in the end.
        world: The known world.
        brief: What the path keeps.
        passed: The legs that were led round something.
    """

    laid: Laid
    world: World
    brief: Brief
    passed: Mapping[int, Passed] = field(default_factory=dict)

    @cached_property
    def ledger(self) -> tuple[LedgerEntry, ...]:
        """All entries, with the chosen curves as they lie in the end.

        A leg that was led round after its neighbour has turned the tangents at the via point
        between them; what was not chosen stays as it was weighed.
        """
        entries: list[LedgerEntry] = []
        for leg in sorted(self.passed):
            met = self.passed[leg].entries
            laid = self.laid.leg(leg)
            chosen = met[0].chosen if met else None  # all entries of a leg share it
            if chosen is None or np.array_equal(chosen.spans, laid):
                entries += met
                continue
            cost = asdict(measure(laid, self.world, self.brief))  # fields of a candidate as well
            points = self.laid.detours(leg)
            entries += [_as_laid(entry, spans=laid, vias=points, **cost) for entry in met]
        return tuple(entries)


def _as_laid(entry: LedgerEntry, **curve: Any) -> LedgerEntry:
    """The entry with other values for the curve that was chosen."""
    candidates = (replace(c, **curve) if c.chosen else c for c in entry.candidates)
    return replace(entry, candidates=tuple(candidates))
