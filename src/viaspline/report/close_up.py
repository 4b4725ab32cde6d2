"""The tightest place of a path, close up, beside the map.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.report import style
from viaspline.report.body_marks import draw_body
from viaspline.report.path_marks import draw_echoes
from viaspline.report.scene import Scene
from viaspline.report.side_column import SideColumn
from viaspline.report.units import down

CLOSE_UP_ROOM_IN = 2.9  # in the column, at least [inch]


def close_up(
    column: SideColumn,
    scene: Scene,
    path: Path,
    certificate: Certificate,
    robot: RobotSpec,
    layers: Callable[[Axes, float], None],
    seen: Floats | None = None,
) -> None:
    """The tightest place, large enough to see the clearance, as the map shows it.

    Args:
        column: Where to.
        scene: The world.
        path: What was planned or driven.
        certificate: Of that path.
        robot: Whose body stands there.
        layers: Draws what the map shows besides the world, on axes at so many pixels a metre.
        seen: What a lidar has seen: points [m], shape (n, 2); what was there stays faint.

    It is left out where nothing is tight, where there is no room for it in the column, and where
    the map shows it as large.
    """
    radius = robot.outer_radius
    tight = certificate.clearance < 10 * max(certificate.required, radius)
    half = 5.0 * max(scene.required, 1.2 * certificate.clearance + radius)
    if certificate.obstacle is None or not tight or scene.required <= 0:
        return
    if column.room < CLOSE_UP_ROOM_IN or 4 * half > column.map_width:
        return
    height = min(2.3, column.room - 0.65)
    where = style.short(style.without_folder(certificate.obstacle), 36)
    title = f"tightest place: {down(certificate.clearance)}\nbeside {where}"
    axes = column.axes(height, title)
    x, y = certificate.tightest_at[:2]
    box = axes.get_window_extent()
    axes.set_xlim(x - half, x + half)
    axes.set_ylim(y - half * box.height / box.width, y + half * box.height / box.width)
    scale = box.width / (2 * half)
    column.scale_bar(axes, scale)
    scene.draw(axes, scale, faint=seen is not None)
    if seen is not None:
        draw_echoes(axes, seen, 5.0)
    layers(axes, scale)
    draw_body(axes, certificate, robot, float(path.heading(certificate.tightest_u)))
    body = certificate.contact or (x, y)
    nearest = scene.nearest_to(body)
    if nearest is not None:
        _gap(axes, body, nearest, 0.0 if certificate.contact else radius)


def _gap(axes: Axes, robot: tuple[float, float], wall: tuple[float, float], radius: float) -> None:
    """The clearance as a bar from the body to the obstacle."""
    way = np.subtract(wall, robot)
    distance = float(np.hypot(*way))
    if distance <= radius:
        return
    body = np.array(robot) + way * (radius / distance)
    axes.add_line(Line2D(*np.array([body, wall]).T, color=style.TIGHTEST, linewidth=2, zorder=15))
