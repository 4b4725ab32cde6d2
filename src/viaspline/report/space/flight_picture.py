"""``run.png`` of a mission in space: what was flown, beside what was planned, and how much room."""

from __future__ import annotations

from typing import Final

import numpy as np
import shapely
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.patches import Patch, PathPatch

from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.canvas import any_name, outline, png, polyline
from viaspline.report.driven_line import draw_driven, speed_colours
from viaspline.report.labels import Labels
from viaspline.report.path_marks import draw_arrows
from viaspline.report.space.elevation_profile import GROUND
from viaspline.report.space.flown_clearance import flown_clearance
from viaspline.report.space.moving_in_space import draw_met_in_space
from viaspline.report.space.solid_marks import clear_contour_labels, draw_solids, name_roofs
from viaspline.report.space.space_view import draw_space_of_many
from viaspline.report.space.spatial_picture import (
    body_subtitle,
    draw_legend,
    plan_view_of,
    scene_of,
)
from viaspline.report.space.spatial_scene import NamedSolid, SpatialScene
from viaspline.report.space.spatial_sheet import SpatialSheet, spatial_sheet
from viaspline.report.units import down, metres, seconds
from viaspline.report.via_marks import draw_vias
from viaspline.space.spatial_run import SpatialRun

STRIPS: Final = ("speed [m/s]", "free space [m]")
PLANNED: Final = "planned"
HEADS_PX: Final = 150.0  # from one head on the flown path to the next [pixels]
FREE_SHOWN: Final = 8.0  # times what is asked: more free space than anybody wants to see
DASHES: Final = (0, (6, 2))


@any_name()
def flight_picture(run: SpatialRun, name: str) -> bytes:
    """The picture as PNG.

    Args:
        run: What was flown.
        name: The mission's name.
    """
    plan = run.plan
    scene = scene_of(plan)
    view = plan_view_of(plan, _with_unseen(scene, run))
    sheet = spatial_sheet(view, *_heading(run, name), strips=STRIPS, along="time [s]")
    handles = _draw_map(sheet, scene, run)
    handles += _draw_heights(sheet.elevation, scene, run)
    _draw_speeds(sheet.strips[0], run)
    _draw_clearance(sheet.strips[1], run)
    for axes in (sheet.elevation, *sheet.strips):
        for replan in run.replans:
            axes.axvline(replan.time, color=style.UNSEEN, linewidth=0.9, linestyle=":")
    whole = _with_unseen(scene, run)
    planned = [(plan.path, style.OLD_PATH)]
    in_space = draw_space_of_many(sheet.figure, sheet.view, planned, whole)
    in_space.plot(*run.positions.T, color=style.PATH, linewidth=1.6, zorder=10)
    draw_legend(sheet, handles)
    return png(sheet.figure)


def _heading(run: SpatialRun, name: str) -> tuple[str, tuple[str, ...]]:
    end = "reached its goal" if run.reached else "did NOT reach its goal"
    length = float(np.sqrt((np.diff(run.positions, axis=0) ** 2).sum(axis=1)).sum())
    title = f"{style.short(name, 48)}: {end}, {metres(length, 1)} in {seconds(run.duration)}"
    new = {0: "no new path under way", 1: "1 new path under way"}
    paths = new.get(len(run.replans), f"{len(run.replans)} new paths under way")
    second = body_subtitle(run.plan) if run.reached else run.reason
    return title, (f"{how_near_in_space(run)}; {paths}", second)


def how_near_in_space(run: SpatialRun) -> str:
    """How near a flight came to anything, in words; what touched it first."""
    asked = metres(run.plan.certificate.required)
    proven = "nothing to keep clear of"
    if np.isfinite(run.clearance):
        proven = f"proven: nowhere closer than {down(run.clearance)} to anything ({asked} asked)"
    met = run.encounters
    if met is None or not np.isfinite(met.clearance):
        return proven
    if not met.contacts:
        moves = f"{down(met.clearance)} from '{style.short(met.obstacle or '')}', which moves"
        return f"{proven}, {moves}"
    return f"{met.touched}; {proven}" if np.isfinite(run.clearance) else met.touched


def _with_unseen(scene: SpatialScene, run: SpatialRun) -> SpatialScene:
    unseen = [
        NamedSolid(one.solid(), one.name or "") for one in run.plan.mission.world.unseen_standing
    ]
    return SpatialScene([*scene.solids, *unseen], scene.terrain, scene.flat, scene.bounds)


def _draw_map(sheet: SpatialSheet, scene: SpatialScene, run: SpatialRun) -> list[Artist]:
    """The flight from above; returns what belongs in a legend."""
    plan, axes = run.plan, sheet.map
    labels = Labels(axes)
    handles = draw_solids(axes, scene)
    handles += _draw_unseen(axes, labels, run)
    planned = polyline(plan.path.spans)
    handles += axes.plot(
        *planned.T, color=style.OLD_PATH, linewidth=1.1, linestyle=DASHES, zorder=7, label=PLANNED,
        scalex=False, scaley=False,
    )  # fmt: skip
    colours, limits = speed_colours(run.speeds)
    words = f"flown, 0 to {limits.vmax:.3g} m/s"
    handles.append(draw_driven(axes, run.positions, run.speeds, colours, limits, words))
    route = [via for via in plan.path.vias if via.kind == "user" and via.index is not None]
    vias, places = draw_vias(axes, labels, route, plan.mission)
    draw_arrows(axes, run.positions[:, :2], style.INK, avoid=places, every=HEADS_PX)
    handles += vias + _draw_replans(axes, labels, run)
    handles += draw_met_in_space(axes, labels, run)
    name_roofs(labels, scene)
    clear_contour_labels(axes)
    labels.place(np.vstack([planned, run.positions[:, :2]]), places)
    return handles


def _draw_unseen(axes: Axes, labels: Labels, run: SpatialRun) -> list[Artist]:
    """What only the sensor finds; returns what belongs in a legend."""
    look = {"facecolor": style.UNSEEN_FILL, "edgecolor": style.UNSEEN, "hatch": "////"}
    unseen = run.plan.mission.world.unseen_standing
    for one in unseen:
        shadow = NamedSolid(one.solid()).shadow
        axes.add_patch(PathPatch(outline(shadow), linewidth=0.9, zorder=2.6, **look))
        if one.name:
            x, y = shapely.get_coordinates(shapely.point_on_surface(shadow))[0].tolist()
            labels.add(style.short(one.name), (x, y), rank=6, colour=style.UNSEEN)
    words = "obstacle that was not on the map"
    return [Patch(linewidth=0.9, label=words, **look)] if unseen else []  # type: ignore[arg-type]


def _draw_replans(axes: Axes, labels: Labels, run: SpatialRun) -> list[Artist]:
    """Where the path was changed; returns what belongs in a legend."""
    handles: list[Artist] = []
    for replan in run.replans:
        x, y = (float(np.interp(replan.time, run.times, run.positions[:, k])) for k in (0, 1))
        handles = [*axes.plot(
            x, y, marker="D", markersize=6.0, markerfacecolor="white", markeredgecolor=style.UNSEEN,
            markeredgewidth=1.4, linestyle="none", zorder=14, label="new path from here",
            scalex=False, scaley=False,
        )]  # fmt: skip
        what = "new path" if replan.path is not None else "stopped, no way on"
        labels.add(f"{what}, {replan.time:.0f} s", (x, y), rank=4, colour=style.UNSEEN)
    return handles


def _planned_at(run: SpatialRun) -> tuple[Floats, Floats]:
    """Places (n, 3) [m] and speeds (n,) [m/s] that were planned for the times of a run."""
    law = run.plan.trajectory
    along = np.minimum(np.asarray(law.distance_at(run.times)), run.plan.path.length)
    return np.asarray(run.plan.path.at_distance(along)), np.asarray(law.speed_at(along))


def _draw_heights(axes: Axes, scene: SpatialScene, run: SpatialRun) -> list[Artist]:
    """Heights over time, flown and planned, and the ground below."""
    ground = scene.ground(run.positions[:, :2])
    planned = _planned_at(run)[0][:, 2]
    every = np.concatenate([run.positions[:, 2], planned, ground[np.isfinite(ground)]])
    low, high = float(every.min()), float(every.max())
    grow = max(0.12 * (high - low), 1.0)
    axes.set_xlim(float(run.times[0]), max(float(run.times[-1]), float(run.times[0]) + 1e-9))
    axes.set_ylim(low - grow, high + grow)
    axes.plot(run.times, planned, color=style.OLD_PATH, linewidth=1.1, linestyle=DASHES, zorder=4)
    (flown,) = axes.plot(run.times, run.positions[:, 2], color=style.PATH, linewidth=1.6, zorder=3,
                         label="flown, over time")  # fmt: skip
    if not np.isfinite(ground).any():
        return [flown]
    axes.fill_between(run.times, ground, low - 2 * grow, color=GROUND, alpha=0.55, linewidth=0)
    return [flown, Patch(facecolor=GROUND, alpha=0.55, label="ground under the path")]


def _draw_speeds(axes: Axes, run: SpatialRun) -> None:
    planned = _planned_at(run)[1]
    axes.plot(run.times, planned, color=style.OLD_PATH, linewidth=0.9, linestyle=DASHES, zorder=4)
    axes.plot(run.times, run.speeds, color=style.PATH, linewidth=1.1)
    axes.set_ylim(0.0, 1.15 * max(float(run.speeds.max()), float(planned.max()), 1e-3))


def _draw_clearance(axes: Axes, run: SpatialRun) -> None:
    """Free space over time, beside what was asked."""
    free, asked = flown_clearance(run), run.plan.certificate.required
    finite = free[np.isfinite(free)]
    if not finite.size:
        axes.text(0.5, 0.5, "nothing to keep clear of", transform=axes.transAxes, ha="center",
                  va="center", size=style.SMALL_PT, color=style.MUTED)  # fmt: skip
        axes.set_yticks([])
        return
    axes.plot(run.times, free, color=style.PATH, linewidth=1.1)
    least = float(finite.min())
    top = min(1.15 * float(finite.max()), max(FREE_SHOWN * asked, 3.0 * least, 0.1))
    axes.set_ylim(min(0.0, 1.1 * least), max(top, 1.3 * asked, 1e-3))
    axes.axhline(asked, color=style.TIGHTEST, linewidth=0.8, linestyle=(0, (4, 2)))
    axes.plot(
        run.times[int(np.nanargmin(free))], least, marker="o", markersize=7, zorder=5,
        markerfacecolor="none", markeredgecolor=style.TIGHTEST, markeredgewidth=1.5,
        linestyle="none", clip_on=False,
    )  # fmt: skip
    axes.annotate(
        f"{asked:g} m asked", (1.0, asked), xycoords=axes.get_yaxis_transform(), xytext=(-3, 2),
        textcoords="offset points", size=style.SMALL_PT - 1, color=style.TIGHTEST, ha="right",
    )  # fmt: skip
