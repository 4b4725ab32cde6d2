"""A run and a flight that move on plain axes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Final

import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viaspline.errors import GeometryError
from viaspline.handed_in import number_from
from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.animation import FilmedRun
from viaspline.report.canvas import any_name
from viaspline.report.notebook.plain_axes import axes_from, map_on, name_in_legend
from viaspline.report.run_picture import run_scene
from viaspline.report.space.spatial_film import ARROW_PX
from viaspline.report.space.spatial_picture import draw_plan_view, plan_view_of, scene_of
from viaspline.robot.run import Run
from viaspline.space.spatial_run import SpatialRun

MAX_FRAMES: Final = 3000


@any_name()
def animate_run(run: Run, ax: Axes | None, pace: float, fps: float) -> FuncAnimation:
    """A run as an animation: see ``Run.animate``."""
    times = moments(run.times, pace, fps)
    axes = axes_from(ax)
    scene, view = run_scene(run)
    filmed = FilmedRun(run, scene, map_on(axes, view))
    name_in_legend(axes, filmed.handles)

    def at(time: float) -> list[Artist]:
        shown = filmed.at(time)
        for artist in filmed.artists:
            artist.set_visible(artist in shown)
        axes.set_title(filmed.clock_at(time), loc="right")
        return shown

    return animation(axes, at, times, fps)


@any_name()
def animate_flight(run: SpatialRun, ax: Axes | None, pace: float, fps: float) -> FuncAnimation:
    """A flight as an animation, seen from above: see ``SpatialRun.animate``."""
    times = moments(run.times, pace, fps)
    axes = axes_from(ax)
    scene = scene_of(run.plan)
    sheet = map_on(axes, plan_view_of(run.plan, scene))
    handles = draw_plan_view(axes, scene, run.plan)
    (trail,) = axes.plot(
        [], [], color=style.UNSEEN, linewidth=2.2, zorder=9, label="flown",
        scalex=False, scaley=False,
    )  # fmt: skip
    (dot,) = axes.plot(
        [], [], "o", color=style.UNSEEN, markeredgecolor=style.INK, markersize=8, zorder=30,
        label="robot, and where it looks", scalex=False, scaley=False,
    )  # fmt: skip
    (nose,) = axes.plot(
        [], [], color=style.INK, linewidth=1.6, zorder=31, scalex=False, scaley=False
    )
    name_in_legend(axes, [*handles, trail, dot])
    length = ARROW_PX / sheet.pixels_per_metre

    def at(time: float) -> list[Artist]:
        x, y, z = (float(np.interp(time, run.times, axis)) for axis in run.positions.T)
        heading = float(np.interp(time, run.times, run.headings))
        speed = float(np.interp(time, run.times, run.speeds))
        gone = run.positions[: int(np.searchsorted(run.times, time, side="right")), :2]
        trail.set_data(*np.vstack((gone, [[x, y]])).T)
        dot.set_data([x], [y])
        nose.set_data([x, x + length * np.cos(heading)], [y, y + length * np.sin(heading)])
        axes.set_title(f"{time:.1f} s   {speed:.2f} m/s   {z:.1f} m high", loc="right")
        return [trail, dot, nose]

    return animation(axes, at, times, fps)


def moments(times: Floats, pace: float, fps: float) -> Floats:
    """The times that are shown [s].

    Args:
        times: Of the run, increasing [s].
        pace: How many times as fast as it was driven.
        fps: Pictures a second.

    Raises:
        GeometryError: For numbers that aren't above 0, or more pictures than anybody looks at.

    >>> moments(np.array([0.0, 10.0]), pace=10.0, fps=4.0)
    array([ 0. ,  2.5,  5. ,  7.5, 10. ])
    """
    pace, fps = number_from("pace", pace), number_from("fps", fps)
    if not (0.0 < pace < math.inf and 0.0 < fps <= 1000.0):
        raise GeometryError(f"pace is {pace} and fps {fps}; give numbers above 0, fps to 1000")
    count = math.ceil((times[-1] - times[0]) / pace * fps) + 1
    if count > MAX_FRAMES:
        problem = f"at {fps:g} pictures a second that makes {count} pictures"
        raise GeometryError(f"{problem}, more than {MAX_FRAMES}; give a faster pace or less fps")
    return np.linspace(float(times[0]), float(times[-1]), max(count, 2))


def animation(
    axes: Axes, at: Callable[[float], Iterable[Artist]], times: Floats, fps: float
) -> FuncAnimation:
    """What shows these times on axes, one picture after the other.

    Args:
        axes: Where.
        at: Places what moves at a time [s].
        times: [s].
        fps: Pictures a second.
    """
    figure = axes.get_figure(root=True)
    assert isinstance(figure, Figure)
    return FuncAnimation(
        figure, at, frames=times.tolist(), interval=1000.0 / fps, repeat=False, blit=False
    )
