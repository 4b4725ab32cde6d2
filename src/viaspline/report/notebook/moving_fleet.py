"""The robots of a fleet that move on plain axes, by its plan or as they drove.

Tested through ``report/notebook/test_moving_axes``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.canvas import any_name
from viaspline.report.fleet.fleet_colours import KIND_COLOURS, MAX_TOLD_APART, colours_of
from viaspline.report.fleet.places_over_time import FleetMotion, span_of
from viaspline.report.notebook.fleet_axes import draw_fleet_plan
from viaspline.report.notebook.moving_axes import animation, moments
from viaspline.report.notebook.plain_axes import axes_from, map_on, name_in_legend
from viaspline.report.sheet import view_of


@any_name()
def animate_fleet_plan(plan: FleetPlan, ax: Axes | None, pace: float, fps: float) -> FuncAnimation:
    """The robots of a plan as they are going to drive: see ``FleetPlan.animate``."""
    times = moments(np.array(span_of(plan)), pace, fps)
    axes = axes_from(ax)
    name_in_legend(axes, draw_fleet_plan(plan, axes))
    motion = FleetMotion.of_plan(plan, times)
    return _moving(axes, motion.places, motion.bodies, times, fps)


@any_name()
def animate_fleet_run(run: FleetRun, ax: Axes | None, pace: float, fps: float) -> FuncAnimation:
    """The robots of a run as they drove, on their paths: see ``FleetRun.animate``."""
    times = moments(np.array([0.0, run.end_s]), pace, fps)
    axes = axes_from(ax)
    packed = run.courses.packed
    ways = [slice(*ends) for ends in zip(packed.first[:-1], packed.first[1:], strict=True)]
    map_on(axes, view_of(packed.place, np.zeros((0, 2)), None, float(packed.reach.max())))
    lines = LineCollection(
        [packed.place[way] for way in ways], colors=_inks(len(ways)), linewidths=1.2, zorder=6
    )
    lines.set_label("paths")
    axes.add_collection(lines, autolim=False)
    name_in_legend(axes, [lines])
    places = np.empty((len(ways), len(times), 2))
    for k, (name, way) in enumerate(zip(run.names, ways, strict=True)):
        come = run.distance_at(name, times)
        for axis in (0, 1):
            places[k, :, axis] = np.interp(come, packed.distance[way], packed.place[way, axis])
    return _moving(axes, places, packed.reach - 0.5 * run.required, times, fps)


def _inks(count: int) -> list[str]:
    return colours_of(count) if count <= MAX_TOLD_APART else [KIND_COLOURS[0]] * count


def _moving(axes: Axes, places: Floats, bodies: Floats, times: Floats, fps: float) -> FuncAnimation:
    """Discs as large as bodies that are moved: places (n, t, 2) and radii (n,) [m]."""
    sizes = 2.0 * bodies
    discs = EllipseCollection(
        sizes, sizes, np.zeros(len(sizes)), units="xy", offsets=places[:, 0],
        offset_transform=axes.transData, facecolors=_inks(len(places)), edgecolors=style.INK,
        linewidths=0.8, zorder=30,
    )  # fmt: skip
    axes.add_collection(discs, autolim=False)

    def at(time: float) -> list[Artist]:
        discs.set_offsets(places[:, int(np.searchsorted(times, time))])
        axes.set_title(f"{time:.1f} s", loc="right")
        return [discs]

    return animation(axes, at, times, fps)
