"""What stands about a place in space: solids, ground, bounds and fences, and the altitude band.

Tested through ``mission/space/test_place_checks``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from viaspline.maps.voxels import Voxels
from viaspline.mission.fields import Corners
from viaspline.mission.freespace import FreeSpace
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.solids import Place, Solid
from viaspline.mission.space.altitude_spec import AltitudeSpec
from viaspline.mission.space.flight_places import ground_height
from viaspline.mission.space.ground_spec import GroundSpec
from viaspline.mission.space.solid_distance import ground_distance, solid_distance
from viaspline.mission.space.upright_body import SpatialSize, UprightBody

ROUND_OFF_M = 1e-9
"""A place may be this much too near [m]: round-off, not a fault."""


@dataclass(frozen=True)
class SolidSpace:
    """Where a robot may be.

    Attributes:
        size: The robot with its clearance.
        solids: What stands, shape (n,).
        ground: The ground; None: there is none.
        altitude: How low and how high it may be.
        home: How high the ground is under the start [m]; NaN if nobody knows.
        walls: Bounds and fences, with the margin that is kept from them.
    """

    size: SpatialSize
    solids: Sequence[Solid]
    ground: GroundSpec | None
    altitude: AltitudeSpec | None
    home: float
    walls: FreeSpace

    @classmethod
    def of(
        cls,
        size: SpatialSize,
        obstacles: Sequence[Obstacle],
        walls: tuple[tuple[float, float, float, float] | None, Sequence[Sequence[Corners]]],
        ground: GroundSpec | None,
        altitude: AltitudeSpec | None,
        home: float,
    ) -> SolidSpace:
        """The space among obstacles of one sound shape each, inside of bounds and fences."""
        bounds, fences = walls
        free = FreeSpace(bounds, fences, [], size.radius + size.margin)
        solids = [obstacle.solid() for obstacle in obstacles]
        return cls(size, solids, ground, altitude, home, free)

    @cached_property
    def _tree(self) -> Any:
        import shapely

        boxes = np.array([box_of(solid) for solid in self.solids]).reshape(-1, 6)
        return shapely.STRtree(list(np.atleast_1d(shapely.box(*boxes[:, [0, 1, 3, 4]].T))))

    def around(self, x: float, y: float) -> list[int]:
        """The solids that may be too near to a place at some height."""
        import shapely

        if not self.solids:
            return []
        far = self.size.radius + self.size.margin
        window = shapely.box(x - far, y - far, x + far, y + far)
        found: list[int] = sorted(self._tree.query(window).tolist())
        return found

    def near_solids(self, body: UprightBody) -> Iterator[tuple[int, float]]:
        """The solids that a body is too near to, each with its distance [m]."""
        for i in self.around(body.x, body.y):
            distance = solid_distance(body, self.solids[i], self.size.margin)
            if distance < self.size.margin - ROUND_OFF_M:
                yield i, distance

    def above_ground(self, body: UprightBody, *, only_known: bool = False) -> float:
        """The distance of a body from the ground [m]; infinite if it is out of reach.

        Args:
            body: The body.
            only_known: Whether to leave out what isn't known of the ground, though it is blocked.
        """
        ground, reach = self.ground, self.size.margin
        if ground is None:
            return math.inf
        if ground.terrain is None:
            return body.low - ground_height(ground, body.x, body.y)
        is_blocked = ground.nodata == "blocked" and not only_known
        return ground_distance(body, ground.terrain, blocked=is_blocked, reach=reach)

    def band(self, x: float, y: float) -> tuple[float, float]:
        """The heights between which the reference point may be at a place [m].

        Where its ground isn't known, heights above ground aren't limited.
        """
        if self.altitude is None:
            return -math.inf, math.inf
        above = self.altitude.above
        zero = 0.0 if above == "amsl" else self.home
        zero = ground_height(self.ground, x, y) if above == "ground" else zero
        if math.isnan(zero):
            return -math.inf, math.inf
        low, high = self.altitude.min_m, self.altitude.max_m
        return (
            -math.inf if low is None else zero + low,
            math.inf if high is None else zero + high,
        )

    def is_free(self, place: Place) -> bool:
        """Whether the robot may be at a place, as far as its height decides it."""
        body, (low, high) = self.size.at(place), self.band(*place[:2])
        return (
            low - ROUND_OFF_M <= place[2] <= high + ROUND_OFF_M
            and self.above_ground(body) >= self.size.margin - ROUND_OFF_M
            and not any(self.near_solids(body))
        )

    def free_height(self, place: Place, zero: float) -> float | None:
        """The nearest height at which the robot may be at a place [m]; None if none is found.

        Heights over and under what stands there, the ground's and the band's are tried.

        Args:
            place: Where, x, y, z [m].
            zero: What the height is in round numbers above [m].
        """
        x, y, z = place
        up = self.size.upwards
        boxes = [box_of(self.solids[i]) for i in self.around(x, y)]
        low, high = self.band(x, y)
        over = [low, self._ground_top(x, y) + up, *(box[5] + up for box in boxes)]
        under = [high, *(box[2] - up for box in boxes)]
        rounded = [math.ceil(1e3 * (h - zero)) / 1e3 for h in over if math.isfinite(h)]
        rounded += (math.floor(1e3 * (h - zero)) / 1e3 for h in under if math.isfinite(h))
        tried = sorted((zero + height for height in rounded), key=lambda h: abs(h - z))
        return next((height for height in tried if self.is_free((x, y, height))), None)

    def _ground_top(self, x: float, y: float) -> float:
        """How high the ground is about a place [m]; -inf if there is none or nobody knows."""
        if self.ground is None:
            return -math.inf
        if self.ground.terrain is None:
            return ground_height(self.ground, x, y)
        terrain, far = self.ground.terrain, self.size.radius + self.size.margin
        steps = math.ceil(far / terrain.cell) + 1
        offsets = terrain.cell * np.arange(-steps, steps + 1)
        nodes = np.stack(np.meshgrid(x + offsets, y + offsets), axis=-1)
        u = np.round((nodes - terrain.origin) / terrain.cell).astype(int)
        ny, nx = terrain.heights.shape
        inside = (u >= 0).all(axis=-1) & (u[..., 0] < nx) & (u[..., 1] < ny)
        heights = terrain.heights[u[inside][:, 1], u[inside][:, 0]]
        known = heights[~np.isnan(heights)]
        return float(known.max()) if known.size else -math.inf


def box_of(solid: Solid) -> tuple[float, float, float, float, float, float]:
    """The box round a solid: x, y, z of its least corner, then of its greatest [m]."""
    return solid.extent if isinstance(solid, Voxels) else solid.box
