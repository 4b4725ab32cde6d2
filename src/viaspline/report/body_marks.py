"""The robot's body on pictures: what it sweeps along a path, and where it stands on it.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch, Polygon, Rectangle

from viaspline.curve.certificate import Certificate
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.curve.sweep import footprints_along, placed, swept_parts
from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.world_spec import SpeedZone
from viaspline.report import style
from viaspline.report.canvas import outline
from viaspline.report.labels import Labels

MIN_BODY_WIDTH_PX = 5.0  # width of a body that is worth drawing [pixels]
MAX_BODIES = 90  # along a path, at most
BODY_SPACING_LENGTHS = 1.6  # from one body to the next, in its lengths

HEADING_LENGTH_PX, HEADING_SPACING_PX = 15.0, 60.0
"""Of the strokes that say where a body looks, and from one to the next [pixels]."""


def draw_swept(
    axes: Axes, curve: PiecewiseCubic, robot: RobotSpec, pixels_per_metre: float
) -> list[Artist]:
    """The area that a body covers along a curve, and a long one's outline now and then.

    Returns:
        What belongs in a legend; nothing where the body is too small to be seen.
    """
    steers = robot.footprint is not None or robot.turn_radius is not None
    if (
        not steers
        or 2.0 * robot.inner_radius * pixels_per_metre < MIN_BODY_WIDTH_PX
        or curve.length <= 0.0
    ):
        return []
    tolerance = max(1.0 / pixels_per_metre, 0.01 * robot.outer_radius)
    parts = swept_parts(curve, robot.footprint, tolerance, radius=_disc(robot))
    axes.add_collection(
        PathCollection(
            [outline(part) for part in parts], facecolors=style.SWEPT, edgecolors="none", zorder=2.2
        ),
        autolim=False,
    )  # fmt: skip
    if robot.footprint is not None:
        spacing = max(BODY_SPACING_LENGTHS * 2.0 * robot.outer_radius, curve.length / MAX_BODIES)
        axes.add_collection(
            PolyCollection(
                list(footprints_along(curve, robot.footprint, spacing)), facecolors="none",
                edgecolors=style.BODY, linewidths=0.7, zorder=3.5,
            ),
            autolim=False,
        )  # fmt: skip
    return [Rectangle((0, 0), 1, 1, facecolor=style.SWEPT, label="swept by the body")]


def draw_body(axes: Axes, certificate: Certificate, robot: RobotSpec, heading: float) -> None:
    """The body at the tightest place.

    Args:
        axes: Where.
        certificate: It says where, and how a long body stands there.
        robot: Whose body.
        heading: Which way it looks [rad].
    """
    if certificate.tightest_heading is not None:
        heading = certificate.tightest_heading
    axes.add_artist(body_patch(robot, certificate.tightest_at[:2], heading))


def body_patch(robot: RobotSpec, at: Sequence[float], heading: float) -> Patch:
    """The body at a place (x, y) [m], as it looks that way [rad]."""
    look: dict[str, Any] = {
        "facecolor": style.SENSOR,
        "edgecolor": style.INK,
        "zorder": 10,
        "linewidth": 0.7,
    }
    x, y = at
    if robot.footprint is None:
        return Circle((x, y), robot.radius_m, **look)
    (corners,) = placed(np.array(robot.footprint), np.array([[x, y]]), np.array([heading]))
    return Polygon(corners, alpha=0.85, **look)


def draw_headings(axes: Axes, points: Floats, headings: Floats) -> list[Artist]:
    """Where a body looks that needn't look the way that it goes, now and then along a curve.

    Args:
        axes: Where.
        points: Along the curve [m], shape (n, 2).
        headings: Of the body there [rad], shape (n,).

    Returns:
        What belongs in a legend.
    """
    pixels = axes.transData.transform(points)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(pixels, axis=0).T))])
    if not np.isfinite(along[-1]):
        return []
    count = max(min(int(along[-1] // HEADING_SPACING_PX), 80), 1)
    at = np.searchsorted(along, (np.arange(count) + 0.5) * along[-1] / count)
    feet = pixels[at]
    tips = feet + HEADING_LENGTH_PX * np.column_stack((np.cos(headings[at]), np.sin(headings[at])))
    ends = axes.transData.inverted().transform(np.stack((feet, tips), axis=1).reshape(-1, 2))
    look: dict[str, Any] = {"color": style.SENSOR, "linewidth": 1.6}
    axes.add_collection(
        LineCollection(list(ends.reshape(-1, 2, 2)), zorder=9.5, capstyle="round", **look),
        autolim=False,
    )
    axes.plot(
        *ends[::2].T, marker="o", markersize=4.5, markerfacecolor="white", linestyle="none",
        markeredgecolor=style.SENSOR, zorder=9.6, scalex=False, scaley=False,
    )  # fmt: skip
    return [Line2D([], [], marker="o", markerfacecolor="white", markersize=4.5,
                   label="where the body looks", **look)]  # fmt: skip


def draw_zones(axes: Axes, labels: Labels, zones: tuple[SpeedZone, ...]) -> list[Artist]:
    """Areas with a lower speed, with that speed; returns what belongs in a legend."""
    look: dict[str, Any] = {
        "facecolor": style.ZONE,
        "edgecolor": style.DETOUR,
        "linewidth": 0.9,
        "alpha": 0.5,
    }
    for zone in zones:
        axes.add_artist(Polygon(zone.polygon, zorder=1.5, **look))
        x, y = np.mean(zone.polygon, axis=0).tolist()
        name = f"{style.short(zone.name)}: " if zone.name else ""
        labels.add(
            f"{name}{zone.max_speed_mps:g} m/s", (x, y), rank=5, colour=style.ZONE_INK,
            area=shapely.Polygon(zone.polygon),
        )  # fmt: skip
    return [Rectangle((0, 0), 1, 1, label="speed zone", **look)] if zones else []


def _disc(robot: RobotSpec) -> float:
    return robot.radius_m if robot.footprint is None else 0.0
