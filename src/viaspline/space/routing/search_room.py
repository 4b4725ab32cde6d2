"""The space in which a route is searched, and the lattices in it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from weakref import WeakKeyDictionary

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.routing import shape_moves as shape_moves  # a search asks them
from viaspline.kernels.space.routing import voxel_moves as voxel_moves
from viaspline.kernels.space.routing.lattice_nodes import MOST_ASIDE
from viaspline.kernels.space.routing.route_protocol import PlaceLattice
from viaspline.kernels.space.routing.voxel_block import VoxelBlock, voxel_block
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.solids import Solid
from viaspline.world.space.spatial_world import SpatialWorld

_STEPS_ACROSS, _LAYERS, _MOST_ACROSS = 50, 4, 500
_MARGIN_STEPS = 2.0
_MOST_CUBES = 1.0  # a body and its clearance that reach farther are near too many cubes at once

_BLOCKS: WeakKeyDictionary[Voxels, VoxelBlock] = WeakKeyDictionary()
"""The blocks of all voxels that are still in use, without limits: rooms of a map share them."""


@dataclass(frozen=True, eq=False)
class SearchRoom:
    """What a search sees of a world.

    Attributes:
        packed: What kernels ask.
        body: Radius of the robot about a place that the distances already hold [m].
        limits: Within which places may be, x, y, z from and to [m], (6,); infinite where nothing
            limits them.
        solids: A box about all solids, likewise; from inf to -inf where there are none.
        anchor: A place of the lattice that suits the world, and its step [m], (4,); a step of 0
            lets the search choose.
        cubes: All that stands, without limits, where that is one block of voxels and the robot a
            ball: what is asked of cubes alone is answered several times as fast.
    """

    packed: PackedSpace
    body: float
    limits: Floats
    solids: Floats
    anchor: Floats
    cubes: VoxelBlock | None = None

    @classmethod
    def of_world(cls, world: SpatialWorld) -> SearchRoom:
        """Of a world's solids, voxels and ground, and the limits of its places."""
        packed = world.packed
        limits = np.array([-np.inf] * 3 + [np.inf] * 3)
        if packed.bounds.size:
            limits[[0, 1, 3, 4]] = packed.bounds[0]
        limits[[2, 5]] = packed.height_limits[:2]
        solids = np.array([np.inf] * 3 + [-np.inf] * 3)
        if packed.boxes.size:
            solids[:3] = packed.boxes[:, :3].min(axis=0)
            solids[3:] = packed.boxes[:, 3:].max(axis=0)
        if world.ground is not None:
            floor = packed.ground_frame[3] if np.isfinite(packed.ground_frame[3]) else None
            floor = _lowest(packed) if floor is None else floor
            limits[2] = max(limits[2], floor)
            heights = packed.heights[np.isfinite(packed.heights)]
            solids[5] = max(solids[5], float(heights.max()) if heights.size else floor)
        return cls(packed, float(packed.core[0]), limits, solids, _voxel_anchor(packed))

    def knowing(self, world: SpatialWorld, solids: Sequence[Solid]) -> SearchRoom:
        """This one of a world, quicker where voxels alone stand in it.

        Args:
            world: Its world.
            solids: All that stands there, as the world numbers them.
        """
        packed = world.packed
        is_more = world.ground is not None or len(packed.fences) or packed.core.any()
        if is_more or len(world) != 1 or len(solids) != 1 or not isinstance(solids[0], Voxels):
            return self
        return replace(self, cubes=_block_of(solids[0]))

    def searched(self, radius: float, places: Floats) -> PackedSpace | VoxelBlock:
        """What a search asks for ways that keep a radius from everything.

        Args:
            radius: [m].
            places: Through which they lead [m], (n, 3).
        """
        cubes = self.cubes
        if cubes is None or not 0.0 < radius <= _MOST_CUBES * cubes.frame[3]:
            return self.packed
        inward = np.array([radius, radius, 0.0])  # heights are those of the place itself
        low, high = self.limits[:3] + inward, self.limits[3:] - inward
        with np.errstate(invalid="ignore"):  # where nothing limits the places
            low = np.where(low - self.limits[:3] < inward, np.nextafter(low, np.inf), low)
            high = np.where(self.limits[3:] - high < inward, np.nextafter(high, -np.inf), high)
        if (places < low).any() or (places > high).any():
            return self.packed  # by a rounding: they keep the bounds
        return cubes._replace(limits=np.concatenate([low, high]))

    def lattice(
        self, start: Floats, goal: Floats, margin: float, halvings: int = 0,
        reach: float = math.inf,
    ) -> PlaceLattice:  # fmt: skip
        """A lattice that a way between two places lies in.

        Args:
            start: [m], (3,).
            goal: [m], (3,).
            margin: Beyond the solids, where nothing limits the places [m].
            halvings: How often its step is halved.
            reach: How far from both places what lies about is that its step counts on [m].
        """
        low, high = self._box(start, goal, margin)
        step = float(self.anchor[3])
        if step == 0.0:
            nearest, farthest = np.minimum(start, goal) - reach, np.maximum(start, goal) + reach
            step = _step_for(np.minimum(high, farthest) - np.maximum(low, nearest))
        step /= 2.0**halvings
        low, high = self._box(start, goal, margin + _MARGIN_STEPS * step)
        first = low.copy()
        if self.anchor[3] > 0.0:
            first = self.anchor[:3] + step * np.ceil((low - self.anchor[:3]) / step - 1e-9)
        else:
            steps = np.floor((high - low) / step + 1e-9)  # what lacks but a rounding is a whole one
            first = low + 0.5 * (high - low - step * steps)
        counts = np.maximum(np.floor((high - first) / step + 1e-9).astype(np.int64) + 1, 1)
        return PlaceLattice(np.array([*first, step]), np.minimum(counts, MOST_ASIDE))

    def cells(self, start: Floats, goal: Floats, margin: float, halvings: int) -> PlaceLattice:
        """Cells that cover all the space in which a way between two places may lie."""
        lattice = self.lattice(start, goal, margin, halvings)
        step = lattice.frame[3]
        low, high = self._box(start, goal, margin + _MARGIN_STEPS * step)
        before = np.maximum(np.ceil((lattice.frame[:3] - low) / step - 0.5 + 1e-6), 0.0)
        first = lattice.frame[:3] - step * before
        counts = np.ceil((high - first) / step - 0.5 + 1e-6).astype(np.int64) + 1
        return PlaceLattice(np.array([*first, step]), np.clip(counts, 1, MOST_ASIDE))

    def _box(self, start: Floats, goal: Floats, margin: float) -> tuple[Floats, Floats]:
        """The limits; without them, the solids and the two places, and a margin."""
        ends = np.array([start, goal])
        low, high = ends.min(axis=0), ends.max(axis=0)
        solid_low, solid_high = self.solids[:3], self.solids[3:]
        low = np.where(np.isfinite(solid_low), np.minimum(low, solid_low), low) - margin
        high = np.where(np.isfinite(solid_high), np.maximum(high, solid_high), high) + margin
        low = np.where(np.isfinite(self.limits[:3]), self.limits[:3], low)
        high = np.where(np.isfinite(self.limits[3:]), self.limits[3:], high)
        return low, np.maximum(low, high)


def _block_of(voxels: Voxels) -> VoxelBlock:
    """The cubes of a map, without limits."""
    found = _BLOCKS.get(voxels)
    if found is None:
        everywhere = np.array([-np.inf] * 3 + [np.inf] * 3)
        found = voxel_block(voxels.blocked, voxels.cell, voxels.origin, everywhere)
        _BLOCKS[voxels] = found
    return found


def _lowest(packed: PackedSpace) -> float:
    heights = packed.heights[np.isfinite(packed.heights)]
    return float(heights.min()) if heights.size else 0.0


def _step_for(size: Floats) -> float:
    """A fiftieth of the world, or less where it is flat."""
    across = float(size[:2].max())
    layer = max(float(size[2]) / _LAYERS, across / _MOST_ACROSS)
    step = min(across / _STEPS_ACROSS, layer)
    return step if step > 0.0 else max(float(size.max()) / _STEPS_ACROSS, 1.0)


def _voxel_anchor(packed: PackedSpace) -> Floats:
    """The middle of a cube of the finest voxels, and its side; zeros where there are none."""
    frames = packed.voxel_frames
    spatial = frames[np.isnan(frames[:, 6])]  # squares over heights have no cubes
    if not len(spatial):
        return np.zeros(4)
    x, y, z, c, s, side = spatial[int(np.argmin(spatial[:, 5])), :6].tolist()
    half = 0.5 * side
    if abs(s) < 1e-9 or abs(c) < 1e-9:
        return np.array([x + half * (c - s), y + half * (s + c), z + half, side])
    return np.array([x, y, z + half, side / math.sqrt(2.0)])
