"""The film of a run: the robot, what it sees, what it knows, and the path that it follows."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.lines import Line2D
from matplotlib.patches import Circle
from matplotlib.text import Text

from viaspline.report import style
from viaspline.report.canvas import any_name, polyline
from viaspline.report.driven_line import thinned
from viaspline.report.labels import Labels
from viaspline.report.moving_film import MovingLayer
from viaspline.report.run_picture import has_lidar, run_scene
from viaspline.report.scene import Scene
from viaspline.report.sensor_view import sight_of
from viaspline.report.sheet import Sheet, new_sheet
from viaspline.report.side_column import SideColumn
from viaspline.report.via_marks import draw_vias
from viaspline.report.video_file import VideoFile
from viaspline.report.video_writer import FILM_DPI, MAX_FRAMES, Frame, write_film
from viaspline.robot.run import Run


@any_name()
def film_run(run: Run, name: str, film: VideoFile, progress: Callable[[float], None]) -> None:
    """Film a run.

    Args:
        run: What was driven.
        name: The mission's name.
        film: Where to.
        progress: Hears how much is done, from 0 to 1.
    """
    count = int(np.clip(len(run.times), 2, MAX_FRAMES))
    write_film(film, frames(run, name, count), count, progress)


def frames(run: Run, name: str, count: int) -> Iterator[Frame]:
    """Pictures of the run, equally far apart in time."""
    stage = _Stage(run, name)
    for time in np.linspace(run.times[0], run.times[-1], count):
        yield stage.frame(float(time))


class FilmedRun:
    """A run on the map of a sheet: what stands still is drawn, what moves is placed at a time.

    Args:
        run: What was driven.
        scene: Its world.
        sheet: Its map shows the part of the world that is to be seen.
    """

    def __init__(self, run: Run, scene: Scene, sheet: Sheet) -> None:
        self._run = run
        planned = polyline(run.plan.path.spans)
        labels = Labels(sheet.map)
        scans = has_lidar(run)
        handles = scene.draw(sheet.map, sheet.pixels_per_metre, reveal=scans, faint=scans)
        vias, places = draw_vias(sheet.map, labels, run.plan.path.vias, run.plan.mission)
        labels.place(planned, places)
        self._moving = _moving(sheet.map, sheet.pixels_per_metre, run)
        self._sight = sight_of(run, sheet)
        self._others = MovingLayer(sheet.map, run.moving, sheet.pixels_per_metre)
        shown = (*_legend(self._moving, run), *self._sight.handles, *self._others.handles)
        self.handles: tuple[Artist, ...] = (*handles, *vias, *shown)
        self.artists: tuple[Artist, ...] = (
            *self._moving, *self._sight.artists, *self._others.artists,
        )  # fmt: skip
        self._paths = [(-np.inf, planned)]
        self._paths += [(replan.time, polyline(replan.path.spans)) for replan in run.replans]

    def at(self, time: float, over: Sequence[Artist] = ()) -> list[Artist]:
        """What is to be seen of all that moves at a time [s], in the order in which it is drawn.

        Args:
            time: Times don't go back.
            over: What stands still and is drawn over the trail.
        """
        run, (old, path, trail, robot) = self._run, self._moving
        x, y = (float(np.interp(time, run.times, run.positions[:, axis])) for axis in (0, 1))
        now = max(i for i, (start, _) in enumerate(self._paths) if start <= time)
        path.set_data(*self._paths[now][1].T)
        old.set_data(*(self._paths[now - 1][1] if now else np.zeros((0, 2))).T)
        driven = run.positions[: int(np.searchsorted(run.times, time, side="right")), :2]
        trail.set_data(*np.vstack([thinned(driven, 1500), [[x, y]]]).T)
        robot.set_center((x, y))
        heading = float(np.interp(time, run.times, np.unwrap(run.headings)))
        sight = self._sight.at(time, (x, y), heading)
        others = self._others.at(time)
        return [*sight, old, path, trail, *over, *others, robot]

    def clock_at(self, time: float) -> str:
        """The time and the speed then, in words."""
        speed = float(np.interp(time, self._run.times, self._run.speeds))
        return f"{time:.1f} s   {speed:.2f} m/s"


class _Stage:
    """What stands still is drawn once; what moves is drawn onto it for every frame."""

    def __init__(self, run: Run, name: str) -> None:
        scene, view = run_scene(run)
        self._sheet = sheet = new_sheet(view, (), style.short(name, 48), (), dpi=FILM_DPI)
        self._filmed = FilmedRun(run, scene, sheet)
        SideColumn(sheet).legend(self._filmed.handles)
        # the few markers of the route are drawn over the trail again
        self._over = [a for a in (*sheet.map.lines, *sheet.map.texts) if a.get_zorder() >= 11][:120]
        self._clock = _clock(sheet)
        canvas = sheet.figure.canvas
        assert isinstance(canvas, FigureCanvasAgg)
        self._canvas = canvas
        for artist in (*self._filmed.artists, self._clock):
            artist.set_animated(True)
        canvas.draw()  # type: ignore[no-untyped-call]
        self._still = canvas.copy_from_bbox(sheet.figure.bbox)  # type: ignore[no-untyped-call]

    def frame(self, time: float) -> Frame:
        """The picture at a time [s]."""
        self._clock.set_text(self._filmed.clock_at(time))
        self._canvas.restore_region(self._still)  # type: ignore[no-untyped-call]
        for artist in self._filmed.at(time, self._over):
            self._sheet.map.draw_artist(artist)
        self._sheet.figure.draw_artist(self._clock)
        pixels = np.asarray(self._canvas.buffer_rgba())[..., :3]  # type: ignore[no-untyped-call]
        height, width = (size - size % 2 for size in pixels.shape[:2])
        return pixels[:height, :width].copy()


def _legend(moving: tuple[Line2D, Line2D, Line2D, Circle], run: Run) -> list[Artist]:
    """What the legend says of them: nothing of an old path where there is none."""
    old, path, trail, robot = moving
    disc = Line2D(
        [], [], linestyle="none", marker="o", markersize=9, color=robot.get_facecolor(),
        markeredgecolor=style.INK, markeredgewidth=0.8, label="robot",
    )  # fmt: skip
    return [*([old] if run.replans else []), path, trail, disc]


def _clock(sheet: Sheet) -> Text:
    _, up = sheet.figure.get_size_inches()
    x = sheet.map.get_position().x0
    return sheet.figure.text(
        x, 1 - 0.62 / up, "", size=style.TITLE_PT - 2, color=style.MUTED, va="center",
        family="DejaVu Sans Mono",
    )  # fmt: skip


def _moving(axes: Axes, pixels_per_metre: float, run: Run) -> tuple[Line2D, Line2D, Line2D, Circle]:
    """Old path, path, trail, robot."""
    (old,) = axes.plot([], [], color=style.OLD_PATH, linewidth=1.2, linestyle=(0, (5, 2)),
                       zorder=7, label="path before")  # fmt: skip
    (path,) = axes.plot([], [], color=style.SENSOR, linewidth=1.8, zorder=8, label="path")
    (trail,) = axes.plot([], [], color=style.PATH, linewidth=2.8, zorder=9, label="driven",
                         solid_capstyle="round")  # fmt: skip
    size = max(run.plan.mission.robot.outer_radius, 5.0 / pixels_per_metre)
    robot = Circle((0, 0), size, facecolor=style.UNSEEN, edgecolor=style.INK, linewidth=0.8,
                   zorder=30, label="robot")  # fmt: skip
    axes.add_artist(robot)
    return old, path, trail, robot
