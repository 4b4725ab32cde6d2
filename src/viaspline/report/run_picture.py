"""``run.png``: what was driven, how fast, what was found under way and what was done about it.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, Normalize

from viaspline.curve.path import PathVia
from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.requirements import Requirements
from viaspline.report import style
from viaspline.report.body_marks import draw_headings, draw_swept, draw_zones
from viaspline.report.canvas import any_name, png, polyline
from viaspline.report.close_up import CLOSE_UP_ROOM_IN, close_up
from viaspline.report.driven_line import draw_driven, sharpest_driven, speed_colours, thinned
from viaspline.report.labels import Labels
from viaspline.report.moving_marks import Moment, draw_moving
from viaspline.report.path_marks import draw_arrows, draw_echoes, draw_tightest, mark_sharpest
from viaspline.report.plan_picture import proof, subtitle, via_ticks
from viaspline.report.profile_strips import fill_strips, mark_clipped, strip_names, with_peaks
from viaspline.report.replan_marks import draw_replans
from viaspline.report.scene import Scene, nearest_on
from viaspline.report.sheet import Box, Sheet, new_sheet, view_of
from viaspline.report.side_column import SideColumn
from viaspline.report.space_time_column import run_space_time
from viaspline.report.units import metres, seconds
from viaspline.report.via_marks import draw_plain_vias, draw_vias
from viaspline.robot.run import Event, Replan, Run

DRAWN_VALUES = 6000  # about how many values are drawn along the path
CROSS_TRACK_STRIP = "left of path [m]"  # the strip of what a robot with a drive was off
NOTED_EVENTS = ("detected", "replanned", "skipped", "braked", "stopped", "contact")
EVENT_MARKS = {
    "detected": ("x", "detected"),
    "braked": ("v", "braked"),
    "stopped": ("X", "stopped"),
    "skipped": ("P", "gave up a via point"),
    "contact": ("*", "contact"),
}


@any_name()
def run_picture(run: Run, name: str) -> bytes:
    """The picture as PNG.

    Args:
        run: What was driven.
        name: The mission's name.
    """
    mission = run.plan.mission
    scene, view = run_scene(run)
    rows = strip_names(run.positions)
    if run.tracking is not None:
        rows.append(CROSS_TRACK_STRIP)
    sheet = new_sheet(view, rows, *_heading(run, name))
    colours, limits = speed_colours(run.speeds)
    handles = draw_run_map(sheet, scene, run)
    _fill_strips(sheet, run)
    column = SideColumn(sheet)
    column.colour_bar(colours, limits, "speed of the driven path [m/s]")
    column.legend(handles)
    run_space_time(column, run)
    column_notes = _notes(run)
    if column.room > CLOSE_UP_ROOM_IN + 0.155 * min(len(column_notes), 6):
        seen = echoes(run) if has_lidar(run) else None
        layers = partial(_draw_close, run=run, colours=colours, limits=limits)
        close_up(column, scene, run.path, run.certificate, mission.robot, layers, seen)
    column.notes("Under way", column_notes)
    return png(sheet.figure)


def run_scene(run: Run) -> tuple[Scene, Box]:
    """The world of a run, and the part of it that pictures show."""
    mission = run.plan.mission
    required = Requirements.of(mission, run.plan.tracking_error).required
    scene = Scene.of(run.plan.world, required, mission.world.unseen_standing)
    margin = max(required, mission.robot.outer_radius)
    seen = np.vstack([polyline(run.plan.path.spans), run.positions[:, :2]])
    return scene, view_of(seen, scene.corners, scene.box, margin)


def draw_run_map(sheet: Sheet, scene: Scene, run: Run) -> list[Artist]:
    """Draw a run on the map of a sheet.

    Args:
        sheet: Its map shows the part of the world that is to be seen.
        scene: The world.
        run: What was driven.

    Returns:
        What belongs in a legend.
    """
    mission = run.plan.mission
    planned, driven = polyline(run.plan.path.spans), run.positions[:, :2]
    labels = Labels(sheet.map)
    scans = has_lidar(run)
    handles = scene.draw(sheet.map, sheet.pixels_per_metre, faint=scans)
    if scans:
        handles += draw_echoes(sheet.map, echoes(run))
    else:
        scene.name(labels)
    handles += draw_zones(sheet.map, labels, mission.world.speed_zones)
    handles += draw_swept(sheet.map, run.path, mission.robot, sheet.pixels_per_metre)
    before = _draw_planned(sheet.map, planned)
    if run.replans or not run.reached:  # else the driven path covers it
        handles.append(before)
    colours, limits = speed_colours(run.speeds)
    handles.append(draw_driven(sheet.map, run.positions, run.speeds, colours, limits))
    vias, places = draw_vias(sheet.map, labels, _all_vias(run), mission)
    draw_arrows(sheet.map, thinned(driven), style.INK, avoid=places, every=150)
    if mission.robot.held_heading is not None:
        some = thinned(np.column_stack((driven, run.headings)))
        handles += draw_headings(sheet.map, some[:, :2], some[:, 2])
    handles += vias + _draw_events(sheet, labels, run)
    handles += draw_tightest(sheet.map, labels, run.certificate)
    sharpest = sharpest_driven(run)
    if sharpest is not None:
        handles += mark_sharpest(sheet.map, labels, sharpest.at, sharpest.radius)
    handles += draw_moving(sheet.map, labels, _moment(run))
    noted = [event.at[:2] for event in run.events if event.kind in _told(run)]
    labels.place(np.vstack([planned, thinned(driven)]), np.vstack([places, *noted]))
    return handles


def _draw_close(
    axes: Axes, pixels_per_metre: float, *, run: Run, colours: Colormap, limits: Normalize
) -> None:
    """What the map shows of a run, for axes that show a part of it larger."""
    mission = run.plan.mission
    draw_zones(axes, Labels(axes), mission.world.speed_zones)
    draw_swept(axes, run.path, mission.robot, pixels_per_metre)
    if run.replans or not run.reached:
        _draw_planned(axes, polyline(run.plan.path.spans))
    draw_driven(axes, run.positions, run.speeds, colours, limits)
    draw_plain_vias(axes, _all_vias(run), mission)


def _moment(run: Run) -> Moment:
    """What moves, at the run's tightest instant."""
    begin, end = float(run.times[0]), float(run.times[-1])
    met = run.encounters
    now = end if met is None or met.time is None else met.time
    x, y = run.place_at(now)[:2]
    heading = float(np.interp(now, run.times, np.unwrap(run.headings)))
    return Moment(run.moving, begin, end, now, run.plan.mission.robot, (x, y, heading))


def _heading(run: Run, name: str) -> tuple[str, tuple[str, str]]:
    end = "reached its goal" if run.reached else "did NOT reach its goal"
    title = (
        f"{style.short(name, 48)}: {end}, {metres(run.path.length, 1)} in {seconds(run.duration)}"
    )
    new = {0: "no new path under way", 1: "1 new path under way"}
    paths = new.get(len(run.replans), f"{len(run.replans)} new paths under way")
    line = f"{how_near(run)}; {paths}"
    if run.tracking is not None:
        line += f"; {metres(run.tracking.cross.p99, 3)} beside its path in 99 % of the time"
    if not run.reached:  # why is more to the point than the spline's tension
        return title, (run.reason or "", line)
    return title, (line, subtitle(run.plan.mission))


def how_near(run: Run) -> str:
    """How near it came to anything, in words; what touched it first."""
    met = run.encounters
    if met is None or not met.contacts:
        return proof(run.certificate, moving=None if met is None else met.clearance)
    stands = f"; {proof(run.certificate)}" if np.isfinite(run.certificate.clearance) else ""
    return f"{met.touched}{stands}"


def has_lidar(run: Run) -> bool:
    """Whether the robot saw surfaces, not obstacles."""
    sensor = run.plan.mission.robot.sensor
    return sensor is not None and sensor.lidar is not None


def echoes(run: Run) -> Floats:
    """The points of surfaces that a lidar had shown at the end [m], shape (n, 2)."""
    if run.known is None or not has_lidar(run):
        return np.zeros((0, 2))
    shown = run.known.obstacles[len(run.plan.world) :]
    rings = [ring for obstacle in shown if (ring := obstacle.ring) is not None and ring.is_disc]
    return np.array([ring.loops[0][0] for ring in rings]).reshape(-1, 2)


def _told(run: Run) -> tuple[str, ...]:
    """The kinds of events that are told; what a lidar shows is more than anybody wants to read."""
    return tuple(kind for kind in NOTED_EVENTS if kind != "detected" or not has_lidar(run))


def _notes(run: Run) -> list[str]:
    """What happened, line by line."""
    events = [event for event in run.events if event.kind in _told(run)]
    if not has_lidar(run):
        return [note(event) for event in events]
    lines = [(e.time, note(e)) for e in events if e.kind != "replanned"]
    lines += [(replan.time, _new_path(replan)) for replan in run.replans]
    return [line for _, line in sorted(lines, key=lambda line: line[0])]


def _new_path(replan: Replan) -> str:
    mode, length = replan.mode.replace("_", " "), metres(replan.path.length)
    return f"{replan.time:.1f} s  new path of {length} ({mode})"


def note(event: Event) -> str:
    """An event on one short line."""
    return style.short(f"{event.time:.1f} s  {event.message or event.kind}", 50)


def _draw_planned(axes: Axes, planned: Floats) -> Artist:
    (line,) = axes.plot(
        *planned.T, color=style.OLD_PATH, linewidth=1.1, linestyle=(0, (6, 2)), zorder=7,
        scalex=False, scaley=False, label="path planned before",
    )  # fmt: skip
    return line


def _all_vias(run: Run) -> list[PathVia]:
    """Points of the route as planned, detours as driven."""
    users = [via for via in run.plan.path.vias if via.kind == "user"]
    return [*users, *(via for via in run.path.vias if via.kind == "detour")]


def _draw_events(sheet: Sheet, labels: Labels, run: Run) -> list[Artist]:
    handles: dict[str, Artist] = {}
    for event in run.events:
        if event.kind not in EVENT_MARKS or event.kind not in _told(run):
            continue
        marker, words = EVENT_MARKS[event.kind]
        (handles[event.kind],) = sheet.map.plot(
            *event.at[:2], marker=marker, markersize=6.5, color=style.UNSEEN, linestyle="none",
            markeredgecolor=style.UNSEEN if marker == "x" else "white",
            markeredgewidth=1.8 if marker == "x" else 0.6, zorder=15, label=words,
        )  # fmt: skip
        if event.kind == "detected":
            _draw_sight(sheet, run, event)
        else:
            at = event.at[0], event.at[1]
            labels.add(f"{words}, {event.time:.0f} s", at, rank=2, colour=style.UNSEEN)
    return [*handles.values(), *draw_replans(sheet.map, labels, run, many=has_lidar(run))]


def _draw_sight(sheet: Sheet, run: Run, event: Event) -> None:
    """A line from where the robot was to what it saw."""
    names = run.world.names
    name = str(event.data.get("name"))
    if name not in names:
        return
    seen = nearest_on(run.world.obstacles[names.index(name)], event.at)
    if seen is None:
        return
    sheet.map.plot(
        *np.array([event.at[:2], seen]).T, color=style.UNSEEN, linewidth=0.8, linestyle=":",
        zorder=style.AROUND_MARKS, scalex=False, scaley=False,
    )  # fmt: skip


def _fill_strips(sheet: Sheet, run: Run) -> None:
    steps = np.hypot(*np.diff(run.positions[:, :2], axis=0).T)
    if run.positions.shape[1] == 3:
        steps = np.hypot(steps, np.diff(run.positions[:, 2]))
    distances = np.concatenate([[0.0], np.cumsum(steps)])
    keep = with_peaks(run.curvatures, DRAWN_VALUES)
    values = [run.speeds[keep], run.curvatures[keep]]
    if len(strip_names(run.positions)) == 3:
        values.append(run.positions[keep, 2])
    if run.tracking is not None:
        off = np.interp(run.times, run.tracking.times, run.tracking.cross_track)
        values.append(off[keep])
    fill_strips(
        sheet.strips, distances[keep], values, via_ticks(run.path, run.plan.mission), style.PATH
    )
    sharpest = sharpest_driven(run)
    if sharpest is not None:
        mark_clipped(sheet.strips[1], distances[keep], values[1], sharpest.curvature)
    for replan in run.replans:
        sheet.strips[0].axvline(replan.distance, color=style.UNSEEN, linewidth=0.9, linestyle=":")
