"""The sides on which a mission has obstacles passed, as barriers that a leg's path never crosses.

The barrier of an obstacle goes from its middle, square to the leg, out to the forbidden side and
beyond everything. It binds a leg

- if the obstacle is in its way: it is nearer to the straight line between the leg's via points
  than twice what is required, or stands too close to pass between to something that is nearer than
  what is required;
- if the straight line passes it on the side that is asked for: no detour goes round it the other
  way;
- if the path of the leg would come nearer to it than twice what is required;
- under way, if the path so far passes it so near, on the side that is asked for.

Whoever lays a path searches with these barriers, and ``wrong`` decides on the finished curve.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.planning.checking.barrier_crossings import crossings
from viaspline.planning.checking.conflicts import CLEAR, too_close
from viaspline.planning.problem.via_sequence import WholeLeg
from viaspline.planning.routing.route_problem import on_the_line
from viaspline.planning.routing.side_barrier import barriers_of
from viaspline.world.world import World

NEAR_RATIO = 2.0  # of what is required, within which an obstacle with a side is in the way


@dataclass(frozen=True)
class AskedSides:
    """The obstacles with a side of their own, as one leg sees them.

    Attributes:
        indices: Of the obstacles in the world, (k,).
        barriers: What closes the forbidden side of each [m], (k, 4).
        binding: Which of them the path of the leg must not cross, (k,).
    """

    indices: Ints
    barriers: Floats
    binding: Flags

    @classmethod
    def of(
        cls, leg: WholeLeg, indices: Ints, world: World, required: float, groups: Callable[[], Ints]
    ) -> AskedSides:
        """The sides that a leg keeps.

        Args:
            leg: From where to where, and what is driven so far.
            indices: Of the obstacles with a side of their own, as ``sided`` finds them, (k,).
            world: The known world.
            required: Distance that the path keeps [m].
            groups: Gives the label of every obstacle's group, (n,).
        """
        if not indices.size:
            return cls(indices, np.empty((0, 4)), np.zeros(0, np.bool_))
        barriers = forced_barriers(leg, indices, world)
        in_the_way = on_the_line(world, leg.start, leg.goal, NEAR_RATIO * required)
        touched = on_the_line(world, leg.start, leg.goal, required)
        if touched.any() and not world.are_maps.any():
            labels = groups()
            in_the_way |= np.isin(labels, labels[touched])
        binding = in_the_way[indices] | ~_crossed_by(np.array([leg.start, leg.goal]), barriers)
        sides = cls(indices, barriers, binding)
        if leg.laid is None:
            return sides
        kept = indices[~crossings(leg.laid, barriers).any(axis=0)]
        return sides.with_binding(sides.near(kept, leg.laid, world, required).tolist())

    @property
    def freed(self) -> AskedSides:
        """No sides at all."""
        return AskedSides(self.indices[:0], self.barriers[:0], self.binding[:0])

    @property
    def bound(self) -> Ints:
        """The obstacles whose sides bind, (b,)."""
        return self.indices[self.binding]

    @property
    def closed(self) -> Floats:
        """The barriers that bind [m], (b, 4)."""
        return np.ascontiguousarray(self.barriers[self.binding])

    def closed_among(self, active: Flags) -> Floats:
        """The barriers of those obstacles that are known to be met, (n,) [m], (b, 4)."""
        return np.ascontiguousarray(self.barriers[active[self.indices]])

    def gone_round(self, places: Floats) -> Ints:
        """The obstacles that a polyline (m, 2) [m] goes round on the wrong side, (j,)."""
        if not self.indices.size:
            return self.indices
        return self.indices[self.binding & _crossed_by(places, self.barriers)]

    def binding_if_met(self, active: Flags) -> AskedSides:
        """These sides, where the sides of those that are known to be met, (n,), bind as well."""
        if not self.indices.size:
            return self
        return replace(self, binding=self.binding | active[self.indices])

    def crossed(self, spans: Floats) -> NDArray[np.bool_]:
        """Which spans of the leg's curve cross a barrier that binds, (m,)."""
        if not self.indices.size:
            return np.zeros(len(spans), np.bool_)
        return np.asarray(crossings(spans, self.closed).any(axis=1))

    def with_binding(self, more: Sequence[int]) -> AskedSides:
        """These sides, where those of some more obstacles bind as well."""
        return replace(self, binding=self.binding | np.isin(self.indices, more))

    def near(self, among: Ints, spans: Floats, world: World, required: float) -> Ints:
        """Those ``among`` the obstacles that don't bind which a curve comes near to, (j,)."""
        free = np.intersect1d(among, self.indices[~self.binding]).tolist()
        reach = NEAR_RATIO * required
        return np.array([
            i for i in free if (too_close(World([world.obstacles[i]]), spans, reach) != CLEAR).any()
        ], np.int64)  # fmt: skip

    def overlooked(self, spans: Floats, world: World, required: float) -> Ints:
        """Obstacles that don't bind, but that a curve comes near to on the wrong side, (j,)."""
        if not self.indices.size:
            return self.indices
        crossed = self.indices[crossings(spans, self.barriers).any(axis=0)]
        return self.near(crossed, spans, world, required)

    def wrong(self, spans: Floats) -> Ints:
        """The obstacles that a curve of the leg passes on the wrong side, (j,)."""
        if not self.indices.size:
            return self.indices
        return self.indices[self.binding & crossings(spans, self.barriers).any(axis=0)]


def forced_barriers(leg: WholeLeg, indices: Ints, world: World) -> Floats:
    """What closes the forbidden sides of obstacles on a leg, whether they bind it or not [m].

    Args:
        leg: From where to where.
        indices: Of obstacles with a side of their own, (k,).
        world: The known world.

    Returns:
        Shape (k, 4).
    """
    return np.vstack([
        barriers_of(world, i, leg.start, leg.goal).forcing(world.obstacles[i].forced_side)
        for i in indices.tolist()
    ])  # fmt: skip


def sided(world: World) -> Ints:
    """Indices of the obstacles that ask for a side, (k,)."""
    return world.sided


def _crossed_by(places: Floats, barriers: Floats) -> NDArray[np.bool_]:
    """Which barriers a polyline (m, 2) [m] crosses, (b,)."""
    share = np.arange(4.0)[:, None] / 3.0
    start, end = places[:-1, None, :2], places[1:, None, :2]
    return np.asarray(crossings(start + share * (end - start), barriers).any(axis=0))
