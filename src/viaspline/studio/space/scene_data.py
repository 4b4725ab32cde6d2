"""What stands in the world of a mission in space, as the page draws it from above and in 3-D.

It is told apart from plans, and once: it stays while points of the route are dragged.

Tested through ``studio/space/test_spatial_server``.
"""

from __future__ import annotations

import base64
import hashlib
import io
import math
from collections.abc import Iterator
from typing import Any, Final

import contourpy
import numpy as np
import shapely

from viaspline.kernels.arrays import Floats
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.solids import RoundedSegment
from viaspline.mission.world_spec import WorldSpec
from viaspline.report.space.spatial_scene import NamedSolid
from viaspline.studio.page_messages import encoded
from viaspline.studio.page_numbers import finite, rounded
from viaspline.studio.space.voxel_cubes import VoxelCubes, roof_heights

MAX_NODES_ASIDE: Final = 160
"""Of a terrain that is sent; of a finer one every so many nodes."""

CONTOUR_COUNT: Final = 9
MAX_KEPT_SCENES: Final = 8
OUTLINE_TOLERANCE_M: Final = 0.02


class Scenes:
    """The scenes of worlds, by the names that plans tell, and pictures of voxels from above."""

    def __init__(self) -> None:
        self._last: tuple[WorldSpec, str] | None = None
        self._voxels: dict[bytes, dict[str, Any]] = {}
        self._kept: dict[str, bytes] = {}

    def name_of(self, world: WorldSpec) -> str:
        """What the scene of a world is called; it is kept from then on."""
        if self._last is not None and self._last[0] == world:
            return self._last[1]
        content = encoded(self._scene(world)).encode()
        name = hashlib.blake2b(content, digest_size=12).hexdigest()
        while len(self._kept) >= MAX_KEPT_SCENES and name not in self._kept:
            del self._kept[next(iter(self._kept))]
        self._kept[name] = content
        self._last = (world, name)
        return name

    def content(self, name: str) -> bytes | None:
        """A scene as JSON, by its name."""
        return self._kept.get(name)

    def _scene(self, world: WorldSpec) -> dict[str, Any]:
        ground = world.ground
        return {
            "solids": list(self._solids(world)),
            "terrain": None if ground is None or ground.terrain is None else _mesh(ground.terrain),
            "contours": [] if ground is None or ground.terrain is None else _lines(ground.terrain),
            "flat": None if ground is None else ground.flat_m,
            "bounds": world.bounds,
        }

    def _solids(self, world: WorldSpec) -> Iterator[dict[str, Any]]:
        for key, obstacles in (("known", world.known), ("unseen", world.unseen)):
            for i, obstacle in enumerate(obstacles):
                if obstacle.motion is not None:
                    continue
                solid = obstacle.solid()
                head = {"list": key, "index": i, "name": obstacle.name or ""}
                if isinstance(solid, Voxels):
                    yield head | self._cubes(solid)
                elif isinstance(solid, RoundedSegment):
                    yield head | {
                        "kind": "segment", "first": solid.first, "last": solid.last,
                        "radius": solid.radius,
                    }  # fmt: skip
                else:
                    shadow = NamedSolid(solid).shadow
                    yield head | {
                        "kind": "prism", "parts": _rings(shadow), "low": finite(solid.low),
                        "high": finite(solid.high),
                    }  # fmt: skip

    def _cubes(self, voxels: Voxels) -> dict[str, Any]:
        if voxels.digest not in self._voxels:
            if len(self._voxels) >= MAX_KEPT_SCENES:
                del self._voxels[next(iter(self._voxels))]
            self._voxels[voxels.digest] = _cube_data(voxels)
        return self._voxels[voxels.digest]


def _cube_data(voxels: Voxels) -> dict[str, Any]:
    cubes = VoxelCubes.of(voxels)
    indices = np.ascontiguousarray(cubes.indices, dtype="<i2")
    return {
        "kind": "voxels", "origin": voxels.origin, "cell": cubes.cell,
        "extent": voxels.extent, "cubes": base64.b64encode(indices.tobytes()).decode(),
        "roofs": base64.b64encode(_roofs_png(voxels)).decode(),
    }  # fmt: skip


def _roofs_png(voxels: Voxels) -> bytes:
    """How high columns of cubes reach, as a picture: the darker the higher, clear without cubes."""
    from PIL import Image

    heights = roof_heights(voxels)
    low, high = voxels.extent[2], voxels.extent[5]
    grey = np.nan_to_num(215.0 - 130.0 * (heights - low) / (high - low), nan=0.0)
    alpha = np.where(np.isfinite(heights), 255, 0)
    image = np.stack((grey, alpha), axis=-1).astype(np.uint8)
    buffer = io.BytesIO()
    upright = np.ascontiguousarray(image.transpose(1, 0, 2)[::-1])
    Image.fromarray(upright, "LA").save(buffer, "PNG", compress_level=3)
    return buffer.getvalue()


def _rings(shadow: shapely.Geometry) -> list[list[list[float]]]:
    """The parts of an outline, each its outer ring and its holes, as x, y in turn."""
    parts = shapely.get_parts(shapely.simplify(shadow, OUTLINE_TOLERANCE_M)).tolist()
    return [
        [
            rounded(np.ravel(np.array(ring.coords)[:-1, :2]), 3)
            for ring in (part.exterior, *part.interiors)
        ]
        for part in parts
    ]


def _thinned(terrain: Terrain) -> tuple[Floats, float]:
    """Heights of a terrain at no more nodes than are drawn, and how far apart these are [m]."""
    step = max(1, math.ceil(max(terrain.heights.shape) / MAX_NODES_ASIDE))
    return terrain.heights[::step, ::step], terrain.cell * step


def _mesh(terrain: Terrain) -> dict[str, Any]:
    heights, cell = _thinned(terrain)
    known = np.round(heights, 2)
    return {
        "origin": terrain.origin,
        "cell": cell,
        "nx": heights.shape[1],
        "ny": heights.shape[0],
        "heights": [None if math.isnan(z) else z for z in known.ravel().tolist()],
    }


def _lines(terrain: Terrain) -> list[dict[str, Any]]:
    """Contour lines of a terrain: their heights [m], and their places as x, y in turn."""
    heights, cell = _thinned(terrain)
    if not terrain.highest > terrain.lowest:
        return []
    step = _round_step((terrain.highest - terrain.lowest) / CONTOUR_COUNT)
    ny, nx = heights.shape
    x = terrain.origin[0] + cell * np.arange(nx)
    y = terrain.origin[1] + cell * np.arange(ny)
    drawn = contourpy.contour_generator(x, y, np.ma.masked_invalid(heights))
    first = math.ceil(terrain.lowest / step)
    levels = [k * step for k in range(first, math.floor(terrain.highest / step) + 1)]
    return [
        {"height": round(level, 6), "line": rounded(np.ravel(np.asarray(line)), 2)}
        for level in levels
        for line in drawn.lines(level)
    ]


def _round_step(least: float) -> float:
    """The least of 1, 2 and 5 times a power of ten that is no less.

    >>> _round_step(0.7), _round_step(13.0)
    (1.0, 20.0)
    """
    power = 10.0 ** math.floor(math.log10(least))
    return next(k * power for k in (1.0, 2.0, 5.0, 10.0) if k * power >= least * (1.0 - 1e-9))
