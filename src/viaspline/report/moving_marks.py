"""What moves on a map: where it goes while the robot drives, and where it is at one instant.

Tested through ``report/test_moving_pictures``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import shapely
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from shapely.affinity import affine_transform

from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.report import style
from viaspline.report.body_marks import body_patch
from viaspline.report.canvas import outline, shape_of
from viaspline.report.labels import Labels
from viaspline.whole_plan import Plan
from viaspline.world.moving_obstacles import MovingObstacles

TRAIL_PIECES = 200  # of a trail, at most
JUMP_RATIO = 1.5  # a step longer than the fastest goes in it is a jump
ARROW_S = 1.0  # what goes on at its speed gets in the time of its arrow [s]
MAX_NAMED = 12


class Moment(NamedTuple):
    """What moves, seen at an instant.

    Attributes:
        moving: All of it.
        begin: From when trails are drawn [s],
        end: and until when [s].
        now: When the shapes are drawn [s].
        robot: Whose body is drawn where it is then.
        at: Where that is: x, y [m], and which way it looks [rad].
    """

    moving: MovingObstacles
    begin: float
    end: float
    now: float
    robot: RobotSpec
    at: tuple[float, float, float]


def body_at(plan: Plan, time: float) -> tuple[float, float, float]:
    """Where the robot of a plan is at a time: x, y [m], and which way it looks [rad]."""
    path, held = plan.path, plan.mission.robot.held_heading
    u = float(path.parameter(min(float(plan.trajectory.distance_at(time)), path.length)))
    x, y = np.asarray(path.evaluate(u))[:2].tolist()
    return x, y, float(path.heading(u)) if held is None else held


def draw_moving(axes: Axes, labels: Labels, moment: Moment) -> list[Artist]:
    """Trails, shapes at the instant, and arrows as long as one second's way.

    Returns:
        What belongs in a legend.
    """
    moving = moment.moving
    if not len(moving):
        return []
    axes.add_collection(
        LineCollection(
            trails(moving, moment.begin, moment.end), colors=style.MOVING, linewidths=0.8,
            alpha=0.35, zorder=4, capstyle="round",
        ),
        autolim=False,
    )  # fmt: skip
    shapes, arrows, named = shapes_and_arrows(moving, moment.now)
    axes.add_collection(
        PathCollection(
            [outline(shape) for shape in shapes], facecolors=style.MOVING_FILL,
            edgecolors=style.MOVING, linewidths=0.9, zorder=6.5, alpha=0.9,
        ),
        autolim=False,
    )  # fmt: skip
    if len(arrows):
        axes.quiver(
            *arrows.T, angles="xy", scale_units="xy", scale=1.0, color=style.MOVING, width=0.0025,
            headwidth=4.0, headlength=5.0, zorder=6.6,
        )  # fmt: skip
    x, y, heading = moment.at
    axes.add_artist(body_patch(moment.robot, (x, y), heading))
    for name, at in named[:MAX_NAMED] if len(moving) <= MAX_NAMED else ():
        labels.add(style.short(name), at, rank=5, colour=style.MOVING)
    return [
        Rectangle(
            (0, 0), 1, 1, facecolor=style.MOVING_FILL, edgecolor=style.MOVING, linewidth=0.9,
            label=f"moves; robot and all as at {moment.now:.1f} s",
        ),
        Line2D([], [], color=style.MOVING, linewidth=0.8, alpha=0.5, label="where it goes"),
    ]  # fmt: skip


def trails(moving: MovingObstacles, begin: float, end: float) -> list[Floats]:
    """The ways of the frames between two times [m], each (k, 2), cut where something jumps."""
    times = np.linspace(begin, max(end, begin + 1e-6), TRAIL_PIECES + 1)
    frames = np.array([moving.frames(time)[:, :2] for time in times])
    step = float(times[1] - times[0])
    found: list[Floats] = []
    for i in range(len(moving)):
        way = frames[:, i]
        far = JUMP_RATIO * float(moving.packed.speeds[i]) * step + 1e-9
        with np.errstate(invalid="ignore"):
            cuts = ~(np.hypot(*np.diff(way, axis=0).T) <= far)
        parts = np.split(way, np.flatnonzero(cuts) + 1)
        found += [part for part in parts if len(part) > 1 and np.isfinite(part).all()]
    return found


def placed_shape(moving: MovingObstacles, index: int, frame: Floats) -> shapely.Geometry:
    """An obstacle's shape where its frame (x, y, heading) is."""
    x, y, heading = frame.tolist()
    c, s = np.cos(heading), np.sin(heading)
    placed: shapely.Geometry = affine_transform(
        shape_of(moving.obstacles[index]), (c, -s, s, c, x, y)
    )
    return placed


def shapes_and_arrows(
    moving: MovingObstacles, now: float
) -> tuple[list[shapely.Geometry], Floats, list[tuple[str, tuple[float, float]]]]:
    """Shapes, arrows (x, y, dx, dy) and names with places of all that is there at an instant."""
    frames, later = moving.frames(now), moving.frames(now + 1e-3)
    shapes, arrows, named = [], [], []
    for i, frame in enumerate(frames):
        if not np.isfinite(frame).all():
            continue
        shapes.append(placed_shape(moving, i, frame))
        named.append((moving.name(i), (float(frame[0]), float(frame[1]))))
        way = (later[i, :2] - frame[:2]) * (ARROW_S / 1e-3)
        length = float(np.hypot(*way))
        if 1e-3 < length <= JUMP_RATIO * float(moving.packed.speeds[i]) * ARROW_S:
            arrows.append((*frame[:2].tolist(), *way.tolist()))
    return shapes, np.array(arrows).reshape(-1, 4), named
