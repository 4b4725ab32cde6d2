"""Free space about places as half-planes, one for each convex obstacle that is near."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from free_space import FreeSpace

TRUST = 3.0  # how far a place may move, as a multiple of the distance that is required
SAME_WAY = np.cos(np.radians(10.0))


@dataclass(frozen=True)
class HalfPlanes:
    """Places ``p`` with ``normal @ p >= offset`` are clear of an obstacle.

    Attributes:
        node: The place that each belongs to, (k,).
        normal: Away from the obstacle, of length 1, (k, 2).
        offset: [m], (k,).
    """

    node: np.ndarray
    normal: np.ndarray
    offset: np.ndarray

    @staticmethod
    def trust(space: FreeSpace) -> float:
        """How far the places may move until more obstacles have to be looked at [m]."""
        return TRUST * space.required

    @classmethod
    def about(cls, space: FreeSpace, points: np.ndarray) -> HalfPlanes:
        """Those of everything that places could come too near to when they move.

        Args:
            space: What is to be kept clear of.
            points: [m], (n, 2), outside of everything.
        """
        solids, reach = space.solids, np.sqrt(2.0) * cls.trust(space) + space.required
        places = shapely.points(points)
        node, core = shapely.STRtree(solids.cores).query(
            places, predicate="dwithin", distance=reach + float(solids.radii.max(initial=0.0))
        ) if len(solids.cores) else (np.empty(0, int), np.empty(0, int))  # fmt: skip
        nearest = shapely.shortest_line(solids.cores[core], places[node])
        ends = shapely.get_coordinates(nearest).reshape(-1, 2, 2)
        away = ends[:, 1] - ends[:, 0]
        far = np.hypot(*away.T)
        kept = (far > 1e-9) & (far - solids.radii[core] <= reach)
        node, core, ends, away, far = (a[kept] for a in (node, core, ends, away, far))
        normal = away / far[:, None]
        offset = (normal * ends[:, 0]).sum(axis=1) + solids.radii[core] + space.required
        slack = far - solids.radii[core] - space.required
        needed = _not_implied(node, normal, slack)
        return cls(node[needed], normal[needed], offset[needed])


def _not_implied(node: np.ndarray, normal: np.ndarray, slack: np.ndarray) -> np.ndarray:
    """Indices of half-planes, without those behind a tighter one that looks nearly the same way."""
    kept: list[int] = []
    order = np.lexsort((slack, node))
    first = 0
    for k in order.tolist():
        if kept and node[kept[-1]] != node[k]:
            first = len(kept)
        others = kept[first:]
        if others and (normal[others] @ normal[k]).max() > SAME_WAY:
            continue
        kept.append(k)
    return np.array(kept, int)
