"""What a robot keeps clear of in space: solids, ground, bounds, and limits of its height."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.errors import GeometryError
from viaspline.handed_in import all_of, number_from, numbers_from
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.space import space_answers as space_answers  # a certificate asks them
from viaspline.kernels.space.ground_pyramid import ground_heights
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.space_distance import space_distances
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.solids import GridPrism, Prism, RoundedSegment, Solid
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.told_value import ToldValue
from viaspline.world.handed_places import checked_bounds
from viaspline.world.pack import Rings
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.pack_space import pack_space
from viaspline.world.world import BOUNDS, NOTHING

SOLIDS = (Prism, GridPrism, RoundedSegment, Voxels)


@dataclass(frozen=True, eq=False)
class SpatialWorld(ToldValue, ComparedByValue):
    """Solids and ground, in bounds that reach over all heights.

    A place is that of the robot's reference point, and its distance that of an upright cylinder
    about it, the core: exact outside of all solids, negative inside. The ground is taken as
    columns, one for each patch of the terrain and as high as its highest corner.

    Attributes:
        packed: What kernels take.
        names: Of the solids, (n,).
        ground: Terrain, the height of flat ground [m], or None.
        bounds: ``x_min, y_min, x_max, y_max`` [m], or None.
        band: In which heights the robot stays.

    Example:
        >>> from viaspline.mission.shapes.rounded_ring import RoundedRing
        >>> mast = Prism(RoundedRing([[(0.0, 0.0)]], 1.0), 0.0, 20.0)
        >>> world = SpatialWorld.of([mast], ["mast"], ground=0.0, core_half_height=0.5)
        >>> world.distance([(4, 0, 10), (0, 0, 25), (40, 0, 3)])
        array([3. , 4.5, 2.5])
        >>> [world.name(index) for index in world.nearest([(4, 0, 10), (40, 0, 3)])[1]]
        ['mast', 'ground']
    """

    packed: PackedSpace
    names: tuple[str, ...]
    ground: Terrain | float | None
    bounds: tuple[float, float, float, float] | None
    band: HeightBand

    @classmethod
    def of(
        cls,
        solids: Iterable[Solid] = (),
        names: Iterable[str] | None = None,
        ground: Terrain | float | None = None,
        bounds: Sequence[float] | None = None,
        core_radius: float = 0.0,
        core_half_height: float = 0.0,
        *,
        nodata: Literal["blocked", "free"] = "blocked",
        fences: Sequence[Rings] = (),
        band: HeightBand | None = None,
    ) -> SpatialWorld:
        """The world of these solids.

        Args:
            solids: What is known.
            names: What each is called; "obstacle 1" and so on if they are not given.
            ground: Terrain, the height of flat ground [m], or None.
            bounds: ``x_min, y_min, x_max, y_max`` [m], or None.
            core_radius: Of the cylinder about a place [m].
            core_half_height: Of the cylinder about a place [m].
            nodata: What a patch is of which the terrain knows nothing, and all beyond its edge: as
                high as can be, or not there.
            fences: What the robot stays inside of: each a ring and its holes [m].
            band: In which heights it stays; everywhere without.

        Raises:
            GeometryError: For something else than that, or as many names as there are no solids.
        """
        given = all_of("solids", solids, SOLIDS, "give Prism, GridPrism, RoundedSegment or Voxels")
        called: tuple[str, ...] = tuple(f"obstacle {i + 1}" for i in range(len(given)))
        if names is not None:
            called = all_of("names", names, str, "give a name for each")
        if len(called) != len(given):
            raise GeometryError(
                f"{len(called)} names for {len(given)} solids; give one for each, or none"
            )
        if ground is not None and not isinstance(ground, Terrain):
            ground = _finite("ground", ground)
        if nodata not in ("blocked", "free"):
            raise GeometryError(f"nodata is {nodata!r}; give 'blocked' or 'free'")
        core = (_size("core_radius", core_radius), _size("core_half_height", core_half_height))
        edges = None if bounds is None else checked_bounds(bounds)
        kept = HeightBand() if band is None else band
        unknown = math.inf if nodata == "blocked" else -math.inf
        if kept.knows_ground and ground is None:
            raise GeometryError("the band is one above ground, and there is none; give ground")
        packed = pack_space(given, ground, unknown, edges, fences, core, kept.numbers)
        return cls(packed, called, ground, edges, kept)

    def __len__(self) -> int:
        return len(self.names)

    def __repr__(self) -> str:
        return f"SpatialWorld({len(self)} solids, ground={self.ground}, bounds={self.bounds})"

    def name(self, index: int) -> str:
        """What an index of ``nearest`` is called."""
        if index == NOTHING:
            return "nothing"
        if index <= BOUNDS:
            return "bounds" if index == BOUNDS else f"fence {BOUNDS - index}"
        return "ground" if index == len(self.names) else self.names[index]

    def distance(self, places: ArrayLike) -> NDArray[np.float64]:
        """Signed distance between the world and the core at places [m].

        Args:
            places: Shape (n, 3) or (3,).

        Returns:
            Shape (n,), or a scalar array for one place; infinite in an empty world.

        Raises:
            GeometryError: For other shapes, and for places that are not finite.
        """
        return self.nearest(places)[0]

    def nearest(self, places: ArrayLike) -> tuple[Floats, Ints]:
        """Signed distance [m] and what is nearest.

        Returns:
            (distance, index): the solid's index; one more than the last for the ground, -2 for
            the bounds, -3 - f for fence f, -1 in an empty world; see ``name``.
        """
        flat, shape = _as_places(places)
        distance, index = space_distances(self.packed, flat)
        return distance.reshape(shape), index.reshape(shape)

    def ground_at(self, places: ArrayLike) -> Floats:
        """Height of the ground [m] below places (n, 2), (n, 3) or a single one.

        Returns:
            NaN where the terrain knows nothing; -inf without any ground.

        Raises:
            GeometryError: For other shapes.
        """
        array = numbers_from("places", places)
        if array.ndim == 0 or array.shape[-1] not in (2, 3):
            raise GeometryError(f"places have shape {array.shape}; give (n, 2) or (n, 3)")
        flat = np.array(array.reshape(-1, array.shape[-1])[:, :2])
        found: Floats = ground_heights(self.packed, flat)
        return found.reshape(array.shape[:-1])


def _as_places(places: ArrayLike) -> tuple[Floats, tuple[int, ...]]:
    array = numbers_from("places", places)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise GeometryError(f"places have shape {array.shape}; give (n, 3) or (3,)")
    if not np.isfinite(array).all():
        raise GeometryError("places contain NaN or infinity; give finite numbers")
    return np.array(array.reshape(-1, 3)), array.shape[:-1]


def _finite(name: str, given: float) -> float:
    number = number_from(name, given)
    if not math.isfinite(number):
        raise GeometryError(f"{name} is {number}; give a finite height [m]")
    return number


def _size(name: str, given: float) -> float:
    number = number_from(name, given)
    if not 0.0 <= number < math.inf:
        raise GeometryError(f"{name} is {number}; give 0 m or more")
    return number
