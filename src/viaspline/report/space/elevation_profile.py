"""The path unrolled: its height over the distance along it, with the ground and what is near.

What stands under or over the path is drawn dark, what stands beside it, within ``BESIDE_M``, light.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np
import shapely
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Flags, Floats
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.solids import Prism, RoundedSegment
from viaspline.report import style
from viaspline.report.space.spatial_scene import NamedSolid, SpatialScene

BESIDE_M: Final = 10.0
SAMPLES: Final = 1200
GROUND: Final = "#b59a6d"
BAND: Final = "#5b8e7d"


class Silhouette(NamedTuple):
    """What of a solid is near a path, place by place.

    Attributes:
        low: Where it begins in height [m], shape (n,); NaN where it isn't near.
        high: Where it ends [m].
        meets: Whether it stands right under or over the path.
    """

    low: Floats
    high: Floats
    meets: Flags


class ProfileRange(NamedTuple):
    """Heights that are allowed along a path [m], shape (n,) each, at evenly spaced distances."""

    low: Floats
    high: Floats


def draw_profile(
    axes: Axes, path: Path, scene: SpatialScene, body_radius: float, band: ProfileRange | None
) -> list[Artist]:
    """Draw the unrolled elevation; returns handles for the legend.

    Args:
        axes: Where to.
        path: In space.
        scene: What stands in the world.
        body_radius: Of the body [m]: what is so near in plan is under or over it.
        band: What heights are allowed, if they are limited: at ``SAMPLES`` even distances.
    """
    distances = np.linspace(0.0, path.length, SAMPLES)
    places = path.at_distance(distances)
    handles: list[Artist] = []
    ground = scene.ground(places[:, :2])
    heights = places[:, 2]
    shown = _shown(heights, ground, band)
    if np.isfinite(ground).any():
        axes.fill_between(distances, ground, shown[0] - 1e3, color=GROUND, alpha=0.55, linewidth=0)
        axes.plot(distances, ground, color=GROUND, linewidth=1.0)
        handles.append(Patch(facecolor=GROUND, alpha=0.55, label="ground under the path"))
    handles += _draw_solids_near(axes, distances, places, scene, body_radius, shown)
    if band is not None:
        for edge in band:
            axes.plot(distances, edge, color=BAND, linewidth=1.0, linestyle=(0, (4, 2)))
        handles.append(Line2D([], [], color=BAND, linestyle=(0, (4, 2)), label="altitude band"))
    axes.plot(distances, heights, color=style.PATH, linewidth=1.8, zorder=4)
    for via in path.vias:
        at = float(path.distance(via.u))
        colour = style.DETOUR if via.kind == "detour" else style.INK
        axes.plot([at], [via.at[2]], "o", color=colour, markersize=3.2, zorder=5)
    axes.set_xlim(0.0, max(path.length, 1e-9))
    axes.set_ylim(*shown)
    return handles


def _shown(heights: Floats, ground: Floats, band: ProfileRange | None) -> tuple[float, float]:
    """From where to where heights are shown [m]."""
    finite = [heights, ground[np.isfinite(ground)]]
    if band is not None:
        finite += [edge[np.isfinite(edge)] for edge in band]
    every = np.concatenate(finite)
    low, high = float(every.min()), float(every.max())
    grow = max(0.12 * (high - low), 1.0)
    return low - grow, high + grow


def _draw_solids_near(
    axes: Axes, distances: Floats, places: Floats, scene: SpatialScene, radius: float,
    shown: tuple[float, float],
) -> list[Artist]:  # fmt: skip
    if not len(scene.solids):
        return []
    reach = shapely.LineString(places[:, :2]).buffer(BESIDE_M)
    shapely.prepare(reach)
    near = shapely.intersects(reach, scene.shadows)
    beside, under = False, False
    for k in np.flatnonzero(near).tolist():
        seen = silhouette(scene.solids[k], places, radius)
        low = np.maximum(seen.low, shown[0] - 1.0)
        high = np.minimum(seen.high, shown[1] + 1.0)
        light = np.isfinite(low) & ~seen.meets
        dark = np.isfinite(low) & seen.meets
        for mask, alpha, order in ((light, 0.35, 1.5), (dark, 1.0, 2.0)):
            if mask.any():
                axes.fill_between(
                    distances, low, high, where=_widened(mask).tolist(), color=style.OBSTACLE,
                    alpha=alpha, linewidth=0, zorder=order,
                )  # fmt: skip
        beside |= bool(light.any())
        under |= bool(dark.any())
    handles: list[Artist] = []
    if under:
        handles.append(Patch(facecolor=style.OBSTACLE, label="under or over the path"))
    if beside:
        words = f"beside it, within {BESIDE_M:g} m"
        handles.append(Patch(facecolor=style.OBSTACLE, alpha=0.35, label=words))
    return handles


def _widened(mask: Flags) -> Flags:
    """With one more sample at either end, so that a single one is seen."""
    wide = mask.copy()
    wide[1:] |= mask[:-1]
    return wide


def silhouette(one: NamedSolid, places: Floats, radius: float) -> Silhouette:
    """What of a solid is near the places of a path.

    Args:
        one: The solid.
        places: [m], shape (n, 3).
        radius: What is so near in plan is under or over the path [m].
    """
    solid = one.solid
    if isinstance(solid, Voxels):
        return _of_voxels(solid, places)
    apart = shapely.distance(shapely.points(places[:, :2]), one.shadow)
    near, meets = np.asarray(apart <= BESIDE_M), np.asarray(apart <= radius)
    if isinstance(solid, Prism):
        low = np.where(near, max(solid.low, -1e6), np.nan)
        return Silhouette(low, np.where(near, min(solid.high, 1e6), np.nan), meets)
    middle = _height_beside(solid, places)
    half = solid.radius
    return Silhouette(
        np.where(near, middle - half, np.nan), np.where(near, middle + half, np.nan), meets
    )


def _height_beside(solid: RoundedSegment, places: Floats) -> Floats:
    """Height of a line where it is nearest to places in plan [m]."""
    first, last = np.array(solid.first), np.array(solid.last)
    way = last - first
    level = float(way[:2] @ way[:2])
    if level == 0.0:
        return np.clip(places[:, 2], min(first[2], last[2]), max(first[2], last[2]))
    share = np.clip((places[:, :2] - first[:2]) @ way[:2] / level, 0.0, 1.0)
    return np.asarray(first[2] + share * way[2])


def _of_voxels(voxels: Voxels, places: Floats) -> Silhouette:
    """The cubes in the column of each place that are nearest to it in height, below or above."""
    index = np.floor((places - np.array(voxels.origin)) / voxels.cell).astype(int)
    nx, ny, nz = voxels.blocked.shape
    inside = ((index[:, :2] >= 0) & (index[:, :2] < (nx, ny))).all(axis=1)
    low = np.full(len(places), np.nan)
    high = np.full(len(places), np.nan)
    for k in np.flatnonzero(inside).tolist():
        column = np.flatnonzero(voxels.blocked[index[k, 0], index[k, 1]])
        below = column[column <= min(index[k, 2], nz - 1)]
        if below.size:
            low[k] = -math.inf
            high[k] = voxels.origin[2] + (below[-1] + 1) * voxels.cell
    low = np.where(np.isfinite(high), voxels.origin[2], np.nan)
    return Silhouette(low, high, np.isfinite(high))
