"""Solids and ground seen from above: outlines with the heights of their roofs, contour lines.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
import shapely
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch

from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.solids import GridPrism, Prism
from viaspline.report import style
from viaspline.report.canvas import outline, renderer_of
from viaspline.report.label_layout import overlaps
from viaspline.report.labels import Labels
from viaspline.report.space.spatial_scene import NamedSolid, SpatialScene

MAX_HEIGHTS_WRITTEN: Final = 40
"""Roofs whose heights are written on the map; of more only the largest."""

MAX_CONTOUR_NODES: Final = 400
"""Of a terrain aside; of a finer one every so many nodes are drawn."""

CONTOUR_LABEL: Final = "height on a contour line"

HEIGHT_RANK: Final = 8
"""Of heights among labels: names and warnings choose their places first."""


def draw_solids(axes: Axes, scene: SpatialScene) -> list[Artist]:
    """Draw what stands in the world and the ground under it; returns handles for the legend."""
    handles: list[Artist] = []
    if scene.terrain is not None:
        handles.append(_draw_contours(axes, scene.terrain))
    prisms = [one for one in scene.solids if isinstance(one.solid, Prism | GridPrism)]
    overhead = [one for one in prisms if scene.is_overhead(one)]
    standing = [one for one in prisms if one not in overhead]
    lines = [one for one in scene.solids if not isinstance(one.solid, Prism | GridPrism | Voxels)]
    if standing:
        _fill(axes, standing, style.OBSTACLE, "-", 1.0)
        face = Patch(facecolor=style.OBSTACLE, edgecolor=style.OBSTACLE_EDGE)
        face.set_label("stands there, roof height [m]")
        handles.append(face)
    if overhead:
        _fill(axes, overhead, style.OBSTACLE, (0, (3, 2)), 0.45)
        face = Patch(
            facecolor=style.OBSTACLE, edgecolor=style.OBSTACLE_EDGE, alpha=0.5, linestyle="--"
        )
        face.set_label("overhead, from - to [m]")
        handles.append(face)
    if lines:
        _fill(axes, lines, style.OBSTACLES[1][0], "-", 0.7)
        face = Patch(facecolor=style.OBSTACLES[1][0], edgecolor=style.OBSTACLES[1][1])
        face.set_label("ball, cable or mast")
        handles.append(face)
    fields = [one.solid for one in scene.solids if isinstance(one.solid, Voxels)]
    handles += [_draw_voxels(axes, voxels) for voxels in fields]
    return handles


def _fill(
    axes: Axes, solids: list[NamedSolid], face: str, dash: str | tuple[int, tuple[int, ...]],
    alpha: float,
) -> None:  # fmt: skip
    edge = style.OBSTACLE_EDGE if face == style.OBSTACLE else style.OBSTACLES[1][1]
    for one in solids:
        axes.add_patch(
            PathPatch(
                outline(one.shadow),
                facecolor=face,
                edgecolor=edge,
                linewidth=0.7,
                linestyle=dash,
                alpha=alpha,
                zorder=2,
            )
        )


def _draw_contours(axes: Axes, terrain: Terrain) -> Artist:
    """Contour lines of the ground, labelled."""
    step = max(1, math.ceil(max(terrain.heights.shape) / MAX_CONTOUR_NODES))
    heights = terrain.heights[::step, ::step]
    ny, nx = heights.shape
    x = terrain.origin[0] + terrain.cell * step * np.arange(nx)
    y = terrain.origin[1] + terrain.cell * step * np.arange(ny)
    if terrain.highest > terrain.lowest:
        lines = axes.contour(x, y, heights, 9, colors="#8a7350", linewidths=0.6, zorder=1)
        for text in axes.clabel(lines, fontsize=style.SMALL_PT - 1.5, fmt="%g"):
            text.set_gid(CONTOUR_LABEL)
    return Line2D([], [], color="#8a7350", linewidth=0.8, label="height of the ground [m]")


def clear_contour_labels(axes: Axes) -> None:
    """Take heights off contour lines where they lie under another text or reach beyond the axes."""
    renderer = renderer_of(axes.figure)
    frame = np.array(axes.get_window_extent().extents)
    texts = [text for text in axes.texts if text.get_gid() == CONTOUR_LABEL]
    others = [text for text in axes.texts if text.get_gid() != CONTOUR_LABEL and text.get_text()]
    boxes = np.array([one.get_window_extent(renderer).extents for one in others]).reshape(-1, 4)
    for text in texts:
        box = np.array([text.get_window_extent(renderer).extents])
        is_cut = bool((box[:, :2] < frame[:2]).any() or (box[:, 2:] > frame[2:]).any())
        if is_cut or overlaps(box, boxes).any():
            text.remove()
        else:
            boxes = np.vstack((boxes, box))


def _draw_voxels(axes: Axes, voxels: Voxels) -> Artist:
    """The highest blocked cube of each column, the darker the higher."""
    blocked = voxels.blocked
    tops = blocked.shape[2] - np.argmax(blocked[:, :, ::-1], axis=2)
    image = np.where(blocked.any(axis=2), tops * voxels.cell + voxels.origin[2], np.nan)
    x0, y0, z0, x1, y1, z1 = voxels.extent
    axes.imshow(
        image.T, origin="lower", extent=(x0, x1, y0, y1), cmap="Greys", vmin=z0 - 0.4 * (z1 - z0),
        vmax=z1 + 0.4 * (z1 - z0), interpolation="nearest", aspect="auto", zorder=1.5,
    )  # fmt: skip
    return Patch(facecolor="#8d8d8d", edgecolor="none", label="voxels, the darker the higher")


def name_roofs(labels: Labels, scene: SpatialScene) -> None:
    """Ask for the heights of the largest roofs, each within its outline where it has room."""
    roofed = [one for one in scene.solids if _has_roof(one)]
    sizes = [-float(shapely.area(one.shadow)) for one in roofed]
    for k in np.argsort(sizes, kind="stable")[:MAX_HEIGHTS_WRITTEN].tolist():
        low, high = (f"{round(end, 1):g}" for end in roofed[k].heights)
        text = f"{low} - {high}" if scene.is_overhead(roofed[k]) else high
        parts = shapely.get_parts(roofed[k].shadow)
        largest = parts[int(np.argmax(shapely.area(parts)))]
        labels.add_within(text, largest, rank=HEIGHT_RANK, size=style.SMALL_PT - 1)


def _has_roof(one: NamedSolid) -> bool:
    return not isinstance(one.solid, Voxels) and math.isfinite(one.heights[1])
