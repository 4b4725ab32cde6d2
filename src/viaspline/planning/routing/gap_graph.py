"""All convex pieces of a world, and the gaps between them.

Tested through ``planning/routing/test_bottleneck``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.planning.routing.gap_links import (
    ConvexPieces,
    GapLinks,
    links_among,
    links_between,
)
from viaspline.planning.routing.map_links import MapPieces
from viaspline.world.world import World

MAX_GAP_OBSTACLES: Final = 1000
"""Whose gaps a search has the time to measure."""


def is_soon_made(world: World) -> bool:
    """Whether the gaps of a world are few: not among too many things, and not on maps."""
    return len(world) <= MAX_GAP_OBSTACLES and not world.are_maps.any()


@dataclass(frozen=True)
class GapGraph:
    """Convex pieces, and those pairs of them that have a narrow gap between them.

    Attributes:
        radii: By how much the cores of the pieces are grown [m], (n,).
        owners: What each is a piece of, an index as of ``World.nearest``, (n,).
        places: A place in each core [m], (n, 2).
        links: Pairs of pieces, the narrowest gap first.
    """

    radii: Floats
    owners: Ints
    places: Floats
    links: GapLinks

    @classmethod
    def of(cls, world: World, reach: float, least: float = -math.inf) -> GapGraph:
        """That of a world, with the gaps of ``least`` and more that are below ``reach`` [m]."""
        pieces = ConvexPieces.of(world)
        links = [links_among(pieces, reach, least)]
        numbered = [(np.arange(len(pieces.owners)), pieces)]
        radii, owners, places = [pieces.radii], [pieces.owners], [pieces.places]
        count = len(pieces.owners)
        maps = _maps(world)
        for k, cells in enumerate(maps):
            numbers = count + np.arange(len(cells.cells))
            count += len(numbers)
            links.append(cells.links(reach).renumbered(numbers, numbers))
            for others, other in numbered:
                near = cells.near(other, reach)
                between = links_between(other, cells.pieces(near), reach)
                links.append(between.renumbered(others, numbers[near]))
            radii.append(np.zeros(len(numbers)))
            owners.append(np.full(len(numbers), cells.owner))
            places.append(cells.middles)
            if k + 1 < len(maps):  # for the maps that follow
                numbered.append((numbers, cells.pieces(np.arange(len(numbers)))))
        found = GapLinks.joined(links)
        found = found.some(found.widths >= least)
        return cls(
            np.concatenate(radii),
            np.concatenate(owners),
            np.concatenate(places),
            found.some(np.argsort(np.maximum(found.widths, 0.0), kind="stable")),
        )

    def middle_of(self, link: int) -> tuple[float, float]:
        """The middle of a gap, between the two surfaces [m]."""
        p, q = self.links.feet[link].reshape(2, 2)
        length = float(np.hypot(*(q - p)))
        from_core = float(self.radii[self.links.pairs[link, 0]] + 0.5 * self.links.widths[link])
        x, y = (p + (from_core / length if length > 0.0 else 0.0) * (q - p)).tolist()
        return x, y


def _maps(world: World) -> list[MapPieces]:
    found = []
    for index, obstacle in enumerate(world.obstacles):
        if obstacle.grid is not None:
            found.append(MapPieces(obstacle.grid, index))
    return found
