"""What a robot's sensor reaches at a moment of a film, and what it has found by then.

Tested through ``report/test_animation``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch, PathPatch, Polygon, Rectangle

from viaspline.kernels.arrays import Floats
from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.report import style
from viaspline.report.canvas import outline, shape_of
from viaspline.report.map_ground import MapColours, MapGround
from viaspline.report.sheet import Sheet
from viaspline.robot.perception.belief import ON_MAP_M
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.run import Run


class SensorView(ABC):
    """A sensor in a film.

    Attributes:
        artists: All that moves or comes and goes.
        handles: What belongs in a legend.
    """

    artists: tuple[Artist, ...] = ()
    handles: tuple[Artist, ...] = ()

    @abstractmethod
    def at(self, time: float, place: tuple[float, float], heading: float) -> list[Artist]:
        """What is to be drawn at a time [s], with the robot at a place [m]; times don't go back."""


def sight_of(run: Run, sheet: Sheet) -> SensorView:
    """The sensor of a run, on the map of a sheet."""
    sensor = run.plan.mission.robot.sensor
    if sensor is None:
        return _Blind()
    if sensor.lidar is not None:
        return _Beams(run, sheet, sensor.lidar)
    return _Range(run, sheet.map, sensor.reach)


class _Blind(SensorView):
    def at(self, time: float, place: tuple[float, float], heading: float) -> list[Artist]:
        return []


class _Range(SensorView):
    """A disc, and the obstacles that it has touched."""

    def __init__(self, run: Run, axes: Axes, reach: float) -> None:
        self._disc = Circle((0, 0), reach, facecolor=style.SENSOR, alpha=0.18, zorder=2.4)
        axes.add_artist(self._disc)
        self._found: list[tuple[float, Artist]] = []
        first = len(run.plan.world)
        for i, obstacle in enumerate(run.plan.mission.world.unseen_standing, first):
            near = np.flatnonzero(run.world.distances_to(i, run.positions) <= reach)
            if near.size:
                self._found.append((float(run.times[near[0]]), _found(axes, obstacle)))
        self.artists = (self._disc, *(found for _, found in self._found))
        if self._found:
            self.handles = (_in_colours(Rectangle((0, 0), 1, 1, label="found under way")),)

    def at(self, time: float, place: tuple[float, float], heading: float) -> list[Artist]:
        self._disc.set_center(place)
        return [self._disc, *(found for start, found in self._found if start <= time)]


def _found(axes: Axes, obstacle: Obstacle) -> Artist:
    """An obstacle that can be shown when it is found."""
    if obstacle.grid is not None:
        MapGround(obstacle.grid, "", MapColours(style.UNSEEN_FILL, style.UNSEEN)).draw(
            axes, zorder=5
        )
        return axes.images[-1]
    return axes.add_artist(_in_colours(PathPatch(outline(shape_of(obstacle)), zorder=5)))


def _in_colours(patch: Patch) -> Patch:
    patch.set(facecolor=style.UNSEEN_FILL, edgecolor=style.UNSEEN, hatch="////", linewidth=0.9)
    return patch


class _Beams(SensorView):
    """The ground that the beams sweep, and the points off the map that they have hit.

    A point on what moves leaves no trace: by the next look something else may be there.
    """

    def __init__(self, run: Run, sheet: Sheet, spec: Lidar) -> None:
        exact = spec.model_copy(update={"noise_m": 0.0})
        self._map = run.plan.world
        self._lidar = LidarSensor(run.world.obstacles, exact, moving=run.moving)
        self._grain = 1.0 / sheet.pixels_per_metre
        self._points: Floats = np.zeros((0, 2))
        self._fan = Polygon(
            np.zeros((3, 2)), facecolor=style.SENSOR, alpha=0.25, zorder=2.4, label="seen now"
        )
        self._dots = Line2D(
            [], [], marker=".", markersize=3.0, color=style.UNSEEN, markeredgewidth=0,
            linestyle="none", zorder=5, label="seen by the lidar",
        )  # fmt: skip
        sheet.map.add_artist(self._fan)
        sheet.map.add_artist(self._dots)
        self.artists = self.handles = (self._fan, self._dots)

    def at(self, time: float, place: tuple[float, float], heading: float) -> list[Artist]:
        scan = self._lidar.scan(place, heading, time=time)
        angles = scan.first_direction + np.arange(len(scan.ranges)) * scan.angle_increment
        ends = place + scan.free[:, None] * np.column_stack((np.cos(angles), np.sin(angles)))
        self._fan.set_xy(np.vstack([[place], ends]))
        hits = scan.hits
        if len(self._map) and len(hits):
            hits = hits[self._map.distance(hits) > ON_MAP_M]
        hits = hits[self._lidar.moving.distance(hits, time) > ON_MAP_M]
        dots = np.round(np.vstack([self._points, hits]) / self._grain)
        self._points = np.unique(dots, axis=0) * self._grain
        self._dots.set_data(*self._points.T)
        return [self._fan, self._dots]
