"""``plan.png`` of a mission in space: seen from above, from the side, and in perspective.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from viaspline.kernels.arrays import Floats
from viaspline.maps.terrain import Terrain
from viaspline.report import style
from viaspline.report.canvas import any_name, png, polyline
from viaspline.report.driven_line import DrivenKey
from viaspline.report.labels import Labels
from viaspline.report.path_marks import draw_arrows, draw_path, draw_tightest
from viaspline.report.profile_strips import Ticks
from viaspline.report.sheet import Box, view_of
from viaspline.report.space.elevation_profile import SAMPLES, ProfileRange, draw_profile
from viaspline.report.space.moving_in_space import draw_moving_in_space
from viaspline.report.space.solid_marks import clear_contour_labels, draw_solids, name_roofs
from viaspline.report.space.space_view import draw_space
from viaspline.report.space.spatial_scene import NamedSolid, SpatialScene
from viaspline.report.space.spatial_sheet import SpatialSheet, spatial_sheet
from viaspline.report.summary import spline_words
from viaspline.report.units import down, metres, seconds
from viaspline.report.via_marks import draw_vias
from viaspline.space.spatial_plan import SpatialPlan

PER_LEGEND_ROW = 6


@any_name()
def spatial_picture(plan: SpatialPlan, name: str) -> bytes:
    """The picture as PNG.

    Args:
        plan: What was planned.
        name: The mission's name.
    """
    return png(drawn_page(plan, name).figure)


def drawn_page(plan: SpatialPlan, name: str, dpi: int = style.DPI) -> SpatialSheet:
    """The page with all that it shows.

    Args:
        plan: What was planned.
        name: The mission's name.
        dpi: Pixels for each inch of it.
    """
    scene = scene_of(plan)
    robot = plan.mission.robot
    title = (
        f"{style.short(name, 48)}: {metres(plan.path.length, 1)} in "
        f"{seconds(plan.trajectory.duration)}"
    )
    words = (proof_words(plan), body_subtitle(plan))
    sheet = spatial_sheet(plan_view_of(plan, scene), title, words, dpi)
    handles = draw_plan_view(sheet.map, scene, plan)
    handles += draw_profile(sheet.elevation, plan.path, scene, robot.radius_m, band_of(plan))
    _fill_strips(sheet, plan)
    draw_space(sheet.figure, sheet.view, plan.path, scene)
    draw_legend(sheet, handles)
    return sheet


def draw_legend(sheet: SpatialSheet, handles: Sequence[Artist]) -> None:
    """The legend of the page, beside the map."""
    legend = sheet.figure.legend(
        handles=list(handles), loc="upper left", bbox_to_anchor=sheet.legend,
        fontsize=style.SMALL_PT, frameon=False, borderaxespad=0,
        ncol=2 if len(handles) > PER_LEGEND_ROW else 1, columnspacing=1.2, labelspacing=0.75,
        markerscale=0.6, handler_map={LineCollection: DrivenKey()},
    )  # fmt: skip
    for text in legend.get_texts():
        text.set_parse_math(False)


def plan_view_of(plan: SpatialPlan, scene: SpatialScene) -> Box:
    """The part of the world that is seen from above."""
    robot = plan.mission.robot
    margin = robot.radius_m + robot.clearance_m
    return view_of(polyline(plan.path.spans), scene.corners(), plan.world.bounds, margin)


def draw_plan_view(axes: Axes, scene: SpatialScene, plan: SpatialPlan) -> list[Artist]:
    """Draw a plan in space as it is seen from above.

    Args:
        axes: They show the part of the world that is to be seen.
        scene: What stands in the world.
        plan: What was planned.

    Returns:
        What belongs in a legend.
    """
    points = polyline(plan.path.spans)
    handles = draw_solids(axes, scene)
    labels = Labels(axes)
    handles.append(draw_path(axes, points))
    route = [via for via in plan.path.vias if via.kind == "detour" or via.index is not None]
    vias, places = draw_vias(axes, labels, route, plan.mission)
    draw_arrows(axes, points, style.PATH, avoid=places)
    handles += vias + draw_tightest(axes, labels, plan.certificate)
    handles += draw_moving_in_space(axes, labels, plan)
    name_roofs(labels, scene)
    clear_contour_labels(axes)
    labels.place(points, places)
    return handles


def scene_of(plan: SpatialPlan) -> SpatialScene:
    """What stands in the plan's world."""
    mission, world = plan.mission, plan.world
    solids = [
        NamedSolid(obstacle.solid(), obstacle.name or "") for obstacle in mission.world.standing
    ]
    ground = world.ground
    terrain = ground if isinstance(ground, Terrain) else None
    flat = None if ground is None or terrain is not None else float(ground)  # type: ignore[arg-type]
    return SpatialScene(solids, terrain, flat, world.bounds)


def band_of(plan: SpatialPlan) -> ProfileRange | None:
    """The heights that are allowed along the path; None where they aren't limited."""
    band = plan.world.band
    low, high, above_least, above_most = band.numbers
    if not np.isfinite([low, high, above_least, above_most]).any():
        return None
    places = plan.path.at_distance(np.linspace(0.0, plan.path.length, SAMPLES))
    lows: Floats = np.full(SAMPLES, low)
    highs: Floats = np.full(SAMPLES, high)
    if band.knows_ground:
        ground = plan.world.ground_at(places)
        lows, highs = np.fmax(lows, ground + above_least), np.fmin(highs, ground + above_most)
    return ProfileRange(
        np.where(np.isfinite(lows), lows, np.nan), np.where(np.isfinite(highs), highs, np.nan)
    )


def proof_words(plan: SpatialPlan) -> str:
    """What is proven, in a line."""
    certificate, moving = plan.certificate, plan.moving
    words = "nothing to keep clear of"
    if np.isfinite(certificate.clearance):
        words = (
            f"proven: nowhere closer than {down(certificate.clearance)} to anything that stands "
            f"({metres(certificate.required)} asked)"
        )
    if moving is None or not np.isfinite(moving.clearance):
        return words.replace(" that stands", "")
    return f"{words}; {down(moving.clearance)} from what moves, at {moving.tightest_at_s:.1f} s"


def body_subtitle(plan: SpatialPlan) -> str:
    """How the curve was asked to be, and who flies it."""
    robot = plan.mission.robot
    body = f"ball of radius {robot.radius_m:g} m"
    if robot.half_height_m is not None:
        body = f"body {2 * robot.radius_m:g} m wide and {2 * robot.half_height_m:g} m high"
    speeds = (
        f"at most {robot.max_speed_mps:g} m/s, up {robot.climb_speed:g}, "
        f"down {robot.descent_speed:g} m/s"
    )
    return f"{spline_words(plan.mission)}; {body}, {speeds}"


def _fill_strips(sheet: SpatialSheet, plan: SpatialPlan) -> None:
    """Speed and climb over the distance."""
    path, law = plan.path, plan.trajectory
    distances = np.unique(np.concatenate((np.linspace(0.0, path.length, SAMPLES), law.distances)))
    speed = np.asarray(law.speed_at(distances))
    climb = speed * path.tangent(path.parameter(distances))[:, 2]
    for axes, value in zip(sheet.strips, (speed, climb), strict=True):
        axes.plot(distances, value, color=style.PATH, linewidth=1.1)
        axes.margins(y=0.12)
    sheet.strips[0].set_ylim(bottom=0.0)
    sheet.strips[1].axhline(0.0, color=style.MUTED, linewidth=0.5)
    robot = plan.mission.robot
    for limit in (robot.climb_speed, -robot.descent_speed):
        if np.abs(climb).max() > 0.5 * abs(limit):
            sheet.strips[1].axhline(
                limit, color=style.TIGHTEST, linewidth=0.8, linestyle=(0, (4, 2))
            )
    for distance, _ in _ticks(plan):
        for axes in (sheet.elevation, *sheet.strips):
            axes.axvline(distance, color=style.OBSTACLE, linewidth=0.5, zorder=0)


def _ticks(plan: SpatialPlan) -> Ticks:
    users = [via for via in plan.path.vias if via.kind == "user" and via.index is not None]
    return [(float(plan.path.distance(via.u)), str(k)) for k, via in enumerate(users)]
