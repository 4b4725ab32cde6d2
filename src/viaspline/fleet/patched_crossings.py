"""The crossings of a fleet of which some are others than before, not put among each other yet.

The boxes of a thousand robots take a hundred megabytes. As long as nobody asks for all of them,
those of robots that keep their paths stay where they are.

Tested through ``fleet/test_renewed_crossings``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.renewed_boxes import merged_pairs, renewed_boxes

MOST_FRESH = 0.25
"""Where more boxes than that part of all are others than before, they are put among them."""


@dataclass(frozen=True, eq=False)
class PatchedCrossings:
    """Crossings of which those of some robots are found anew.

    Attributes:
        kept: The crossings as they were.
        fresh: Those that some robots have now, with whomever.
        is_changed: These robots, (n,).
        moved: By how much the numbers of each robot's cells have changed since ``kept``, (n,).
        robots: The two robots of each crossing that there is now; see ``PackedCrossings``.
        span: Where each of these is.
    """

    kept: PackedCrossings
    fresh: PackedCrossings
    is_changed: Flags
    moved: Ints
    robots: Ints
    span: Floats

    @classmethod
    def of(
        cls, kept: PackedCrossings, fresh: PackedCrossings, is_changed: Flags, moved: Ints
    ) -> PatchedCrossings:
        """With all pairs of robots in their order."""
        count = len(is_changed) + 1 - len(kept.box_first)  # robots that weren't there before
        kept = kept._replace(box_first=np.pad(kept.box_first, (0, count), "edge"))
        robots, span, _, _ = merged_pairs(
            kept.robots, kept.span, fresh.robots, fresh.span, is_changed
        )
        return cls(kept, fresh, is_changed, moved, robots, span)

    def patched(self, fresh: PackedCrossings, is_changed: Flags, moved: Ints) -> PatchedCrossings:
        """With the crossings of some robots found anew once more.

        Args:
            fresh: As those of the class, as are the next two.
            is_changed: As there.
            moved: By how much the numbers of cells have changed since this one.
        """
        more = len(is_changed) - len(self.is_changed)
        found = PatchedCrossings.of(self.fresh, fresh, is_changed, moved).merged()
        return PatchedCrossings.of(
            self.kept, found, is_changed | np.pad(self.is_changed, (0, more)),
            moved + np.pad(self.moved, (0, more)),
        )  # fmt: skip

    @property
    def has_many(self) -> bool:
        """Whether so much is found anew that all had better be put among each other."""
        return len(self.fresh.cell) > MOST_FRESH * len(self.kept.cell)

    def merged(self) -> PackedCrossings:
        """All crossings with all boxes."""
        return PackedCrossings(*renewed_boxes(self.kept, self.fresh, self.is_changed, self.moved))

    def boxes_of(self, chosen: Flags) -> PackedCrossings:
        """All crossings, with the boxes of some robots alone, (n,)."""
        return PackedCrossings(
            *renewed_boxes(
                boxes_of_robots(self.kept, chosen), boxes_of_robots(self.fresh, chosen),
                self.is_changed, self.moved,
            )
        )  # fmt: skip


def boxes_of_robots(crossings: PackedCrossings, chosen: Flags) -> PackedCrossings:
    """Crossings without the boxes of any but some robots, (n,)."""
    counts = np.where(chosen, np.diff(crossings.box_first), 0)
    rows = zip(crossings.box_first[:-1][chosen].tolist(), counts[chosen].tolist(), strict=True)
    boxes = np.concatenate(
        [np.empty(0, np.int64), *(np.arange(begin, begin + count) for begin, count in rows)]
    )
    return crossings._replace(
        box_first=np.concatenate(([0], np.cumsum(counts))).astype(np.int64),
        cell=crossings.cell[boxes], crossing=crossings.crossing[boxes],
        other=crossings.other[boxes], low=crossings.low[boxes], high=crossings.high[boxes],
    )  # fmt: skip
