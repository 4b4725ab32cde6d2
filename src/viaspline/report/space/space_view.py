"""A small picture in perspective; what is far from the path is a ghost.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
import shapely
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from mpl_toolkits.mplot3d.axes3d import Axes3D

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.solids import GridPrism, Prism, RoundedSegment
from viaspline.report import style
from viaspline.report.space.seen_faces import Face, ball_faces, prism_faces, segment_within
from viaspline.report.space.spatial_scene import SpatialScene

GHOST_M: Final = 25.0
"""From the path in plan; what stands farther away is drawn as a ghost."""

MAX_SOLIDS: Final = 150
MAX_CUBES: Final = 4000
MAX_NODES: Final = 40

LEAST_SHARE: Final = 0.25
"""Of the longest side of what is shown, to which a shorter one is widened."""

MOST_TICKS: Final = 6
"""Of the longest side; shorter ones have fewer, lest their numbers touch."""


def draw_space(figure: Figure, box: tuple[float, float, float, float], path: Path,
               scene: SpatialScene) -> Axes3D:  # fmt: skip
    """Draw the path among what stands near it.

    Args:
        figure: Where to.
        box: Left, bottom, width, height as fractions of the figure.
        path: In space.
        scene: What stands in the world.
    """
    return draw_space_of_many(figure, box, [(path, style.PATH)], scene)


def draw_space_of_many(
    figure: Figure, box: tuple[float, float, float, float], paths: Sequence[tuple[Path, str]],
    scene: SpatialScene,
) -> Axes3D:  # fmt: skip
    """Draw several paths among what stands near them.

    Args:
        figure: Where to.
        box: Left, bottom, width, height as fractions of the figure.
        paths: In space, each with its colour, at least one.
        scene: What stands in the world.
    """
    axes = figure.add_axes(box, projection="3d")
    assert isinstance(axes, Axes3D)
    draw_in_perspective(axes, paths, scene)
    axes.tick_params(labelsize=style.SMALL_PT - 2, pad=-3)
    return axes


def draw_in_perspective(
    axes: Axes3D, paths: Sequence[tuple[Path, str]], scene: SpatialScene
) -> None:
    """Draw several paths among what stands near them.

    Args:
        axes: In three dimensions.
        paths: In space, each with its colour, at least one.
        scene: What stands in the world.
    """
    lines = [path.at_distance(np.linspace(0.0, path.length, 400)) for path, _ in paths]
    shown = _shown(scene, np.concatenate(lines))
    _draw_ground(axes, scene, shown)
    _draw_solids(axes, scene, lines, shown)
    for line, (_, colour) in zip(lines, paths, strict=True):
        axes.plot(line[:, 0], line[:, 1], line[:, 2], color=colour, linewidth=1.6, zorder=9,
                  label="path")  # fmt: skip
        ends = line[[0, -1]]
        axes.scatter(ends[:, 0], ends[:, 1], ends[:, 2], color=[style.START, style.GOAL], s=12)
    low, high = shown
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_zlim(low[2], high[2])
    wide = high - low
    axes.set_box_aspect(wide.tolist())
    for one, share in zip((axes.xaxis, axes.yaxis, axes.zaxis), wide / wide.max(), strict=True):
        one.set_major_locator(MaxNLocator(max(round(MOST_TICKS * float(share)), 1)))
    axes.view_init(elev=32, azim=-60)


def _shown(scene: SpatialScene, places: Floats) -> tuple[Floats, Floats]:
    """Lowest and highest corner of what is shown [m]: the path, from the ground under it up."""
    low, high = places.min(axis=0), places.max(axis=0)
    low[2] = min(low[2], _floor(scene, places))
    wide = np.maximum(high - low, LEAST_SHARE * float((high - low).max()) + 1e-6)
    aside = 0.5 * (wide - (high - low))
    aside[2] = 0.0
    return low - aside, low - aside + wide


def _floor(scene: SpatialScene, places: Floats) -> float:
    """The lowest ground under the path [m]; its lowest place where none is known."""
    ground = scene.ground(places[:, :2])
    known = ground[np.isfinite(ground)]
    return float(known.min()) if known.size else float(places[:, 2].min())


def _draw_ground(axes: Axes3D, scene: SpatialScene, shown: tuple[Floats, Floats]) -> None:
    if scene.terrain is None:
        return
    x, y = (np.linspace(shown[0][k], shown[1][k], MAX_NODES) for k in (0, 1))
    across, up = np.meshgrid(x, y)
    heights = scene.terrain.height_at(np.stack((across, up), axis=-1))
    axes.plot_surface(across, up, heights, color="#cdb98f", alpha=0.5, linewidth=0, shade=True)


def _draw_solids(
    axes: Axes3D, scene: SpatialScene, lines: Sequence[Floats], shown: tuple[Floats, Floats]
) -> None:
    """What stands there, as far as it is within what is shown."""
    places = np.concatenate(lines)
    track = shapely.MultiLineString([line[:, :2] for line in lines])
    apart = shapely.distance(track, scene.shadows) if len(scene.solids) else np.empty(0)
    for k in np.argsort(apart, kind="stable")[:MAX_SOLIDS].tolist():
        solid = scene.solids[k].solid
        alpha = 0.45 if apart[k] <= GHOST_M else 0.1
        if isinstance(solid, Prism | GridPrism):
            faces = prism_faces(scene.solids[k].shadow, (solid.low, solid.high), shown)
            _draw_faces(axes, faces, style.OBSTACLE, style.OBSTACLE_EDGE, alpha)
        elif isinstance(solid, RoundedSegment):
            _draw_rounded(axes, solid, alpha, shown)
        else:
            _draw_cubes(axes, solid, places)


def _draw_faces(axes: Axes3D, faces: Sequence[Face], face: str, edge: str, alpha: float) -> None:
    for corners in sorted({len(one) for one in faces}):  # matplotlib pads others with noise
        axes.add_collection3d(
            Poly3DCollection(
                [one for one in faces if len(one) == corners], facecolor=face, edgecolor=edge,
                linewidth=0.3, alpha=alpha,
            )
        )  # fmt: skip


def _draw_rounded(
    axes: Axes3D, solid: RoundedSegment, alpha: float, shown: tuple[Floats, Floats]
) -> None:
    """A ball as it is; a cable or a mast as its line, which is as good as all that is seen."""
    fill, edge = style.OBSTACLES[1]
    if solid.first == solid.last:
        middle = np.array(solid.first)
        if ((middle >= shown[0]) & (middle <= shown[1])).all():
            _draw_faces(axes, ball_faces(solid), fill, edge, alpha)
        return
    part = segment_within(np.array([solid.first, solid.last]), shown)
    if len(part):
        axes.plot(*part.T, color=edge, linewidth=2.0, alpha=2.0 * alpha)


def _draw_cubes(axes: Axes3D, voxels: Voxels, places: Floats) -> None:
    """The middles of cubes on the surface, thinned to as many as a small picture shows."""
    blocked = voxels.blocked
    inner = np.zeros_like(blocked)
    if min(blocked.shape) > 2:
        inner[1:-1, 1:-1, 1:-1] = (
            blocked[:-2, 1:-1, 1:-1] & blocked[2:, 1:-1, 1:-1] & blocked[1:-1, :-2, 1:-1]
            & blocked[1:-1, 2:, 1:-1] & blocked[1:-1, 1:-1, :-2] & blocked[1:-1, 1:-1, 2:]
        )  # fmt: skip
    cubes = np.argwhere(blocked & ~inner)
    at = (cubes + 0.5) * voxels.cell + np.array(voxels.origin)
    low, high = places.min(axis=0) - GHOST_M, places.max(axis=0) + GHOST_M
    at = at[((at >= low) & (at <= high)).all(axis=1)]
    at = at[:: max(1, math.ceil(len(at) / MAX_CUBES))]
    axes.scatter(at[:, 0], at[:, 1], at[:, 2], color=style.OBSTACLE_EDGE, s=1.2, alpha=0.25)
